// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SpecularImages.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr std::size_t MostPlanes = 16;
constexpr std::size_t MostSequences = 16;
constexpr std::size_t LongestSequence = 4;
constexpr double MostSamples = 4e8; // of all receivers together
constexpr std::size_t Batches = 8;
constexpr std::uint32_t FewestPoints = 8; // a batch
constexpr std::uint32_t MostPoints = 128;
constexpr double Coverage = 2.7; // of an error estimated from eight batches
constexpr double SamePlane = 1e-6;
constexpr int MostSheets = 1000;

} // namespace

SpecularImages::SpecularImages(const Scene& scene, const OcclusionScene& occluders,
  const SpecularSurfaces& surfaces, const std::vector<SpecularSource>& sources,
  std::size_t receivers, const SpecularLightOptions& options)
  : Occluders(occluders)
  , Surfaces(surfaces)
  , Sources(sources)
  , Options(options)
  , Bands(static_cast<std::size_t>(scene.Optics.Bands))
{
  this->FindPlanes(scene);
  this->FindSequences(receivers);
}

void SpecularImages::FindPlanes(const Scene& scene)
{
  this->PlaneIndex.assign(2 * scene.Triangles.size(), -1);
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max(extent, Length(p));
  }
  std::vector<std::vector<Vec3>> corners;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    for (const bool front : { true, false })
    {
      const auto triangle = static_cast<std::int32_t>(t);
      if (!this->Surfaces.Mirror(triangle, front))
      {
        continue;
      }
      const Vec3 normal = this->Surfaces.Normal(triangle, front);
      const Triangle3 v = scene.TriangleAt(t);
      if (normal == Vec3{})
      {
        continue;
      }
      const double offset = Dot(normal, Centroid(v));
      std::size_t k = 0;
      while (k < this->Planes.size() &&
        (Length(this->Planes[k].Normal - normal) > SamePlane ||
          std::fabs(this->Planes[k].Offset - offset) > SamePlane * extent))
      {
        ++k;
      }
      if (k == MostPlanes)
      {
        this->Planes.clear();
        return;
      }
      if (k == this->Planes.size())
      {
        this->Planes.push_back({ normal, offset, {}, 0.0 });
        corners.emplace_back();
      }
      corners[k].insert(corners[k].end(), v.begin(), v.end());
      this->PlaneIndex[2 * t + (front ? 0 : 1)] = static_cast<std::int32_t>(k);
    }
  }
  for (std::size_t k = 0; k < this->Planes.size(); ++k)
  {
    Vec3 lo = corners[k][0], hi = lo;
    for (const Vec3& p : corners[k])
    {
      lo = { std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z) };
      hi = { std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z) };
    }
    this->Planes[k].Center = 0.5 * (lo + hi);
    this->Planes[k].Radius = 0.5 * Length(hi - lo);
  }
}

void SpecularImages::FindSequences(std::size_t receivers)
{
  const std::size_t sources = this->Sources.size();
  std::vector<Sequence> last{ {} };
  for (std::size_t order = 1; order <= LongestSequence && sources > 0; ++order)
  {
    std::vector<Sequence> next;
    for (const Sequence& s : last)
    {
      for (std::size_t k = 0; k < this->Planes.size(); ++k)
      {
        // The same plane cannot follow itself.
        if (s.empty() || static_cast<std::size_t>(s.back()) != k)
        {
          next.push_back(s);
          next.back().push_back(static_cast<std::int32_t>(k));
        }
      }
    }
    const std::size_t all = this->Sequences.size() + next.size();
    const double work = static_cast<double>(all * sources * receivers) * Batches * FewestPoints;
    if (next.empty() || all > MostSequences || work > MostSamples)
    {
      return;
    }
    this->Sequences.insert(this->Sequences.end(), next.begin(), next.end());
    this->Longest = order;
    last = std::move(next);
  }
}

