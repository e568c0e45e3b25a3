// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionInternals.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace radiometry
{
namespace
{

/// How far from its triangle's rim towards the middle a sensor on the rim looks out.
constexpr double RimNudge = 1e-6;

/// True when `p` is within `distance` of the box.
bool Near(const Box3& box, const Vec3& p, double distance)
{
  for (int a = 0; a < 3; ++a)
  {
    if (p[a] < box.Min[a] - distance || p[a] > box.Max[a] + distance)
    {
      return false;
    }
  }
  return true;
}

RTCDevice Device()
{
  // One device for the process: creating one costs milliseconds. Never released: Embree's own
  // threads may outlive static destructors.
  static RTCDevice device = rtcNewDevice(nullptr);
  if (!device)
  {
    throw std::runtime_error("Embree could not be initialised");
  }
  return device;
}

} // namespace

OcclusionScene::OcclusionScene(const Scene& scene)
  : Impl(std::make_unique<Internals>())
{
  const std::size_t count = scene.Triangles.size();
  this->Impl->Bands = scene.Optics.Bands;
  if (count == 0)
  {
    return;
  }
  Box3 bounds;
  for (const auto& t : scene.Triangles)
  {
    for (const std::int32_t p : t)
    {
      bounds.Add(scene.Points[p]);
    }
  }
  const Vec3 size = bounds.Size();
  this->Impl->Center = bounds.Center();
  // A power of two: scaling is exact.
  this->Impl->Scale = std::exp2(-std::ceil(std::log2(std::max({ size.x, size.y, size.z }))));

  std::vector<Box3> boxes(count);
  this->Impl->Triangles.resize(count);
  this->Impl->Normals.resize(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    Triangle3& scaled = this->Impl->Triangles[t];
    const Triangle3 original = scene.TriangleAt(t);
    for (int k = 0; k < 3; ++k)
    {
      scaled[k] = this->Impl->ToBox(original[k]);
      boxes[t].Add(scaled[k]);
    }
    this->Impl->Bounds.Add(boxes[t]);
    this->Impl->Normals[t] = Normalized(AreaNormal2(scaled));
  }
  this->Impl->Tree = BoxTree(boxes);
  if (Transmission::Present(scene))
  {
    this->Impl->Panes = std::make_unique<Transmission>(scene, boxes);
  }

  RTCDevice device = Device();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.Points.size()));
  auto* indices = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned int), count));
  if (!vertices || !indices)
  {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("Embree could not allocate the geometry of " + std::to_string(count) +
      " triangles");
  }
  for (std::size_t p = 0; p < scene.Points.size(); ++p)
  {
    const Vec3 scaled = this->Impl->ToBox(scene.Points[p]);
    for (int a = 0; a < 3; ++a)
    {
      vertices[3 * p + a] = static_cast<float>(scaled[a]);
    }
  }
  for (std::size_t t = 0; t < count; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      indices[3 * t + k] = static_cast<unsigned int>(scene.Triangles[t][k]);
    }
  }
  rtcCommitGeometry(geometry);
  this->Impl->Handle = rtcNewScene(device);
#if RTC_VERSION_MAJOR >= 4
  rtcSetSceneFlags(this->Impl->Handle,
    static_cast<RTCSceneFlags>(
      RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS));
#else
  rtcSetSceneFlags(this->Impl->Handle,
    static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
#endif
  rtcAttachGeometry(this->Impl->Handle, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Impl->Handle);
}

OcclusionScene::~OcclusionScene() = default;

const ShadowLines& OcclusionScene::Lines(
  const Scene& scene, int threads, const StageProgress& stage) const
{
  std::call_once(this->Impl->LinesFlag, [&] {
    this->Impl->Lines = std::make_unique<ShadowLines>(
      scene, this->Impl->Tree, this->Impl->Center, this->Impl->Scale, threads, stage);
  });
  return *this->Impl->Lines;
}

bool OcclusionScene::Occluded(const RayEnd& from, const RayEnd& to) const
{
  return this->Impl->Occluded(this->Impl->MakeQuery(from, to));
}

bool OcclusionScene::Visible(const RayEnd& from, const RayEnd& to, double* bands) const
{
  return this->Impl->Visible(this->Impl->MakeQuery(from, to), bands);
}

bool OcclusionScene::VisibleDirection(
  const RayEnd& from, const Vec3& direction, double* bands) const
{
  return this->Impl->Visible(this->Impl->MakeQuery(from, direction), bands);
}

bool OcclusionScene::HasPanes() const
{
  return this->Impl->Panes != nullptr;
}

const std::vector<std::uint8_t>* OcclusionScene::Panes() const
{
  return this->Impl->Panes ? &this->Impl->Panes->Panes() : nullptr;
}

