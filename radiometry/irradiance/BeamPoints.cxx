// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamIrradiance.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/BeamLights.h"
#include "radiometry/irradiance/LightSum.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace radiometry
{
namespace
{

/// How far inside its triangles a vertex asks for the light, as a share of the way to the centroid.
constexpr double NudgeShare = 1.0 / 64.0;

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// The places from which a vertex asks for a light: a little inside each face around it that faces
/// the light.
template <typename Visit>
void VisitPlaces(
  const Scene& scene, const SourceFlux& source, const SurfacePoint& p, const Visit& visit)
{
  for (const std::int32_t t : p.Around)
  {
    const Triangle3 around = scene.TriangleAt(t);
    const Vec3 start = p.Point + NudgeShare * (Centroid(around) - p.Point);
    const Vec3 n = AreaNormal2(around);
    if (source.InFront(start, Dot(n, p.Normal) >= 0.0 ? n : -n))
    {
      visit(RayEnd{ start, t });
    }
  }
}

/// True when rounding hides on which side of a point's plane the light is.
bool InPlane(const SourceFlux& source, const SurfacePoint& p, double extent)
{
  const Light& light = source.GetLight();
  const double height = source.Directional() ? -Dot(p.Normal, light.Direction)
                                             : Dot(p.Normal, light.Position - p.Point);
  const double reach = source.Directional() ? 1.0 : Length(light.Position - p.Point) + extent;
  return height <= 4.0 * Epsilon * reach;
}

/// What of a light reaches a point.
struct Sight
{
  explicit Sight(std::size_t bands)
    : Share(bands, 1.0)
    , Least(bands)
    , Most(bands)
    , One(bands)
  {
  }
  std::vector<double> Share; // of each band
  double Doubt = 0.0;        // of the share
  int Rays = 0;
  std::vector<double> Least, Most, One; // room
};

/// What one place sees of a light.
void Ask(const ShadowCutter& cutter, const RayEnd& from, std::vector<double>& shares)
{
  if (cutter.Transmits())
  {
    cutter.Passing(from, shares.data());
  }
  else
  {
    std::fill(shares.begin(), shares.end(), cutter.Hidden(from) ? 0.0 : 1.0);
  }
}

void See(const Scene& scene, const SourceFlux& source, const ShadowCutter& cutter,
  const SurfacePoint& p, const RayEnd& from, Sight& sight)
{
  sight.Doubt = 0.0;
  sight.Rays = 1;
  if (p.Around.empty())
  {
    Ask(cutter, from, sight.Share);
    return;
  }
  const std::size_t bands = sight.Share.size();
  std::fill(sight.Share.begin(), sight.Share.end(), 0.0);
  std::fill(sight.Least.begin(), sight.Least.end(), 1.0);
  std::fill(sight.Most.begin(), sight.Most.end(), 0.0);
  sight.Rays = 0;
  VisitPlaces(scene, source, p, [&](const RayEnd& place) {
    ++sight.Rays;
    Ask(cutter, place, sight.One);
    for (std::size_t b = 0; b < bands; ++b)
    {
      sight.Share[b] += sight.One[b];
      sight.Least[b] = std::min(sight.Least[b], sight.One[b]);
      sight.Most[b] = std::max(sight.Most[b], sight.One[b]);
    }
  });
  for (std::size_t b = 0; b < bands && sight.Rays > 0; ++b)
  {
    sight.Share[b] /= sight.Rays;
    // A shadow's edge runs through the vertex.
    sight.Doubt = std::max(sight.Doubt, 0.5 * (sight.Most[b] - sight.Least[b]));
  }
}

/// Neighbouring points under one light after the other.
class PointBlock : public ReceiverBlock
{
public:
  static constexpr std::size_t Most = 32;

  PointBlock(const Scene& scene, const OcclusionScene& occluders, const BeamLights& lights,
    const std::vector<SurfacePoint>& points, const DirectOptions& options, double extent)
    : Geometry(scene)
    , Occluders(occluders)
    , Lights(lights)
    , Points(points)
    , Hides(lights.Hides)
    , Extent(extent)
    , Bands(static_cast<std::size_t>(scene.Optics.Bands))
    , Transmits(lights.Size() > 0 && lights.Cutters[0] && lights.Cutters[0]->Transmits())
    , Seen(this->Bands)
  {
  }

  /// `blind`: there is no time to ask what is hidden; half of each light is taken.
  void Load(const std::uint32_t* begin, const std::uint32_t* end, bool blind)
  {
    this->Shadows = this->Hides && !blind && this->Lights.Cutters[0];
    this->Ids = begin;
    this->Count = static_cast<std::size_t>(end - begin);
    this->Around = {};
    this->Around.Greatest = std::numeric_limits<double>::infinity();
    Vec3 sum;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const SurfacePoint& p = this->Points[begin[i]];
      this->Around.Box.Add(p.Point);
      sum += p.Normal;
      this->From[i] = { p.Point, p.Triangle };
      if (p.Triangle < 0 && this->Shadows)
      {
        this->From[i].Triangle =
          this->Occluders.Touching(this->From[i].Point, p.Normal, p.Rounding);
        this->From[i].Close =
          this->From[i].Triangle < 0 && this->Occluders.TooClose(this->From[i].Point);
      }
    }
    const double length = Length(sum);
    this->Around.Normal = length > 0.0 ? sum / length : Vec3{ 0.0, 0.0, 1.0 };
    this->Around.CosSpread = length > 0.0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < this->Count && length > 0.0; ++i)
    {
      this->Around.CosSpread = std::min(this->Around.CosSpread,
        Dot(this->Around.Normal, this->Points[begin[i]].Normal) - 1e-15);
    }
  }
  std::size_t Size() const { return this->Count; }
  const ReceiverBounds& Bounds() const { return this->Around; }

  std::int64_t Ask(std::size_t light, const std::uint8_t* active, const double*,
    LightShare* shares) override
  {
    const SourceFlux& source = *this->Lights.Sources[light];
    const ShadowCutter* cutter = this->Lights.Cutters[light].get();
    std::int64_t rays = 0;
    this->Tint.assign(this->Transmits ? this->Count * this->Bands : 0, 1.0);
    this->Starts.clear();
    this->StartOf.clear();
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      this->Asked[i] = this->Lit[i] = 0;
      const SurfacePoint& p = this->Points[this->Ids[i]];
      const double e = active[i] != 0 ? source.AtPoint(p.Point, p.Normal) : 0.0;
      if (!(e > 0.0) || InPlane(source, p, this->Extent))
      {
        continue;
      }
      shares[i].Open = shares[i].Lit = e;
      if (this->Shadows && this->Transmits)
      {
        See(this->Geometry, source, *cutter, p, this->From[i], this->Seen);
        rays += this->Seen.Rays;
        this->Tinted(i, e, shares[i]);
      }
      else if (this->Shadows)
      {
        this->AddStarts(source, p, i);
      }
    }
    rays += this->Shadows ? this->Trace(*cutter) : 0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      LightShare& share = shares[i];
      if (share.Open > 0.0 && this->Shadows && !this->Transmits)
      {
        const bool edge = this->Lit[i] > 0 && this->Lit[i] < this->Asked[i];
        share.Lit *= this->Asked[i] > 0 ? static_cast<double>(this->Lit[i]) / this->Asked[i] : 0.0;
        // A shadow's edge runs through the vertex.
        share.Systematic += edge ? 0.5 * share.Open : 0.0;
      }
      else if (this->Hides && !this->Shadows)
      {
        share.Lit = share.Systematic = 0.5 * share.Open;
      }
      share.Systematic += 16.0 * Epsilon * share.Lit;
    }
    return rays;
  }
  const double* Tints() const override { return this->Tint.empty() ? nullptr : this->Tint.data(); }

