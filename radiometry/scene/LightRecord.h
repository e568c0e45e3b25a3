// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"

#include <memory>
#include <string>
#include <vector>

namespace radiometry
{

/// One light as the light arrays of docs/arrays.md hold it: SI units, but angles in degrees as in
/// the arrays. What sources and readers hand over, before a simulation turns it into a Light.
struct LightRecord
{
  std::string Name;
  LightType Type = LightType::Point;
  Vec3 Position;                        // m
  Vec3 Direction{ 0.0, 0.0, -1.0 };     // unit; where the light travels to
  Vec3 Reference{ 1.0, 0.0, 0.0 };      // C = 0 of a web, azimuth 0 of an environment
  std::vector<double> Intensity{ 1.0 }; // per band; unit as in docs/arrays.md, by type
  double SpotCutoff = 180.0;            // degrees
  double SpotInnerCutoff = -1.0;        // degrees; < 0: hard edge
  double SpotExponent = 0.0;
  Vec3 Attenuation{ 0.0, 0.0, 1.0 };
  std::vector<Vec3> Polygon;            // area: corners, m
  bool TwoSided = false;                // area
  std::shared_ptr<const CandelaWeb> Web;
  std::shared_ptr<const SkyRadiance> Environment;
  bool Enabled = true;
  int AttachedTo = 0; // 0 scene, 1 object, 2 camera
};

/// Throws InputError, naming the light array at fault, when the record cannot be simulated:
/// non-finite or negative numbers, a zero direction, a cone outside its range, an attenuation that
/// vanishes everywhere.
void Validate(const LightRecord& light, long long index = -1);

/// The light of a simulation: metres relative to `origin`, radians, a unit direction. A spot of 180
/// degrees has no cone and, as in OpenGL, no exponent.
Light ToLight(
  const LightRecord& record, double metersPerUnit, const Vec3& origin, std::size_t index);

/// The direction as a unit vector. Throws InputError naming `name` when it is not finite or zero.
Vec3 UnitDirection(const char* name, const Vec3& direction, long long index = -1);

/// Flux of a spot per unit of its axial intensity [sr]: the integral over the cone of
/// cos^e(phi) f(phi) with f = 1 (hard edge) or glTF's smooth edge
/// f = min(1, ((cos phi - cos outer)/(cos inner - cos outer))^2).
///   Model   hard: 2 pi (1 - cos^{e+1} outer)/(e + 1);  no cone (180 degrees): 4 pi
///   Exact   closed form; where the smooth edge is so narrow that the closed form would cancel,
///           a Gauss-Legendre rule that is exact to rounding there
double SpotFluxFactor(double cutoffDegrees, double innerCutoffDegrees, double exponent);

} // namespace radiometry
