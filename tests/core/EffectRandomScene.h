// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace test
{

/// What a random scene is for: its size and how hard the tolerance is.
enum class RandomSize
{
  Direct,   // some tens of cells
  Radiosity // some ten cells
};

/// A small and nasty scene with all that a plan decides on, in any mix.
struct RandomScene
{
  radiometry::Scene Scene;
  std::vector<radiometry::SurfacePoint> Points; // vertices of the surface, then free sensors
  double RelativeTolerance = 0.0;
  double AbsoluteTolerance = 0.0; // W/m^2
  std::string What;               // in words, for messages
};

/// The scene of a seed, the same on every machine that has this standard library's random numbers:
///   Shapes     a convex body, a room, a hall with boxes, a soup of triangles, sheets, a body in a room;
///              of any size and place, up to metres of UTM
///   Materials  diffuse, specular, mirrors, emitting, panes, sheets that scatter light through,
///              two-sided, black; 1 to 4 bands, some of them identical
///   Lights     point, spot, directional, panels, skies, luminaires; cones, smooth edges, exponents,
///              legacy attenuation; disabled, far, behind, weak; a global ambient light
RandomScene MakeRandomScene(std::uint64_t seed, RandomSize size);

} // namespace test
