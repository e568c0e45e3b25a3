// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SkyIrradiance.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/ClosedSurfaces.h"
#include "radiometry/irradiance/OpenSides.h"
#include "radiometry/irradiance/SkyTable.h"
#include "radiometry/irradiance/VisibleSky.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <tuple>

namespace radiometry
{
namespace
{

constexpr std::uint64_t SkySalt = 0x736b79ull;
constexpr int FirstSamples = 256;
/// Where no ray has found the sky, more are not spent.
constexpr int DarkSamples = 2048;

std::vector<std::unique_ptr<SkyTable>> MakeTables(
  const Scene& scene, const DirectOptions& options = {})
{
  std::vector<std::unique_ptr<SkyTable>> tables;
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    const Light& light = scene.Lights[k];
    if (options.Takes(k) && light.Enabled && light.Type == LightType::Environment)
    {
      tables.push_back(std::make_unique<SkyTable>(light));
      if (tables.back()->Black())
      {
        tables.pop_back();
      }
    }
  }
  return tables;
}

void Prepare(const Scene&, const OcclusionScene&, const DirectOptions&, const Patch& patch,
  SkyReceiver& receiver)
{
  receiver.Corners = patch.Corners;
  receiver.Triangle = patch.Triangle;
  receiver.Normal = Normalized(AreaNormal2(patch.Corners));
}

void Prepare(const Scene& scene, const OcclusionScene& occluders, const DirectOptions& options,
  const SurfacePoint& point, SkyReceiver& receiver)
{
  SurfacePoint p = point;
  if (options.Occlusion && p.Triangle < 0 && p.Around.empty())
  {
    p.Triangle = occluders.Touching(p.Point, p.Normal, p.Rounding);
  }
  receiver.Normal = p.Normal;
  receiver.Corners[0] = p.Point;
  receiver.Count = 1;
  if (options.Occlusion)
  {
    receiver.Starts = PointStarts(scene, occluders, p);
  }
}

/// Normal that groups receivers alike.
Vec3 NormalOf(const Patch& patch)
{
  return Normalized(AreaNormal2(patch.Corners));
}
Vec3 NormalOf(const SurfacePoint& point)
{
  return point.Normal;
}
double WeightOf(const Patch& patch)
{
  return Area(patch.Corners);
}
double WeightOf(const SurfacePoint&)
{
  return 1.0;
}

/// Irradiance with nothing in the way, for each different normal once.
class OpenIrradiance
{
public:
  template <typename Receivers>
  OpenIrradiance(const std::vector<std::unique_ptr<SkyTable>>& skies, const Receivers& receivers,
    std::size_t bands, int threads, const StageProgress& stage)
    : Bands(bands)
    , Skies(skies.size())
    , Which(receivers.size())
  {
    std::vector<Vec3> normals(receivers.size());
    ParallelFor(
      receivers.size(), threads, { stage.Listener, stage.Begin, stage.Begin, stage.Name },
      [&](std::size_t i) { normals[i] = NormalOf(receivers[i]); }, 1e-7);
    std::vector<std::size_t> order(receivers.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::tie(normals[a].x, normals[a].y, normals[a].z, a) <
        std::tie(normals[b].x, normals[b].y, normals[b].z, b);
    });
    std::vector<std::size_t> first;
    for (const std::size_t i : order)
    {
      if (first.empty() || !(normals[i] == normals[first.back()]))
      {
        first.push_back(i);
      }
      this->Which[i] = first.size() - 1;
    }
    this->Values.assign(first.size() * this->Skies * bands, 0.0);
    this->Errors.assign(first.size() * this->Skies, 0.0);
    ParallelFor(
      first.size(), threads, stage,
      [&](std::size_t k) {
        for (std::size_t s = 0; s < this->Skies; ++s)
        {
          const std::size_t at = k * this->Skies + s;
          this->Errors[at] = skies[s]->Irradiance(normals[first[k]], &this->Values[at * bands]);
        }
      },
      2e-5);
  }

  const double* Value(std::size_t receiver, std::size_t sky) const
  {
    return &this->Values[(this->Which[receiver] * this->Skies + sky) * this->Bands];
  }
  double RelativeError(std::size_t receiver, std::size_t sky) const
  {
    return this->Errors[this->Which[receiver] * this->Skies + sky];
  }

private:
  std::size_t Bands;
  std::size_t Skies;
  std::vector<std::size_t> Which; // normal of each receiver
  std::vector<double> Values;     // normals x skies x bands
  std::vector<double> Errors;     // normals x skies, relative
};

