// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaReceiver.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/AreaSums.h"
#include "radiometry/irradiance/SampleMean.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiometry
{
namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
/// Parts of a source that one sample of a patch may look at.
constexpr int WorkASample = 2;

/// A polygon's part before the plane of another.
ConvexPolygon Before(const ConvexPolygon& polygon, const Vec3& n, const Vec3& through)
{
  double heights[ConvexPolygon::Capacity];
  bool below = false;
  for (int k = 0; k < polygon.N; ++k)
  {
    heights[k] = Dot(n, polygon.P[k] - through);
    below = below || heights[k] < 0.0;
  }
  if (!below)
  {
    return polygon;
  }
  ConvexPolygon part;
  Clip(polygon, heights, part);
  return part;
}

/// Half of what all sources together can give, with an error of half.
AreaLight Bound(
  const AreaSources& sources, const Vec3& center, const Vec3& normal, double radius)
{
  AreaLight light;
  const auto bands = static_cast<std::size_t>(sources.Bands());
  light.Value.assign(bands, 0.0);
  if (!sources.Groups().empty())
  {
    const AreaSources::Group& all = sources.Groups().front();
    const double factor = AreaSources::Factor(all, center, normal, radius);
    for (std::size_t b = 0; b < bands && factor > 0.0; ++b)
    {
      light.Value[b] =
        0.5 * std::min(all.Exitances[b], all.Power[b] > 0.0 ? all.Power[b] * factor : 0.0);
    }
  }
  light.Error = light.Value;
  light.Unshadowed = light.Value;
  for (double& value : light.Unshadowed)
  {
    value *= 2.0;
  }
  light.Open = light.Improvable = true;
  return light;
}

} // namespace

AreaLight BoundArea(const AreaSources& sources, const Patch& patch)
{
  const ExchangePatch shape(patch.Corners);
  return shape.Area > 0.0 ? Bound(sources, shape.Center, shape.Normal, shape.Radius)
                          : AreaSums(static_cast<std::size_t>(sources.Bands())).Result(0.0);
}

AreaLight BoundArea(const AreaSources& sources, const SurfacePoint& point)
{
  return Bound(sources, point.Point, point.Normal, 0.0);
}

/// A part of a patch and a source: the light between them.
struct AreaReceiver::Part
{
  std::size_t Source = 0;
  Triangle3 Corners;
  std::vector<std::int32_t> Inside; // what may stand between
  bool Listed = false;              // Inside is whole
  double Whole = 0.0;               // exchange were nothing in the way, m^2
  double Rule = 0.0;                // error of Whole
  double Value = 0.0;               // exchange, m^2
  double Variance = 0.0;
  double Weight = 0.0;              // the greatest exitance
  std::uint64_t Path = 1;           // which part of the patch it is

  double Doubt() const { return this->Variance * this->Weight * this->Weight; }
  bool operator<(const Part& other) const { return this->Doubt() < other.Doubt(); }
};

AreaReceiver::AreaReceiver(const SourceView& view, double scale)
  : View(view)
  , Scale(scale)
{
}

