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
#include <functional>
#include <thread>
#include <unordered_map>

namespace radiometry
{
namespace
{

constexpr std::uint64_t SkySalt = 0x736b79ull;
constexpr int FirstSamples = 256;
constexpr int HurriedSamples = 64;
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

/// Irradiance with nothing in the way, for each different normal once, when it is first asked for.
class OpenIrradiance
{
public:
  template <typename Receivers>
  OpenIrradiance(const std::vector<std::unique_ptr<SkyTable>>& skies, const Receivers& receivers,
    std::size_t bands, int threads, const StageProgress& stage)
    : Bands(bands)
    , Tables(skies)
    , Skies(skies.size())
    , Which(receivers.size())
  {
    std::vector<Vec3> normals(receivers.size());
    ParallelFor(
      receivers.size(), threads, { stage.Listener, stage.Begin, stage.Begin, stage.Name },
      [&](std::size_t i) { normals[i] = NormalOf(receivers[i]); }, 1e-7);
    struct Hash
    {
      std::size_t operator()(const Vec3& n) const
      {
        const std::hash<double> one;
        return (one(n.x) * 31 + one(n.y)) * 1000003 + one(n.z);
      }
    };
    std::unordered_map<Vec3, std::uint32_t, Hash> numbers;
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      if (i > 0 && normals[i] == normals[i - 1])
      {
        this->Which[i] = this->Which[i - 1]; // as on a flat floor
        continue;
      }
      const auto found =
        numbers.emplace(normals[i], static_cast<std::uint32_t>(this->Normals.size()));
      if (found.second)
      {
        this->Normals.push_back(normals[i]);
      }
      this->Which[i] = found.first->second;
    }
    this->Values.assign(this->Normals.size() * this->Skies * bands, 0.0);
    this->Errors.assign(this->Normals.size() * this->Skies, 0.0);
    this->State = std::vector<std::atomic<std::uint8_t>>(this->Normals.size());
  }

  const double* Value(std::size_t receiver, std::size_t sky)
  {
    this->Find(this->Which[receiver]);
    return &this->Values[(this->Which[receiver] * this->Skies + sky) * this->Bands];
  }
  double RelativeError(std::size_t receiver, std::size_t sky) const
  {
    return this->Errors[this->Which[receiver] * this->Skies + sky];
  }

private:
  void Find(std::size_t normal)
  {
    constexpr std::uint8_t unknown = 0, working = 1, known = 2;
    std::atomic<std::uint8_t>& state = this->State[normal];
    if (state.load(std::memory_order_acquire) == known)
    {
      return;
    }
    std::uint8_t expected = unknown;
    if (!state.compare_exchange_strong(expected, working))
    {
      while (state.load(std::memory_order_acquire) != known)
      {
        std::this_thread::yield(); // some microseconds
      }
      return;
    }
    for (std::size_t s = 0; s < this->Skies; ++s)
    {
      const std::size_t at = normal * this->Skies + s;
      this->Errors[at] =
        this->Tables[s]->Irradiance(this->Normals[normal], &this->Values[at * this->Bands]);
    }
    state.store(known, std::memory_order_release);
  }

  std::size_t Bands;
  const std::vector<std::unique_ptr<SkyTable>>& Tables;
  std::size_t Skies;
  std::vector<Vec3> Normals;
  std::vector<std::uint32_t> Which; // normal of each receiver
  std::vector<std::atomic<std::uint8_t>> State;
  std::vector<double> Values; // normals x skies x bands
  std::vector<double> Errors; // normals x skies, relative
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

/// Skies on receivers, one by one.
template <typename Receiver>
class Skies : public DirectKind
{
public:
  Skies(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<Receiver>& receivers, const DirectOptions& options, DirectFields& fields,
    std::vector<std::unique_ptr<SkyTable>> tables, bool noTime, const StageProgress& stage)
    : DirectKind(2, receivers.size(), scene.Optics.Bands, options, fields, nullptr)
    , Geometry(scene)
    , Occluders(occluders)
    , Receivers(receivers)
    , Tables(std::move(tables))
    , Open(this->Tables, receivers, this->Bands, options.Threads, stage)
    , Hides(options.Occlusion && !scene.Triangles.empty())
    , Panes(Compiled(Effect::Transmission) && this->Hides && options.Transmission &&
        occluders.HasPanes())
    , Most(MostSamples(options.RelativeTolerance))
    // Of several ranks all go through the same rounds, since they compare with the mean of all.
    , Ranks(options.MeanShare > 0.0 ? options.Ranks : nullptr)
    , Target(receivers.size(), 0)
    , Proved(receivers.size() * this->Tables.size(), Unknown)
    , Unshadowed(receivers.size(), 0.0f)
  {
    this->NoTime = noTime;
    if (this->Hides && !noTime)
    {
      this->Sides = std::make_unique<OpenSides>(scene);
    }
    for (const auto& table : this->Tables)
    {
      this->Greatest += table->GreatestIrradiance();
    }
    DirectField& own = this->Own();
    own.Dropped.resize(receivers.size(), 0.0f);
    own.Spent.resize(receivers.size(), 0);
    own.Dark.resize(receivers.size(), 0);
    this->Resume();
  }

