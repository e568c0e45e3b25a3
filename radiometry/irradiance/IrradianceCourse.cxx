// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceCourse.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace radiometry
{
namespace
{

/// Of a time budget: what a pilot may take.
constexpr double PilotBudget = 0.1;
/// Seconds a receiver for putting its value where it belongs.
constexpr double CollectSeconds = 150e-9;
/// ... and for handing it on, when all is done.
constexpr double OutputSeconds = 100e-9;
/// Seconds a receiver and light for the share of a light, on one thread, beside what direct light
/// takes.
constexpr double ShareSeconds = 0.15e-6;

double Greatest(const Communicator* ranks, double value)
{
  if (ranks)
  {
    ranks->Largest(&value, 1);
  }
  return value;
}

} // namespace

IrradianceCourse::IrradianceCourse(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const IrradianceOptions& options,
  const DirectOptions& direct, int sides, IrradianceKept& kept, IrradianceResult& result,
  Monitor* monitor)
  : Geometry(scene)
  , Occluders(occluders)
  , Points(points)
  , Options(options)
  , Direct(direct)
  , Sides(static_cast<std::size_t>(sides))
  , Kept(kept)
  , Result(result)
  , Listener(monitor)
{
  this->End = options.LightVisibility ? 0.5 : 0.98;
  this->CellsEnd = options.Cells ? (points.empty() ? this->End : 0.8 * this->End) : 0.02;
  this->WantShares = options.LightVisibility &&
    !(kept.SharesRelative >= 0.0 && options.RelativeTolerance >= kept.SharesRelative &&
      options.AbsoluteTolerance >= kept.SharesAbsolute);
  if (options.Cells && options.RefineShadowBoundaries)
  {
    this->CellsBegin = 0.3 * this->CellsEnd;
    this->CutCells();
  }
  this->MakeRuns();
}

IrradianceCourse::~IrradianceCourse() = default;

/// What is left of the budget; 0: there is none.
double IrradianceCourse::Left() const
{
  if (!(this->Options.TimeBudget > 0.0))
  {
    return 0.0;
  }
  double slow = 1.0;
  slow = this->CellRun ? std::max(slow, this->CellRun->Slow()) : slow;
  slow = this->PointRuns[0] ? std::max(slow, this->PointRuns[0]->Slow()) : slow;
  const double output = slow * OutputSeconds *
    static_cast<double>(this->Patches.size() + this->Sides * this->Points.size());
  return std::max(
    1e-9, this->Options.TimeBudget - output - this->Result.Convergence.Elapsed());
}

void IrradianceCourse::CutCells()
{
  if (!this->Kept.HasPieces)
  {
    this->Direct.SecondsLeft = this->Left();
    this->Kept.Pieces = CutAlongShadows(this->Geometry, this->Occluders, this->Direct,
      this->Sides == 2, this->Options.PiecesPerCell,
      { this->Listener, 0.02, this->CellsBegin, "cutting along shadows" });
    this->Kept.HasPieces = true;
    this->Kept.Cells = {};
  }
  this->Patches = MakePatches(this->Geometry, this->Kept.Pieces, this->Sides == 2);
  this->Items = this->Kept.Pieces.Size();
}

void IrradianceCourse::MakeRuns()
{
  if (this->Options.Cells)
  {
    if (!this->Options.RefineShadowBoundaries)
    {
      this->Items = this->Geometry.Cells;
      this->Patches = MakePatches(this->Geometry, 0);
      if (this->Sides == 2)
      {
        const std::vector<Patch> backs = MakePatches(this->Geometry, 1);
        this->Patches.insert(this->Patches.end(), backs.begin(), backs.end());
      }
    }
    this->Direct.SecondsLeft = this->Left();
    this->CellRun = std::make_unique<DirectRun<Patch>>(this->Geometry, this->Occluders,
      this->Patches, this->Direct,
      StageProgress{ this->Listener, this->CellsBegin, this->CellsBegin, "direct light" },
      &this->Kept.Cells);
  }
  for (std::size_t side = 0; side < this->Sides && !this->Points.empty(); ++side)
  {
    this->Facing[side] = this->Points;
    for (SurfacePoint& p : this->Facing[side])
    {
      p.Normal = side == 1 ? -p.Normal : p.Normal;
    }
    this->Direct.SecondsLeft = this->Left();
    this->PointRuns[side] = std::make_unique<DirectRun<SurfacePoint>>(this->Geometry,
      this->Occluders, this->Facing[side], this->Direct,
      StageProgress{ this->Listener, this->CellsBegin, this->CellsBegin, "direct light at points" },
      &this->Kept.Points[side]);
  }
}

/// The shares of lights ask each light again: about what direct light takes, and what each light
/// takes with nothing in the way.
double IrradianceCourse::SharesSeconds() const
{
  if (!this->WantShares)
  {
    return 0.0;
  }
  const auto lights = static_cast<double>(this->Geometry.Lights.size());
  const auto receivers = static_cast<double>(
    this->Patches.size() + (this->Points.empty() ? 0 : this->Sides * this->Points.size()));
  const int available = AvailableThreads();
  const int workers =
    this->Options.Threads > 0 ? std::min(this->Options.Threads, available) : available;
  return 1.3 * (this->Rest[0] + this->Rest[1] + this->Rest[2]) +
    ShareSeconds * lights * receivers / workers;
}

double IrradianceCourse::Pilot()
{
  const double most = PilotBudget * this->Left();
  StageProgress stage{ this->Listener, this->CellsBegin, this->CellsBegin, "looking ahead" };
  if (this->CellRun)
  {
    this->Rest[0] = this->CellRun->Pilot(stage, most);
  }
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (this->PointRuns[side])
    {
      this->Rest[1 + side] = this->PointRuns[side]->Pilot(stage, most);
    }
  }
  this->Rest[3] = this->SharesSeconds();
  const double elapsed = this->Result.Convergence.Elapsed();
  const double collect = CollectSeconds *
    static_cast<double>(this->Patches.size() + this->Sides * this->Points.size());
  double seconds = elapsed + collect;
  for (const double rest : this->Rest)
  {
    seconds += rest;
  }
  seconds = Greatest(this->Options.Ranks, seconds);
  return this->Options.TimeBudget > 0.0 ? std::min(seconds, this->Options.TimeBudget) : seconds;
}