/// Decides a part: nothing between, all hidden, or an estimate from samples.
void AreaReceiver::Evaluate(
  const Patch& patch, std::uint64_t key, Part& part, std::int64_t& rays) const
{
  const Blockers& blockers = *this->View.GetBlockers();
  const AreaSource& source = this->View.GetSources()[part.Source];
  const Vec3 n = Normalized(AreaNormal2(part.Corners));
  const ConvexPolygon receiver =
    Before(ConvexPolygon(part.Corners), source.Normal, source.Outline.P[0]);
  const ConvexPolygon light = Before(source.Outline, n, part.Corners[0]);
  part.Value = part.Whole;
  part.Variance = 0.0;
  if (receiver.N < 3 || light.N < 3)
  {
    return;
  }
  const Shaft shaft(receiver, light, blockers.Rounding());
  std::vector<std::int32_t> inside;
  if (part.Listed)
  {
    for (const std::int32_t t : part.Inside)
    {
      if (shaft.Touches(blockers[t]))
      {
        inside.push_back(t);
      }
    }
  }
  else
  {
    part.Listed = blockers.InShaft(shaft, SourceView::MostProof, inside);
    inside.erase(std::remove(inside.begin(), inside.end(), patch.Triangle), inside.end());
  }
  part.Inside = std::move(inside);
  if (part.Inside.empty())
  {
    return;
  }
  if (part.Listed && this->View.CountPanes(part.Inside) == 0 &&
    blockers.HideAll(receiver, light, shaft, part.Inside))
  {
    part.Value = 0.0;
    return;
  }

  const std::vector<std::int32_t> casters = part.Listed
    ? blockers.Casters(part.Inside, source.Normal, source.Outline.P[0])
    : std::vector<std::int32_t>{};
  const bool few = part.Listed && this->View.Few(casters);
  SampleMean samples(part.Whole / Area(part.Corners));
  const std::uint64_t partKey = Hash64(key, Hash64(part.Source, part.Path));
  const Triangle3& c = part.Corners;
  for (int set = 0; set < SampleMean::Sets; ++set)
  {
    const SobolSequence sequence(Hash64(partKey, static_cast<std::uint64_t>(set)));
    for (int i = 0; i < SampleMean::Each; ++i)
    {
      const auto u = sequence(static_cast<std::uint32_t>(i));
      const Vec3 b = TrianglePoint({ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } }, u[0], u[1]);
      const Vec3 x = c[0] + b.y * (c[1] - c[0]) + b.z * (c[2] - c[0]);
      const SeenSource seen = this->View.See({ x, { x, patch.Triangle }, n, {} }, part.Source,
        few ? &casters : nullptr, WorkASample,
        Hash64(partKey, static_cast<std::uint64_t>(64 + set * SampleMean::Each + i)));
      rays += seen.Rays;
      samples.Add(b.y, b.z, seen.Whole, seen.Visible);
    }
  }
  double variance = 0.0;
  const double area = Area(part.Corners);
  part.Value = std::clamp(samples.Mean(variance) * area, 0.0, part.Whole);
  part.Variance = variance * area * area;
}

AreaLight AreaReceiver::AtPatch(const Patch& patch, std::uint64_t key, const double* before,
  const AreaEffort& effort) const
{
  const AreaSources& sources = this->View.GetSources();
  const auto bands = static_cast<std::size_t>(sources.Bands());
  const ExchangePatch shape(patch.Corners);
  AreaSums sums(bands);
  if (!(shape.Area > 0.0))
  {
    return sums.Result(0.0);
  }
  const double tolerance = std::clamp(0.01 * effort.RelativeTolerance, 1e-12, 1e-8);
  const auto exchange = [&](Part& part, double wanted) {
    const ExchangePatch receiver(part.Corners);
    part.Whole = 0.0;
    part.Rule = 0.0;
    for (const ExchangePatch& t : sources[part.Source].Triangles)
    {
      const PairExchangeResult pair = PairExchange(receiver, t, wanted);
      part.Whole += pair.Value;
      part.Rule += pair.Error;
    }
  };
  std::vector<Part> parts;
  std::vector<std::size_t> open; // a heap: the part that is most in doubt first
  const auto byDoubt = [&](std::size_t a, std::size_t b) { return parts[a] < parts[b]; };
  std::int64_t rays = 0;
  const auto add = [&](const Part& part, double sign) {
    const double share = part.Whole > 0.0 ? part.Value / part.Whole : 0.0;
    sums.Add(sources[part.Source].Exitance, sign, part.Value / shape.Area,
      part.Variance / (shape.Area * shape.Area), share * part.Rule / shape.Area, 0.0);
  };
  const auto keep = [&](Part&& part) {
    add(part, 1.0);
    parts.push_back(std::move(part));
    if (parts.back().Variance > 0.0)
    {
      open.push_back(parts.size() - 1);
      std::push_heap(open.begin(), open.end(), byDoubt);
    }
  };

  sums.Visit(sources, shape.Center, shape.Normal, shape.Radius, before, effort,
    [&](std::size_t s) {
      if (sources[s].Triangle >= 0 && sources[s].Triangle == patch.Triangle)
      {
        return;
      }
      Part part;
      part.Source = s;
      part.Corners = patch.Corners;
      part.Weight = sources[s].Strength;
      exchange(part, tolerance);
      if (!(part.Whole > 0.0))
      {
        return;
      }
      sums.Add(sources[s].Exitance, 1.0, 0.0, 0.0, 0.0, part.Whole / shape.Area);
      part.Value = part.Whole;
      if (this->View.GetBlockers())
      {
        this->Evaluate(patch, key, part, rays);
      }
      keep(std::move(part));
    });

  int made = 0;
  bool met = sums.Met(before, effort);
  while (!met && !open.empty() && made + 4 <= effort.Work)
  {
    std::pop_heap(open.begin(), open.end(), byDoubt);
    const Part part = std::move(parts[open.back()]);
    parts[open.back()] = Part();
    open.pop_back();
    add(part, -1.0);
    const Triangle3& c = part.Corners;
    const Vec3 m[3] = { 0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0]) };
    const Triangle3 quarters[4] = { { c[0], m[0], m[2] }, { m[0], c[1], m[1] }, { m[2], m[1], c[2] },
      { m[0], m[1], m[2] } };
    for (std::uint64_t q = 0; q < 4; ++q)
    {
      Part quarter;
      quarter.Source = part.Source;
      quarter.Corners = quarters[q];
      quarter.Weight = part.Weight;
      quarter.Path = 4 * part.Path + q;
      exchange(quarter, std::max(tolerance, 1e-6));
      if (!(quarter.Whole > 0.0))
      {
        continue;
      }
      quarter.Inside = part.Inside;
      quarter.Listed = part.Listed;
      this->Evaluate(patch, key, quarter, rays);
      keep(std::move(quarter));
      ++made;
    }
    met = sums.Met(before, effort);
  }
  // Summed anew: taking away leaves rounding.
  sums.Clear();
  for (const Part& part : parts)
  {
    add(part, 1.0);
  }

  double size = std::numeric_limits<double>::infinity(); // the least height
  for (int k = 0; k < 3; ++k)
  {
    size = std::min(
      size, 2.0 * shape.Area / Length(patch.Corners[(k + 1) % 3] - patch.Corners[k]));
  }
  AreaLight light = sums.Result(Epsilon * (16.0 + this->Scale / size));
  light.Rays = rays;
  light.Open = !met && !open.empty();
  light.Improvable = !open.empty() || light.Dropped > 0.0;
  return light;
}

