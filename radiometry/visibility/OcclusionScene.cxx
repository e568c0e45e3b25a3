// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionScene.h"

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/visibility/ExactHit.h"
#include "radiometry/visibility/ShadowLines.h"
#include "radiometry/visibility/Transmission.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

namespace radiometry
{
namespace
{

#if RTC_VERSION_MAJOR >= 4
using FilterContext = RTCRayQueryContext;
#else
using FilterContext = RTCIntersectContext;
#endif

struct QueryContext
{
  FilterContext Context; // first: Embree hands back its address
  RayQuery* Queries;     // by the rays' ids
};

void Filter(const RTCFilterFunctionNArguments* args)
{
  for (unsigned int i = 0; i < args->N; ++i)
  {
    if (args->valid[i] == 0)
    {
      continue;
    }
    RayQuery& query = reinterpret_cast<QueryContext*>(args->context)
                        ->Queries[RTCRayN_id(args->ray, args->N, i)];
    const auto t = static_cast<std::int32_t>(RTCHitN_primID(args->hit, args->N, i));
    const double along = RTCRayN_tfar(args->ray, args->N, i) - EndMargin;
    const bool nearEnd =
      along < 2.0 * EndMargin || along > query.Length - 2.0 * EndMargin;
    if (t == query.FromTriangle && nearEnd)
    {
      args->valid[i] = 0; // what every ray from a surface meets first
      continue;
    }
    double distance = 0.0;
    const Verdict verdict = Judge(query, t, nearEnd, distance);
    if (verdict != Verdict::Hit)
    {
      args->valid[i] = 0;
      // Far from both ends single precision meets what double does not only where the ray runs
      // along a surface: its neighbours may then have been missed. (A pane is passed on purpose.)
      const bool pane = query.Passed && (*query.Passed)[t] != 0;
      query.Ambiguous =
        query.Ambiguous || verdict == Verdict::RimMiss || (!nearEnd && !pane);
    }
  }
}

/// Rays that leave a surface at less than this sine are decided in double: where hits are no longer
/// judged one by one (EndMargin away) they would be within rounding of their own plane.
constexpr double GrazingSine = 1e-7 / EndMargin;

/// How far from its triangle's rim towards the middle a sensor on the rim looks out.
constexpr double RimNudge = 1e-6;

/// The length, without the cost of guarding against overflow where there is none.
double Norm(const Vec3& a)
{
  const double l2 = LengthSquared(a);
  return l2 > 1e-280 && l2 < 1e280 ? std::sqrt(l2) : std::max(Length(a), 1e-300);
}

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

struct OcclusionScene::Internals
{
  Vec3 Center;
  double Scale = 1.0;
  Box3 Bounds; // of the scaled triangles
  std::vector<Triangle3> Triangles;
  std::vector<Vec3> Normals; // unit
  BoxTree Tree;
  RTCScene Handle = nullptr;
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

  Vec3 ToBox(const Vec3& p) const { return this->Scale * (p - this->Center); }

  /// The part of the ray inside the scene's box, or false when it passes by.
  bool Clip(const RayQuery& q, double& begin, double& end) const
  {
    begin = 0.0;
    end = q.Length;
    for (int a = 0; a < 3; ++a)
    {
      const double lo = this->Bounds.Min[a] - EndMargin - q.Start[a];
      const double hi = this->Bounds.Max[a] + EndMargin - q.Start[a];
      const double d = q.Direction[a];
      if (d == 0.0)
      {
        if (lo > 0.0 || hi < 0.0)
        {
          return false;
        }
        continue;
      }
      const double inverse = 1.0 / d;
      begin = std::max(begin, std::min(lo * inverse, hi * inverse));
      end = std::min(end, std::max(lo * inverse, hi * inverse));
    }
    return begin <= end;
  }

  /// Everything in double: for the rare ray that single precision cannot decide.
  SurfaceHit ExactClosest(const RayQuery& q, double begin, double end) const
  {
    SurfaceHit best;
    best.Distance = std::numeric_limits<double>::infinity();
    const Vec3 a = q.Start + begin * q.Direction;
    const Vec3 b = q.Start + end * q.Direction;
    const auto reaches = [&](const Box3& box) {
      double lo = 0.0;
      double hi = 1.0;
      for (int k = 0; k < 3; ++k)
      {
        const double d = b[k] - a[k];
        const double l = box.Min[k] - 1e-12 - a[k];
        const double h = box.Max[k] + 1e-12 - a[k];
        if (d == 0.0)
        {
          if (l > 0.0 || h < 0.0)
          {
            return false;
          }
          continue;
        }
        lo = std::max(lo, std::min(l / d, h / d));
        hi = std::min(hi, std::max(l / d, h / d));
      }
      return lo <= hi;
    };
    this->Tree.Visit(reaches, [&](std::int32_t t) {
      double distance = 0.0;
      if (Judge(q, t, true, distance) == Verdict::Hit &&
        (distance < best.Distance || (distance == best.Distance && t < best.Triangle)))
      {
        best.Triangle = t;
        best.Distance = distance;
      }
      return true;
    });
    return best;
  }

