// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionInternals.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

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
  this->Impl->Bands = scene.Optics.Bands;
  if (scene.Triangles.empty())
  {
    return;
  }
  // What everything else is made of when it is first asked for: a copy, for the scene may be gone.
  this->Impl->Points = scene.Points;
  this->Impl->Corners = scene.Triangles;
  if (Transmission::Present(scene))
  {
    this->Impl->Build();
    std::vector<Box3> boxes(this->Impl->Triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
    {
      for (const Vec3& p : this->Impl->Triangles[t])
      {
        boxes[t].Add(p);
      }
    }
    this->Impl->Panes = std::make_unique<Transmission>(scene, boxes);
  }
}

/// Triangles in the unit box and the tree over them.
void OcclusionScene::Internals::Build()
{
  std::call_once(this->BuildFlag, [&] {
    tbb::this_task_arena::isolate([&] { this->BuildTree(); });
    this->Built.store(true, std::memory_order_release);
  });
}

void OcclusionScene::Internals::BuildTree()
{
  const std::size_t count = this->Corners.size();
  Box3 bounds;
  for (const auto& t : this->Corners)
  {
    for (const std::int32_t p : t)
    {
      bounds.Add(this->Points[p]);
    }
  }
  if (count == 0)
  {
    return;
  }
  const Vec3 size = bounds.Size();
  this->Center = bounds.Center();
  // A power of two: scaling is exact.
  this->Scale = std::exp2(-std::ceil(std::log2(std::max({ size.x, size.y, size.z }))));
  std::vector<Box3> boxes(count);
  this->Triangles.resize(count);
  this->Normals.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t)
    {
      Triangle3& scaled = this->Triangles[t];
      for (int k = 0; k < 3; ++k)
      {
        scaled[k] = this->ToBox(this->Points[this->Corners[t][k]]);
        boxes[t].Add(scaled[k]);
      }
      this->Normals[t] = Normalized(AreaNormal2(scaled));
    }
  });
  for (const Box3& box : boxes)
  {
    this->Bounds.Add(box);
  }
  this->Tree = BoxTree(boxes);
}

/// Embree's own hierarchy, for the first ray.
void OcclusionScene::Internals::BuildRays()
{
  this->Build();
  std::call_once(this->RaysFlag, [&] {
    tbb::this_task_arena::isolate([&] { this->BuildHandle(); });
    this->HasRays.store(true, std::memory_order_release);
  });
}

void OcclusionScene::Internals::BuildHandle()
{
  const std::size_t count = this->Corners.size();
  if (count == 0)
  {
    return;
  }
  RTCDevice device = Device();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), this->Points.size()));
  auto* indices = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned int), count));
  if (!vertices || !indices)
  {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("Embree could not allocate the geometry of " + std::to_string(count) +
      " triangles");
  }
  for (std::size_t p = 0; p < this->Points.size(); ++p)
  {
    const Vec3 scaled = this->ToBox(this->Points[p]);
    for (int a = 0; a < 3; ++a)
    {
      vertices[3 * p + a] = static_cast<float>(scaled[a]);
    }
  }
  for (std::size_t t = 0; t < count; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      indices[3 * t + k] = static_cast<unsigned int>(this->Corners[t][k]);
    }
  }
  rtcCommitGeometry(geometry);
  this->Handle = rtcNewScene(device);
#if RTC_VERSION_MAJOR >= 4
  rtcSetSceneFlags(this->Handle,
    static_cast<RTCSceneFlags>(
      RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS));
#else
  rtcSetSceneFlags(this->Handle,
    static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
#endif
  rtcAttachGeometry(this->Handle, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Handle);
}

void OcclusionScene::Prepare() const
{
  this->Impl->BuildRays();
}

bool OcclusionScene::HasRays() const
{
  return this->Impl->HasRays.load(std::memory_order_acquire);
}

double OcclusionScene::BuildingSeconds(int threads) const
{
  // A triangle, on one thread (measured on a 2.5 GHz Xeon); the tree hardly gains by more.
  constexpr double tree = 0.4e-6;
  constexpr double rays = 0.9e-6;
  constexpr double lines = 1.2e-6;
  const int available = AvailableThreads();
  const double workers = threads > 0 ? std::min(threads, available) : available;
  const Internals& m = *this->Impl;
  const double each = (m.Built.load() ? 0.0 : tree) +
    ((m.HasRays.load() ? 0.0 : rays) + (m.Lines ? 0.0 : lines)) / (0.5 * workers + 0.5);
  return each * static_cast<double>(m.Corners.size());
}

std::size_t OcclusionScene::MemoryBytes() const
{
  const Internals& m = *this->Impl;
  std::size_t bytes = m.Points.size() * sizeof(Vec3) + m.Corners.size() * sizeof(m.Corners[0]);
  if (m.Built.load(std::memory_order_acquire))
  {
    bytes += m.Triangles.size() * (sizeof(Triangle3) + sizeof(Vec3) + sizeof(std::int32_t)) +
      m.Tree.Size() * sizeof(BoxTree::Node);
  }
  if (this->HasRays())
  {
    constexpr std::size_t embree = 150; // a triangle, measured
    bytes += m.Corners.size() * embree;
  }
  constexpr std::size_t lines = 32; // a triangle: its edges and cones
  return bytes + (m.Lines ? m.Corners.size() * lines : 0);
}

OcclusionScene::~OcclusionScene() = default;

const ShadowLines& OcclusionScene::Lines(
  const Scene& scene, int threads, const StageProgress& stage) const
{
  this->Impl->Build();
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
  this->Impl->Build();
  return this->Impl->Tree;
}

bool OcclusionScene::OccludedDirection(const RayEnd& from, const Vec3& direction) const
{
  return this->Impl->Occluded(this->Impl->MakeQuery(from, direction));
}

bool OcclusionScene::TooClose(const Vec3& point) const
{
  this->Impl->Build();
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
  this->Impl->Build();
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
  m.Build();
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
