// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// The Phong exponent of cells without one, and that from which a surface is a perfect mirror.
inline constexpr double DefaultShininess = 10.0;
inline constexpr double MirrorShininess = 1e6;

/// Optical properties of the cells of a surface. Arrays hold cells x bands values, cell by cell.
/// Index 0 is the front, 1 the back.
struct Materials
{
  int Bands = 1;
  std::array<std::vector<double>, 2> DiffuseReflectance;
  std::array<std::vector<double>, 2> SpecularReflectance; // empty: none anywhere
  std::array<std::vector<double>, 2> EmittedExitance;     // W/m^2; empty: none anywhere
  std::array<std::vector<double>, 2> Shininess;           // per cell, Phong exponent; empty: 10
  std::vector<double> Transmittance;                      // straight through; empty: opaque
  std::vector<double> DiffuseTransmittance; // of what falls on either side, leaves the other; empty: 0
  std::vector<std::uint8_t> TwoSided;                     // per cell
};

/// What the core computes on: a surface of triangles that belong to the caller's cells, further
/// triangles that only block light, and lights.
///
/// Coordinates are metres relative to Origin (subtracted in double, so that scenes in UTM metres
/// lose nothing). Points with equal coordinates are one point: the connectivity of the triangles
/// is that of the surface, whatever seams the file had.
struct Scene
{
  Vec3 Origin;
  std::vector<Vec3> Points;
  /// Receivers first ([0, ReceiverTriangles)), then triangles that only occlude.
  std::vector<std::array<std::int32_t, 3>> Triangles;
  /// The caller's cell of each receiver triangle; -1 for triangles that only occlude.
  std::vector<std::int32_t> TriangleCell;
  std::size_t ReceiverTriangles = 0;
  std::size_t Cells = 0;
  Materials Optics;
  /// Share that passes straight through, triangles x bands, occluders included; empty: all opaque.
  std::vector<double> TriangleTransmittance;
  std::vector<Light> Lights;
  std::vector<double> GlobalAmbient; // irradiance of every point, per band, W/m^2; empty: none

  Triangle3 TriangleAt(std::size_t t) const
  {
    const auto& v = this->Triangles[t];
    return { this->Points[v[0]], this->Points[v[1]], this->Points[v[2]] };
  }
};

} // namespace radiometry
