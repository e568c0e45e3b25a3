// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactorPairs.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/GatherRecords.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr int Sets = ExchangeStratum::Sets;
constexpr double MostPoints = 1u << 20; // of each sequence in a row's round
constexpr double MostAgreed = 1024;     // ... of a stratum all of whose rays agree
constexpr double LookedShare = 0.4;     // of the goal: what one ray that sees nothing may take
constexpr double HiddenShare = 1.5;     // ... what one that sees something may add
constexpr std::size_t FewStrata = 8;    // of a row whose strata must each be looked at well

/// What 95 % of Student's t with so many degrees of freedom stay below (within 1 %).
double Student95(double freedom)
{
  const double x = 1.0 / std::max(1.0, freedom);
  return 1.96 + x * (2.37 + x * (2.82 + x * 5.55));
}

double Looked(const ExchangeStratum& s) { return s.AnyHidden ? HiddenShare : LookedShare; }

} // namespace

bool ViewFactorPairs::TimeIsUp() const
{
  return this->Options.TimeBudget > 0.0 && this->Clock->Elapsed() > this->Options.TimeBudget;
}

double ViewFactorPairs::Goal(const GroupExchange& row) const
{
  const double area =
    std::min(this->Tree[this->Tree.Root(row.I)].Area, this->Tree[this->Tree.Root(row.J)].Area);
  return std::max(
    this->Options.RelativeTolerance * row.Value, this->Options.AbsoluteTolerance * area);
}

void ViewFactorPairs::Sample(ExchangeStratum& stratum) const
{
  const PatchTree::Node& a = this->Tree[stratum.A];
  const PatchTree::Node& b = this->Tree[stratum.B];
  const auto span = [](const PatchTree::Node& n) {
    return (static_cast<std::uint64_t>(n.Begin) << 32) | static_cast<std::uint64_t>(n.End);
  };
  const std::uint64_t key =
    Hash64(Hash64(Hash64(this->Options.Seed, stratum.Round++), span(a)), span(b));
  stratum.Done = stratum.Wanted;
  stratum.Wanted = 0;
  stratum.Rays += static_cast<std::int64_t>(Sets) * stratum.Done;
  stratum.AnyVisible = stratum.AnyHidden = false;
  for (int set = 0; set < Sets; ++set)
  {
    stratum.Weight[set] = stratum.Visible[set] = 0.0;
    const SobolSequence sequence(Hash64(key, static_cast<std::uint64_t>(set)));
    for (std::uint32_t k = 0; k < stratum.Done; ++k)
    {
      this->SamplePoint(stratum, set, sequence(k));
    }
  }
}

void ViewFactorPairs::SamplePoint(
  ExchangeStratum& stratum, int set, const std::array<double, 4>& u) const
{
  double shareA = u[0], shareB = u[2];
  const std::int32_t elementA = this->Tree.Pick(this->Tree[stratum.A], shareA);
  const std::int32_t elementB = this->Tree.Pick(this->Tree[stratum.B], shareB);
  const ExchangePatch& shapeA = this->Tree.Shape(elementA);
  const ExchangePatch& shapeB = this->Tree.Shape(elementB);
  if (stratum.Near)
  {
    // Where two triangles are near each other the kernel has a peak: its mean over one of them, as
    // seen from the point on the other.
    const double reach = 1.5 * (shapeA.Radius + shapeB.Radius);
    if (LengthSquared(shapeB.Center - shapeA.Center) < reach * reach)
    {
      const Vec3 from = TrianglePoint(shapeA.Corners, shareA, u[1]);
      const double mean =
        Pi / shapeB.Area * PointToPolygon(from, shapeA.Normal, SmallPolygon(shapeB.Corners));
      if (mean > 0.0)
      {
        const double fraction = stratum.Open
          ? 1.0
          : this->NearFraction(elementA, elementB, { shareA, u[1], shareB, u[3] });
        stratum.Weight[set] += mean;
        stratum.Visible[set] += mean * fraction;
        stratum.AnyVisible = stratum.AnyVisible || fraction > 0.0;
        stratum.AnyHidden = stratum.AnyHidden || fraction < 1.0;
      }
      return;
    }
  }
  const Vec3 x = TrianglePoint(shapeA.Corners, shareA, u[1]);
  const Vec3 y = TrianglePoint(shapeB.Corners, shareB, u[3]);
  const Vec3 r = y - x;
  const double r2 = LengthSquared(r);
  const double kernel =
    std::max(0.0, Dot(shapeA.Normal, r)) * std::max(0.0, -Dot(shapeB.Normal, r)) / (r2 * r2);
  if (!(kernel > 0.0))
  {
    return;
  }
  stratum.Weight[set] += kernel;
  if (!stratum.Open &&
    this->Occluders.Occluded(
      { x, this->Tree.Triangle(elementA) }, { y, this->Tree.Triangle(elementB) }))
  {
    stratum.AnyHidden = true;
  }
  else
  {
    stratum.AnyVisible = true;
    stratum.Visible[set] += kernel;
  }
}