AreaLight AreaReceiver::AtPoint(const SurfacePoint& point, const std::vector<ViewPoint>& places,
  std::uint64_t key, const double* before, const AreaEffort& effort) const
{
  const AreaSources& sources = this->View.GetSources();
  const auto bands = static_cast<std::size_t>(sources.Bands());
  AreaSums sums(bands);
  std::int64_t rays = 0;
  bool sampled = false;
  sums.Visit(sources, point.Point, point.Normal, 0.0, before, effort, [&](std::size_t s) {
    const std::int32_t own = sources[s].Triangle;
    if (own >= 0 && (own == point.Triangle ||
        std::find(point.Around.begin(), point.Around.end(), own) != point.Around.end()))
    {
      return;
    }
    static thread_local Pieces pieces;
    PiecesAbove(point.Point, point.Normal, {}, sources[s], pieces);
    const double whole = Factor(point.Point, point.Normal, pieces);
    if (!(whole > 0.0))
    {
      return;
    }
    double share = 1.0;
    double error = 1e-13 * whole;
    for (const ConvexPolygon& piece : pieces)
    {
      error += PointToPolygonRounding(point.Point, piece.P, piece.N);
    }
    double variance = 0.0;
    if (this->View.GetBlockers())
    {
      double all = 0.0, visible = 0.0, spread = 0.0, low = 1.0, high = 0.0;
      for (std::size_t p = 0; p < places.size(); ++p)
      {
        const SeenSource seen = this->View.See(
          places[p], s, nullptr, effort.Work, Hash64(key, Hash64(s, p)));
        rays += seen.Rays;
        all += seen.Whole;
        visible += seen.Visible;
        spread += seen.Variance;
        if (seen.Whole > 0.0)
        {
          low = std::min(low, seen.Visible / seen.Whole);
          high = std::max(high, seen.Visible / seen.Whole);
        }
      }
      share = all > 0.0 ? std::min(1.0, visible / all) : 0.0;
      variance = all > 0.0 ? spread * (whole / all) * (whole / all) : 0.0;
      sampled = sampled || variance > 0.0;
      // A shadow's edge that parts the places beside a vertex.
      error += places.size() > 1 && high > low ? 0.5 * (high - low) * whole : 0.0;
    }
    sums.Add(sources[s].Exitance, 1.0, share * whole, variance, share > 0.0 ? error : 0.0, whole);
  });
  AreaLight light = sums.Result(16.0 * Epsilon);
  light.Rays = rays;
  light.Open = sampled && !sums.Met(before, effort);
  light.Improvable = sampled || light.Dropped > 0.0;
  return light;
}

} // namespace radiometry
