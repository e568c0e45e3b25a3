// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClusterNetwork.h"

#include "radiometry/formfactor/ClusterCode.h"
#include "radiometry/formfactor/ClusterExchange.h"
#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/scene/Collective.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace radiometry
{

ClusterNetwork::ClusterNetwork(ElementTree tree, int threads, const Communicator* ranks)
  : Tree(std::move(tree))
  , Threads(threads)
  , Ranks(ranks)
{
  this->Begin.assign(this->Tree.Size() + 1, 0);
  this->NumberCurved();
}

void ClusterNetwork::NumberCurved()
{
  this->Curved.resize(this->Tree.Size());
  this->CurvedCount = 0;
  for (std::size_t k = 0; k < this->Curved.size(); ++k)
  {
    const bool flat = this->Tree[static_cast<std::int32_t>(k)].Flat();
    this->Curved[k] = flat ? -1 : static_cast<std::int32_t>(this->CurvedCount++);
  }
}

bool ClusterNetwork::Link(const ClusterRefiner& refiner, const ClusterRefiner& hasty,
  double seconds, std::size_t most, const StageProgress& stage)
{
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  std::vector<std::vector<ClusterLink>> parts(1);
  ClusterRefiner::Tally tally;
  const std::vector<NodePair> tasks = refiner.Tasks(this->TaskCount(), parts[0], tally);
  const auto size = static_cast<std::size_t>(this->Ranks ? this->Ranks->Size() : 1);
  const auto rank = static_cast<std::size_t>(this->Ranks ? this->Ranks->Rank() : 0);
  if (rank > 0)
  {
    parts[0].clear(); // the first rank's
    tally = {};
  }
  const std::size_t own = tasks.size() / size + (rank < tasks.size() % size);
  parts.resize(own + 1);
  std::vector<ClusterRefiner::Tally> tallies(own + 1);
  tallies[0] = tally;
  std::atomic<std::size_t> total{ parts[0].size() };
  std::atomic<bool> over{ false }, late{ false };
  Collectively(this->Ranks, [&] {
    ParallelFor(
      own, this->Threads, stage,
      [&](std::size_t k) {
        if (over)
        {
          return;
        }
        if (seconds > 0.0 && std::chrono::duration<double>(clock::now() - start).count() > seconds)
        {
          late = true;
        }
        auto& links = parts[k + 1];
        const bool fits =
          (late ? hasty : refiner).Refine(tasks[k * size + rank], most, links, tallies[k + 1]);
        links.shrink_to_fit();
        if (!fits || (total += links.size()) > most)
        {
          over = true;
        }
      },
      1e-3);
  });
  double state[2] = { over ? 1.0 : 0.0, late ? 1.0 : 0.0 };
  if (this->Ranks)
  {
    this->Ranks->Largest(state, 2);
  }
  if (state[0] > 0.0)
  {
    return false;
  }
  this->Hurried = state[1] > 0.0;
  Collectively(this->Ranks, [&] { this->Keep(parts); });
  std::int64_t counts[3] = { static_cast<std::int64_t>(total.load()), 0, 0 };
  for (const auto& t : tallies)
  {
    counts[1] += t.Pairs;
    counts[2] += t.Rays;
  }
  if (this->Ranks)
  {
    this->Ranks->Sum(counts, 3);
  }
  this->LinkCount = counts[0];
  this->PairCount = counts[1];
  this->RayCount = counts[2];
  return true;
}

std::size_t ClusterNetwork::Count(const ClusterRefiner& refiner, const StageProgress& stage) const
{
  std::vector<ClusterLink> first;
  ClusterRefiner::Tally tally;
  const std::vector<NodePair> tasks = refiner.Tasks(this->TaskCount(), first, tally);
  const auto size = static_cast<std::size_t>(this->Ranks ? this->Ranks->Size() : 1);
  std::vector<std::size_t> counts(tasks.size(), 0);
  Collectively(this->Ranks, [&] {
    ParallelFor(
      tasks.size(), this->Threads, stage,
      [&](std::size_t k) {
        std::vector<ClusterLink> links;
        ClusterRefiner::Tally unused;
        refiner.Refine(tasks[k], std::numeric_limits<std::size_t>::max(), links, unused);
        counts[k] = links.size();
      },
      1e-3);
  });
  std::vector<std::size_t> ofRank(size, 0);
  ofRank[0] = first.size();
  for (std::size_t k = 0; k < tasks.size(); ++k)
  {
    ofRank[k % size] += counts[k];
  }
  return *std::max_element(ofRank.begin(), ofRank.end());
}

/// Sorts links by their nodes, each link twice.
void ClusterNetwork::Keep(std::vector<std::vector<ClusterLink>>& parts)
{
  this->Begin.assign(this->Tree.Size() + 1, 0);
  for (const auto& part : parts)
  {
    for (const ClusterLink& link : part)
    {
      ++this->Begin[static_cast<std::size_t>(link.A) + 1];
      ++this->Begin[static_cast<std::size_t>(link.B) + 1];
    }
  }
  for (std::size_t k = 1; k < this->Begin.size(); ++k)
  {
    this->Begin[k] += this->Begin[k - 1];
  }
  this->Entries.resize(this->Begin.back());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (auto& part : parts)
  {
    for (const ClusterLink& link : part)
    {
      const auto turn = static_cast<std::uint8_t>(link.Slope * 255.0f);
      const Vec3 slope = turn == 0
        ? Vec3{}
        : (turn / 255.0) * ExchangeSlope(this->Tree[link.A], this->Tree[link.B]).Slope;
      const auto x = static_cast<float>(slope.x), y = static_cast<float>(slope.y),
                 z = static_cast<float>(slope.z);
      const double back =
        static_cast<double>(link.Factor) * this->Tree[link.A].Area / this->Tree[link.B].Area;
      this->Entries[next[static_cast<std::size_t>(link.A)]++] = { link.B, link.Kernel, { x, y, z },
        turn, CodedError(link.Factor), CodedError(link.FormA), CodedError(link.FormB),
        CodedError(link.SightA), CodedError(link.SightB), {} };
      this->Entries[next[static_cast<std::size_t>(link.B)]++] = { link.A, link.Kernel,
        { -x, -y, -z }, turn, CodedError(back), CodedError(link.FormB), CodedError(link.FormA),
        CodedError(link.SightB), CodedError(link.SightA), {} };
    }
    std::vector<ClusterLink>().swap(part);
  }
}

std::vector<std::int32_t> ClusterNetwork::Components() const
{
  // A linked node's elements all exchange with the same others.
  const std::size_t n = this->Tree.Order().size();
  LinkedSets sets(this->Tree.Size());
  std::vector<std::uint8_t> linked(this->Tree.Size(), 0);
  for (std::size_t k = 0; k < this->Tree.Size(); ++k)
  {
    const auto at = static_cast<std::int32_t>(k);
    const std::int32_t parent = this->Tree[at].Parent;
    const bool above = parent >= 0 && linked[static_cast<std::size_t>(parent)];
    if (above)
    {
      sets.Join(at, parent);
    }
    linked[k] = above;
    for (std::size_t e = this->Begin[k]; e < this->Begin[k + 1]; ++e)
    {
      if (this->Entries[e].Kernel > 0.0f)
      {
        sets.Join(at, this->Entries[e].Other);
        linked[k] = 1;
      }
    }
  }
  std::vector<std::int32_t> leafOf(n), number(this->Tree.Size(), -1), label(n);
  for (std::size_t k = 0; k < this->Tree.Size(); ++k)
  {
    const ElementTree::Node& node = this->Tree[static_cast<std::int32_t>(k)];
    if (node.Leaf())
    {
      leafOf[this->Item(node)] = static_cast<std::int32_t>(k);
    }
  }
  const auto name = [&](LinkedSets& of, const auto& place) {
    std::int32_t next = 0;
    std::fill(number.begin(), number.end(), -1);
    for (std::size_t i = 0; i < n; ++i)
    {
      auto& found = number[static_cast<std::size_t>(of.Root(place(i)))];
      found = found < 0 ? next++ : found;
      label[i] = found;
    }
  };
  name(sets, [&](std::size_t i) { return leafOf[i]; });
  if (this->Ranks)
  {
    // What is joined on any rank is joined.
    const auto size = static_cast<std::size_t>(this->Ranks->Size());
    std::vector<std::int32_t> all(n * size);
    std::copy(label.begin(), label.end(),
      all.begin() + static_cast<std::ptrdiff_t>(n * static_cast<std::size_t>(this->Ranks->Rank())));
    this->Ranks->Gather(all.data(), RankShare::Begins(*this->Ranks, size, n));
    LinkedSets joined(n);
    std::vector<std::int32_t> first(n);
    for (std::size_t r = 0; r < size; ++r)
    {
      std::fill(first.begin(), first.end(), -1);
      for (std::size_t i = 0; i < n; ++i)
      {
        auto& f = first[static_cast<std::size_t>(all[r * n + i])];
        const auto element = static_cast<std::int32_t>(i);
        f < 0 ? static_cast<void>(f = element) : joined.Join(f, element);
      }
    }
    name(joined, [](std::size_t i) { return static_cast<std::int32_t>(i); });
  }
  return label;
}

std::size_t ClusterNetwork::MemoryBytes() const
{
  return this->Tree.MemoryBytes() + this->Entries.size() * sizeof(Entry) +
    this->Begin.size() * sizeof(std::size_t) + this->Curved.size() * sizeof(std::int32_t);
}

void ClusterNetwork::Save(ArchiveWriter& out) const
{
  out.Put<std::int32_t>(this->Ranks ? this->Ranks->Size() : 1);
  this->Tree.Save(out);
  out.Put(this->Begin);
  out.Put(this->Entries);
  out.Put(this->LinkCount);
  out.Put(this->PairCount);
  out.Put(this->RayCount);
  out.Put<std::uint8_t>(this->Hurried);
}

void ClusterNetwork::Load(ArchiveReader& in, int threads, const Communicator* ranks)
{
  this->Threads = threads;
  this->Ranks = ranks;
  if (in.Get<std::int32_t>() != (ranks ? ranks->Size() : 1))
  {
    throw std::runtime_error("was saved by another number of ranks");
  }
  this->Tree.Load(in);
  in.Get(this->Begin);
  in.Get(this->Entries);
  this->LinkCount = in.Get<std::int64_t>();
  this->PairCount = in.Get<std::int64_t>();
  this->RayCount = in.Get<std::int64_t>();
  this->Hurried = in.Get<std::uint8_t>() != 0;
  const auto nodes = static_cast<std::int64_t>(this->Tree.Size());
  bool sound = this->Begin.size() == this->Tree.Size() + 1 && this->Begin.front() == 0 &&
    this->Begin.back() == this->Entries.size() &&
    std::is_sorted(this->Begin.begin(), this->Begin.end());
  for (const Entry& entry : this->Entries)
  {
    sound = sound && entry.Other >= 0 && entry.Other < nodes && std::isfinite(entry.Kernel);
  }
  if (!sound)
  {
    throw std::runtime_error("is damaged: links lead nowhere");
  }
  this->NumberCurved();
}

} // namespace radiometry