  /// True when `p`, on triangle t, is close to the triangle's rim.
  bool NearRim(const Vec3& p, std::int32_t t) const
  {
    const Triangle3& v = this->Triangles[t];
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 edge = v[(k + 1) % 3] - v[k];
      const Vec3 across = Cross(edge, p - v[k]);
      if (LengthSquared(across) < Closeness * Closeness * LengthSquared(edge))
      {
        return true;
      }
    }
    return false;
  }

  /// True when single precision cannot keep the ray on its side of the triangle's plane.
  bool Grazes(const Vec3& direction, std::int32_t t) const
  {
    return std::fabs(Dot(direction, this->Normals[t])) < GrazingSine;
  }

  RayQuery MakeQuery(const RayEnd& from, const Vec3& direction) const
  {
    RayQuery q;
    q.Start = this->ToBox(from.Point);
    q.Direction = direction / Norm(direction);
    q.Length = std::numeric_limits<double>::infinity();
    q.FromTriangle = from.Triangle;
    q.Triangles = &this->Triangles;
    q.Normals = &this->Normals;
    q.Exact = from.Close ||
      (from.Triangle >= 0 &&
        (this->NearRim(q.Start, from.Triangle) || this->Grazes(q.Direction, from.Triangle)));
    return q;
  }

  RayQuery MakeQuery(const RayEnd& from, const RayEnd& to) const
  {
    const Vec3 way = to.Point - from.Point;
    RayQuery q = this->MakeQuery(from, way);
    q.Length = this->Scale * Norm(way);
    q.ToTriangle = to.Triangle;
    q.Exact = q.Exact || to.Close ||
      (to.Triangle >= 0 &&
        (this->NearRim(this->ToBox(to.Point), to.Triangle) ||
          this->Grazes(q.Direction, to.Triangle)));
    return q;
  }

  static void FillRay(RTCRay& ray, const RayQuery& q, double begin, double end)
  {
    const Vec3 start = q.Start + (begin - EndMargin) * q.Direction;
    ray.org_x = static_cast<float>(start.x);
    ray.org_y = static_cast<float>(start.y);
    ray.org_z = static_cast<float>(start.z);
    ray.dir_x = static_cast<float>(q.Direction.x);
    ray.dir_y = static_cast<float>(q.Direction.y);
    ray.dir_z = static_cast<float>(q.Direction.z);
    ray.tnear = 0.0f;
    ray.tfar = static_cast<float>(end - begin + 2.0 * EndMargin);
    ray.time = 0.0f;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
  }

  /// Where a ray starts outside the box, the filter's measure of "near the start" moves with it.
  static RayQuery From(const RayQuery& q, double begin)
  {
    RayQuery moved = q;
    moved.Start = q.Start + begin * q.Direction;
    moved.Length = q.Length - begin;
    return moved;
  }

  bool Occluded(RayQuery q) const
  {
    double begin = 0.0;
    double end = 0.0;
    if (!this->Handle || !(q.Length > 0.0) || !this->Clip(q, begin, end))
    {
      return false;
    }
    if (q.Exact)
    {
      return this->ExactClosest(q, begin, end).Triangle >= 0;
    }
    if (begin > 0.0)
    {
      q = From(q, begin);
      end -= begin;
      begin = 0.0;
    }
    RTCRay ray;
    FillRay(ray, q, begin, end);
    QueryContext context;
    context.Queries = &q;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context.Context);
    RTCOccludedArguments args;
    rtcInitOccludedArguments(&args);
    args.context = &context.Context;
    args.filter = &Filter;
    args.flags = static_cast<RTCRayQueryFlags>(
      RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER | RTC_RAY_QUERY_FLAG_INCOHERENT);
    rtcOccluded1(this->Handle, &ray, &args);
#else
    rtcInitIntersectContext(&context.Context);
    context.Context.filter = &Filter;
    rtcOccluded1(this->Handle, &context.Context, &ray);
#endif
    if (ray.tfar < 0.0f)
    {
      return true;
    }
    return q.Ambiguous && this->ExactClosest(q, begin, end).Triangle >= 0;
  }

  /// What gets through along the ray, a share a band.
  bool Visible(RayQuery q, double* bands) const
  {
    std::fill(bands, bands + this->Bands, 1.0);
    q.Passed = this->Panes ? &this->Panes->Panes() : nullptr;
    if (this->Occluded(q))
    {
      return false;
    }
    double begin = 0.0;
    double end = 0.0;
    if (!this->Panes || !(q.Length > 0.0) || !this->Clip(q, begin, end))
    {
      return true;
    }
    q.Passed = nullptr;
    return this->Panes->Pass(begin > 0.0 ? From(q, begin) : q, bands);
  }

