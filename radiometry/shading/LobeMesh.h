// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/shading/Reflectance.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// How a BRDF becomes a shape.
struct LobeShape
{
  Vec3 Normal{ 0.0, 0.0, 1.0 };   // any length but 0
  Vec3 Toward{ 1.0, 0.0, 1.0 };   // to where the light comes from, above the surface
  bool Cosine = false;            // radius by f cos(theta_out) instead of f
  double Decades = 0.0;           // above 0: radius by the logarithm, 0 that far below the greatest
  double Radius = 1.0;            // of the greatest value, m; 0: 1 m for 1/sr (linear only)
  int Resolution = 64;            // rings from the lobe's axis to the horizon; twice as many around
};

/// A BRDF for one incident direction as a mesh over the hemisphere: the point in direction w lies at
/// the distance r(w).
///   Model    rings about the mirror direction, from there to the horizon; half of them where the lobe
///            is, however sharp, so that an exponent of 1000 is as smooth as one of 1
///   Cost     2 Resolution^2 evaluations
///   Fails    CheckBrdf; InputError{"Shininess"} for a perfect mirror, {"IncidentDirection"} for light
///            that does not come from above, {"Normal"}, {"Decades"}, {"Radius"}, {"Resolution"}
struct LobeMesh
{
  std::vector<Vec3> Directions; // unit, to where light leaves
  std::vector<Vec3> Points;     // about the origin
  std::vector<double> Values;   // f_r, 1/sr
  std::vector<double> Cosines;  // of theta_out
  /// Corners of triangles and quadrilaterals one after the other, counter-clockwise from outside.
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Corners;
  double CosIncident = 1.0;
  double Greatest = 0.0; // of f_r, or of f_r cos where the radius is by that
};
/// A direction at that angle (radians) from a normal, on the side of x, or of y where the normal is x.
Vec3 TowardAtAngle(const Vec3& normal, double angle);

LobeMesh MakeLobeMesh(const Brdf& brdf, const LobeShape& shape);

/// The greatest distance of a point of it.
double GreatestDistance(const LobeMesh& mesh);

/// The integral of f cos(theta) over the directions of a mesh, by its cells: what the mesh as it is
/// drawn reflects.
double MeshReflectance(const LobeMesh& mesh);

} // namespace radiometry