/// The visible share of the exchange of two triangles that are near each other, from four points.
double ViewFactorPairs::NearFraction(
  std::int32_t a, std::int32_t b, const std::array<double, 4>& u) const
{
  const ExchangePatch& shapeA = this->Tree.Shape(a);
  const ExchangePatch& shapeB = this->Tree.Shape(b);
  double weight = 0.0, visible = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    // Shifted by halves: a lattice in four dimensions.
    const auto shifted = [&](int d) {
      const double v =
        u[d] + 0.5 * ((d < 2 ? k : k >> 1) & 1) + (d % 2 == 0 ? 0.25 * (k & 1) : 0.0);
      return v - std::floor(v);
    };
    const Vec3 x = TrianglePoint(shapeA.Corners, shifted(0), shifted(1));
    const Vec3 y = TrianglePoint(shapeB.Corners, shifted(2), shifted(3));
    const Vec3 r = y - x;
    const double r2 = LengthSquared(r);
    const double kernel =
      std::max(0.0, Dot(shapeA.Normal, r)) * std::max(0.0, -Dot(shapeB.Normal, r)) / (r2 * r2);
    if (kernel > 0.0)
    {
      weight += kernel;
      visible +=
        this->Occluders.Occluded({ x, this->Tree.Triangle(a) }, { y, this->Tree.Triangle(b) })
        ? 0.0
        : kernel;
    }
  }
  return weight > 0.0 ? visible / weight : 0.5;
}

double ViewFactorPairs::Value(const ExchangeStratum& s) const
{
  double weight = 0.0, visible = 0.0;
  for (int set = 0; set < Sets; ++set)
  {
    weight += s.Weight[set];
    visible += s.Visible[set];
  }
  if (s.Exact >= 0.0)
  {
    return weight > 0.0 ? s.Exact * visible / weight : 0.5 * s.Exact;
  }
  return s.Share * this->Tree[s.A].Area * this->Tree[s.B].Area / Pi * visible /
    (static_cast<double>(Sets) * s.Done);
}

double ViewFactorPairs::Variance(const ExchangeStratum& s) const
{
  double weight = 0.0, visible = 0.0, spread = 0.0;
  for (int set = 0; set < Sets; ++set)
  {
    weight += s.Weight[set];
    visible += s.Visible[set];
  }
  if (s.Exact < 0.0)
  {
    for (int set = 0; set < Sets; ++set)
    {
      const double off = s.Visible[set] - visible / Sets;
      spread += off * off;
    }
    const double unit =
      s.Share * this->Tree[s.A].Area * this->Tree[s.B].Area / Pi / static_cast<double>(s.Done);
    return unit * unit * spread / (Sets * (Sets - 1.0));
  }
  if (!(weight > 0.0))
  {
    return 0.25 * s.Exact * s.Exact;
  }
  if (s.Agreed())
  {
    return 0.0;
  }
  const double fraction = visible / weight;
  for (int set = 0; set < Sets; ++set)
  {
    const double off = (s.Visible[set] - fraction * s.Weight[set]) / weight;
    spread += off * off * Sets / (Sets - 1.0);
  }
  return s.Exact * s.Exact * spread;
}

