// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionInternals.h"

#include <algorithm>

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

/// What Embree is handed beside the rays: the queries that judge their hits, in the form that its
/// version 3 or 4 wants.
class FilteredQuery
{
public:
  FilteredQuery(RayQuery* queries, bool coherent)
    : Coherent(coherent)
  {
    this->Shared.Queries = queries;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&this->Shared.Context);
#else
    rtcInitIntersectContext(&this->Shared.Context);
    this->Shared.Context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    this->Shared.Context.filter = &Filter;
#endif
  }

#if RTC_VERSION_MAJOR >= 4
  template <typename Kind, typename Init>
  Kind Arguments(const Init& initialise)
  {
    Kind arguments;
    initialise(&arguments);
    arguments.context = &this->Shared.Context;
    arguments.filter = &Filter;
    arguments.flags =
      static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER |
        (this->Coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT));
    return arguments;
  }
#else
  FilterContext* Context() { return &this->Shared.Context; }
#endif

private:
  QueryContext Shared;
  bool Coherent;
};

void FillRay(RTCRay& ray, const RayQuery& q, double begin, double end)
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

/// Puts a ray in its place of a packet.
template <typename Packet>
void FillRay(Packet& rays, std::size_t k, const RayQuery& q, double end)
{
  RTCRay ray;
  FillRay(ray, q, 0.0, end);
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
}

/// Where a ray starts outside the box, the filter's measure of "near the start" moves with it.
RayQuery From(const RayQuery& q, double begin)
{
  RayQuery moved = q;
  moved.Start = q.Start + begin * q.Direction;
  moved.Length = q.Length - begin;
  return moved;
}

} // namespace

bool OcclusionScene::Internals::Occluded(RayQuery q) const
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
  FilteredQuery query(&q, false);
#if RTC_VERSION_MAJOR >= 4
  auto arguments = query.Arguments<RTCOccludedArguments>(rtcInitOccludedArguments);
  rtcOccluded1(this->Handle, &ray, &arguments);
#else
  rtcOccluded1(this->Handle, query.Context(), &ray);
#endif
  if (ray.tfar < 0.0f)
  {
    return true;
  }
  return q.Ambiguous && this->ExactClosest(q, begin, end).Triangle >= 0;
}

bool OcclusionScene::Internals::Visible(RayQuery q, double* bands) const
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

void OcclusionScene::Internals::OccludedPacket(
  RayQuery* queries, std::size_t count, std::uint8_t* hidden) const
{
  alignas(64) int valid[PacketSize] = {};
  // Without AVX-512 Embree cuts the packet up and goes by the rays' intervals, not by `valid`: places
  // that are not used hold empty ones.
  RTCRay16 rays{};
  std::fill_n(rays.tfar, PacketSize, -1.0f);
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
    FillRay(rays, k, q, ends[k]);
    valid[k] = -1;
    any = true;
  }
  if (!any)
  {
    return;
  }
  FilteredQuery query(queries, true);
#if RTC_VERSION_MAJOR >= 4
  auto arguments = query.Arguments<RTCOccludedArguments>(rtcInitOccludedArguments);
  rtcOccluded16(valid, this->Handle, &rays, &arguments);
#else
  rtcOccluded16(valid, this->Handle, query.Context(), &rays);
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

bool OcclusionScene::Internals::ClosestFree(const RayQuery& q, SurfaceHit& hit) const
{
  RTCRayHit ray;
  FillRay(ray.ray, q, EndMargin, 8.0); // the scene is smaller
  ray.ray.tnear = static_cast<float>(FreeStart);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  rtcIntersect1(this->Handle, &ray, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(this->Handle, &context, &ray);
#endif
  hit = {};
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ||
    this->Accept(q, static_cast<std::int32_t>(ray.hit.primID), hit);
}

bool OcclusionScene::Internals::Accept(
  const RayQuery& q, std::int32_t triangle, SurfaceHit& hit) const
{
  double distance = 0.0;
  if (triangle == q.FromTriangle || Judge(q, triangle, false, distance) != Verdict::Hit)
  {
    return false;
  }
  hit.Triangle = triangle;
  this->Complete(q, hit);
  return true;
}

SurfaceHit OcclusionScene::Internals::Closest(const RayQuery& q) const
{
  SurfaceHit free;
  return q.Free && this->ClosestFree(q, free) ? free : this->ClosestJudged(q);
}

SurfaceHit OcclusionScene::Internals::ClosestJudged(RayQuery q) const
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
  FilteredQuery query(&q, false);
#if RTC_VERSION_MAJOR >= 4
  auto arguments = query.Arguments<RTCIntersectArguments>(rtcInitIntersectArguments);
  rtcIntersect1(this->Handle, &hit, &arguments);
#else
  rtcIntersect1(this->Handle, query.Context(), &hit);
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

} // namespace radiometry
