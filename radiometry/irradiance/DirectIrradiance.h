// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

struct DirectOptions
{
  double RelativeTolerance = 0.01; // of each value's error, relative to the value
  double AbsoluteTolerance = 0.0;  // W/m^2; whichever of the two is met first
  double MeanShare = 0.0; // a value below that share of the mean over all receivers may be wrong by
                          // the relative tolerance of that (light that rays sample)
  double SecondsLeft = 0.0;        // after that many seconds nothing more is looked at for shadows:
                                   // half of the light is taken, with an error of half; 0: no limit
  bool Occlusion = true;
  bool SpotShape = true;    // false: spots light all directions with their axial intensity
  bool Attenuation = true;  // false: legacy attenuation is taken as inverse square
  bool Environment = true;  // false: environment lights are left out
  bool Emission = false;    // true: emitting surfaces of the scene light it, too
  bool Transmission = true; // false: surfaces with Transmittance are opaque
  /// Area lights, emitting surfaces and skies may be left out of a value beside which they are small.
  bool DropAreas = true;
  bool DropSky = true;
  double Dropped = 0.0; // W/m^2: the bound on what was left out before, of every value
  std::array<double, 3>* KindSeconds = nullptr; // gets what beams, areas and skies took, if not null
  int Threads = 0;          // 0: all
  const Communicator* Ranks = nullptr; // that share the receivers; null: this process alone
  /// Numbers of the receivers, which key their samples, where they are some of more (a rank's share,
  /// group by group); null: their places in the list.
  const std::uint32_t* Numbers = nullptr;
  /// The place in Scene::Lights of the one light that counts, without the global ambient; -1: all.
  std::ptrdiff_t OnlyLight = -1;

  /// Whether a light of the scene counts, by its place.
  bool Takes(std::size_t light) const
  {
    return this->OnlyLight < 0 || static_cast<std::size_t>(this->OnlyLight) == light;
  }
  std::uint64_t NumberOf(std::size_t receiver) const
  {
    return this->Numbers ? this->Numbers[receiver] : receiver;
  }
};

/// The light of one kind of source on each receiver, kept so that a later run may go on from it.
struct DirectField
{
  enum : std::uint8_t
  {
    Computed = 1,   // there is a value
    Unfinished = 2, // time was over before it was good enough
    Improvable = 4  // more work would make its error smaller
  };
  std::vector<double> Value; // receivers x bands, W/m^2
  std::vector<double> Error;
  std::vector<float> Dropped; // of the error: bounds on sources left out, and what neighbours share
  std::vector<std::uint8_t> State;
  std::vector<std::int32_t> Spent; // rays of the last estimate; empty: not known
  std::vector<std::uint8_t> Dark;  // every ray was blocked; empty: not known
  double Peak = 0.0;               // the greatest value, were nothing in the way, of any band
  double RelativeTolerance = 1e300; // what all values have met
  double AbsoluteTolerance = 1e300;

  bool Empty() const { return this->State.empty(); }
  /// Room for that many, where there is none yet.
  void Begin(std::size_t receivers, std::size_t bands);
  std::size_t MemoryBytes() const;
};

/// All kinds: beams, areas, skies.
struct DirectState
{
  std::array<DirectField, 3> Fields;
  std::int64_t Rays = 0;

  std::size_t MemoryBytes() const;
};

/// Sums over a rank's receivers when a round of work ended.
struct DirectRound
{
  double Seconds = 0.0;
  double Value = 0.0;  // of irradiance, weighted
  double Error = 0.0;  // the same
  double Weight = 0.0; // receivers x bands
  double Rays = 0.0;
};

struct DirectResult
{
  int Bands = 1;
  std::vector<double> Irradiance; // patches (points) x bands, W/m^2
  std::vector<double> Error;      // the same shape
  /// Of each patch, what of its Error is a bound on lights left out, or that of lights estimated
  /// together from samples: errors that neighbours have in common; empty: none.
  std::vector<float> Dropped;
  double DroppedPeak = 0.0;       // the greatest of those
  double DroppedMean = 0.0;       // their mean, W/m^2
  double PeakUnshadowed = 0.0;    // greatest value, were nothing in the way, of any band
  std::int64_t Rays = 0;
  bool TimedOut = false;
};

/// Direct irradiance, averaged over each patch, from the enabled lights of the scene.
///   Model   E = E_ambient + sum over lights: what BeamIrradiance.h, AreaIrradiance.h and
///           SkyIrradiance.h say of each kind, in that order; their errors are independent
///   Bytes   the same for any number of threads
///   Ranks   each computes its share of the receivers and gets the others' from them: the bytes are
///           those of one process (with MeanShare up to the rounding of a mean). Collective
DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage = {},
  ConvergenceRecord* record = nullptr);

/// Direct irradiance at points, about their normals.
DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage = {}, ConvergenceRecord* record = nullptr);

/// What no double holds is an error (InputError{"Irradiance"}) and never an infinity handed on.
void CheckFinite(const DirectResult& result);

/// Rows of the record from what all ranks (null: one process) had when each of their rounds ended.
/// Collective.
void AddRounds(const Communicator* ranks, const std::vector<DirectRound>& rounds,
  const char* stage, ConvergenceRecord& record);

} // namespace radiometry
