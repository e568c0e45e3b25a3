// SPDX-License-Identifier: BSD-3-Clause
// MonteCarloOperator to and from an archive.
#include "radiometry/formfactor/MonteCarloOperator.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace radiometry
{
namespace
{

[[noreturn]] void Damaged(const char* what)
{
  throw std::runtime_error(std::string("is damaged: ") + what);
}

/// Where rows begin: ascending from 0 to `end`.
void CheckBegins(const std::vector<std::size_t>& begin, std::size_t rows, std::size_t end)
{
  if (begin.size() != rows + 1 || begin.front() != 0 || begin.back() != end ||
    !std::is_sorted(begin.begin(), begin.end()))
  {
    Damaged("the rays of its elements do not follow each other");
  }
}

} // namespace

void MonteCarloOperator::Save(ArchiveWriter& out) const
{
  out.Put(static_cast<std::uint64_t>(this->Size()));
  out.Put(static_cast<std::uint64_t>(this->Width));
  out.Put(static_cast<std::uint64_t>(this->Share.Begin));
  out.Put(static_cast<std::uint64_t>(this->Share.End));
  out.Put(this->Options.Seed);
  out.Put(this->Areas());
  out.Put(this->RaysOf);
  out.Put(this->Leaks);
  out.Put(this->CutOf);
  out.Put(static_cast<std::uint64_t>(this->Rounds.size()));
  for (const Round& round : this->Rounds)
  {
    out.Put(round.Begin);
    out.Put(round.Hit);
    out.Put(round.PartBegin);
    out.Put(round.PartHit);
    out.Put(round.PartWeight);
  }
}

std::unique_ptr<MonteCarloOperator> MonteCarloOperator::Load(ArchiveReader& in,
  std::shared_ptr<const OcclusionScene> occluders, std::shared_ptr<const ElementSet> elements,
  const ExchangeOptions& options)
{
  std::unique_ptr<MonteCarloOperator> made(
    new MonteCarloOperator(std::move(occluders), std::move(elements), options));
  MonteCarloOperator& f = *made;
  const auto n = in.Get<std::uint64_t>();
  const auto width = in.Get<std::uint64_t>();
  const auto begin = in.Get<std::uint64_t>();
  const auto end = in.Get<std::uint64_t>();
  f.Options.Seed = in.Get<std::uint64_t>();
  std::vector<double> areas;
  in.Get(areas);
  if (n != f.Size() || areas != f.Areas())
  {
    throw std::runtime_error("was made of another surface or of other elements");
  }
  if (width != f.Width)
  {
    throw std::runtime_error("was made for other mirrors or panes");
  }
  if (begin != f.Share.Begin || end != f.Share.End)
  {
    throw std::runtime_error("was made by another number of ranks");
  }
  const std::size_t rows = f.Share.End - f.Share.Begin;
  in.Get(f.RaysOf);
  in.Get(f.Leaks);
  in.Get(f.CutOf);
  if (f.RaysOf.size() != n || f.Leaks.size() != rows || f.CutOf.size() != rows)
  {
    Damaged("it lacks elements");
  }
  const auto element = [n](std::int32_t hit) {
    return hit >= 0 && static_cast<std::uint64_t>(hit) < n;
  };
  std::vector<std::int64_t> traced(rows, 0);
  const auto rounds = in.Get<std::uint64_t>();
  for (std::uint64_t r = 0; r < rounds; ++r)
  {
    Round round;
    in.Get(round.Begin);
    in.Get(round.Hit);
    in.Get(round.PartBegin);
    in.Get(round.PartHit);
    in.Get(round.PartWeight);
    CheckBegins(round.Begin, rows, round.Hit.size());
    if (!round.PartBegin.empty())
    {
      CheckBegins(round.PartBegin, rows * Batches, round.PartHit.size());
    }
    if (round.PartWeight.size() != round.PartHit.size() * width ||
      (round.PartBegin.empty() && !round.PartHit.empty()) ||
      !std::all_of(round.PartHit.begin(), round.PartHit.end(), element) ||
      !std::all_of(round.Hit.begin(), round.Hit.end(),
        [&](std::int32_t hit) { return hit == Round::None || element(hit); }))
    {
      Damaged("a ray meets an element that there is not");
    }
    for (std::size_t row = 0; row < rows; ++row)
    {
      traced[row] += static_cast<std::int64_t>(round.Begin[row + 1] - round.Begin[row]);
    }
    f.OwnBytes += round.Bytes();
    f.Rounds.push_back(std::move(round));
  }
  for (std::size_t row = 0; row < rows; ++row)
  {
    if (traced[row] != f.RaysOf[f.Share.Begin + row])
    {
      Damaged("it lacks rays");
    }
  }
  f.FindRows();
  f.Total = std::accumulate(f.RaysOf.begin(), f.RaysOf.end(), std::int64_t(0));
  f.TotalCut = std::accumulate(f.CutOf.begin(), f.CutOf.end(), std::int64_t(0));
  if (options.Ranks)
  {
    auto largest = static_cast<double>(f.OwnBytes);
    options.Ranks->Largest(&largest, 1);
    options.Ranks->Sum(&f.TotalCut, 1);
    f.OwnBytes = static_cast<std::size_t>(largest);
  }
  f.Summarise({});
  return made;
}

} // namespace radiometry