/// False where no line from the sphere to the last image passes the sphere about the last mirror.
bool SpecularImages::MaySee(
  const Sequence& sequence, const SpecularSource& source, const Vec3& center, double radius) const
{
  const Plane& plane = this->Planes[static_cast<std::size_t>(sequence.back())];
  const double height = plane.Height(center);
  if (height <= -radius)
  {
    return false;
  }
  if (source.Is == SpecularSource::Kind::Beam && source.Beam->Directional())
  {
    Vec3 way = -source.Beam->GetLight().Direction;
    for (const std::int32_t k : sequence)
    {
      way = this->Planes[static_cast<std::size_t>(k)].Turn(way);
    }
    const double down = -Dot(plane.Normal, way);
    if (down <= 0.0)
    {
      return false;
    }
    const Vec3 meets = center + (height / down) * way;
    return Length(meets - plane.Center) <= plane.Radius + radius + radius / down;
  }
  const bool panel = source.Is == SpecularSource::Kind::Panel;
  Vec3 image = panel ? Centroid(source.Corners) : source.Beam->GetLight().Position;
  double size = 0.0;
  for (const Vec3& corner : source.Corners)
  {
    size = panel ? std::max(size, Length(corner - image)) : 0.0;
  }
  for (const std::int32_t k : sequence)
  {
    const Plane& p = this->Planes[static_cast<std::size_t>(k)];
    if (p.Height(image) <= -size)
    {
      return false; // behind that mirror
    }
    image = p.Reflect(image);
  }
  const double depth = -plane.Height(image);
  if (depth <= size || height <= radius)
  {
    return true;
  }
  const double share = height / (height + depth);
  const Vec3 meets = center + share * (image - center);
  const double way = Length(image - center) + radius + size;
  const double spread = (radius + size) * (1.0 + way / (height + depth - radius - size));
  return height + depth <= radius + size || Length(meets - plane.Center) <= plane.Radius + spread;
}

bool SpecularImages::Way(const Sequence& sequence, const SpecularSource& source, const Vec3& on,
  const RayEnd& from, double* bands) const
{
  const bool parallel = source.Is == SpecularSource::Kind::Beam && source.Beam->Directional();
  std::array<Vec3, LongestSequence + 1> targets;
  targets[0] = parallel ? -source.Beam->GetLight().Direction : on;
  for (std::size_t k = 0; k < sequence.size(); ++k)
  {
    const Plane& plane = this->Planes[static_cast<std::size_t>(sequence[k])];
    targets[k + 1] = parallel ? plane.Turn(targets[k]) : plane.Reflect(targets[k]);
  }
  const std::size_t width = this->Surfaces.Width();
  RayEnd at = from;
  for (std::size_t k = sequence.size(); k > 0; --k)
  {
    const Vec3 direction = parallel ? targets[k] : targets[k] - at.Point;
    for (int sheets = 0;; ++sheets)
    {
      const SurfaceHit hit = this->Occluders.Closest(at, direction);
      if (hit.Triangle < 0 || sheets == MostSheets || !this->Surfaces.GoesOn(hit))
      {
        return false;
      }
      const bool mirror = this->PlaneOf(hit.Triangle, hit.Front) == sequence[k - 1];
      bool any = false;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        bands[b] *= mirror ? this->Surfaces.Reflectance(hit.Triangle, hit.Front, width > 1 ? b : 0)
                           : this->Surfaces.Transmittance(hit.Triangle, width > 1 ? b : 0);
        any = any || bands[b] > 0.0;
      }
      if (!any)
      {
        return false;
      }
      at = this->Surfaces.Place(hit);
      if (mirror)
      {
        break;
      }
    }
  }
  std::vector<double> through(this->Bands, 1.0);
  if (parallel)
  {
    if (!this->Occluders.VisibleDirection(at, targets[0], through.data()))
    {
      return false;
    }
  }
  else
  {
    RayEnd end{ on, source.Triangle };
    if (end.Triangle < 0 && source.Is == SpecularSource::Kind::Panel)
    {
      end.Triangle = this->Occluders.Touching(end.Point, source.Normal, 0.0);
    }
    end.Close = end.Triangle < 0 && this->Occluders.TooClose(end.Point);
    if (!this->Occluders.Visible(at, end, through.data()))
    {
      return false;
    }
  }
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    bands[b] *= through[b];
  }
  return true;
}

