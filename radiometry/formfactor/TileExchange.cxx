// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/TileExchange.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/visibility/PairVisibility.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
// Halving both blocks down to single elements takes twice six steps.
constexpr int Depths = 14;
// So few pairs are not halved further.
constexpr std::size_t FewPairs = 4;
// Looking at a candidate costs some hundredth of sampling a pair, and settles a tenth of the groups:
// with more candidates a pair than these the pairs are sampled at once.
constexpr std::size_t CandidatesPerPair = 3;

} // namespace

struct TileExchange::Work
{
  std::size_t BlockA, BlockB;
  bool Diagonal; // the pairs within one block
  double* Values;
  TileResult& Result;
  PatchBlockers::Candidates* Lists; // one a depth
};

TileExchange::TileExchange(const ElementBlocks& rows, const ElementBlocks& columns,
  const OcclusionScene& occluders, const PatchBlockers* blockers, const ExchangeOptions& options)
  : Rows(rows)
  , Columns(columns)
  , Occluders(occluders)
  , Blockers(blockers)
  , Options(options)
  , Tolerance(std::clamp(0.05 * options.RelativeTolerance, 1e-9, 1e-3))
  , Deadline(std::chrono::steady_clock::time_point::max())
{
  if (options.SecondsLeft > 0.0 && options.SecondsLeft < 1e9)
  {
    this->Deadline = std::chrono::steady_clock::now() +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(options.SecondsLeft));
  }
}

bool TileExchange::Late() const
{
  return this->Deadline != std::chrono::steady_clock::time_point::max() &&
    std::chrono::steady_clock::now() > this->Deadline;
}

void TileExchange::operator()(
  std::size_t i, std::size_t j, double* values, TileResult& result) const
{
  thread_local std::vector<PatchBlockers::Candidates> lists(Depths);
  result.Truncation.assign(2 * Edge, 0.0);
  Work work{ i, j, i == j && &this->Rows == &this->Columns, values, result, lists.data() };
  if (work.Diagonal)
  {
    this->Same(work, 1);
  }
  else
  {
    this->Divide(work, 1, 1, 0);
  }
}

/// The pairs within one group.
void TileExchange::Same(Work& work, std::size_t a) const
{
  if (a >= Edge)
  {
    return; // an element does not see itself
  }
  this->Same(work, 2 * a);
  this->Same(work, 2 * a + 1);
  this->Divide(work, 2 * a, 2 * a + 1, 0);
}

void TileExchange::Divide(Work& work, std::size_t a, std::size_t b, int depth) const
{
  const Node& na = this->Rows.At(work.BlockA, a);
  const Node& nb = this->Columns.At(work.BlockB, b);
  if (na.Group.Count == 0 || nb.Group.Count == 0 || ElementBlocks::BackFacing(na, nb))
  {
    return;
  }
  if (!this->Blockers)
  {
    this->Open(work, na, nb);
    return;
  }
  const auto pairs =
    static_cast<std::size_t>(na.Group.Count) * static_cast<std::size_t>(nb.Group.Count);
  const PatchBlockers::Candidates* whole = depth > 0 ? &work.Lists[depth - 1] : nullptr;
  if (whole && !this->Late() &&
    (whole->Complete ? whole->Triangles.size() > CandidatesPerPair * pairs : pairs <= 2 * FewPairs))
  {
    this->Mixed(work, na, nb, *whole);
    return;
  }
  PatchBlockers::Candidates& between = work.Lists[depth];
  const Sight sight = this->Blockers->Between(
    na.Group, nb.Group, whole, between, std::clamp<std::size_t>(pairs / 4, 48, 1024));
  if (sight == Sight::Hidden)
  {
    return;
  }
  if (sight == Sight::Clear)
  {
    this->Open(work, na, nb);
    return;
  }
  if (pairs <= FewPairs)
  {
    this->Mixed(work, na, nb, between);
    return;
  }
  if (this->Late())
  {
    this->Rough(work, na, nb);
    return;
  }
  if (b >= Edge || (a < Edge && na.Radius >= nb.Radius))
  {
    this->Divide(work, 2 * a, b, depth + 1);
    this->Divide(work, 2 * a + 1, b, depth + 1);
  }
  else
  {
    this->Divide(work, a, 2 * b, depth + 1);
    this->Divide(work, a, 2 * b + 1, depth + 1);
  }
}

