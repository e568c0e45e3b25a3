// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectKind.h"
#include "radiometry/irradiance/ReceiverShare.h"

#include <array>
#include <memory>
#include <vector>

namespace radiometry
{

/// Adds the seconds of its life to those of a kind.
class KindClock
{
public:
  KindClock(const DirectOptions& options, std::size_t kind)
    : Seconds(options.KindSeconds ? &(*options.KindSeconds)[kind] : nullptr)
  {
  }
  ~KindClock()
  {
    if (this->Seconds)
    {
      *this->Seconds += this->Clock.Elapsed();
    }
  }
  KindClock(const KindClock&) = delete;
  KindClock& operator=(const KindClock&) = delete;

private:
  double* Seconds;
  const ConvergenceRecord Clock;
};

/// Direct light on receivers (patches, or points) in steps: a pilot on some that lie all over the
/// surface, brought to the tolerance, which says what the rest will take; then the rest. The pilot's
/// values are those that the run would have computed anyway.
template <typename Receiver>
class DirectRun
{
public:
  /// `kept`: where values are, and stay; those that meet the tolerance are not computed again. Null:
  /// all is computed, and forgotten. `recorded`: Result() is asked for rows of a record. All but
  /// `kept` must outlive this.
  DirectRun(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<Receiver>& receivers, const DirectOptions& options,
    const StageProgress& stage, DirectState* kept = nullptr, bool recorded = true);
  ~DirectRun();

  /// Seconds that the rest of the run will take, of this process. `most`: seconds that the pilot
  /// itself may take; 0: as long as it has to.
  double Pilot(const StageProgress& stage, double most = 0.0);
  /// Brings all values to the tolerance, or as far as `seconds` allow (0: no limit).
  /// `record`: the clock of the rows; null: none.
  void Finish(const StageProgress& stage, const ConvergenceRecord* record, double seconds = 0.0);
  /// What there is. Collective.
  DirectResult Result(ConvergenceRecord* record);
  /// Values that this process has to compute, or to make finer.
  std::size_t Waiting() const;
  /// How much longer this machine takes now than the constants say by which time is planned; at
  /// least 1.
  double Slow() const { return this->Slowness; }

private:
  const std::vector<Receiver>& Mine() const { return this->Share ? this->Own : this->All; }
  void MakeKinds(const StageProgress& stage);
  std::vector<std::uint32_t> Candidates(std::size_t kind) const;
  void PilotOf(std::size_t kind, const StageProgress& stage, double most);
  DirectKind::Tally TallyOf(std::size_t kind) const;
  void AddUp(std::size_t kind, const ConvergenceRecord& clock, double begun);
  void Combine(std::size_t receiver, std::size_t kinds, double* values, double* errors,
    double& dropped) const;
  int Present() const;
  int Workers() const;

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const std::vector<Receiver>& All;
  const ConvergenceRecord Clock;
  const std::size_t Bands;
  DirectOptions Options; // of this rank's share
  std::unique_ptr<ReceiverShare> Share; // null: one process
  std::vector<Receiver> Own;
  ReceiverGroups Groups;
  DirectState Local;
  DirectState* State;
  std::array<std::unique_ptr<DirectKind>, DirectKinds> Kinds;
  std::array<double, DirectKinds> Rest{}; // seconds that each will take
  std::array<std::vector<DirectRound>, DirectKinds> Rounds;
  double Slowness = 1.0;  // of this machine now, against what the seconds of building were found on
  double RaysSoFar = 0.0; // of kinds that have ended
  bool Recorded;
  std::int64_t RaysBefore = 0;
  bool TimedOut = false;
};

/// Whether the lights of a kind, or emitting surfaces, take part.
bool AnyBeam(const Scene& scene, const DirectOptions& options);
bool AnyArea(const Scene& scene, const DirectOptions& options);
bool AnySky(const Scene& scene, const DirectOptions& options);

} // namespace radiometry
