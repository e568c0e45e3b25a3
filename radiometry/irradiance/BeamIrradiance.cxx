// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamIrradiance.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/BeamLights.h"
#include "radiometry/irradiance/PatchBlock.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <tbb/enumerable_thread_specific.h>

namespace radiometry
{
namespace
{

/// How far a round goes: lights asked one by one in a block, parts a patch may be cut into for each.
struct Round
{
  std::size_t Lights;
  int Work;
};
constexpr std::size_t AllLights = std::numeric_limits<std::size_t>::max();

/// Rounds of growing effort on what is not yet good enough; in haste the first ones ask few of many
/// lights.
std::vector<Round> PlanRounds(std::size_t lights, bool hurried)
{
  std::vector<Round> rounds;
  for (std::size_t some = 8; hurried && 2 * some < lights; some *= 8)
  {
    rounds.push_back({ some, 1 });
  }
  for (const int work : { 1, 64, 512, 4096 })
  {
    rounds.push_back({ AllLights, work });
  }
  return rounds;
}

/// Beams on patches, cluster by cluster.
class PatchBeams : public DirectKind
{
public:
  PatchBeams(const Scene& scene, const std::vector<Patch>& patches, const DirectOptions& options,
    std::unique_ptr<BeamLights> lights, bool noTime, DirectFields& fields,
    const ReceiverGroups& groups)
    : DirectKind(0, patches.size(), scene.Optics.Bands, options, fields, &groups)
    , Lights(std::move(lights))
    , Peaks(groups.Size(), 0.0)
    , Blocks([this, &scene, &patches, &options, extent = Extent(scene)] {
      return std::make_unique<Worker>(scene, *this->Lights, patches, options, extent);
    })
  {
    this->NoTime = noTime;
    if (this->Lights->Size() > 1 && this->Own().Dropped.empty())
    {
      this->Own().Dropped.assign(patches.size(), 0.0f);
    }
  }

  const char* Name() const override { return "direct light"; }

protected:
  int Rounds(bool hurried) const override
  {
    return static_cast<int>(PlanRounds(this->Lights->Size(), hurried).size());
  }
  double Guess(int round, bool hurried) const override
  {
    const Round r = PlanRounds(this->Lights->Size(), hurried)[static_cast<std::size_t>(round)];
    return 1e-5 * static_cast<double>(std::min(r.Lights, this->Lights->Size()));
  }
  bool Work(std::size_t item, int round, Haste haste) override
  {
    const Round r =
      PlanRounds(this->Lights->Size(), haste == Haste::Some)[static_cast<std::size_t>(round)];
    return this->Compute(item, this->Groups->Begin(item), this->Groups->End(item), r, round == 0,
      haste == Haste::Blind);
  }
  void Between(int, const std::vector<std::uint32_t>& items, std::vector<std::uint8_t>&) override
  {
    for (const std::uint32_t item : items)
    {
      this->Own().Peak = std::max(this->Own().Peak, this->Peaks[item]);
    }
  }

private:
  struct Worker
  {
    Worker(const Scene& scene, const BeamLights& lights, const std::vector<Patch>& patches,
      const DirectOptions& options, double extent)
      : Block(scene, lights, patches, options, extent)
      , Sum(lights.Tree, scene.Optics.Bands)
    {
    }
    PatchBlock Block;
    LightSum Sum;
    std::vector<std::uint8_t> Active;
  };

  /// True when the patches are so far apart that they differ much in which of many lights matter to
  /// them. Small clusters cost more for each light, so they must be much wider than their distance to
  /// the lights, and the smallest hold patches that are so themselves.
  bool TooWide(const Box3& box, std::size_t count) const
  {
    constexpr std::size_t many = 32;
    constexpr std::size_t few = 16;
    constexpr std::size_t least = 4;
    if (this->Lights->Size() <= many || count <= least)
    {
      return false;
    }
    const double nearest = this->Lights->Tree.Nearest(box.Center());
    const double width = Length(box.Size());
    return count > few ? width > 2.0 * nearest
                       : width > 2.0 * nearest * std::sqrt(static_cast<double>(count));
  }