void TileExchange::Store(
  Work& work, std::int32_t r, std::int32_t c, double value, double error) const
{
  const auto row = static_cast<std::size_t>(r);
  const auto column = static_cast<std::size_t>(c);
  work.Result.Truncation[row] += error;
  work.Result.Truncation[Edge + column] += error;
  work.Values[row * Edge + column] = value;
  if (work.Diagonal)
  {
    work.Values[column * Edge + row] = value;
  }
}

/// Of pairs that exchange next to nothing (in nearly one plane, say) no digits are sought.
PairExchangeResult TileExchange::Unblocked(const ExchangePatch& a, const ExchangePatch& b) const
{
  return PairExchange(
    a, b, this->Tolerance, 1e-4 * this->Tolerance * std::min(a.Area, b.Area));
}

/// Nothing stands between any of them.
void TileExchange::Open(Work& work, const Node& a, const Node& b) const
{
  for (std::int32_t r = a.First; r < a.First + a.Group.Count; ++r)
  {
    const std::size_t i = work.BlockA * Edge + static_cast<std::size_t>(r);
    for (std::int32_t c = b.First; c < b.First + b.Group.Count; ++c)
    {
      const std::size_t j = work.BlockB * Edge + static_cast<std::size_t>(c);
      if (this->Rows.Placed(i).Triangle == this->Columns.Placed(j).Triangle)
      {
        continue; // one plane
      }
      const PairExchangeResult pair =
        this->Unblocked(this->Rows.Shape(i), this->Columns.Shape(j));
      if (pair.Value > 0.0)
      {
        ++work.Result.Pairs;
        this->Store(work, r, c, pair.Value, pair.Error);
      }
    }
  }
}

/// A few pairs that something may stand between.
void TileExchange::Mixed(Work& work, const Node& a, const Node& b,
  const PatchBlockers::Candidates& between) const
{
  for (std::int32_t r = a.First; r < a.First + a.Group.Count; ++r)
  {
    for (std::int32_t c = b.First; c < b.First + b.Group.Count; ++c)
    {
      this->Single(work, r, c, between);
    }
  }
}

void TileExchange::Single(Work& work, std::int32_t r, std::int32_t c,
  const PatchBlockers::Candidates& between) const
{
  const std::size_t i = work.BlockA * Edge + static_cast<std::size_t>(r);
  const std::size_t j = work.BlockB * Edge + static_cast<std::size_t>(c);
  const PlacedPatch& pi = this->Rows.Placed(i);
  const PlacedPatch& pj = this->Columns.Placed(j);
  if (pi.Triangle == pj.Triangle)
  {
    return;
  }
  const PairExchangeResult pair =
    this->Unblocked(this->Rows.Shape(i), this->Columns.Shape(j));
  if (!(pair.Value > 0.0))
  {
    return;
  }
  ++work.Result.Pairs;
  // Even parts: (V error) F <= tolerance sqrt(F)/2 makes a row's error that tolerance.
  const double factor =
    pair.Value / std::min(this->Rows.Shape(i).Area, this->Columns.Shape(j).Area);
  PairSampling sampling;
  sampling.Wanted = 0.5 * this->Options.RelativeTolerance / std::sqrt(factor);
  const double rays = std::clamp(0.125 / (sampling.Wanted * sampling.Wanted), 4.0, 64.0);
  sampling.First = static_cast<int>(std::exp2(std::ceil(std::log2(rays))));
  const auto [low, high] = std::minmax(this->Rows.Order()[i], this->Columns.Order()[j]);
  sampling.Key = Hash64(this->Options.Seed,
    (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high));
  const PairVisibilityResult v =
    PairVisibility(this->Occluders, *this->Blockers, pi, pj, between, sampling);
  work.Result.Rays += v.Rays;
  if (v.Error > 0.0)
  {
    work.Result.Sampled.push_back({ static_cast<std::int32_t>(i), static_cast<std::int32_t>(j),
      static_cast<float>(v.Error * pair.Value) });
  }
  this->Store(work, r, c, pair.Value * v.Fraction, pair.Error);
}

