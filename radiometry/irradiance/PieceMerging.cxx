// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/PieceMerging.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace radiometry
{
namespace
{

using Loop = std::vector<std::int32_t>;

/// Gives every place one number: places closer than the tolerance are one.
class PointPool
{
public:
  PointPool(const std::vector<PlanePiece>& pieces, const std::vector<Vec3>& kept, double tolerance)
  {
    std::vector<Vec3> all = kept; // first, so that they stay as they are
    for (const PlanePiece& piece : pieces)
    {
      all.insert(all.end(), piece.Corners.begin(), piece.Corners.end());
    }
    std::vector<std::int32_t> order(all.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::int32_t i) {
      return all[i].x + 0.7548776662466927 * all[i].y + 0.5698402909980532 * all[i].z;
    };
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return key(a) < key(b) || (key(a) == key(b) && a < b);
    });
    std::vector<std::int32_t> leader(all.size());
    std::iota(leader.begin(), leader.end(), 0);
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      for (std::size_t j = i; j-- > 0 && key(order[i]) - key(order[j]) <= 2.0 * tolerance;)
      {
        if (Length(all[order[i]] - all[order[j]]) <= tolerance)
        {
          const std::int32_t first = std::min(leader[order[i]], leader[order[j]]);
          leader[order[i]] = leader[order[j]] = first;
        }
      }
    }
    std::vector<std::int32_t> number(all.size(), -1);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      std::int32_t lead = leader[i];
      while (leader[lead] != lead)
      {
        lead = leader[lead];
      }
      if (number[lead] < 0)
      {
        number[lead] = static_cast<std::int32_t>(this->Points.size());
        this->Points.push_back(all[lead]);
      }
      this->Numbers.push_back(number[lead]);
    }
    this->Kept.assign(this->Points.size(), 0);
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
      this->Kept[this->Numbers[i]] = 1;
    }
    this->Next = kept.size();
  }

  /// The corners of the next piece, in the order in which the pieces were given.
  Loop Take(std::size_t corners)
  {
    Loop loop;
    for (std::size_t k = 0; k < corners; ++k)
    {
      const std::int32_t p = this->Numbers[this->Next++];
      if (loop.empty() || loop.back() != p)
      {
        loop.push_back(p);
      }
    }
    while (loop.size() > 1 && loop.front() == loop.back())
    {
      loop.pop_back();
    }
    return loop;
  }

  std::vector<Vec3> Points;
  std::vector<std::uint8_t> Kept;

private:
  std::vector<std::int32_t> Numbers;
  std::size_t Next = 0;
};

class Joiner
{
public:
  Joiner(const std::vector<Vec3>& points, const Vec3& normal, double tolerance)
    : Points(points)
    , Normal(normal)
    , Tolerance(tolerance)
  {
  }

  /// Adds the points of others that lie on the loop's edges.
  void Fit(Loop& loop) const
  {
    Loop fitted;
    std::vector<std::pair<double, std::int32_t>> between;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const Vec3& a = this->Points[loop[k]];
      const Vec3 along = this->Points[loop[(k + 1) % loop.size()]] - a;
      const double length = Length(along);
      between.clear();
      for (std::size_t p = 0; p < this->Points.size(); ++p)
      {
        const Vec3 d = this->Points[p] - a;
        const double t = Dot(d, along) / length;
        if (t > this->Tolerance && t < length - this->Tolerance &&
          LengthSquared(d - (t / length) * along) <= this->Tolerance * this->Tolerance)
        {
          between.emplace_back(t, static_cast<std::int32_t>(p));
        }
      }
      std::sort(between.begin(), between.end());
      fitted.push_back(loop[k]);
      for (const auto& [t, p] : between)
      {
        fitted.push_back(p);
      }
    }
    loop.swap(fitted);
  }

  /// How far to the left the loop turns at b, coming from a and going to c (m; below 0: right).
  double Turn(std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    const Vec3 in = this->Points[b] - this->Points[a];
    const Vec3 out = this->Points[c] - this->Points[b];
    const double longest = std::max(Length(in), Length(out));
    return longest > 0.0 ? Dot(this->Normal, Cross(in, out)) / longest : 0.0;
  }

  /// The union of two loops whose common edges form one chain, when it is convex; else empty.
  Loop Union(const Loop& a, const Loop& b) const
  {
    const auto inB = [&](std::int32_t u, std::int32_t v) {
      for (std::size_t k = 0; k < b.size(); ++k)
      {
        if (b[k] == u && b[(k + 1) % b.size()] == v)
        {
          return true;
        }
      }
      return false;
    };
    const std::size_t n = a.size();
    std::vector<std::uint8_t> common(n);
    std::size_t shared = 0;
    for (std::size_t k = 0; k < n; ++k)
    {
      common[k] = inB(a[(k + 1) % n], a[k]) ? 1 : 0;
      shared += common[k];
    }
    if (shared == 0 || shared == n)
    {
      return {};
    }
    std::size_t start = 0; // the first edge of a after the chain
    while (!(common[(start + n - 1) % n] == 1 && common[start] == 0))
    {
      ++start;
    }
    Loop joined;
    std::size_t k = start;
    for (; common[k % n] == 0; ++k)
    {
      joined.push_back(a[k % n]);
    }
    if (n - (k - start) != shared)
    {
      return {}; // more than one chain
    }
    const std::int32_t from = a[k % n];
    const std::int32_t to = a[start];
    const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), from) - b.begin());
    for (std::size_t j = 0; b[(at + j) % b.size()] != to; ++j)
    {
      if (j == b.size())
      {
        return {};
      }
      joined.push_back(b[(at + j) % b.size()]);
    }
    const std::size_t m = joined.size();
    const auto convexAt = [&](std::int32_t p) {
      const auto i = static_cast<std::size_t>(std::find(joined.begin(), joined.end(), p) - joined.begin());
      return this->Turn(joined[(i + m - 1) % m], p, joined[(i + 1) % m]) >= -this->Tolerance;
    };
    return m >= 3 && convexAt(from) && convexAt(to) ? joined : Loop{};
  }

