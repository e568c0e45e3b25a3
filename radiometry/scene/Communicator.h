// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// The processes (ranks) that compute one scene together. Each holds the whole scene and all values
/// on it; what is costly to compute or to keep (the rows of an operator, direct light, gathered
/// points) is each rank's own share.
///
/// Every call is collective: all ranks make the same calls in the same order, from the thread that
/// started the computation. What they decide on must be the same everywhere: seconds, aborts and
/// errors are agreed on by Largest.
class Communicator
{
public:
  virtual ~Communicator() = default;
  virtual int Rank() const = 0;
  virtual int Size() const = 0;
  /// values[k] = the sum over the ranks; the same bytes on each.
  virtual void Sum(double* values, std::size_t count) const = 0;
  virtual void Sum(std::int64_t* values, std::size_t count) const = 0;
  /// values[k] = the greatest of the ranks'.
  virtual void Largest(double* values, std::size_t count) const = 0;
  /// values[begin[r], begin[r + 1]) are rank r's when called, and everyone's after. `begin` has
  /// Size() + 1 entries, the same on all ranks.
  virtual void Gather(double* values, const std::vector<std::size_t>& begin) const = 0;
  virtual void Gather(std::int32_t* values, const std::vector<std::size_t>& begin) const = 0;
};

/// The items of n that belong to a rank: consecutive, as even as can be. Null: all of them.
struct RankShare
{
  std::size_t Begin = 0, End = 0;
  RankShare(const Communicator* ranks, std::size_t n)
    : Begin(ranks ? At(*ranks, n, ranks->Rank()) : 0)
    , End(ranks ? At(*ranks, n, ranks->Rank() + 1) : n)
  {
  }
  bool Has(std::size_t item) const { return item >= this->Begin && item < this->End; }
  /// Where each rank's share begins, times `width`: what Communicator::Gather wants.
  static std::vector<std::size_t> Begins(
    const Communicator& ranks, std::size_t n, std::size_t width = 1)
  {
    std::vector<std::size_t> begin;
    for (int r = 0; r <= ranks.Size(); ++r)
    {
      begin.push_back(width * At(ranks, n, r));
    }
    return begin;
  }

private:
  static std::size_t At(const Communicator& ranks, std::size_t n, int rank)
  {
    const auto size = static_cast<std::size_t>(ranks.Size());
    const auto r = static_cast<std::size_t>(rank);
    return n / size * r + (r < n % size ? r : n % size);
  }
};

} // namespace radiometry
