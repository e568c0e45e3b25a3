// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/LightPaths.h"

#include "radiometry/formfactor/MirroredSky.h"
#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace radiometry
{
namespace
{

constexpr std::size_t Batches = 8;
constexpr double Coverage = 2.7;      // of an error estimated from eight batches
constexpr double FirstPaths = 4096.0; // a batch
constexpr double LeastPaths = 1e6;    // that a run may take however few its elements ...
constexpr double PathsAnElement = 200.0;
constexpr double MostPairs = 2e7; // of elements and lights that are looked at one by one
constexpr double DarkShare = 0.05;

/// An element that reflects light of the lights.
struct Reflector
{
  std::int32_t Element;
  double Power;        // that it may send on
  std::uint32_t Paths; // of a batch, at first
};

class Tracer
{
public:
  Tracer(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
    const SpecularSurfaces& surfaces, const std::vector<SpecularSource>& sources,
    const SpecularImages& images, const SpecularLightOptions& options)
    : Occluders(occluders)
    , Elements(elements)
    , Surfaces(surfaces)
    , Sources(sources)
    , Images(images)
    , Options(options)
    , Bands(static_cast<std::size_t>(scene.Optics.Bands))
    , Sums(new std::atomic<std::int64_t>[Batches * elements.Size() * Bands])
  {
    for (std::size_t k = 0; k < Batches * this->Elements.Size() * this->Bands; ++k)
    {
      this->Sums[k].store(0, std::memory_order_relaxed);
    }
    this->FindReflectors();
  }

  bool Nothing() const { return this->Reflectors.empty() || !(this->Total > 0.0); }
  double Paths() const
  {
    double paths = 0.0;
    for (const Reflector& r : this->Reflectors)
    {
      paths += static_cast<double>(r.Paths) * Batches;
    }
    return paths;
  }

  /// Paths [first, end) times those of the first round.
  void Trace(std::uint32_t first, std::uint32_t end, const StageProgress& stage)
  {
    const RankShare share(this->Options.Ranks, this->Reflectors.size());
    Collectively(this->Options.Ranks, [&] {
      ParallelFor(
        share.End - share.Begin, this->Options.Threads, stage,
        [&](std::size_t k) {
          this->TraceFrom(this->Reflectors[share.Begin + k], Batches, first, end);
        },
        1e-4);
    });
  }
  /// Fails where most paths are caught between mirrors.
  void CheckMirrors();
  /// Irradiance and its standard error after so many rounds.
  void Result(double rounds, std::vector<double>& mean, std::vector<double>& error) const;

private:
  struct Drawn;
  void FindReflectors();
  double SourcePower(std::size_t source, const Patch& patch, const Vec3& normal) const;
  /// Returns how many were caught.
  int TraceFrom(const Reflector& r, std::size_t batches, std::uint32_t first, std::uint32_t end);
  bool Draw(const SpecularSource& source, const Vec3& normal, const RayEnd& at,
    const std::array<double, 4>& u, Vec3& direction, std::vector<double>& flux) const;
  bool Follow(SurfaceHit hit, Vec3 direction, std::size_t batch, std::uint64_t key,
    std::uint32_t index, bool imaged, std::vector<double>& flux);
  void Count(std::int32_t element, std::size_t batch, const std::vector<double>& flux,
    const std::vector<double>& weight)
  {
    const std::size_t width = this->Surfaces.Width();
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double units = flux[b] * weight[width > 1 ? b : 0] / this->Unit;
      this
        ->Sums[(batch * this->Elements.Size() + static_cast<std::size_t>(element)) * this->Bands +
          b]
        .fetch_add(std::llround(units), std::memory_order_relaxed);
    }
  }

  const OcclusionScene& Occluders;
  const ElementSet& Elements;
  const SpecularSurfaces& Surfaces;
  const std::vector<SpecularSource>& Sources;
  const SpecularImages& Images;
  SpecularLightOptions Options;
  std::size_t Bands;
  std::unique_ptr<std::atomic<std::int64_t>[]> Sums; // batches x elements x bands, of flux
  std::vector<Reflector> Reflectors;
  double Total = 0.0;
  double Unit = 1.0; // W
  bool OneByOne = true;
};

/// Roughly what a source gives an element, nothing in the way.
double Tracer::SourcePower(std::size_t s, const Patch& patch, const Vec3& normal) const
{
  const SpecularSource& source = this->Sources[s];
  double most = source.Roughly(Centroid(patch.Corners), normal);
  for (const Vec3& corner : patch.Corners)
  {
    most = std::max(most, source.Roughly(corner, normal));
  }
  const double area = Area(patch.Corners);
  if (source.Is == SpecularSource::Kind::Beam && area > 0.0)
  {
    // A narrow cone may fall between all of these.
    double error = 0.0;
    most = std::max(most, source.Beam->OnPolygon(patch.Corners.data(), 3, normal, error) / area);
  }
  return most * source.Strength;
}

void Tracer::FindReflectors()
{
  const std::vector<Patch>& patches = this->Elements.GetPatches();
  std::vector<std::int32_t> reflecting;
  for (std::size_t e = 0; e < patches.size(); ++e)
  {
    double most = 0.0;
    for (std::size_t b = 0; b < this->Surfaces.Width(); ++b)
    {
      most =
        std::max(most, this->Surfaces.Reflectance(patches[e].Triangle, patches[e].Side == 0, b));
    }
    if (most > 0.0)
    {
      reflecting.push_back(static_cast<std::int32_t>(e));
      this->Reflectors.push_back({ static_cast<std::int32_t>(e), most, 0 });
    }
  }
  this->OneByOne =
    static_cast<double>(reflecting.size()) * static_cast<double>(this->Sources.size()) <= MostPairs;
  double strength = 0.0;
  for (const SpecularSource& source : this->Sources)
  {
    strength += source.Strength;
  }
  ParallelFor(this->Reflectors.size(), this->Options.Threads, {}, [&](std::size_t k) {
    Reflector& r = this->Reflectors[k];
    const Patch& patch = patches[static_cast<std::size_t>(r.Element)];
    const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
    double power = this->OneByOne ? 0.0 : strength;
    for (std::size_t s = 0; this->OneByOne && s < this->Sources.size(); ++s)
    {
      power += this->SourcePower(s, patch, normal);
    }
    r.Power *= power * this->Elements.GetAreas()[static_cast<std::size_t>(r.Element)];
  });
  for (const Reflector& r : this->Reflectors)
  {
    this->Total += r.Power;
  }
  for (Reflector& r : this->Reflectors)
  {
    r.Paths = static_cast<std::uint32_t>(
      std::max(1.0, std::ceil(this->Total > 0.0 ? FirstPaths * r.Power / this->Total : 1.0)));
  }
  // Room for paths that come by thousands of times.
  this->Unit = std::max(this->Total, 1e-300) * 0x1p-44;
}

/// Light of a source at a place of a reflector: flux over area and over the density of what was drawn,
/// per band; false where there is none.
bool Tracer::Draw(const SpecularSource& source, const Vec3& normal, const RayEnd& at,
  const std::array<double, 4>& u, Vec3& direction, std::vector<double>& flux) const
{
  std::vector<double> through(this->Bands, 1.0);
  double share = 0.0;
  bool visible = false;
  switch (source.Is)
  {
    case SpecularSource::Kind::Beam:
    {
      share = source.Beam->AtPoint(at.Point, normal);
      if (!(share > 0.0))
      {
        return false;
      }
      const Light& light = source.Beam->GetLight();
      if (source.Beam->Directional())
      {
        direction = light.Direction;
        visible = this->Occluders.VisibleDirection(at, -direction, through.data());
      }
      else
      {
        direction = Normalized(at.Point - light.Position);
        visible = this->Occluders.Visible(
          at, { light.Position, -1, this->Occluders.TooClose(light.Position) }, through.data());
      }
      break;
    }
    case SpecularSource::Kind::Panel:
    {
      const Vec3 on = TrianglePoint(source.Corners, u[2], u[3]);
      share = source.FromPanel(on, at.Point, normal);
      if (!(share > 0.0))
      {
        return false;
      }
      direction = Normalized(at.Point - on);
      RayEnd end{ on, source.Triangle };
      if (end.Triangle < 0)
      {
        end.Triangle = this->Occluders.Touching(end.Point, source.Normal, 0.0);
        end.Close = end.Triangle < 0 && this->Occluders.TooClose(end.Point);
      }
      visible = this->Occluders.Visible(at, end, through.data());
      break;
    }
  }
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    flux[b] = through[b] * share * source.Intensity[b];
  }
  return visible;
}