private:
  const std::vector<Vec3>& Points;
  const Vec3 Normal;
  const double Tolerance;
};

/// Joins what may be joined until nothing more can.
void JoinLoops(const Joiner& joiner, std::vector<Loop>& loops, const std::vector<std::int64_t>& states)
{
  bool changed = true;
  while (changed)
  {
    changed = false;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> left;
    for (std::size_t i = 0; i < loops.size(); ++i)
    {
      for (std::size_t k = 0; k < loops[i].size(); ++k)
      {
        left[{ loops[i][k], loops[i][(k + 1) % loops[i].size()] }] = i;
      }
    }
    for (const auto& [edge, i] : left)
    {
      const auto twin = left.find({ edge.second, edge.first });
      if (twin == left.end() || edge.first > edge.second)
      {
        continue;
      }
      const std::size_t j = twin->second;
      if (i == j || states[i] != states[j] || loops[i].empty() || loops[j].empty())
      {
        continue;
      }
      Loop joined = joiner.Union(loops[i], loops[j]);
      if (!joined.empty())
      {
        loops[i] = std::move(joined);
        loops[j].clear();
        changed = true;
      }
    }
  }
}

} // namespace

PieceSet JoinPieces(const std::vector<PlanePiece>& pieces, const Vec3& normal, double tolerance,
  const std::vector<Vec3>& kept)
{
  PointPool pool(pieces, kept, tolerance);
  const Joiner joiner(pool.Points, normal, tolerance);
  std::vector<Loop> loops;
  std::vector<std::int64_t> states;
  for (const PlanePiece& piece : pieces)
  {
    Loop loop = pool.Take(piece.Corners.size());
    if (loop.size() >= 3)
    {
      joiner.Fit(loop);
      loops.push_back(std::move(loop));
      states.push_back(piece.State);
    }
  }
  JoinLoops(joiner, loops, states);

  // Corners at which nothing turns.
  std::vector<std::uint8_t> turns = pool.Kept;
  for (const Loop& loop : loops)
  {
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const std::size_t n = loop.size();
      const double turn = joiner.Turn(loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]);
      turns[loop[k]] |= std::fabs(turn) > tolerance ? 1 : 0;
    }
  }
  PieceSet out;
  std::vector<std::int32_t> number(pool.Points.size(), -1);
  for (std::size_t i = 0; i < loops.size(); ++i)
  {
    Loop loop;
    for (const std::int32_t p : loops[i])
    {
      if (turns[p] == 0)
      {
        continue;
      }
      if (number[p] < 0)
      {
        number[p] = static_cast<std::int32_t>(out.Points.size());
        out.Points.push_back(pool.Points[p]);
      }
      loop.push_back(number[p]);
    }
    if (loop.size() >= 3)
    {
      out.Loops.push_back(std::move(loop));
      out.States.push_back(states[i]);
    }
  }
  return out;
}

} // namespace radiometry
