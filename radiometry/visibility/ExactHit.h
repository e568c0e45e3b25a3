// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

// All lengths below are in units of the scene's box, whose greatest extent lies in (0.5, 1].

// A single-precision ray starts that far behind its true start and ends that far behind its true
// end, so that rounding (6e-8) cannot make it miss what touches an end. What it finds there
// without right is rejected in double.
inline constexpr double EndMargin = 1.0 / 65536.0;
// An end closer than this to the rim of its own triangle, or to any other triangle, may fall on
// the wrong side of a neighbour when rounded: such rays are decided in double alone.
inline constexpr double Closeness = 5e-7;

// A ray that leaves its triangle at more than FreeSine, from a place farther than FreeStart from the
// rim, where nothing else is so near, is taken up at FreeStart: its own plane, rounded to single
// precision (1e-7 and as much again by the crossing), lies behind it there.
inline constexpr double FreeStart = 1.0 / 131072.0;
inline constexpr double FreeSine = 0.05;

/// A ray in double, with what the filter needs to judge a hit.
struct RayQuery
{
  Vec3 Start;
  Vec3 Direction;              // unit
  double Length = 0.0;         // may be infinite
  std::int32_t FromTriangle = -1;
  std::int32_t ToTriangle = -1;
  const std::vector<Triangle3>* Triangles = nullptr;
  const std::vector<Vec3>* Normals = nullptr;
  bool Ambiguous = false;      // single precision met a triangle's rim near an end
  bool Exact = false;          // an end is too close to a surface for single precision
  bool Free = false;           // nothing is near the start (FreeStart)
  const std::vector<std::uint8_t>* Passed = nullptr; // by triangle, 1: not asked; null: all are
};

enum class Verdict
{
  Miss,
  Hit,
  RimMiss // outside by so little that a neighbour may have been meant
};

/// Volumes of a ray with each edge of a triangle; all of one sign (or zero) where it passes inside.
/// An edge is always taken in the same direction, so that both its triangles compute one number.
struct EdgeFunctions
{
  double Least;
  double Middle;
  double Most;
  double Scale; // the longest edge
};
EdgeFunctions FindEdgeFunctions(const RayQuery& ray, const Triangle3& triangle);

/// Decides in double whether the open segment of `ray` crosses triangle `t`. With `strict`, the
/// crossing must be inside the triangle; without, only the plane is judged (single precision has
/// found the inside, watertight across shared edges).
Verdict Judge(const RayQuery& ray, std::int32_t t, bool strict, double& distance);

} // namespace radiometry