void Tracer::CheckMirrors()
{
  constexpr std::size_t Probes = 32;
  int caught = 0, probes = 0;
  for (std::size_t k = 0; k < this->Reflectors.size(); k += 1 + this->Reflectors.size() / Probes)
  {
    Reflector one = this->Reflectors[k];
    one.Paths = 1;
    caught += this->TraceFrom(one, 1, 0, 1);
    ++probes;
  }
  if (2 * caught > probes)
  {
    const Patch& p =
      this->Elements.GetPatches()[static_cast<std::size_t>(this->Reflectors[0].Element)];
    throw InputError(names::SpecularReflectance, p.Cell,
      this->Surfaces.Reflectance(p.Triangle, p.Side == 0, 0),
      "less than 1 somewhere around: light between these mirrors is caught for ever (more than " +
        std::to_string(MostBounces) + " reflections)");
  }
  for (std::size_t k = 0; k < Batches * this->Elements.Size() * this->Bands; ++k)
  {
    this->Sums[k].store(0, std::memory_order_relaxed);
  }
}

int Tracer::TraceFrom(
  const Reflector& r, std::size_t batches, std::uint32_t first, std::uint32_t end)
{
  int caught = 0;
  const auto element = static_cast<std::size_t>(r.Element);
  const Patch& patch = this->Elements.GetPatches()[element];
  const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
  std::vector<double> chance(this->Sources.size());
  for (std::size_t s = 0; s < chance.size(); ++s)
  {
    chance[s] = this->OneByOne ? this->SourcePower(s, patch, normal) : this->Sources[s].Strength;
  }
  std::partial_sum(chance.begin(), chance.end(), chance.begin());
  if (!(chance.back() > 0.0))
  {
    return caught;
  }
  std::vector<double> flux(this->Bands);
  for (std::size_t batch = 0; batch < batches; ++batch)
  {
    const std::uint64_t key = Hash64(Hash64(this->Options.Seed ^ 0x6c69676874ull, element), batch);
    const SobolSequence sequence(key), choices(Hash64(key));
    for (std::uint32_t k = first * r.Paths; k < end * r.Paths; ++k)
    {
      const auto u = sequence(k);
      const auto v = choices(k);
      const auto s = static_cast<std::size_t>(
        std::upper_bound(chance.begin(), chance.end(), v[0] * chance.back()) - chance.begin());
      const double density = (chance[s] - (s > 0 ? chance[s - 1] : 0.0)) / chance.back();
      const RayEnd at{ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle };
      Vec3 direction;
      if (!this->Draw(this->Sources[s], normal, at, u, direction, flux))
      {
        continue;
      }
      const double each =
        this->Elements.GetAreas()[element] / (density * static_cast<double>(r.Paths));
      for (double& f : flux)
      {
        f *= each;
      }
      SurfaceHit hit;
      hit.Triangle = patch.Triangle;
      hit.Front = patch.Side == 0;
      // The place by itself, not by its coordinates on the triangle.
      std::vector<double> weight(this->Surfaces.Width(), 1.0);
      const SpecularSurfaces::Fate fate =
        this->Surfaces.Reflect(hit, { v[0], v[1], v[2], v[3] }, direction, weight.data());
      if (fate == SpecularSurfaces::Fate::Absorbed)
      {
        continue;
      }
      const bool imaged = this->Images.PlaneOf(hit.Triangle, hit.Front) >= 0;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        flux[b] *= weight[weight.size() > 1 ? b : 0];
      }
      caught += this->Follow(
        this->Occluders.Closest(at, direction), direction, batch, key, k, imaged, flux);
    }
  }
  return caught;
}