  /// Rays of neighbours, sixteen at a time.
  static constexpr std::size_t PacketSize = 16;
  void OccludedPacket(RayQuery* queries, std::size_t count, std::uint8_t* hidden) const
  {
    alignas(64) int valid[PacketSize] = {};
    RTCRay16 rays;
    double ends[PacketSize] = {};
    bool any = false;
    for (std::size_t k = 0; k < count; ++k)
    {
      RayQuery& q = queries[k];
      double begin = 0.0;
      hidden[k] = 0;
      if (!this->Handle || !(q.Length > 0.0) || !this->Clip(q, begin, ends[k]))
      {
        continue;
      }
      if (q.Exact)
      {
        hidden[k] = this->ExactClosest(q, begin, ends[k]).Triangle >= 0 ? 1 : 0;
        continue;
      }
      if (begin > 0.0)
      {
        q = From(q, begin);
        ends[k] -= begin;
      }
      RTCRay ray;
      FillRay(ray, q, 0.0, ends[k]);
      rays.org_x[k] = ray.org_x;
      rays.org_y[k] = ray.org_y;
      rays.org_z[k] = ray.org_z;
      rays.dir_x[k] = ray.dir_x;
      rays.dir_y[k] = ray.dir_y;
      rays.dir_z[k] = ray.dir_z;
      rays.tnear[k] = ray.tnear;
      rays.tfar[k] = ray.tfar;
      rays.time[k] = ray.time;
      rays.mask[k] = ray.mask;
      rays.id[k] = static_cast<unsigned int>(k);
      rays.flags[k] = 0;
      valid[k] = -1;
      any = true;
    }
    if (!any)
    {
      return;
    }
    QueryContext context;
    context.Queries = queries;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context.Context);
    RTCOccludedArguments args;
    rtcInitOccludedArguments(&args);
    args.context = &context.Context;
    args.filter = &Filter;
    args.flags = static_cast<RTCRayQueryFlags>(
      RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER | RTC_RAY_QUERY_FLAG_COHERENT);
    rtcOccluded16(valid, this->Handle, &rays, &args);
#else
    rtcInitIntersectContext(&context.Context);
    context.Context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.Context.filter = &Filter;
    rtcOccluded16(valid, this->Handle, &context.Context, &rays);
#endif
    for (std::size_t k = 0; k < count; ++k)
    {
      if (valid[k] != 0)
      {
        hidden[k] = rays.tfar[k] < 0.0f ||
            (queries[k].Ambiguous && this->ExactClosest(queries[k], 0.0, ends[k]).Triangle >= 0)
          ? 1
          : 0;
      }
    }
  }

  SurfaceHit Closest(RayQuery q) const
  {
    double begin = 0.0;
    double end = 0.0;
    if (!this->Handle || !this->Clip(q, begin, end))
    {
      return {};
    }
    if (q.Exact)
    {
      SurfaceHit exact = this->ExactClosest(q, begin, end);
      if (exact.Triangle < 0)
      {
        return {};
      }
      this->Complete(q, exact);
      return exact;
    }
    const double skipped = begin;
    if (begin > 0.0)
    {
      q = From(q, begin);
      end -= begin;
      begin = 0.0;
    }
    RTCRayHit hit;
    FillRay(hit.ray, q, begin, end);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    QueryContext context;
    context.Queries = &q;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context.Context);
    RTCIntersectArguments args;
    rtcInitIntersectArguments(&args);
    args.context = &context.Context;
    args.filter = &Filter;
    args.flags = static_cast<RTCRayQueryFlags>(
      RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER | RTC_RAY_QUERY_FLAG_INCOHERENT);
    rtcIntersect1(this->Handle, &hit, &args);
#else
    rtcInitIntersectContext(&context.Context);
    context.Context.filter = &Filter;
    rtcIntersect1(this->Handle, &context.Context, &hit);
#endif
    SurfaceHit result;
    if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID)
    {
      result.Triangle = static_cast<std::int32_t>(hit.hit.primID);
      result.Distance = hit.ray.tfar - EndMargin;
    }
    if (q.Ambiguous)
    {
      const SurfaceHit exact = this->ExactClosest(q, begin, end);
      if (exact.Triangle >= 0 && (result.Triangle < 0 || exact.Distance < result.Distance))
      {
        result = exact;
      }
    }
    if (result.Triangle < 0)
    {
      return {};
    }
    this->Complete(q, result);
    result.Distance += skipped;
    return result;
  }

  /// Side, distance and barycentric coordinates of a hit, in double.
  void Complete(const RayQuery& q, SurfaceHit& hit) const
  {
    const Triangle3& v = this->Triangles[hit.Triangle];
    const Vec3 n = AreaNormal2(v);
    const double rate = Dot(n, q.Direction);
    hit.Front = rate < 0.0;
    hit.Distance = -Dot(n, q.Start - v[0]) / rate;
    const Vec3 p = q.Start + hit.Distance * q.Direction - v[0];
    const double nn = Dot(n, n);
    hit.U = std::clamp(Dot(n, Cross(p, v[2] - v[0])) / nn, 0.0, 1.0);
    hit.V = std::clamp(Dot(n, Cross(v[1] - v[0], p)) / nn, 0.0, 1.0 - hit.U);
  }
};

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
