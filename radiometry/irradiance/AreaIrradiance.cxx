// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaIrradiance.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/irradiance/AreaStage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiometry
{
namespace
{

/// Parts that a receiver (at points: a source) may be cut into, round by round.
constexpr int Efforts[] = { 4, 64, 1024 };
constexpr int AllRounds = 3;

/// Area sources on receivers, one by one.
template <class Receiver>
class Areas : public DirectKind
{
public:
  Areas(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<Receiver>& receivers, const DirectOptions& options, DirectFields& fields,
    std::unique_ptr<AreaSources> sources, bool noTime)
    : DirectKind(1, receivers.size(), scene.Optics.Bands, options, fields, nullptr)
    , Sources(std::move(sources))
    , Receivers(receivers)
    , Unshadowed(receivers.size(), 0.0f)
  {
    this->NoTime = noTime;
    if (!noTime)
    {
      this->Stage = std::make_unique<AreaStage>(
        scene, occluders, *this->Sources, options.Occlusion, options.Transmission);
    }
    this->Own().Dropped.resize(receivers.size(), 0.0f);
    this->Own().Spent.resize(receivers.size(), 0);
  }

  const char* Name() const override { return "area lights"; }

protected:
  int Rounds(bool) const override { return AllRounds; }
  double Guess(int, bool) const override { return 1e-4; }
  bool Work(std::size_t i, int round, Haste haste) override
  {
    DirectField& own = this->Own();
    // One that is gone on with begins where it stopped.
    const int done = own.Spent[i] - 1;
    const int at = std::min(std::max(round, done), AllRounds - 1);
    const std::size_t first = i * this->Bands;
    static thread_local std::vector<double> before;
    before.resize(this->Bands);
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      before[b] = this->Before(i, b);
    }
    AreaEffort effort;
    effort.RelativeTolerance = this->Options.RelativeTolerance;
    effort.AbsoluteTolerance = this->Options.AbsoluteTolerance;
    effort.Work = Efforts[at];
    effort.Dropped = this->DroppedBefore(i);
    effort.Drop = this->Options.DropAreas;
    const bool blind = haste == Haste::Blind || !this->Stage;
    const AreaLight light = blind
      ? BoundArea(*this->Sources, this->Receivers[i])
      : this->Stage->At(this->Receivers[i], this->Options.NumberOf(i), before.data(), effort);
    std::copy_n(light.Value.begin(), this->Bands, &own.Value[first]);
    std::copy_n(light.Error.begin(), this->Bands, &own.Error[first]);
    own.Dropped[i] = static_cast<float>(light.Dropped);
    own.Spent[i] = blind ? 0 : at + 1;
    this->Unshadowed[i] = static_cast<float>(
      *std::max_element(light.Unshadowed.begin(), light.Unshadowed.end()) * (1.0 + 1e-7));
    this->RayCount += light.Rays;
    // What is as far as it can be is not gone on with.
    const bool last = at + 1 == AllRounds;
    own.State[i] = static_cast<std::uint8_t>(DirectField::Computed |
      (light.Improvable && !(light.Open && last) ? DirectField::Improvable : 0) |
      (blind || (light.Open && !last) ? DirectField::Unfinished : 0));
    return blind || (light.Open && !last);
  }
  void Between(int, const std::vector<std::uint32_t>& items, std::vector<std::uint8_t>&) override
  {
    for (const std::uint32_t i : items)
    {
      this->Own().Peak = std::max(this->Own().Peak, static_cast<double>(this->Unshadowed[i]));
    }
  }

private:
  std::unique_ptr<AreaSources> Sources;
  std::unique_ptr<AreaStage> Stage; // null: there is no time
  const std::vector<Receiver>& Receivers;
  std::vector<float> Unshadowed;
};

template <class Receiver>
std::unique_ptr<DirectKind> Make(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Receiver>& receivers, const DirectOptions& options, DirectFields& fields,
  double seconds)
{
  auto sources = std::make_unique<AreaSources>(
    scene, Compiled(Effect::Emission) && options.Emission, options.OnlyLight);
  if (sources->Size() == 0)
  {
    return nullptr;
  }
  // A tree of its own, with neighbours, over the triangles that block.
  constexpr double blockers = 2.5e-6; // seconds a triangle
  const bool noTime = seconds > 0.0 && options.Occlusion &&
    blockers * static_cast<double>(scene.Triangles.size()) +
        occluders.BuildingSeconds(options.Threads) > seconds;
  return std::make_unique<Areas<Receiver>>(
    scene, occluders, receivers, options, fields, std::move(sources), noTime);
}

} // namespace

std::unique_ptr<DirectKind> MakeAreas(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, DirectFields& fields,
  double seconds)
{
  return Make(scene, occluders, patches, options, fields, seconds);
}

std::unique_ptr<DirectKind> MakeAreas(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options, DirectFields& fields,
  double seconds)
{
  return Make(scene, occluders, points, options, fields, seconds);
}

} // namespace radiometry
