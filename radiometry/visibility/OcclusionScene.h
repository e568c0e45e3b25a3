// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

class BoxTree;
class ShadowLines;

/// What a ray meets first.
struct SurfaceHit
{
  std::int32_t Triangle = -1; // -1: nothing
  bool Front = false;         // met from its front
  double Distance = 0.0;      // in units of the direction's length
  double U = 0.0;             // the hit is (1-u-v) p0 + u p1 + v p2
  double V = 0.0;
};

/// A point from or to which light is followed: the triangle on whose plane it lies exactly, or -1
/// for a point in free space.
struct RayEnd
{
  Vec3 Point;
  std::int32_t Triangle = -1;
  /// Closer to a surface than single precision can tell (see OcclusionScene::TooClose): rays of
  /// this end are decided in double throughout. Set for free points; found out for others.
  bool Close = false;
};

/// Visibility among the triangles of a scene: Embree in coordinates recentred and scaled to the
/// unit box, with every hit near either end of a ray decided again in double, the end taken as
/// exactly on its own plane. No offset in metres; a triangle never hides its own points; triangles
/// coplanar with an end's triangle do not hide it.
///
/// Made lazily: the tree over the triangles when it or a ray is first asked for, Embree's hierarchy
/// for the first ray, so that a scene in which nothing hides anything pays for neither. Prepare()
/// where many threads are about to ask: they would wait for the one that came first.
///
/// Thread-safe after construction.
class OcclusionScene
{
public:
  explicit OcclusionScene(const Scene& scene);
  ~OcclusionScene();
  OcclusionScene(const OcclusionScene&) = delete;
  OcclusionScene& operator=(const OcclusionScene&) = delete;

  /// Makes what rays need, with all threads.
  void Prepare() const;
  /// Whether that has been made.
  bool HasRays() const;
  /// About how long that, and Lines, will take: 0 where they are there.
  double BuildingSeconds(int threads) const;
  /// Of all that has been made so far; what Embree takes is estimated.
  std::size_t MemoryBytes() const;

  /// True when the segment between the two ends is blocked.
  bool Occluded(const RayEnd& from, const RayEnd& to) const;
  /// True when the ray from `from` along `direction` (any length) meets anything.
  bool OccludedDirection(const RayEnd& from, const Vec3& direction) const;
  /// What gets from one end to the other straight through the panes in between (Transmission.h), a
  /// share a band; false, and no band told, when nothing does. `bands` has room for the scene's.
  bool Visible(const RayEnd& from, const RayEnd& to, double* bands) const;
  /// The same along a ray from `from` (any length).
  bool VisibleDirection(const RayEnd& from, const Vec3& direction, double* bands) const;
  /// True when some triangle lets light through; the queries above but these two take it as opaque.
  bool HasPanes() const;
  /// For each triangle of the scene 1 where it lets light through; null where none does.
  const std::vector<std::uint8_t>* Panes() const;
  /// The same from many starts: hidden[k] is 1 where the segment from from[k] is blocked. Fastest
  /// where neighbours in the list are neighbours in space.
  void Occluded(const RayEnd* from, std::size_t count, const RayEnd& to, std::uint8_t* hidden) const;
  void OccludedDirection(
    const RayEnd* from, std::size_t count, const Vec3& direction, std::uint8_t* hidden) const;
  /// ... and to as many ends: hidden[k] is 1 where the segment from from[k] to to[k] is blocked.
  void Occluded(const RayEnd* from, const RayEnd* to, std::size_t count, std::uint8_t* hidden) const;
  /// The lines at which shadows can begin or end, found when first asked for. `scene`: the one this
  /// was made of.
  const ShadowLines& Lines(
    const Scene& scene, int threads, const StageProgress& stage = {}) const;
  /// True when a free point (a light, a sensor) lies so near a triangle that its rays must be
  /// decided in double: what RayEnd::Close should be.
  bool TooClose(const Vec3& point) const;
  /// The triangle that a free point lies on, within `rounding` (m, and at least 1e-12 of the scene's
  /// size), and whose plane is square to `normal` within 30 degrees; -1: none. `point` is then moved
  /// onto its plane, and from its rim a millionth of the way inside.
  std::int32_t Touching(Vec3& point, const Vec3& normal, double rounding) const;
  /// Finds out where rays may leave surfaces without a look at what is near: some microseconds a
  /// triangle, once. Closest is then faster; its answers are the same.
  void PrepareRays(int threads = 0) const;
  /// The first triangle along a ray.
  SurfaceHit Closest(const RayEnd& from, const Vec3& direction) const;

  /// The tree over the scene's triangles, in coordinates of its own.
  const BoxTree& Tree() const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