private:
  void Tinted(std::size_t i, double e, LightShare& share)
  {
    const std::vector<double>& seen = this->Seen.Share;
    const double most = *std::max_element(seen.begin(), seen.end());
    share.Lit = this->Seen.Rays > 0 ? e * most : 0.0;
    share.Systematic += e * this->Seen.Doubt;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      this->Tint[i * this->Bands + b] = most > 0.0 ? seen[b] / most : 1.0;
    }
  }
  /// The point itself, or a place just inside each face of its sheet that faces the light.
  void AddStarts(const SourceFlux& source, const SurfacePoint& p, std::size_t i)
  {
    const auto add = [&](const RayEnd& from) {
      ++this->Asked[i];
      this->Starts.push_back(from);
      this->StartOf.push_back(static_cast<std::uint8_t>(i));
    };
    if (p.Around.empty())
    {
      add(this->From[i]);
      return;
    }
    VisitPlaces(this->Geometry, source, p, add);
  }
  std::int64_t Trace(const ShadowCutter& cutter)
  {
    if (this->Starts.empty())
    {
      return 0;
    }
    cutter.Hidden(this->Starts, this->Hidden);
    for (std::size_t s = 0; s < this->Starts.size(); ++s)
    {
      this->Lit[this->StartOf[s]] += this->Hidden[s] != 0 ? 0 : 1;
    }
    return static_cast<std::int64_t>(this->Starts.size());
  }

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const BeamLights& Lights;
  const std::vector<SurfacePoint>& Points;
  const bool Hides;
  bool Shadows = false;
  const double Extent;
  const std::size_t Bands;
  const bool Transmits;
  Sight Seen;
  std::size_t Count = 0;
  const std::uint32_t* Ids = nullptr;
  ReceiverBounds Around;
  std::array<RayEnd, Most> From;
  std::array<int, Most> Asked;
  std::array<int, Most> Lit;
  std::vector<RayEnd> Starts;
  std::vector<std::uint8_t> StartOf;
  std::vector<std::uint8_t> Hidden;
  std::vector<double> Tint;
};

