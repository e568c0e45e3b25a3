// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Receivers (patches, points) dealt out to the ranks in groups that are computed together: group g
/// goes to rank g % Size(), so that costly places of the scene are everyone's.
class ReceiverShare
{
public:
  /// `order`: all receivers, group by group; group g has those from first[g] to first[g + 1].
  ReceiverShare(const Communicator& ranks, const std::vector<std::uint32_t>& order,
    const std::vector<std::uint32_t>& first);

  /// The receivers of this rank, in the order of its groups.
  const std::uint32_t* Begin() const { return this->Dealt.data() + this->Starts[this->Own]; }
  std::size_t Size() const { return this->Starts[this->Own + 1] - this->Starts[this->Own]; }
  template <class Receiver>
  std::vector<Receiver> Take(const std::vector<Receiver>& receivers) const
  {
    std::vector<Receiver> own;
    own.reserve(this->Size());
    for (std::size_t k = 0; k < this->Size(); ++k)
    {
      own.push_back(receivers[this->Begin()[k]]);
    }
    return own;
  }
  /// The values of all receivers, `width` each, from those of this rank's (of Begin()). Collective.
  std::vector<double> Gather(const std::vector<double>& own, std::size_t width) const;

private:
  const Communicator& Ranks;
  std::size_t Own;
  std::vector<std::uint32_t> Dealt;  // receivers, rank by rank
  std::vector<std::size_t> Starts;   // of each rank's
};

/// Groups of 64 of n receivers in their own order.
void PlainGroups(
  std::size_t n, std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& first);

} // namespace radiometry