  const char* Name() const override { return "sky"; }

protected:
  int Rounds(bool) const override { return std::numeric_limits<int>::max(); }
  double Guess(int, bool) const override { return 1e-4; }
  bool GoesOn(bool left, bool expired) override
  {
    double state[2] = { left ? 1.0 : 0.0, expired ? 1.0 : 0.0 };
    if (this->Ranks)
    {
      this->Ranks->Largest(state, 2);
    }
    return state[0] > 0.0 && state[1] == 0.0;
  }
  bool Work(std::size_t i, int round, Haste haste) override;
  void Between(
    int round, const std::vector<std::uint32_t>& items, std::vector<std::uint8_t>& again) override;

private:
  enum : std::uint8_t
  {
    Unknown,
    Clear, // nothing stands in the way: proved
    Asked  // by rays
  };
  void Resume();
  bool LeaveOut(std::size_t i);
  void Bound(std::size_t i);
  bool IsClear(std::size_t i, std::size_t sky, const SkyReceiver& receiver);
  int More(std::size_t i, double mean);
  double MeanValue();

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const std::vector<Receiver>& Receivers;
  std::vector<std::unique_ptr<SkyTable>> Tables;
  OpenIrradiance Open;
  const bool Hides;
  const bool Panes;
  const int Most;
  const Communicator* Ranks;
  std::unique_ptr<OpenSides> Sides;
  std::unique_ptr<ClosedSurfaces> Closed;
  double Greatest = 0.0;           // of all skies, any normal, any band
  std::vector<int> Target;         // rays of the next round; 0: the first
  std::vector<std::uint8_t> Proved; // receivers x skies
  std::vector<float> Unshadowed;
};

/// Where rays were traced before, the first round is the one that would have followed.
template <typename Receiver>
void Skies<Receiver>::Resume()
{
  const double mean = this->Options.MeanShare > 0.0 ? this->MeanValue() : 0.0;
  for (std::size_t i = 0; i < this->Receivers.size(); ++i)
  {
    if (this->Waits(i) && this->Own().Spent[i] > 0)
    {
      this->Target[i] = this->More(i, mean);
    }
  }
}

/// True when all skies together are small beside what is there: then they are left out.
template <typename Receiver>
bool Skies<Receiver>::LeaveOut(std::size_t i)
{
  if (!this->Options.DropSky)
  {
    return false;
  }
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    before = std::min(before, this->Before(i, b));
  }
  if (!(this->Greatest <= this->MayDrop(i, before)))
  {
    return false;
  }
  DirectField& own = this->Own();
  std::fill_n(&own.Value[i * this->Bands], this->Bands, 0.0);
  std::fill_n(&own.Error[i * this->Bands], this->Bands, this->Greatest);
  own.Dropped[i] = static_cast<float>(this->Greatest);
  own.State[i] = DirectField::Computed | DirectField::Improvable;
  this->Unshadowed[i] = static_cast<float>(this->Greatest);
  return true;
}

/// No time: half of what no plane gets more than.
template <typename Receiver>
void Skies<Receiver>::Bound(std::size_t i)
{
  DirectField& own = this->Own();
  std::fill_n(&own.Value[i * this->Bands], this->Bands, 0.5 * this->Greatest);
  std::fill_n(&own.Error[i * this->Bands], this->Bands, 0.5 * this->Greatest);
  own.State[i] = DirectField::Computed | DirectField::Improvable | DirectField::Unfinished;
  this->Unshadowed[i] = static_cast<float>(this->Greatest);
}

template <typename Receiver>
bool Skies<Receiver>::IsClear(std::size_t i, std::size_t sky, const SkyReceiver& receiver)
{
  std::uint8_t& known = this->Proved[i * this->Tables.size() + sky];
  if (known == Unknown)
  {
    const SkyTable& table = *this->Tables[sky];
    const Vec3* up = table.DarkBelow() ? &table.Frame().Up : nullptr;
    const auto clear = [&](const Vec3* places, int count) {
      return this->Sides->Open(places, count, receiver.Normal, up);
    };
    // A vertex lies on its neighbours: what counts is where its rays start, a little inside.
    const auto clearStart = [&](const PointStart& start) { return clear(&start.End.Point, 1); };
    known = clear(receiver.Corners.data(), static_cast<int>(receiver.Count)) &&
        std::all_of(receiver.Starts.begin(), receiver.Starts.end(), clearStart)
      ? Clear
      : Asked;
  }
  return known == Clear;
}

template <typename Receiver>
bool Skies<Receiver>::Work(std::size_t i, int round, Haste haste)
{
  DirectField& own = this->Own();
  const double weight = WeightOf(this->Receivers[i]);
  if (!(weight > 0.0))
  {
    own.State[i] = DirectField::Computed;
    return false;
  }
  if (this->LeaveOut(i))
  {
    return false;
  }
  if (haste == Haste::Blind)
  {
    this->Bound(i);
    return true;
  }
  SkyReceiver receiver;
  Prepare(this->Geometry, this->Occluders, this->Options, this->Receivers[i], receiver);
  const int start = haste == Haste::Some ? HurriedSamples : FirstSamples;
  const int samples = this->Target[i] > 0 ? this->Target[i] : start;
  static thread_local std::vector<double> value, error, all;
  value.assign(this->Bands, 0.0);
  error.assign(this->Bands, 0.0);
  all.assign(this->Bands, 0.0);
  bool sampled = false;
  bool hidden = true;
  for (std::size_t s = 0; s < this->Tables.size(); ++s)
  {
    const double* e = this->Open.Value(i, s);
    if (!std::any_of(e, e + this->Bands, [](double x) { return x > 0.0; }))
    {
      continue;
    }
    const double relative = this->Open.RelativeError(i, s);
    static thread_local VisibleShare share;
    const bool sees = !this->Hides || this->IsClear(i, s, receiver);
    if (!sees)
    {
      const std::uint64_t key = Hash64(SkySalt + s, this->Options.NumberOf(i));
      FindVisibleShare(
        this->Occluders, *this->Tables[s], receiver, this->Panes, key, samples, share);
      this->RayCount += share.Rays;
      sampled = true;
      hidden = hidden && share.AllHidden;
    }
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const std::size_t layer = share.Value.size() > 1 ? b : 0;
      const double visible = sees ? 1.0 : share.Value[layer];
      const double doubt = sees ? 0.0 : share.Error[layer];
      value[b] += e[b] * visible;
      error[b] = std::hypot(error[b], e[b] * (doubt + relative * visible));
      all[b] += e[b];
    }
  }
  own.Dark[i] = sampled && hidden ? 1 : 0;
  own.Dropped[i] = 0.0f;
  this->Unshadowed[i] =
    static_cast<float>(*std::max_element(all.begin(), all.end()) * (1.0 + 1e-7));
  std::copy_n(value.begin(), this->Bands, &own.Value[i * this->Bands]);
  std::copy_n(error.begin(), this->Bands, &own.Error[i * this->Bands]);
  own.Spent[i] = sampled ? samples : 0;
  own.State[i] = static_cast<std::uint8_t>(
    DirectField::Computed | (sampled ? DirectField::Improvable | DirectField::Unfinished : 0));
  (void)round;
  return sampled;
}

