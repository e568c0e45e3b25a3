// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/shading/LightingModel.h"

#include <limits>

namespace radiometry
{

/// A triangle as smooth shading sees it: normals of any length that are interpolated as they are and
/// made unit where the model is evaluated.
struct ShadedTriangle
{
  Triangle3 Points;
  std::array<Vec3, 3> Normals;
};

/// How far Gouraud shading (the light of the corners, interpolated) can be from Phong shading (the
/// light of the interpolated normal) anywhere on a triangle: a proven bound on the difference of the
/// colours, in the greatest band, on the front (and on the back where the model is two-sided).
///   Model   Every quantity q that light is made of is kept as its three values at the corners and a
///           bound e on |q - Iq| over the triangle, where Iq interpolates the corners linearly. Then q
///           lies within [min q_i - e, max q_i + e], and with Q = max |q_i|
///             q + r      e_q + e_r
///             q r        e_q (R + e_r) + Q e_r + max |sum_{i<j} w_i w_j (q_i - q_j)(r_i - r_j)|,
///                        where w_i w_j <= 1/4 and their sum <= 1/3
///             f(q)       max|f'| e_q + max|f''| (max q_i - min q_i)^2 / 8     (Popoviciu's variance),
///                        for monotone f at most f's range
///             max(q, 0)  e_q + a b/(a + b), where the corners' q go from -b to a
///           Positions and normals are linear: e = 0. All terms are of second order in the
///           triangle's size, so the bound falls as the difference itself does. A cone with a hard
///           edge, and a legacy highlight where its light sets, jump: there the bound is their height.
///   Inputs  as for Shade(); eye and viewer as in ShadingSample. Exact arithmetic is assumed; the
///           rounding of float32 (about 1e-6) comes on top.
///   Cost    O(lights), some 100 ns each; stops at `enough`: a result above it is only known to be so
///   Fails   infinite where nothing can be said: a light or the eye within about the triangle's size,
///           normals that turn by more than about a right angle, values that are not finite, lights
///           with a web, a polygon or a sky
double ShadingBound(const LightingModel& model, const std::vector<DisplayLight>& lights,
  const DisplayMaterial& front, const DisplayMaterial& back, const Vec3& eye, const Vec3& viewer,
  const ShadedTriangle& triangle, double enough = std::numeric_limits<double>::infinity());

/// What a surface is shaded with, beside its triangles.
struct ShadedScene
{
  LightingModel Model;
  std::vector<DisplayLight> Lights;
  DisplayMaterial Front;
  DisplayMaterial Back;
  Vec3 Eye;
  Vec3 Viewer{ 0.0, 0.0, 1.0 };
};

/// Triangles by the numbers of their points, three each; points and normals have equal numbers.
struct ShadedMesh
{
  std::vector<Vec3> Points;
  std::vector<Vec3> Normals;
  std::vector<unsigned int> Corners;
  std::size_t Size() const { return this->Corners.size() / 3; }
};

/// Sets flags[t] to 1 for the triangles t in [begin, end) whose ShadingBound is at most `tolerance`,
/// to 0 for the others. On all threads; the result does not depend on their number.
void MarkGouraud(const ShadedScene& scene, const ShadedMesh& mesh, std::size_t begin,
  std::size_t end, double tolerance, std::vector<float>& flags);

} // namespace radiometry