  /// Returns true when some patch of the cluster is not yet good enough.
  bool Compute(std::size_t cluster, const std::uint32_t* ids, const std::uint32_t* end,
    const Round& round, bool first, bool blind)
  {
    Worker& worker = *this->Blocks.local();
    PatchBlock& block = worker.Block;
    block.Load(ids, end);
    if (this->TooWide(block.Bounds().Box, block.Size()))
    {
      const std::uint32_t* middle = ids + (end - ids) / 2;
      const bool before = this->Compute(cluster, ids, middle, round, first, blind);
      return this->Compute(cluster, middle, end, round, first, blind) || before;
    }
    DirectField& own = this->Own();
    block.Work = round.Work;
    block.Blind = blind;
    worker.Active.assign(block.Size(), 0);
    for (std::size_t i = 0; i < block.Size(); ++i)
    {
      const bool wanted = blind ? this->Fresh(ids[i])
                                : (first ? this->Waits(ids[i])
                                         : (own.State[ids[i]] & DirectField::Unfinished) != 0);
      worker.Active[i] = wanted && block.PatchArea(i) > 0.0 ? 1 : 0;
      if (wanted && !(block.PatchArea(i) > 0.0))
      {
        own.State[ids[i]] = DirectField::Computed; // nothing arrives where there is no area
      }
      // What was too much by so much before must be smaller by that, and a little more, now.
      block.Factor[i] = first ? 1.0 : 0.7 / std::clamp(this->Excess(ids[i]), 1.0, 1e3);
    }
    LightEffort effort;
    effort.FirstLook = std::min<std::size_t>(32, round.Lights);
    effort.Lights = blind ? std::min<std::size_t>(4, round.Lights) : round.Lights;
    effort.RelativeTolerance = this->Options.RelativeTolerance;
    effort.AbsoluteTolerance = this->Options.AbsoluteTolerance;
    effort.Dropped = this->Options.Dropped;
    LightSum& sum = worker.Sum;
    this->RayCount += sum.Compute(block, block.Bounds(), block.Size(), worker.Active.data(),
      effort, Hash64(this->Options.NumberOf(ids[0]), round.Lights));
    bool open = false;
    for (std::size_t i = 0; i < block.Size(); ++i)
    {
      if (worker.Active[i] != 0)
      {
        open = this->Take(ids[i], i, sum, blind) || open;
      }
    }
    this->Peaks[cluster] = std::max(this->Peaks[cluster], sum.PeakUnshadowed);
    return open;
  }

  /// Takes the result of a patch over; true when it is not good enough and can be better.
  bool Take(std::uint32_t patch, std::size_t i, const LightSum& sum, bool blind)
  {
    DirectField& own = this->Own();
    const std::size_t at = patch * this->Bands;
    std::copy_n(&sum.Value[i * this->Bands], this->Bands, &own.Value[at]);
    std::copy_n(&sum.Error[i * this->Bands], this->Bands, &own.Error[at]);
    if (!own.Dropped.empty())
    {
      own.Dropped[patch] = static_cast<float>(sum.Dropped[i]);
    }
    // An error that is rounding only cannot be made smaller.
    const bool open = blind || (sum.Uncertain[i] != 0 && this->Excess(patch) > 1.0);
    own.State[patch] = static_cast<std::uint8_t>(DirectField::Computed |
      (sum.Uncertain[i] != 0 || sum.Dropped[i] > 0.0 ? DirectField::Improvable : 0) |
      (open ? DirectField::Unfinished : 0));
    return open;
  }

  /// The greatest ratio of a patch's error to what is allowed.
  double Excess(std::uint32_t patch)
  {
    double excess = 0.0;
    for (std::size_t at = patch * this->Bands; at < (patch + 1) * this->Bands; ++at)
    {
      const double error = this->Own().Error[at];
      const double allowed = std::max(this->Options.AbsoluteTolerance,
        this->Options.RelativeTolerance * this->Own().Value[at]);
      excess = std::max(excess, error > 0.0 ? (allowed > 0.0 ? error / allowed : 1e300) : 0.0);
    }
    return excess;
  }

  std::unique_ptr<BeamLights> Lights;
  std::vector<double> Peaks; // of each cluster, nothing in the way
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> Blocks;
};

/// Whether some light reaches some group at all.
bool Reach(const Scene& scene, const BeamLights& lights, const std::vector<Patch>& patches,
  const ReceiverGroups& groups)
{
  const double extent = Extent(scene);
  PatchBlock block(scene, lights, patches, DirectOptions(), extent);
  for (std::size_t g = 0; g < groups.Size(); ++g)
  {
    block.Load(groups.Begin(g), groups.End(g));
    for (const std::int32_t root : lights.Tree.Roots())
    {
      if (lights.Tree.Gain(root, block.Bounds()) > 0.0)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

std::unique_ptr<DirectKind> MakeBeams(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const ReceiverGroups& groups, const DirectOptions& options,
  DirectFields& fields, const StageProgress& stage, double seconds)
{
  auto lights = std::make_unique<BeamLights>(scene, options);
  if (lights->Size() == 0)
  {
    return nullptr;
  }
  // Nothing is built for lights that reach nothing, and nothing that the time does not allow.
  bool noTime = false;
  if (lights->Hides && Reach(scene, *lights, patches, groups))
  {
    noTime = seconds > 0.0 && occluders.BuildingSeconds(options.Threads) > seconds;
    if (!noTime)
    {
      lights->FindShadows(scene, occluders, options, true, stage);
    }
  }
  return std::make_unique<PatchBeams>(
    scene, patches, options, std::move(lights), noTime, fields, groups);
}

} // namespace radiometry
