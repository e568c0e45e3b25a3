// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// A piece of one side of the surface: the unit of receiving and of sending light.
struct Patch
{
  Triangle3 Corners;           // counter-clockwise seen from the side that this patch stands for
  std::int32_t Triangle = -1;  // the scene's triangle on whose plane it lies
  std::int32_t Cell = -1;      // the caller's cell
  std::uint8_t Side = 0;       // 0 front of the cell, 1 back
};

/// A place on (or off) the surface with the normal that light is received about.
struct SurfacePoint
{
  Vec3 Point;
  Vec3 Normal;                // unit
  std::int32_t Triangle = -1; // the scene's triangle on whose plane it lies; -1: a free sensor
  /// A vertex of the surface: the scene's triangles that meet there in one smooth sheet. What hides
  /// the light is then asked just inside each of them that faces it (a vertex itself lies on every
  /// neighbour at once, walls of a corner included), and the answers are averaged. Empty: ask at
  /// the point itself.
  std::vector<std::int32_t> Around;
  /// How far rounding of its coordinates may have moved a free sensor off a surface it lies on, m.
  double Rounding = 0.0;
};

} // namespace radiometry