/// The rays of a receiver's next round; 0: it is good enough, or as good as can be.
template <typename Receiver>
int Skies<Receiver>::More(std::size_t i, double mean)
{
  const DirectField& own = this->Own();
  double excess = 0.0;
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    const std::size_t at = i * this->Bands + b;
    const double value =
      std::max(this->Before(i, b) + own.Value[at], this->Options.MeanShare * mean);
    const double allowed =
      std::max(this->Options.RelativeTolerance * value, this->Options.AbsoluteTolerance);
    if (own.Error[at] > allowed)
    {
      excess = std::max(excess, allowed > 0.0 ? own.Error[at] / allowed : 1e9);
    }
  }
  const int spent = own.Spent[i];
  const int limit = own.Dark[i] ? std::min(this->Most, DarkSamples) : this->Most;
  if (spent == 0 || excess <= 1.0 || spent >= limit)
  {
    return 0;
  }
  // Errors fall with about the power 5/8 of the rays.
  const double wanted = 1.2 * spent * std::pow(excess, 1.6);
  int next = 2 * spent;
  while (next < limit && next < wanted && next < 8 * spent)
  {
    next *= 2;
  }
  return std::min(next, limit);
}

template <typename Receiver>
double Skies<Receiver>::MeanValue()
{
  double sums[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < this->Receivers.size(); ++i)
  {
    const double weight = WeightOf(this->Receivers[i]);
    sums[1] += weight;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      sums[0] += weight * (this->Before(i, b) + this->Own().Value[i * this->Bands + b]) /
        static_cast<double>(this->Bands);
    }
  }
  if (this->Ranks)
  {
    this->Ranks->Sum(sums, 2);
  }
  return sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
}