/// The mean square of what rays may have missed.
double ViewFactorPairs::Unnoticed(const ExchangeStratum& s, double goal) const
{
  if (s.Exact < 0.0)
  {
    return 0.0;
  }
  if (s.Agreed())
  {
    // What a share of which k rays see nothing may be (something stands between, or proof failed).
    const double missed = 0.75 * s.Exact / (static_cast<double>(Sets) * s.Done + 2.0);
    return missed * missed;
  }
  // What pairs of the same kind hide from the rays they got: of V uniform in (0, 1) k rays agree by
  // chance in 2/(k+1) and are then wrong by 4/((k+1)(k+2)(k+3)) in the mean square.
  const double k = std::max(4.0, std::min(Sets * MostAgreed, s.Exact / (LookedShare * goal)));
  return s.Exact * s.Exact * 4.0 / ((k + 1.0) * (k + 2.0) * (k + 3.0)) / (1.0 - 2.0 / (k + 1.0));
}

/// Of one point of each sequence: what the sequences' spread says, and where all rays agree what
/// one more that does not would.
double ViewFactorPairs::Deviation(const ExchangeStratum& s) const
{
  const double seen = std::sqrt(this->Variance(s) * s.Done);
  if (!s.Agreed() || s.Open)
  {
    return seen;
  }
  double weight = 0.0;
  for (const double w : s.Weight)
  {
    weight += w;
  }
  const double rays = static_cast<double>(Sets) * s.Done;
  const double all = s.Exact >= 0.0
    ? s.Exact
    : s.Share * this->Tree[s.A].Area * this->Tree[s.B].Area / Pi * weight / rays;
  const double p = 1.0 / (rays + 2.0);
  return std::max(seen, all * std::sqrt(p * (1.0 - p) / Sets));
}

void ViewFactorPairs::Begin(
  const GroupExchange& row, double scale, ExchangeStratum* strata, std::size_t count) const
{
  double most = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    most += scale * std::max(0.0, strata[k].Exact);
  }
  // A share between nothing and all is known to 1/sqrt(rays).
  const double ratio = most / std::max(this->Goal(row), 1e-300);
  const double points = ratio * ratio / (Sets * static_cast<double>(count));
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool cluster = strata[k].Exact < 0.0;
    strata[k].Wanted = cluster || points > 4.0 ? 8 : (points > 2.0 ? 4 : (points > 1.0 ? 2 : 1));
  }
}

bool ViewFactorPairs::Plan(
  GroupExchange& row, double known, ExchangeStratum* strata, std::size_t count, bool late, double* ideal) const
{
  const double scale = row.I == row.J ? 2.0 : 1.0;
  double value = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    value += this->Value(strata[k]);
  }
  row.Value = known + scale * value;
  const double goal = this->Goal(row);
  double variance = 0.0, fourth = 0.0, unnoticed = 0.0;
  bool looked = true;
  for (std::size_t k = 0; k < count; ++k)
  {
    const ExchangeStratum& s = strata[k];
    const double v = scale * scale * this->Variance(s);
    variance += v;
    fourth += v * v / (Sets - 1.0);
    unnoticed += count <= FewStrata ? scale * scale * this->Unnoticed(s, goal) : 0.0;
    looked = looked &&
      !(count <= FewStrata && s.Exact > 0.0 && s.Agreed() && s.Done < MostAgreed &&
        scale * s.Exact > Looked(s) * goal * (static_cast<double>(Sets) * s.Done + 2.0));
  }
  const double t = variance > 0.0 ? Student95(variance * variance / fourth) : 0.0;
  // A round ends the row when its spread happens to be small: a tenth more.
  const double sampling = 1.1 * t * std::sqrt(variance);
  row.Sampling = std::hypot(sampling, std::sqrt(unnoticed));

  const double left = std::max(0.25 * goal, goal - row.Truncation);
  double points = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    points += strata[k].Done;
  }
  if ((sampling <= left && looked) || points >= MostPoints * static_cast<double>(FewStrata))
  {
    return true;
  }
  if (late)
  {
    this->Late = true;
    return true;
  }
  const double wanted = this->Allot(left, scale, strata, count);
  if (ideal)
  {
    *ideal += wanted;
  }
  return false;
}