void OcclusionScene::Occluded(
  const RayEnd* from, std::size_t count, const RayEnd& to, std::uint8_t* hidden) const
{
  RayQuery queries[Internals::PacketSize];
  for (std::size_t k = 0; k < count; k += Internals::PacketSize)
  {
    const std::size_t n = std::min(Internals::PacketSize, count - k);
    for (std::size_t j = 0; j < n; ++j)
    {
      queries[j] = this->Impl->MakeQuery(from[k + j], to);
    }
    this->Impl->OccludedPacket(queries, n, hidden + k);
  }
}

void OcclusionScene::OccludedDirection(
  const RayEnd* from, std::size_t count, const Vec3& direction, std::uint8_t* hidden) const
{
  RayQuery queries[Internals::PacketSize];
  for (std::size_t k = 0; k < count; k += Internals::PacketSize)
  {
    const std::size_t n = std::min(Internals::PacketSize, count - k);
    for (std::size_t j = 0; j < n; ++j)
    {
      queries[j] = this->Impl->MakeQuery(from[k + j], direction);
    }
    this->Impl->OccludedPacket(queries, n, hidden + k);
  }
}

void OcclusionScene::Occluded(
  const RayEnd* from, const RayEnd* to, std::size_t count, std::uint8_t* hidden) const
{
  RayQuery queries[Internals::PacketSize];
  for (std::size_t k = 0; k < count; k += Internals::PacketSize)
  {
    const std::size_t n = std::min(Internals::PacketSize, count - k);
    for (std::size_t j = 0; j < n; ++j)
    {
      queries[j] = this->Impl->MakeQuery(from[k + j], to[k + j]);
    }
    this->Impl->OccludedPacket(queries, n, hidden + k);
  }
}

const BoxTree& OcclusionScene::Tree() const
{
  return this->Impl->Tree;
}

bool OcclusionScene::OccludedDirection(const RayEnd& from, const Vec3& direction) const
{
  return this->Impl->Occluded(this->Impl->MakeQuery(from, direction));
}

bool OcclusionScene::TooClose(const Vec3& point) const
{
  const Vec3 p = this->Impl->ToBox(point);
  return !this->Impl->Tree.Visit(
    [&](const Box3& box) { return Near(box, p, Closeness); },
    [&](std::int32_t t) {
      const Triangle3& v = this->Impl->Triangles[t];
      return std::fabs(Dot(this->Impl->Normals[t], p - v[0])) > Closeness;
    });
}

std::int32_t OcclusionScene::Touching(Vec3& point, const Vec3& normal, double rounding) const
{
  const double reach = std::max(1e-12, this->Impl->Scale * rounding);
  const Vec3 p = this->Impl->ToBox(point);
  std::int32_t found = -1;
  double nearest = reach;
  this->Impl->Tree.Visit([&](const Box3& box) { return Near(box, p, reach); },
    [&](std::int32_t t) {
      const Triangle3& v = this->Impl->Triangles[t];
      const Vec3& n = this->Impl->Normals[t];
      const double h = std::fabs(Dot(n, p - v[0]));
      bool inside = std::fabs(Dot(n, normal)) > 0.866;
      for (int k = 0; k < 3 && inside; ++k)
      {
        const Vec3 edge = Normalized(v[(k + 1) % 3] - v[k]);
        inside = Dot(n, Cross(edge, p - v[k])) > -reach;
      }
      if (inside && (h < nearest || (h == nearest && (found < 0 || t < found))))
      {
        nearest = h;
        found = t;
      }
      return true;
    });
  if (found >= 0)
  {
    const Triangle3& v = this->Impl->Triangles[found];
    const Vec3& n = this->Impl->Normals[found];
    Vec3 moved = p - Dot(n, p - v[0]) * n;
    if (this->Impl->NearRim(moved, found))
    {
      // On the rim it is on the neighbours too, walls among them: a little inside it is not.
      moved = moved + RimNudge * (Centroid(v) - moved);
    }
    point = this->Impl->Center + moved / this->Impl->Scale;
  }
  return found;
}

void OcclusionScene::PrepareRays(int threads) const
{
  Internals& m = *this->Impl;
  std::call_once(m.CrowdedFlag, [&] {
    std::vector<std::uint8_t> crowded(m.Triangles.size());
    ParallelFor(
      crowded.size(), threads, {},
      [&](std::size_t t) { crowded[t] = m.FindCrowded(static_cast<std::int32_t>(t)); }, 2e-6);
    m.Crowded = std::move(crowded);
    m.KnowsCrowded.store(true, std::memory_order_release);
  });
}

SurfaceHit OcclusionScene::Closest(const RayEnd& from, const Vec3& direction) const
{
  SurfaceHit hit = this->Impl->Closest(this->Impl->MakeQuery(from, direction));
  if (hit.Triangle >= 0)
  {
    hit.Distance /= this->Impl->Scale * Length(direction);
  }
  return hit;
}

} // namespace radiometry