/// Beams at points, in groups of neighbours.
class PointBeams : public DirectKind
{
public:
  PointBeams(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<SurfacePoint>& points, const DirectOptions& options,
    std::unique_ptr<BeamLights> lights, bool noTime, DirectFields& fields,
    const ReceiverGroups& groups)
    : DirectKind(0, points.size(), scene.Optics.Bands, options, fields, &groups)
    , Lights(std::move(lights))
    , Peaks(groups.Size(), 0.0)
    , Workers([this, &scene, &occluders, &points, &options, extent = Extent(scene)] {
      return std::make_unique<Worker>(scene, occluders, *this->Lights, points, options, extent);
    })
  {
    this->NoTime = noTime;
    if (this->Own().Dropped.empty())
    {
      this->Own().Dropped.assign(points.size(), 0.0f);
    }
  }

  const char* Name() const override { return "direct light"; }

protected:
  /// In haste a few of many lights first; then all.
  int Rounds(bool hurried) const override
  {
    int rounds = 1;
    for (std::size_t most = 8; hurried && 2 * most < this->Lights->Size(); most *= 8)
    {
      ++rounds;
    }
    return rounds;
  }
  std::size_t Most(int round, bool hurried) const
  {
    return round + 1 < this->Rounds(hurried) ? std::size_t{ 8 } << (3 * round)
                                             : std::numeric_limits<std::size_t>::max();
  }
  double Guess(int round, bool hurried) const override
  {
    return 1e-5 *
      static_cast<double>(std::min(this->Most(round, hurried), this->Lights->Size()));
  }
  bool Work(std::size_t item, int round, Haste haste) override
  {
    Worker& worker = *this->Workers.local();
    const std::uint32_t* ids = this->Groups->Begin(item);
    const auto count = static_cast<std::size_t>(this->Groups->End(item) - ids);
    const bool blind = haste == Haste::Blind;
    const std::size_t most = blind ? 4 : this->Most(round, haste == Haste::Some);
    const bool last = round + 1 == this->Rounds(haste == Haste::Some) && !blind;
    worker.Block.Load(ids, ids + count, blind);
    LightEffort effort;
    effort.Lights = most;
    effort.FirstLook = std::min<std::size_t>(effort.FirstLook, most);
    effort.RelativeTolerance = this->Options.RelativeTolerance;
    effort.AbsoluteTolerance = this->Options.AbsoluteTolerance;
    effort.Dropped = this->Options.Dropped;
    DirectField& own = this->Own();
    std::array<std::uint8_t, PointBlock::Most> active{};
    for (std::size_t i = 0; i < count; ++i)
    {
      active[i] = (blind ? this->Fresh(ids[i]) : round > 0 || this->Waits(ids[i])) ? 1 : 0;
    }
    LightSum& sum = worker.Sum;
    this->RayCount += sum.Compute(worker.Block, worker.Block.Bounds(), count, active.data(),
      effort, Hash64(this->Options.NumberOf(ids[0]), most));
    for (std::size_t i = 0; i < count; ++i)
    {
      if (active[i] == 0)
      {
        continue;
      }
      std::copy_n(&sum.Value[i * this->Bands], this->Bands, &own.Value[ids[i] * this->Bands]);
      std::copy_n(&sum.Error[i * this->Bands], this->Bands, &own.Error[ids[i] * this->Bands]);
      own.Dropped[ids[i]] = static_cast<float>(sum.Dropped[i]);
      own.State[ids[i]] = static_cast<std::uint8_t>(DirectField::Computed |
        (sum.Uncertain[i] != 0 || sum.Dropped[i] > 0.0 ? DirectField::Improvable : 0) |
        (last ? 0 : DirectField::Unfinished));
    }
    this->Peaks[item] = std::max(this->Peaks[item], sum.PeakUnshadowed);
    return !last;
  }
  void Between(int, const std::vector<std::uint32_t>& items, std::vector<std::uint8_t>&) override
  {
    for (const std::uint32_t item : items)
    {
      this->Own().Peak = std::max(this->Own().Peak, this->Peaks[item]);
    }
  }

private:
  /// What a thread works with.
  struct Worker
  {
    Worker(const Scene& scene, const OcclusionScene& occluders, const BeamLights& lights,
      const std::vector<SurfacePoint>& points, const DirectOptions& options, double extent)
      : Block(scene, occluders, lights, points, options, extent)
      , Sum(lights.Tree, scene.Optics.Bands)
    {
    }
    PointBlock Block;
    LightSum Sum;
  };

