// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamIrradiance.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/PatchBlock.h"
#include "radiometry/irradiance/PatchClusters.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
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

/// Rounds of growing effort on what is not yet good enough; with a time budget the first ones ask
/// few of many lights.
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

/// The patches' share of a run, round by round.
class BeamRun
{
public:
  BeamRun(const Scene& scene, const OcclusionScene& occluders, const std::vector<Patch>& patches,
    const DirectOptions& options, const BeamLights& lights, DirectResult& result)
    : Patches(patches)
    , Options(options)
    , Lights(lights)
    , Result(result)
    , Bands(static_cast<std::size_t>(result.Bands))
    , Areas(patches.size())
    , Clusters(scene, occluders, patches, options.Threads)
    , Peaks(this->Clusters.Size(), 0.0)
    , Dropped(lights.Size() > 1 ? patches.size() : 0, 0.0f)
    , Open(patches.size(), 1)
    , Blocks([&, extent = Extent(scene)] {
      return std::make_unique<Worker>(scene, lights, patches, options, extent);
    })
  {
    this->Todo.resize(this->Clusters.Size());
    std::iota(this->Todo.begin(), this->Todo.end(), 0u);
    if (options.SecondsLeft > 0.0)
    {
      // Spread over the scene, so that what is done in time is a picture of all of it.
      std::stable_sort(this->Todo.begin(), this->Todo.end(), [](std::uint32_t a, std::uint32_t b) {
        return Hash64(a) < Hash64(b);
      });
    }
  }