int MostSamples(double relativeTolerance)
{
  const double wanted = 600.0 / std::max(relativeTolerance, 1e-9);
  int samples = FirstSamples;
  while (samples < wanted && samples < (1 << 20))
  {
    samples *= 2;
  }
  return std::max(samples, 4096);
}

template <typename Receivers>
void Add(const Scene& scene, const OcclusionScene& occluders, const Receivers& receivers,
  const DirectOptions& options, const StageProgress& stage, ConvergenceRecord* record,
  DirectResult& result)
{
  const ConvergenceRecord clock;
  const auto skies = MakeTables(scene, options);
  // Of several ranks all go through the same rounds, since they compare with the mean of all.
  const Communicator* ranks = options.MeanShare > 0.0 ? options.Ranks : nullptr;
  if (skies.empty() || (receivers.empty() && !ranks) || !options.Environment)
  {
    return;
  }
  const auto bands = static_cast<std::size_t>(result.Bands);
  const auto part = [&](double from, double to) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    return p;
  };
  const OpenIrradiance open(skies, receivers, bands, options.Threads, part(0.0, 0.1));
  const bool hides = options.Occlusion && !scene.Triangles.empty();
  const bool panes =
    Compiled(Effect::Transmission) && hides && options.Transmission && occluders.HasPanes();
  std::unique_ptr<OpenSides> sides;
  if (hides)
  {
    sides = std::make_unique<OpenSides>(scene);
    Report(stage.Listener, part(0.0, 0.15).End, stage.Name);
  }

  const std::vector<double> before = result.Irradiance;
  const std::vector<double> beforeError = result.Error;
  const std::int64_t raysBefore = result.Rays;
  const int most = MostSamples(options.RelativeTolerance);
  std::vector<int> target(receivers.size(), FirstSamples); // rays of the next round; 0: done
  std::vector<int> spent(receivers.size(), 0);             // rays of the last
  std::vector<double> own(result.Error.size(), 0.0);       // error of the sky's part
  std::vector<std::uint8_t> proved(receivers.size() * skies.size(), 0);
  std::vector<double> unshadowed(receivers.size(), 0.0);
  std::vector<double> weights(receivers.size());
  std::vector<std::uint8_t> dark(receivers.size(), 0); // every ray was blocked
  std::atomic<std::int64_t> rays{ 0 };
  std::atomic<bool> expired{ false };

  const auto compute = [&](std::size_t i, bool first, bool hasty) {
    SkyReceiver receiver;
    Prepare(scene, occluders, options, receivers[i], receiver);
    weights[i] = WeightOf(receivers[i]);
    const int samples = target[i];
    static thread_local std::vector<double> value, error;
    value.assign(bands, 0.0);
    error.assign(bands, 0.0);
    std::vector<double> all(bands, 0.0);
    bool sampled = false;
    bool hidden = true;
    for (std::size_t s = 0; s < skies.size() && weights[i] > 0.0; ++s)
    {
      const double* e = open.Value(i, s);
      if (!std::any_of(e, e + bands, [](double x) { return x > 0.0; }))
      {
        continue;
      }
      const double relative = open.RelativeError(i, s);
      std::uint8_t& known = proved[i * skies.size() + s];
      if (first && hides)
      {
        const Vec3* up = skies[s]->DarkBelow() ? &skies[s]->Frame().Up : nullptr;
        const auto clear = [&](const Vec3* places, int count) {
          return sides->Open(places, count, receiver.Normal, up);
        };
        // A vertex lies on its neighbours: what counts is where its rays start, a little inside.
        const auto clearStart = [&](const PointStart& start) { return clear(&start.End.Point, 1); };
        known = clear(receiver.Corners.data(), receiver.Count) &&
            std::all_of(receiver.Starts.begin(), receiver.Starts.end(), clearStart)
          ? 1
          : 0;
      }
      static thread_local VisibleShare share;
      const bool sees = !hides || known != 0;
      if (!sees && !hasty)
      {
        const std::uint64_t key = Hash64(SkySalt + s, options.NumberOf(i));
        FindVisibleShare(occluders, *skies[s], receiver, panes, key, samples, share);
        rays += share.Rays;
        sampled = true;
        hidden = hidden && share.AllHidden;
      }
      for (std::size_t b = 0; b < bands; ++b)
      {
        const std::size_t layer = share.Value.size() > 1 ? b : 0;
        const double visible = sees ? 1.0 : (hasty ? 0.5 : share.Value[layer]);
        const double doubt = sees ? 0.0 : (hasty ? 0.5 : share.Error[layer]);
        value[b] += e[b] * visible;
        error[b] = std::hypot(error[b], e[b] * (doubt + relative * visible));
        all[b] += e[b];
      }
    }
    dark[i] = sampled && hidden ? 1 : 0;
    unshadowed[i] = *std::max_element(all.begin(), all.end());
    for (std::size_t b = 0; b < bands; ++b)
    {
      const std::size_t at = i * bands + b;
      result.Irradiance[at] = before[at] + value[b];
      result.Error[at] = std::hypot(beforeError[at], error[b]);
      own[at] = error[b];
    }
    spent[i] = sampled ? samples : 0;
  };
  // The rays of a receiver's next round; 0: it is good enough, or as good as can be.
  const auto more = [&](std::size_t i, double mean) {
    double excess = 0.0;
    for (std::size_t at = i * bands; at < (i + 1) * bands; ++at)
    {
      const double value = std::max(result.Irradiance[at], options.MeanShare * mean);
      const double allowed = std::max(options.RelativeTolerance * value, options.AbsoluteTolerance);
      if (own[at] > allowed)
      {
        excess = std::max(excess, allowed > 0.0 ? own[at] / allowed : 1e9);
      }
    }
    const int limit = dark[i] ? std::min(most, DarkSamples) : most;
    if (spent[i] == 0 || excess <= 1.0 || spent[i] >= limit)
    {
      return 0;
    }
    // Errors fall with about the power 5/8 of the rays.
    const double wanted = 1.2 * spent[i] * std::pow(excess, 1.6);
    int next = 2 * spent[i];
    while (next < limit && next < wanted && next < 8 * spent[i])
    {
      next *= 2;
    }
    return std::min(next, limit);
  };
  const auto meanValue = [&] {
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      weight += weights[i];
      for (std::size_t b = 0; b < bands; ++b)
      {
        sum += weights[i] * result.Irradiance[i * bands + b] / static_cast<double>(bands);
      }
    }
    double sums[2] = { sum, weight };
    if (ranks)
    {
      ranks->Sum(sums, 2);
    }
    return sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
  };
  // Whether any rank has something left to do, and all have time.
  const auto goesOn = [&](bool left) {
    double state[2] = { left ? 1.0 : 0.0, expired ? 1.0 : 0.0 };
    if (ranks)
    {
      ranks->Largest(state, 2);
    }
    return state[0] > 0.0 && state[1] == 0.0;
  };

  std::vector<std::size_t> todo(receivers.size());
  std::iota(todo.begin(), todo.end(), std::size_t{ 0 });
  double done = 0.15;
  for (int round = 0; goesOn(!todo.empty()); ++round)
  {
    const double next = done + 0.5 * (1.0 - done);
    ParallelFor(
      todo.size(), options.Threads, part(done, next),
      [&](std::size_t k) {
        if (options.SecondsLeft > 0.0 && clock.Elapsed() > options.SecondsLeft)
        {
          expired = true;
        }
        if (round == 0 || !expired)
        {
          compute(todo[k], round == 0, expired);
        }
      },
      1e-4);
    done = next;
    const double mean = options.MeanShare > 0.0 ? meanValue() : 0.0;
    for (const std::size_t i : todo)
    {
      target[i] = more(i, mean);
    }
    if (round == 0 && !panes && std::any_of(dark.begin(), dark.end(), [](auto d) { return d != 0; }))
    {
      // Inside closed surfaces what the rays say is certain.
      const ClosedSurfaces closed(scene);
      for (std::size_t i = 0; i < receivers.size(); ++i)
      {
        if (dark[i] && closed.Encloses(receivers[i]))
        {
          std::copy_n(&beforeError[i * bands], bands, &result.Error[i * bands]);
          target[i] = 0;
        }
      }
    }
    todo.erase(
      std::remove_if(todo.begin(), todo.end(), [&](std::size_t i) { return target[i] == 0; }),
      todo.end());
    result.Rays = raysBefore + rays;
    RecordDirect(record, result, weights, "sky");
  }
  result.TimedOut = result.TimedOut || expired;
  result.PeakUnshadowed +=
    receivers.empty() ? 0.0 : *std::max_element(unshadowed.begin(), unshadowed.end());
  Report(stage.Listener, stage.End, stage.Name);
}

} // namespace

void AddSkyIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result)
{
  Add(scene, occluders, patches, options, stage, record, result);
}

void AddSkyIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result)
{
  Add(scene, occluders, points, options, stage, record, result);
}

double GreatestSkyIrradiance(const Scene& scene)
{
  double sum = 0.0;
  for (const auto& table : MakeTables(scene))
  {
    sum += table->GreatestIrradiance();
  }
  return sum;
}

} // namespace radiometry