  std::unique_ptr<BeamLights> Lights;
  std::vector<double> Peaks;
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> Workers;
};

} // namespace

std::vector<std::uint32_t> SpatialOrder(const std::vector<Vec3>& places)
{
  Box3 box;
  for (const Vec3& p : places)
  {
    box.Add(p);
  }
  const Vec3 size = box.Size();
  const double longest = std::max({ size.x, size.y, size.z });
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(places.size());
  const auto spread = [](std::uint64_t digits) {
    digits = (digits | digits << 32) & 0x001f00000000ffffull;
    digits = (digits | digits << 16) & 0x001f0000ff0000ffull;
    digits = (digits | digits << 8) & 0x100f00f00f00f00full;
    digits = (digits | digits << 4) & 0x10c30c30c30c30c3ull;
    return (digits | digits << 2) & 0x1249249249249249ull;
  };
  tbb::parallel_for(
    tbb::blocked_range<std::size_t>(0, places.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        std::uint64_t key = 0;
        for (int a = 0; a < 3; ++a)
        {
          const double place =
            longest > 0.0 ? (places[i][a] - box.Min[a]) / longest * 1048575.0 : 0.0;
          key |= spread(static_cast<std::uint64_t>(std::clamp(place, 0.0, 1048575.0))) << a;
        }
        keys[i] = { key, static_cast<std::uint32_t>(i) };
      }
    });
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(places.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& k) { return k.second; });
  return order;
}

ReceiverGroups PointGroups(const std::vector<SurfacePoint>& points)
{
  std::vector<Vec3> places;
  places.reserve(points.size());
  for (const SurfacePoint& p : points)
  {
    places.push_back(p.Point);
  }
  ReceiverGroups groups;
  groups.Order = SpatialOrder(places);
  for (std::size_t k = 0; k < points.size(); k += PointBlock::Most)
  {
    groups.First.push_back(static_cast<std::uint32_t>(k));
  }
  groups.First.push_back(static_cast<std::uint32_t>(points.size()));
  return groups;
}

std::unique_ptr<DirectKind> MakeBeams(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const ReceiverGroups& groups,
  const DirectOptions& options, DirectFields& fields, const StageProgress& stage, double seconds)
{
  auto lights = std::make_unique<BeamLights>(scene, options);
  if (lights->Size() == 0)
  {
    return nullptr;
  }
  const bool noTime =
    lights->Hides && seconds > 0.0 && occluders.BuildingSeconds(options.Threads) > seconds;
  if (!noTime)
  {
    // No outlines: a point needs one ray a light.
    lights->FindShadows(scene, occluders, options, false, stage);
  }
  return std::make_unique<PointBeams>(
    scene, occluders, points, options, std::move(lights), noTime, fields, groups);
}

} // namespace radiometry