void SpecularImages::AddPatch(const Patch& patch, std::uint64_t key, const Sequence& sequence,
  const SpecularSource& source, double* values, double* squares) const
{
  const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
  const bool panel = source.Is == SpecularSource::Kind::Panel;
  // The receiver unfolded to where it would stand without mirrors.
  const auto unfold = [&](Vec3 p) {
    for (std::size_t k = sequence.size(); k > 0; --k)
    {
      p = this->Planes[static_cast<std::size_t>(sequence[k - 1])].Reflect(p);
    }
    return p;
  };
  Vec3 turned = normal;
  for (std::size_t k = sequence.size(); k > 0; --k)
  {
    turned = this->Planes[static_cast<std::size_t>(sequence[k - 1])].Turn(turned);
  }
  double exact = 0.0; // were every mirror endless and nothing in the way
  if (!panel)
  {
    std::array<Vec3, 3> corners{ unfold(patch.Corners[0]), unfold(patch.Corners[1]),
      unfold(patch.Corners[2]) };
    if (sequence.size() % 2 == 1)
    {
      std::swap(corners[1], corners[2]);
    }
    double error = 0.0;
    exact = source.Beam->OnPolygon(corners.data(), 3, turned, error) / Area(patch.Corners);
    if (!(exact > 0.0))
    {
      return;
    }
  }
  std::array<double, Batches> open{};
  std::vector<double> lit(Batches * this->Bands, 0.0), way(this->Bands);
  std::vector<double> mean(this->Bands), error(this->Bands), before(this->Bands, 0.0);
  double allOpen = 0.0;
  bool whole = true; // every point that gets light gets all
  std::uint32_t done = 0;
  for (std::uint32_t end = FewestPoints; end <= MostPoints; end *= 2)
  {
    for (std::size_t batch = 0; batch < Batches; ++batch)
    {
      const SobolSequence sequenceOf(Hash64(key, batch));
      for (std::uint32_t k = done; k < end; ++k)
      {
        const auto u = sequenceOf(k);
        const Vec3 x = TrianglePoint(patch.Corners, u[0], u[1]);
        const Vec3 on = panel          ? TrianglePoint(source.Corners, u[2], u[3])
          : source.Beam->Directional() ? Vec3{}
                                       : source.Beam->GetLight().Position;
        const Vec3 there = unfold(x);
        const double irradiance =
          panel ? source.FromPanel(on, there, turned) : source.Beam->AtPoint(there, turned);
        open[batch] += irradiance;
        allOpen += irradiance;
        if (!(irradiance > 0.0))
        {
          continue;
        }
        std::fill(way.begin(), way.end(), 1.0);
        if (!this->Way(sequence, source, on, { x, patch.Triangle }, way.data()))
        {
          whole = false;
          continue;
        }
        for (std::size_t b = 0; b < this->Bands; ++b)
        {
          lit[batch * this->Bands + b] += irradiance * way[b];
        }
      }
    }
    done = end;
    const double points = static_cast<double>(done) * Batches;
    bool fine = true;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      // A ratio to what the same points would get for lights of one direction; else a mean.
      double sum = 0.0, square = 0.0;
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        sum += lit[batch * this->Bands + b];
      }
      const double scale = panel ? 1.0 / points : (allOpen > 0.0 ? exact / allOpen : 0.0);
      mean[b] = scale * sum;
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        const double expected =
          panel ? sum / Batches : (allOpen > 0.0 ? sum / allOpen * open[batch] : 0.0);
        const double off = scale * Batches * (lit[batch * this->Bands + b] - expected);
        square += off * off;
      }
      // The larger of the last two estimates: one may be small by chance.
      const double now = Coverage * std::sqrt(square / (Batches * (Batches - 1.0)));
      error[b] = std::max(now, before[b]);
      before[b] = now / std::sqrt(2.0);
      if (!whole || sum == 0.0)
      {
        // An edge of the light may pass between the points.
        const double most = panel ? allOpen / points : exact;
        error[b] = std::max(error[b], 0.5 * most / points);
      }
      fine = fine && error[b] <= 0.5 * this->Options.RelativeTolerance * mean[b];
    }
    if (fine || mean == std::vector<double>(this->Bands, 0.0))
    {
      break;
    }
  }
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    values[b] += source.Intensity[b] * mean[b];
    squares[b] += std::pow(source.Intensity[b] * error[b], 2);
  }
}

/// Runs `body` for this rank's share of the receivers and brings all shares together.
void SpecularImages::Each(std::size_t receivers, const StageProgress& stage,
  std::vector<double>& values, std::vector<double>& errors, double seconds,
  const std::function<void(std::size_t)>& body) const
{
  const Communicator* ranks = this->Options.Ranks;
  const RankShare share(ranks, receivers);
  Collectively(ranks, [&] {
    ParallelFor(
      share.End - share.Begin, this->Options.Threads, stage,
      [&](std::size_t k) { body(share.Begin + k); },
      seconds * static_cast<double>(this->Sequences.size()));
  });
  if (ranks)
  {
    const std::vector<std::size_t> begin = RankShare::Begins(*ranks, receivers, this->Bands);
    ranks->Gather(values.data(), begin);
    ranks->Gather(errors.data(), begin);
  }
}

