// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace radiometry
{

/// Kinds of light in the order in which they are added up: what is there already counts for the
/// tolerance of the next.
constexpr int DirectKinds = 3; // beams, areas, skies
using DirectFields = std::array<DirectField, DirectKinds>;

/// Receivers in groups that are computed together: Order[First[g]] to Order[First[g + 1]].
struct ReceiverGroups
{
  std::vector<std::uint32_t> Order;
  std::vector<std::uint32_t> First;

  std::size_t Size() const { return this->First.empty() ? 0 : this->First.size() - 1; }
  const std::uint32_t* Begin(std::size_t g) const { return this->Order.data() + this->First[g]; }
  const std::uint32_t* End(std::size_t g) const { return this->Order.data() + this->First[g + 1]; }
};

/// Clusters of patches, or neighbouring points, where lights are asked for them together; else runs of
/// the order that they have.
ReceiverGroups MakeReceiverGroups(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options);
ReceiverGroups MakeReceiverGroups(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options);

/// Seconds that items took, each on the thread that had it.
struct ItemCost
{
  std::size_t Items = 0;
  double Sum = 0.0;
  double Squares = 0.0;

  double Mean() const { return this->Items > 0 ? this->Sum / static_cast<double>(this->Items) : 0.0; }
  /// Standard deviation of the mean, relative to it.
  double Doubt() const;
};

/// The light of one kind of source on the receivers of a run. It computes item by item (a receiver,
/// or a group of neighbours), each in rounds of growing effort until it is good enough; which items
/// come first changes no value. What an earlier run left in its field is gone on with.
class DirectKind
{
public:
  /// `fields`: of all kinds; this one writes fields[kind] and reads those before it.
  /// `groups`: the items; null: each receiver is one.
  DirectKind(int kind, std::size_t receivers, int bands, const DirectOptions& options,
    DirectFields& fields, const ReceiverGroups* groups);
  virtual ~DirectKind() = default;

  virtual const char* Name() const = 0;

  /// Items with a receiver that is not good enough, in their order.
  std::vector<std::uint32_t> Waiting() const;
  /// True when a kind that counts for a receiver of the item has not come to it yet.
  bool HasWaiting(std::size_t item) const;
  bool Waits(std::size_t receiver) const { return this->Pending[receiver] != 0; }
  template <class Visit>
  void ForReceivers(std::size_t item, const Visit& visit) const
  {
    if (!this->Groups)
    {
      visit(static_cast<std::uint32_t>(item));
      return;
    }
    for (const std::uint32_t* id = this->Groups->Begin(item); id != this->Groups->End(item); ++id)
    {
      visit(*id);
    }
  }

  /// How long, and how, items are worked on.
  struct Limits
  {
    double Until = 0.0;   // seconds of `Clock` at which only what takes no time is done; 0: none
    bool Hurried = false; // rounds begin with less effort
    const ConvergenceRecord* Clock = nullptr;
  };
  /// Weighted value and error of a receiver, summed over the bands, with what it has so far.
  using Tally = std::function<void(std::uint32_t receiver, double& value, double& error)>;
  /// Works on items until they are good enough. `tally`: by which Changes() are told; empty: they are
  /// not. Returns false when the time was over.
  bool Run(std::vector<std::uint32_t> items, const Limits& limits, const StageProgress& stage,
    ItemCost* cost, const Tally& tally);

  std::int64_t Rays() const { return this->RayCount; }
  /// What each round changed, whichever items came first.
  struct Change
  {
    double Value = 0.0;
    double Error = 0.0;
    double Rays = 0.0;
    double Seconds = 0.0; // on the clock of the limits, when it last ended
  };
  const std::vector<Change>& Changes() const { return this->Made; }

  /// True when a receiver's value in a field may have to be computed, or made finer.
  static bool Needed(const DirectFields& fields, int kind, std::size_t receiver, int bands,
    const DirectOptions& options);
  /// True when that is so for any.
  static bool AnyNeeded(const DirectFields& fields, int kind, std::size_t receivers, int bands,
    const DirectOptions& options);

protected:
  /// What is known of an item's effort.
  enum class Haste
  {
    None,
    Some, // the first rounds ask less
    Blind // no time: bounds, or half of the light with an error of half
  };
  /// A round of work on an item; true: another would make it better, and is needed.
  virtual bool Work(std::size_t item, int round, Haste haste) = 0;
  virtual int Rounds(bool hurried) const = 0;
  /// Seconds that an item of a round may take, for a start.
  virtual double Guess(int round, bool hurried) const = 0;
  /// Between rounds, on the calling thread: which of the items go on.
  virtual void Between(int /*round*/, const std::vector<std::uint32_t>& /*items*/,
    std::vector<std::uint8_t>& /*again*/)
  {
  }
  /// Whether another round is made.
  virtual bool GoesOn(bool left, bool expired) { return left && !expired; }

  /// What kinds before this one give a receiver, per band, and the bounds on what they left out.
  double Before(std::size_t receiver, std::size_t band) const;
  double DroppedBefore(std::size_t receiver) const;
  DirectField& Own() { return this->Fields[static_cast<std::size_t>(this->Kind)]; }
  /// True where there is no value yet.
  bool Fresh(std::size_t receiver) const
  {
    return (this->Fields[static_cast<std::size_t>(this->Kind)].State[receiver] &
             DirectField::Computed) == 0;
  }
  bool HasFresh(std::size_t item) const;
  /// What may be left out of a value of that size, all told: a quarter of its tolerance.
  double MayDrop(std::size_t receiver, double value) const;

  const DirectOptions& Options;
  const std::size_t Bands;
  const ReceiverGroups* Groups;
  std::atomic<std::int64_t> RayCount{ 0 };
  bool NoTime = false; // there was none to build what shadows need: all is done blindly

private:
  int Kind;
  std::vector<Change> Made;
  DirectFields& Fields;
  std::vector<std::uint8_t> Pending; // by receiver
};

} // namespace radiometry