/// A path after its first reflection: what arrives counts, but where images have it already. True
/// where it does not end.
bool Tracer::Follow(SurfaceHit hit, Vec3 direction, std::size_t batch, std::uint64_t key,
  std::uint32_t index, bool imaged, std::vector<double>& flux)
{
  const std::size_t width = this->Surfaces.Width();
  std::vector<double> weight(width, 1.0), counted(width);
  std::size_t reflections = 1;
  for (int bounces = 0; bounces < MostBounces && hit.Triangle >= 0; ++bounces)
  {
    const std::int32_t element = this->Elements.Find(hit.Triangle, hit.Front, hit.U, hit.V);
    const bool known = imaged && (this->Images.AllOrders() || reflections <= this->Images.Order());
    if (element >= 0 && !known)
    {
      this->Count(element, batch, flux, weight);
    }
    if (!this->Surfaces.GoesOn(hit))
    {
      return false;
    }
    const RayEnd place = this->Surfaces.Place(hit);
    const std::int32_t plane = this->Images.PlaneOf(hit.Triangle, hit.Front);
    const SobolSequence numbers(Hash64(key, 977u + static_cast<std::uint64_t>(bounces)));
    const SpecularSurfaces::Fate fate =
      this->Surfaces.Continue(hit, numbers(index), direction, weight.data(), counted.data());
    if (fate == SpecularSurfaces::Fate::Ended || fate == SpecularSurfaces::Fate::Absorbed)
    {
      return false;
    }
    if (fate != SpecularSurfaces::Fate::Transmitted)
    {
      ++reflections;
      imaged = imaged && plane >= 0;
    }
    hit = this->Occluders.Closest(place, direction);
  }
  return hit.Triangle >= 0;
}