void SpecularImages::Add(const std::vector<Patch>& patches, const StageProgress& stage,
  std::vector<double>& values, std::vector<double>& errors) const
{
  if (this->Empty())
  {
    return;
  }
  this->Each(patches.size(), stage, values, errors, 1e-4, [&](std::size_t i) {
    const Patch& patch = patches[i];
    const Vec3 center = Centroid(patch.Corners);
    double radius = 0.0;
    for (const Vec3& corner : patch.Corners)
    {
      radius = std::max(radius, Length(corner - center));
    }
    if (!(Area(patch.Corners) > 0.0))
    {
      return;
    }
    std::vector<double> sum(this->Bands, 0.0), squares(this->Bands, 0.0);
    std::uint64_t key = Hash64(this->Options.Seed ^ 0x696d61676573ull, i);
    for (const Sequence& sequence : this->Sequences)
    {
      for (const SpecularSource& source : this->Sources)
      {
        key = Hash64(key);
        if (this->MaySee(sequence, source, center, radius))
        {
          this->AddPatch(patch, key, sequence, source, sum.data(), squares.data());
        }
      }
    }
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const std::size_t k = i * this->Bands + b;
      values[k] += sum[b];
      errors[k] = std::hypot(errors[k], std::sqrt(squares[b]));
    }
  });
}

void SpecularImages::Add(const std::vector<SurfacePoint>& points, const StageProgress& stage,
  std::vector<double>& values, std::vector<double>& errors) const
{
  if (this->Empty())
  {
    return;
  }
  this->Each(points.size(), stage, values, errors, 1e-5, [&](std::size_t i) {
    const SurfacePoint& point = points[i];
    RayEnd from{ point.Point, point.Triangle };
    if (from.Triangle < 0)
    {
      from.Triangle = this->Occluders.Touching(from.Point, point.Normal, point.Rounding);
      from.Close = from.Triangle < 0 && this->Occluders.TooClose(from.Point);
    }
    std::vector<double> way(this->Bands);
    for (const Sequence& sequence : this->Sequences)
    {
      Vec3 there = from.Point, turned = point.Normal;
      for (std::size_t k = sequence.size(); k > 0; --k)
      {
        const Plane& plane = this->Planes[static_cast<std::size_t>(sequence[k - 1])];
        there = plane.Reflect(there);
        turned = plane.Turn(turned);
      }
      for (std::size_t s = 0; s < this->Sources.size(); ++s)
      {
        const SpecularSource& source = this->Sources[s];
        if (!this->MaySee(sequence, source, from.Point, 0.0))
        {
          continue;
        }
        const bool panel = source.Is == SpecularSource::Kind::Panel;
        const std::uint32_t samples = panel ? 256 : 1;
        const SobolSequence numbers(Hash64(Hash64(this->Options.Seed, i), s));
        std::vector<double> sum(this->Bands, 0.0);
        std::vector<double> batches(Batches * this->Bands, 0.0);
        for (std::uint32_t k = 0; k < samples; ++k)
        {
          const auto u = numbers(k);
          const Vec3 on =
            panel ? TrianglePoint(source.Corners, u[2], u[3]) : source.Beam->GetLight().Position;
          const double irradiance =
            panel ? source.FromPanel(on, there, turned) : source.Beam->AtPoint(there, turned);
          std::fill(way.begin(), way.end(), 1.0);
          if (irradiance > 0.0 && this->Way(sequence, source, on, from, way.data()))
          {
            for (std::size_t b = 0; b < this->Bands; ++b)
            {
              sum[b] += irradiance * way[b] / samples;
              batches[k % Batches * this->Bands + b] += irradiance * way[b] * Batches / samples;
            }
          }
        }
        for (std::size_t b = 0; b < this->Bands; ++b)
        {
          double square = 0.0;
          for (std::size_t batch = 0; panel && batch < Batches; ++batch)
          {
            square += std::pow(batches[batch * this->Bands + b] - sum[b], 2);
          }
          const std::size_t k = i * this->Bands + b;
          values[k] += source.Intensity[b] * sum[b];
          errors[k] = std::hypot(errors[k],
            Coverage * source.Intensity[b] * std::sqrt(square / (Batches * (Batches - 1.0))));
        }
      }
    }
  });
}

} // namespace radiometry
