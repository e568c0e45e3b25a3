// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <memory>
#include <vector>

namespace radiometry
{

class CandelaWeb;
class SkyRadiance;

/// The values of the LightType array.
enum class LightType
{
  Point = 0,
  Spot = 1,
  Directional = 2,
  Area = 3,
  Environment = 4
};

/// One light, in SI units and radians, in the coordinates of its Scene.
struct Light
{
  LightType Type = LightType::Point;
  Vec3 Position;                       // m; not used by directional and environment lights
  Vec3 Direction{ 0.0, 0.0, -1.0 };    // unit; where the light travels to; environment: down
  /// Unit and square to Direction: where C = 0 of a web lies, or azimuth 0 of an environment.
  Vec3 Reference{ 1.0, 0.0, 0.0 };
  std::vector<double> Intensity;       // per band; W/sr on the axis (web: at its greatest value),
                                       // W/m^2 normal to the beam, exitance W/m^2, or W/(m^2 sr)
  double CosCutoff = -1.0;             // cosine of the cone's half-angle; -1: no cone (180 degrees)
  double CosInnerCutoff = -1.0;        // with SmoothEdge: full intensity inside this cosine
  /// 1 - cos of the two angles with all the digits of a narrow beam; below 0: from the cosines.
  double VersineCutoff = -1.0;
  double VersineInnerCutoff = -1.0;
  bool SmoothEdge = false;             // glTF's inner/outer cone: ((cos - outer)/(inner - outer))^2
  double Exponent = 0.0;               // I(phi) = I0 cos^e(phi)
  double Attenuation[3] = { 0.0, 0.0, 1.0 }; // 1/(a + b r + c r^2)
  std::vector<Vec3> Polygon;           // area: corners, counter-clockwise seen from where it lights
  bool TwoSided = false;               // area: lights both sides
  std::shared_ptr<const CandelaWeb> Web;         // point: relative to its greatest value; null: none
  std::shared_ptr<const SkyRadiance> Environment; // environment: relative to Intensity
  bool Enabled = true;
  long long Index = 0;                 // tuple in the input, for messages

  /// True when the attenuation is the inverse square of physics.
  bool InverseSquare() const
  {
    return Attenuation[0] == 0.0 && Attenuation[1] == 0.0 && Attenuation[2] == 1.0;
  }
};

} // namespace radiometry