void Tracer::Result(double rounds, std::vector<double>& mean, std::vector<double>& error) const
{
  const std::size_t values = this->Elements.Size() * this->Bands;
  mean.assign(values, 0.0);
  error.assign(values, 0.0);
  std::vector<std::int64_t> sums(Batches * values);
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    sums[k] = this->Sums[k].load(std::memory_order_relaxed);
  }
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Sum(sums.data(), sums.size());
  }
  for (std::size_t k = 0; k < values; ++k)
  {
    const double scale = this->Unit / (rounds * this->Elements.GetAreas()[k / this->Bands]);
    std::array<double, Batches> batch;
    for (std::size_t b = 0; b < Batches; ++b)
    {
      batch[b] = scale * static_cast<double>(sums[b * values + k]);
      mean[k] += batch[b] / Batches;
    }
    double square = 0.0;
    for (const double b : batch)
    {
      square += (b - mean[k]) * (b - mean[k]);
    }
    error[k] = std::sqrt(square / (Batches * (Batches - 1.0)));
  }
}

/// Elements that few paths met know little of their own error: half of it is the neighbourhood's,
/// whose paths met flux over area.
void Pool(
  const Scene& scene, const ElementSet& elements, std::size_t bands, std::vector<double>& error)
{
  std::size_t count = 0;
  const std::vector<std::int32_t> group = elements.Groups(scene, 2, count);
  std::vector<double> square(count * bands, 0.0), members(count, 0.0);
  const std::vector<double>& areas = elements.GetAreas();
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    members[g] += 1.0;
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double v = error[e * bands + b];
      square[g * bands + b] += v * v * areas[e];
    }
  }
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    for (std::size_t b = 0; b < bands && areas[e] > 0.0; ++b)
    {
      double& v = error[e * bands + b];
      v = std::sqrt(0.5 * (v * v + square[g * bands + b] / members[g] / areas[e]));
    }
  }
}