  void Run(const StageProgress& stage, ConvergenceRecord* record)
  {
    const std::vector<Round> rounds =
      PlanRounds(this->Lights.Size(), this->Options.SecondsLeft > 0.0);
    const std::int64_t before = this->Result.Rays;
    const double span = stage.End - stage.Begin;
    for (std::size_t r = 0; r < rounds.size() && !this->Todo.empty() && !this->Expired; ++r)
    {
      StageProgress part = stage;
      part.Begin = stage.Begin + span * static_cast<double>(r) / static_cast<double>(rounds.size());
      part.End =
        stage.Begin + span * static_cast<double>(r + 1) / static_cast<double>(rounds.size());
      std::vector<std::uint8_t> open(this->Todo.size(), 0);
      ParallelFor(
        this->Todo.size(), this->Options.Threads, part,
        [&](std::size_t k) {
          if (this->Options.SecondsLeft > 0.0 && this->Clock.Elapsed() > this->Options.SecondsLeft)
          {
            this->Expired = true;
          }
          if (r == 0 || !this->Expired)
          {
            open[k] = this->Compute(this->Todo[k], rounds[r], r == 0) ? 1 : 0;
          }
        },
        1e-5 * static_cast<double>(std::min(rounds[r].Lights, this->Lights.Size())));
      std::size_t kept = 0;
      for (std::size_t k = 0; k < this->Todo.size(); ++k)
      {
        this->Todo[kept] = this->Todo[k];
        kept += open[k];
      }
      this->Todo.resize(kept);
      this->Result.Rays = before + this->Rays;
      RecordDirect(record, this->Result, this->Areas, "direct light");
    }
    this->Result.TimedOut = this->Result.TimedOut || this->Expired;
    if (!this->Peaks.empty())
    {
      this->Result.PeakUnshadowed += *std::max_element(this->Peaks.begin(), this->Peaks.end());
    }
    double dropped = 0.0;
    double most = 0.0;
    for (const float d : this->Dropped)
    {
      dropped += d;
      most = std::max(most, static_cast<double>(d));
    }
    if (most > 0.0)
    {
      this->Result.Dropped = std::move(this->Dropped);
    }
    this->Result.DroppedPeak += most;
    this->Result.DroppedMean += dropped / static_cast<double>(this->Patches.size());
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

  /// Returns true when some patch of the cluster is not yet good enough.
  bool Compute(std::size_t cluster, const Round& round, bool first)
  {
    return this->Compute(
      cluster, this->Clusters.Begin(cluster), this->Clusters.End(cluster), round, first);
  }

  /// True when the patches are so far apart that they differ much in which of many lights matter to
  /// them. Small clusters cost more for each light, so they must be much wider than their distance to
  /// the lights, and the smallest hold patches that are so themselves.
  bool TooWide(const Box3& box, std::size_t count) const
  {
    constexpr std::size_t many = 32;
    constexpr std::size_t few = 16;
    constexpr std::size_t least = 4;
    if (this->Lights.Size() <= many || count <= least)
    {
      return false;
    }
    const double nearest = this->Lights.Tree.Nearest(box.Center());
    const double width = Length(box.Size());
    return count > few ? width > 2.0 * nearest
                       : width > 2.0 * nearest * std::sqrt(static_cast<double>(count));
  }

  bool Compute(std::size_t cluster, const std::uint32_t* ids, const std::uint32_t* end,
    const Round& round, bool first)
  {
    Worker& worker = *this->Blocks.local();
    PatchBlock& block = worker.Block;
    block.Load(ids, end);
    if (this->TooWide(block.Bounds().Box, block.Size()))
    {
      const std::uint32_t* middle = ids + (end - ids) / 2;
      const bool before = this->Compute(cluster, ids, middle, round, first);
      return this->Compute(cluster, middle, end, round, first) || before;
    }
    block.Work = round.Work;
    worker.Active.assign(block.Size(), 0);
    for (std::size_t i = 0; i < block.Size(); ++i)
    {
      this->Areas[ids[i]] = block.PatchArea(i);
      worker.Active[i] = block.PatchArea(i) > 0.0 && this->Open[ids[i]] != 0 ? 1 : 0;
      // What was too much by so much before must be smaller by that, and a little more, now.
      block.Factor[i] =
        first ? 1.0 : 0.7 / std::clamp(this->Excess(ids[i]), 1.0, 1e3);
    }
    block.Blind = first && this->Expired;
    LightEffort effort;
    effort.FirstLook = std::min<std::size_t>(32, round.Lights);
    effort.Lights = block.Blind ? std::min<std::size_t>(4, round.Lights) : round.Lights;
    effort.RelativeTolerance = this->Options.RelativeTolerance;
    effort.AbsoluteTolerance = this->Options.AbsoluteTolerance;
    LightSum& sum = worker.Sum;
    this->Rays += sum.Compute(block, block.Bounds(), block.Size(), worker.Active.data(), effort,
      Hash64(this->Options.NumberOf(ids[0]), round.Lights));
    bool open = false;
    for (std::size_t i = 0; i < block.Size(); ++i)
    {
      this->Open[ids[i]] = 0;
      if (worker.Active[i] == 0)
      {
        continue;
      }
      const std::size_t at = ids[i] * this->Bands;
      std::copy_n(&sum.Value[i * this->Bands], this->Bands, &this->Result.Irradiance[at]);
      std::copy_n(&sum.Error[i * this->Bands], this->Bands, &this->Result.Error[at]);
      if (!this->Dropped.empty())
      {
        this->Dropped[ids[i]] = static_cast<float>(sum.Dropped[i]);
      }
      // An error that is rounding only cannot be made smaller.
      if (sum.Uncertain[i] != 0 && this->Excess(ids[i]) > 1.0)
      {
        this->Open[ids[i]] = 1;
        open = true;
      }
    }
    this->Peaks[cluster] = std::max(this->Peaks[cluster], sum.PeakUnshadowed);
    return open;
  }

  /// The greatest ratio of a patch's error to what is allowed.
  double Excess(std::uint32_t patch) const
  {
    double excess = 0.0;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double error = this->Result.Error[patch * this->Bands + b];
      const double allowed = std::max(this->Options.AbsoluteTolerance,
        this->Options.RelativeTolerance * this->Result.Irradiance[patch * this->Bands + b]);
      excess = std::max(excess, error > 0.0 ? (allowed > 0.0 ? error / allowed : 1e300) : 0.0);
    }
    return excess;
  }

  const std::vector<Patch>& Patches;
  const DirectOptions& Options;
  const BeamLights& Lights;
  DirectResult& Result;
  std::size_t Bands;
  std::vector<double> Areas;
  PatchClusters Clusters;
  std::vector<double> Peaks;    // of each cluster, nothing in the way
  std::vector<float> Dropped;   // of each patch: the bound on lights left out
  std::vector<std::uint8_t> Open; // of each patch: not yet good enough
  std::vector<std::uint32_t> Todo; // clusters
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> Blocks;
  std::atomic<std::int64_t> Rays{ 0 };
  std::atomic<bool> Expired{ false };
  const ConvergenceRecord Clock;
};

} // namespace

void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result)
{
  const ConvergenceRecord clock;
  StageProgress preparing = stage;
  preparing.End = stage.Begin + 0.1 * (stage.End - stage.Begin);
  const BeamLights lights(scene, occluders, options, true, preparing);
  if (lights.Size() == 0 || patches.empty())
  {
    return;
  }
  DirectOptions left = options;
  if (options.SecondsLeft > 0.0)
  {
    left.SecondsLeft = std::max(1e-9, options.SecondsLeft - clock.Elapsed());
  }
  StageProgress running = stage;
  running.Begin = preparing.End;
  BeamRun(scene, occluders, patches, left, lights, result).Run(running, record);
}

} // namespace radiometry