/// Points where they help most: in proportion to the deviation of one of them.
double ViewFactorPairs::Allot(
  double goal, double scale, ExchangeStratum* strata, std::size_t count) const
{
  const double wanted = goal / (scale * 2.0);
  double deviations = 0.0, points = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    deviations += this->Deviation(strata[k]);
    points += strata[k].Done;
  }
  const double ideal = deviations * deviations / (wanted * wanted);
  const double total = std::clamp(ideal, LeastGrowth * points, this->Growth * points);
  for (std::size_t k = 0; k < count; ++k)
  {
    ExchangeStratum& s = strata[k];
    double most = deviations > 0.0 ? total * this->Deviation(s) / deviations : 0.0;
    if (count <= FewStrata && s.Exact > 0.0 && s.Agreed())
    {
      most = std::max(most, std::min(MostAgreed, scale * s.Exact / (Looked(s) * goal) / Sets));
    }
    s.Wanted = 1;
    while (s.Wanted < 0.75 * most && s.Wanted < (1u << 20))
    {
      s.Wanted *= 2;
    }
  }
  return ideal;
}

/// All that are to be sampled, each rank its share.
void ViewFactorPairs::SampleAll(std::vector<ExchangeStratum>& strata, const StageProgress& stage)
{
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < strata.size(); ++k)
  {
    if (strata[k].Wanted > 0)
    {
      all.push_back(k);
    }
  }
  const RankShare share(this->Options.Ranks, all.size());
  ParallelFor(
    share.End - share.Begin, this->Options.Threads, stage,
    [&](std::size_t k) {
      ExchangeStratum& stratum = strata[all[share.Begin + k]];
      this->RayCount += static_cast<std::int64_t>(Sets) * stratum.Wanted;
      this->Sample(stratum);
    },
    1e-5);
  if (this->Options.Ranks)
  {
    std::vector<ExchangeStratum> own;
    for (std::size_t k = share.Begin; k < share.End; ++k)
    {
      own.push_back(strata[all[k]]);
    }
    GatherRecords(this->Options.Ranks, own);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      strata[all[k]] = own[k];
    }
  }
}

bool ViewFactorPairs::Refine(std::vector<Row>& rows, std::vector<ExchangeStratum>& strata,
  const StageProgress& stage, ConvergenceRecord& record, const Forecast& forecast)
{
  std::vector<double> known;
  known.reserve(rows.size());
  for (const Row& row : rows)
  {
    known.push_back(row.Exchange.Value);
  }
  constexpr int rounds = 24;
  for (int round = 0;; ++round)
  {
    StageProgress part = stage;
    part.Begin = stage.Begin + (stage.End - stage.Begin) * round / rounds;
    part.End = stage.Begin + (stage.End - stage.Begin) * (round + 1) / rounds;
    const double begin = record.Elapsed();
    double points = 0.0;
    for (const ExchangeStratum& stratum : strata)
    {
      points += stratum.Wanted;
    }
    this->SampleAll(strata, part);
    const double seconds = record.Elapsed() - begin;
    double ideal = 0.0;
    // Fresh points at least twice as many, or none.
    double times[2] = { record.Elapsed(), seconds };
    if (this->Options.Ranks)
    {
      this->Options.Ranks->Largest(times, 2);
    }
    const double left = this->Options.TimeBudget - times[0];
    this->Growth = this->Options.TimeBudget > 0.0
      ? std::min(GreatestGrowth, left / std::max(times[1], 1e-9))
      : GreatestGrowth;
    const bool late = this->Growth < LeastGrowth;
    bool all = true;
    double value = 0.0, error = 0.0;
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
      Row& row = rows[r];
      if (!row.Met)
      {
        row.Met =
          this->Plan(row.Exchange, known[r], strata.data() + row.First, row.Strata, late, &ideal);
        all = all && row.Met;
      }
      value += row.Exchange.Value;
      error += row.Exchange.Error();
    }
    record.Add(round == 0 ? "pairs" : "visibility", value > 0.0 ? error / value : 0.0,
      rows.empty() ? 0.0 : error / static_cast<double>(rows.size()),
      this->PairCount + this->RayCount);
    // Rounds of fresh points, each eight times the one before: a seventh on top of the last.
    if (round == 0 && forecast &&
      !forecast(points > 0.0 ? 8.0 / 7.0 * ideal * seconds / points : 0.0))
    {
      return false;
    }
    if (all || round + 1 == rounds)
    {
      return true;
    }
  }
}

} // namespace radiometry