/// Of the time that is left, what a part may take: as much as it is expected to among those that
/// follow.
double IrradianceCourse::Budget(std::size_t part) const
{
  const double left = this->Left();
  if (!(left > 0.0))
  {
    return 0.0;
  }
  double all = 0.0;
  for (std::size_t k = part; k < this->Rest.size(); ++k)
  {
    all += this->Rest[k];
  }
  const double share = all > 0.0 ? std::max(0.05, this->Rest[part] / all) : 1.0;
  const double slow = this->CellRun ? this->CellRun->Slow() : 1.0;
  const double collect = slow * CollectSeconds *
    static_cast<double>(this->Patches.size() + this->Sides * this->Points.size());
  return std::max(1e-9, share * (left - collect));
}

void IrradianceCourse::FinishCells()
{
  this->CellRun->Finish({ this->Listener, this->CellsBegin, this->CellsEnd, "direct light" },
    &this->Result.Convergence, this->Budget(0));
  const DirectResult r = this->CellRun->Result(&this->Result.Convergence);
  CheckFinite(r);
  // Without time for shadows all errors are of one kind and add up.
  const std::vector<float> common = r.TimedOut
    ? std::vector<float>(this->Patches.size(), std::numeric_limits<float>::max())
    : r.Dropped;
  for (std::size_t side = 0; side < this->Sides; ++side)
  {
    this->Result.Cells[side] = AverageOver(this->Items, this->Geometry.Optics.Bands, this->Patches,
      static_cast<int>(side), r.Irradiance, r.Error, common);
  }
  this->TimedOut = r.TimedOut;
  this->Rays = r.Rays;
  this->Result.DroppedPeak = r.DroppedPeak;
  this->Result.DroppedMean = r.DroppedMean;
}

void IrradianceCourse::FinishPoints(std::size_t side)
{
  const double span = (this->End - this->CellsEnd) / static_cast<double>(this->Sides);
  const double begin = this->CellsEnd + span * static_cast<double>(side);
  ConvergenceRecord* record = side == 0 ? &this->Result.Convergence : nullptr;
  this->PointRuns[side]->Finish(
    { this->Listener, begin, begin + span, "direct light at points" }, record,
    this->Budget(1 + side));
  DirectResult r = this->PointRuns[side]->Result(record);
  CheckFinite(r);
  this->TimedOut = this->TimedOut || r.TimedOut;
  this->Rays += r.Rays;
  this->Result.DroppedPeak = std::max(this->Result.DroppedPeak, r.DroppedPeak);
  this->Result.DroppedMean = std::max(this->Result.DroppedMean, r.DroppedMean);
  this->Result.Points[side] = { std::move(r.Irradiance), std::move(r.Error) };
}

void IrradianceCourse::FindShares()
{
  if (this->WantShares)
  {
    const bool both = !this->Patches.empty() && !this->Points.empty();
    this->Direct.SecondsLeft = (both ? 0.7 : 1.0) * this->Budget(3);
    if (this->Options.Cells)
    {
      this->Kept.CellShares = FindLightVisibility(this->Geometry, this->Occluders, this->Patches,
        this->Items, this->Direct,
        { this->Listener, this->End, this->Points.empty() ? 0.98 : 0.8, "visibility of lights" });
    }
    for (std::size_t side = 0; side < this->Sides && !this->Points.empty(); ++side)
    {
      this->Direct.SecondsLeft =
        this->Budget(3) / static_cast<double>(this->Sides - side);
      this->Kept.PointShares[side] = FindLightVisibility(this->Geometry, this->Occluders,
        this->Facing[side], this->Direct, { this->Listener, 0.8, 0.98, "visibility of lights" });
    }
    const bool whole = !this->TimedOut && !(this->Options.TimeBudget > 0.0 &&
      this->Result.Convergence.Elapsed() > 0.95 * this->Options.TimeBudget);
    this->Kept.SharesRelative = whole ? this->Options.RelativeTolerance : -1.0;
    this->Kept.SharesAbsolute = whole ? this->Options.AbsoluteTolerance : -1.0;
  }
  this->Result.CellVisibility = this->Kept.CellShares;
  this->Result.PointVisibility = this->Kept.PointShares;
}

void IrradianceCourse::Finish()
{
  if (this->CellRun)
  {
    this->FinishCells();
  }
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (this->PointRuns[side])
    {
      this->FinishPoints(side);
    }
  }
  if (this->Options.LightVisibility)
  {
    this->FindShares();
  }
  if (this->Options.RefineShadowBoundaries && this->Options.Cells)
  {
    this->Result.Pieces = this->Kept.Pieces;
    this->Kept.HasPieces = !this->Kept.Pieces.TimedOut;
  }
}

} // namespace radiometry