/// Whether 95 % of the cells, and of their area, are good enough.
bool Fine(const ElementSet& elements, std::size_t bands, const std::vector<double>& known,
  const std::vector<double>& images, const std::vector<double>& mean,
  const std::vector<double>& error, const SpecularLightOptions& options)
{
  std::size_t cells = 0;
  const std::vector<std::int32_t> group = elements.CellGroups(cells);
  const std::vector<double>& areas = elements.GetAreas();
  std::vector<double> value(cells * bands, 0.0), square(cells * bands, 0.0), area(cells, 0.0);
  double all = 0.0, average = 0.0;
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto c = static_cast<std::size_t>(group[e]);
    area[c] += areas[e];
    all += areas[e];
    for (std::size_t b = 0; b < bands; ++b)
    {
      const std::size_t k = e * bands + b;
      const double sum = areas[e] * (known[k] + images[k] + mean[k]);
      value[c * bands + b] += sum;
      average += sum / static_cast<double>(bands);
      square[c * bands + b] += std::pow(areas[e] * Coverage * error[k], 2);
    }
  }
  average /= all > 0.0 ? all : 1.0;
  double fine = 0.0, count = 0.0, met = 0.0;
  for (std::size_t c = 0; c < cells; ++c)
  {
    bool good = true;
    for (std::size_t b = 0; b < bands && area[c] > 0.0; ++b)
    {
      // Of the light that is all about: dim places may be wrong by a share of that.
      const double here = std::max(value[c * bands + b] / area[c], DarkShare * average);
      good = good &&
        std::sqrt(square[c * bands + b]) / area[c] <=
          std::max(options.AbsoluteTolerance, options.RelativeTolerance * here);
    }
    count += 1.0;
    met += good ? 1.0 : 0.0;
    fine += good ? area[c] : 0.0;
  }
  return fine >= 0.95 * all && met >= 0.95 * count;
}

StageProgress Part(const StageProgress& stage, double from, double to)
{
  StageProgress part = stage;
  part.Begin = stage.Begin + from * (stage.End - stage.Begin);
  part.End = stage.Begin + to * (stage.End - stage.Begin);
  return part;
}

} // namespace

SpecularLight FindSpecularLight(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const EmitterSet& emitters, const SpecularSurfaces& surfaces,
  const std::vector<double>& known, const SpecularLightOptions& options, const StageProgress& stage)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const std::size_t values = elements.Size() * bands;
  SpecularLight light;
  light.Irradiance.assign(values, 0.0);
  light.Error.assign(values, 0.0);
  if (!surfaces.Reflects())
  {
    return light;
  }
  AddMirroredSky(scene, occluders, elements, surfaces, options, Part(stage, 0.0, 0.2),
    light.Irradiance, light.Error);
  const std::vector<SpecularSource> sources = FindSpecularSources(scene, emitters, options);
  if (sources.empty())
  {
    return light;
  }
  const SpecularImages images(scene, occluders, surfaces, sources, elements.Size(), options);

  Tracer tracer(scene, occluders, elements, surfaces, sources, images, options);
  if (tracer.Nothing())
  {
    return light;
  }
  tracer.CheckMirrors();
  images.Add(elements.GetPatches(), Part(stage, 0.2, 0.4), light.Irradiance, light.Error);
  const double most = std::max(LeastPaths, PathsAnElement * static_cast<double>(elements.Size()));
  const auto began = std::chrono::steady_clock::now();
  std::vector<double> mean, error;
  std::uint32_t done = 0;
  for (std::uint32_t rounds = 1;; rounds *= 2)
  {
    tracer.Trace(done, rounds, Part(stage, 1.0 - 0.6 / rounds, 1.0 - 0.3 / rounds));
    done = rounds;
    tracer.Result(rounds, mean, error);
    Pool(scene, elements, bands, error);
    light.Paths = static_cast<std::int64_t>(tracer.Paths() * rounds);
    if (Fine(elements, bands, known, light.Irradiance, mean, error, options))
    {
      break;
    }
    double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (options.Ranks)
    {
      options.Ranks->Largest(&seconds, 1);
    }
    if (2.0 * tracer.Paths() * rounds > most ||
      (options.SecondsLeft > 0.0 && 2.0 * seconds > options.SecondsLeft))
    {
      light.Converged = false;
      break;
    }
  }
  for (std::size_t k = 0; k < values; ++k)
  {
    error[k] *= Coverage;
    light.Irradiance[k] += mean[k];
    light.Error[k] = std::hypot(light.Error[k], error[k]);
  }
  light.ByPaths = std::move(mean);
  light.ByPathsError = std::move(error);
  return light;
}