/// No time to look closer.
void TileExchange::Rough(Work& work, const Node& a, const Node& b) const
{
  constexpr std::uint32_t segments = 32;
  const std::size_t firstA = work.BlockA * Edge + static_cast<std::size_t>(a.First);
  const std::size_t firstB = work.BlockB * Edge + static_cast<std::size_t>(b.First);
  const SobolSequence pairs(Hash64(Hash64(this->Options.Seed, 0x726f756768ull),
    (static_cast<std::uint64_t>(firstA) << 32) | firstB));
  const SobolSequence points(Hash64(Hash64(this->Options.Seed, 0x706c616365ull),
    (static_cast<std::uint64_t>(firstA) << 32) | firstB));
  double asked = 0.0, seen = 0.0;
  for (std::uint32_t k = 0; k < segments; ++k)
  {
    const auto u = pairs(k);
    const auto v = points(k);
    const PlacedPatch& p = a.Group.Patches[static_cast<std::int32_t>(u[0] * a.Group.Count)];
    const PlacedPatch& q = b.Group.Patches[static_cast<std::int32_t>(u[1] * b.Group.Count)];
    const Vec3 x = TrianglePoint(p.Corners, v[0], v[1]);
    const Vec3 y = TrianglePoint(q.Corners, v[2], v[3]);
    if (Dot(p.Normal, y - x) > 0.0 && Dot(q.Normal, x - y) > 0.0)
    {
      asked += 1.0;
      seen += this->Occluders.Occluded({ this->Blockers->Unplace(x), p.Triangle },
                { this->Blockers->Unplace(y), q.Triangle })
        ? 0.0
        : 1.0;
    }
  }
  work.Result.Rays += static_cast<std::int64_t>(asked);
  // Rule of succession: the mean of what the share may be, and the spread of what one pair may get.
  const double visible = (seen + 1.0) / (asked + 2.0);
  work.Result.Rough.push_back({ static_cast<std::int32_t>(firstA), a.Group.Count,
    static_cast<std::int32_t>(firstB), b.Group.Count,
    static_cast<float>(std::sqrt((1.0 - visible) / visible)) });
  for (std::int32_t r = 0; r < a.Group.Count; ++r)
  {
    const ExchangePatch& p = this->Rows.Shape(firstA + static_cast<std::size_t>(r));
    for (std::int32_t c = 0; c < b.Group.Count; ++c)
    {
      const ExchangePatch& q = this->Columns.Shape(firstB + static_cast<std::size_t>(c));
      const Vec3 way = q.Center - p.Center;
      const double cosines = std::max(0.0, Dot(p.Normal, way)) * std::max(0.0, -Dot(q.Normal, way));
      if (cosines == 0.0)
      {
        continue;
      }
      // Between discs that face each other, which is never more than a whole hemisphere.
      const double r2 = LengthSquared(way);
      const double larger = std::max(p.Area, q.Area);
      const double value = p.Area * q.Area * cosines / (r2 * (Pi * r2 + larger)) * visible;
      const double off = std::min(1.0, (p.Radius * p.Radius + q.Radius * q.Radius) / r2);
      ++work.Result.Pairs;
      this->Store(work, a.First + r, b.First + c, value, off * value);
    }
  }
}

} // namespace radiometry