template <typename Receiver>
void Skies<Receiver>::Between(
  int round, const std::vector<std::uint32_t>& items, std::vector<std::uint8_t>& again)
{
  DirectField& own = this->Own();
  const double mean = this->Options.MeanShare > 0.0 ? this->MeanValue() : 0.0;
  bool anyDark = false;
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    const std::uint32_t i = items[k];
    own.Peak = std::max(own.Peak, static_cast<double>(this->Unshadowed[i]));
    if (again[k] == 0 || own.Spent[i] == 0)
    {
      continue;
    }
    this->Target[i] = this->More(i, mean);
    again[k] = this->Target[i] > 0 ? 1 : 0;
    anyDark = anyDark || own.Dark[i] != 0;
  }
  if (round == 0 && !this->Panes && anyDark)
  {
    // Inside closed surfaces what the rays say is certain.
    if (!this->Closed)
    {
      this->Closed = std::make_unique<ClosedSurfaces>(this->Geometry);
    }
    for (std::size_t k = 0; k < items.size(); ++k)
    {
      const std::uint32_t i = items[k];
      if (own.Dark[i] != 0 && this->Closed->Encloses(this->Receivers[i]))
      {
        std::fill_n(&own.Error[i * this->Bands], this->Bands, 0.0);
        again[k] = 0;
      }
    }
  }
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    if (again[k] == 0)
    {
      std::uint8_t& state = own.State[items[k]];
      state = static_cast<std::uint8_t>(state & ~DirectField::Unfinished);
    }
  }
}

template <typename Receiver>
std::unique_ptr<DirectKind> Make(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Receiver>& receivers, const DirectOptions& options, DirectFields& fields,
  const StageProgress& stage, double seconds)
{
  auto tables = options.Environment ? MakeTables(scene, options)
                                    : std::vector<std::unique_ptr<SkyTable>>();
  if (tables.empty())
  {
    return nullptr;
  }
  Report(stage.Listener, stage.Begin, stage.Name);
  constexpr double sides = 1.5e-6; // seconds a triangle
  const bool noTime = seconds > 0.0 && options.Occlusion &&
    sides * static_cast<double>(scene.Triangles.size()) +
        occluders.BuildingSeconds(options.Threads) > seconds;
  return std::make_unique<Skies<Receiver>>(
    scene, occluders, receivers, options, fields, std::move(tables), noTime, stage);
}

} // namespace

std::unique_ptr<DirectKind> MakeSkies(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, DirectFields& fields,
  const StageProgress& stage, double seconds)
{
  return Make(scene, occluders, patches, options, fields, stage, seconds);
}

std::unique_ptr<DirectKind> MakeSkies(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options, DirectFields& fields,
  const StageProgress& stage, double seconds)
{
  return Make(scene, occluders, points, options, fields, stage, seconds);
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