namespace
{

/// The element of a side of a triangle at a point of its plane; -1: none.
std::int32_t ElementAt(const Scene& scene, const ElementSet& elements, std::int32_t triangle,
  const Vec3& point, const Vec3& normal)
{
  const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(triangle));
  const Vec3 n = AreaNormal2(v);
  const double nn = Dot(n, n);
  if (!(nn > 0.0))
  {
    return -1;
  }
  const Vec3 p = point - v[0];
  const double a = std::clamp(Dot(n, Cross(p, v[2] - v[0])) / nn, 0.0, 1.0);
  const double b = std::clamp(Dot(n, Cross(v[1] - v[0], p)) / nn, 0.0, 1.0 - a);
  return elements.Find(triangle, Dot(n, normal) >= 0.0, a, b);
}

} // namespace

SpecularLight SpecularLightAt(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const SpecularLight& found, const EmitterSet& emitters,
  const SpecularSurfaces& surfaces, const std::vector<SurfacePoint>& points,
  const SpecularLightOptions& options, const StageProgress& stage)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  SpecularLight light;
  light.Irradiance.assign(points.size() * bands, 0.0);
  light.Error.assign(points.size() * bands, 0.0);
  if (!surfaces.Reflects())
  {
    return light;
  }
  AddMirroredSky(scene, occluders, points, surfaces, options, Part(stage, 0.0, 0.5),
    light.Irradiance, light.Error);
  const std::vector<SpecularSource> sources = FindSpecularSources(scene, emitters, options);
  const SpecularImages images(scene, occluders, surfaces, sources, elements.Size(), options);
  images.Add(points, Part(stage, 0.5, 1.0), light.Irradiance, light.Error);
  if (found.ByPaths.empty())
  {
    return light;
  }
  std::size_t count = 0;
  const std::vector<std::int32_t> group = elements.Groups(scene, 1, count);
  const std::vector<double>& areas = elements.GetAreas();
  std::vector<double> around(count * bands, 0.0), area(count, 0.0), mean(bands, 0.0);
  double all = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    area[g] += areas[e];
    all += areas[e];
    for (std::size_t b = 0; b < bands; ++b)
    {
      around[g * bands + b] += areas[e] * found.ByPaths[e * bands + b];
      mean[b] += areas[e] * found.ByPaths[e * bands + b];
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    std::vector<std::int32_t> triangles = points[i].Around;
    if (triangles.empty() && points[i].Triangle >= 0)
    {
      triangles.push_back(points[i].Triangle);
    }
    std::vector<std::size_t> met;
    for (const std::int32_t t : triangles)
    {
      const std::int32_t e = ElementAt(scene, elements, t, points[i].Point, points[i].Normal);
      if (e >= 0)
      {
        met.push_back(static_cast<std::size_t>(e));
      }
    }
    for (std::size_t b = 0; b < bands; ++b)
    {
      double value = 0.0, error = met.empty() && all > 0.0 ? mean[b] / all : 0.0, local = 0.0;
      for (const std::size_t e : met)
      {
        const double share = 1.0 / static_cast<double>(met.size());
        const auto g = static_cast<std::size_t>(group[e]);
        value += share * found.ByPaths[e * bands + b];
        error += share * found.ByPathsError[e * bands + b];
        local += share * (area[g] > 0.0 ? around[g * bands + b] / area[g] : 0.0);
      }
      light.Irradiance[i * bands + b] += value;
      light.Error[i * bands + b] =
        std::hypot(light.Error[i * bands + b], error + std::fabs(value - local));
    }
  }
  return light;
}

} // namespace radiometry
