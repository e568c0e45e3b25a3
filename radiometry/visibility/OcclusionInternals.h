// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/visibility/ExactHit.h"
#include "radiometry/visibility/OcclusionScene.h"
#include "radiometry/visibility/ShadowLines.h"
#include "radiometry/visibility/Transmission.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <atomic>
#include <memory>
#include <mutex>

namespace radiometry
{

/// What an OcclusionScene is made of, in coordinates scaled to the unit box. Rays are made in
/// OcclusionExact.cxx, where what single precision cannot decide is decided, too; Embree is asked in
/// OcclusionRays.cxx.
struct OcclusionScene::Internals
{
  std::vector<Vec3> Points; // of the scene, m
  std::vector<std::array<std::int32_t, 3>> Corners;
  // What follows is made when it is first asked for: Build() by whoever makes a ray or looks into
  // the tree, BuildRays() by the first ray.
  std::once_flag BuildFlag;
  std::atomic<bool> Built{ false };
  std::once_flag RaysFlag;
  std::atomic<bool> HasRays{ false };
  Vec3 Center;
  double Scale = 1.0;
  Box3 Bounds; // of the scaled triangles
  std::vector<Triangle3> Triangles;
  std::vector<Vec3> Normals; // unit
  BoxTree Tree;
  RTCScene Handle = nullptr;
  std::once_flag CrowdedFlag;
  std::vector<std::uint8_t> Crowded; // by triangle: 1, 2: something stands on its front, its back
  std::atomic<bool> KnowsCrowded{ false };
  std::once_flag LinesFlag;
  std::unique_ptr<ShadowLines> Lines;
  int Bands = 1;
  std::unique_ptr<Transmission> Panes; // null: all is opaque

  ~Internals()
  {
    if (this->Handle)
    {
      rtcReleaseScene(this->Handle);
    }
  }

  void Build();
  void BuildTree();
  void BuildRays();
  void BuildHandle();
  /// Everything that a ray needs.
  void Ready() const
  {
    if (!this->HasRays.load(std::memory_order_acquire))
    {
      const_cast<Internals*>(this)->BuildRays();
    }
  }

  Vec3 ToBox(const Vec3& p) const { return this->Scale * (p - this->Center); }

  /// The part of the ray inside the scene's box, or false when it passes by.
  bool Clip(const RayQuery& q, double& begin, double& end) const;
  /// Everything in double: for the rare ray that single precision cannot decide.
  SurfaceHit ExactClosest(const RayQuery& q, double begin, double end) const;
  /// True when `p`, on triangle t, is close to the triangle's rim.
  bool NearRim(const Vec3& p, std::int32_t t) const;
  /// True when single precision cannot keep the ray on its side of the triangle's plane.
  bool Grazes(const Vec3& direction, std::int32_t t) const;
  /// Side, distance and barycentric coordinates of a hit, in double.
  void Complete(const RayQuery& q, SurfaceHit& hit) const;
  RayQuery MakeQuery(const RayEnd& from, const Vec3& direction) const;
  RayQuery MakeQuery(const RayEnd& from, const RayEnd& to) const;

  bool Occluded(RayQuery q) const;
  /// What gets through along the ray, a share a band.
  bool Visible(RayQuery q, double* bands) const;
  /// Rays of neighbours, sixteen at a time.
  static constexpr std::size_t PacketSize = 16;
  void OccludedPacket(RayQuery* queries, std::size_t count, std::uint8_t* hidden) const;
  SurfaceHit Closest(const RayQuery& q) const;
  /// The same, every hit near the start judged in double.
  SurfaceHit ClosestJudged(RayQuery q) const;
  /// What stands over the triangle closer than FreeStart: bits as of Crowded.
  std::uint8_t FindCrowded(std::int32_t t) const;
  /// True when nothing can be met nearer than FreeStart along a ray from a triangle.
  bool StartsFree(const RayQuery& q) const;
  /// Closest of such a ray by single precision alone; false where that cannot tell.
  bool ClosestFree(const RayQuery& q, SurfaceHit& hit) const;
  /// Completes what single precision met; false where the ray only seems to meet it.
  bool Accept(const RayQuery& q, std::int32_t triangle, SurfaceHit& hit) const;
};

} // namespace radiometry
