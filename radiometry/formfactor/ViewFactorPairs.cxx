// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactorPairs.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/scene/GatherRecords.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace radiometry
{
namespace
{

// An item of work: about so many pairs of elements (Dense), or elements of both (Hierarchical).
constexpr std::int64_t ItemPairs = 8192;
constexpr std::int32_t ItemElements = 2048;
// Fewer pairs than this are taken one by one even where their clusters are apart.
constexpr std::int64_t FewPairs = 16;
// Clusters of this share of their group are sampled even where they touch.
constexpr double SmallShare = 1.0 / 64.0;
// A row of more strata than this is left to all threads together.
constexpr std::size_t LocalStrata = 64;
// Of what stands in a shaft, so many are looked at.
constexpr std::size_t MostInside = 256;

/// The part of a flat node's outline above the plane of another.
ConvexPolygon Above(const std::vector<Vec3>& outline, const PatchTree::Node& plane)
{
  ConvexPolygon whole, above;
  double heights[ConvexPolygon::Capacity];
  double least = 0.0;
  const double rounding = 1e-13 * plane.Radius;
  for (const Vec3& c : outline)
  {
    const double h = Dot(plane.Axis, c - plane.Center);
    heights[whole.N] = std::abs(h) <= rounding ? 0.0 : h;
    least = std::min(least, heights[whole.N]);
    whole.Add(c);
  }
  if (least >= 0.0)
  {
    return whole;
  }
  return Clip(whole, heights, above) ? above : whole;
}

/// The error of a pair that 99 % stay below: the bounds of rules are for the worst of shapes.
/// Against 1e-12 on pairs of rooms, streets and spheres, at tolerances from 1e-6 to 1e-2, 99 % of
/// errors were below 0.003 of the bound of rules and 0.03 of the estimate of the contour integral,
/// and all below 0.04 and 0.44. What rounding may make is as great as it says.
double Truncated(const PairExchangeResult& pair)
{
  const bool rule = pair.Method == ExchangeMethod::Rule || pair.Method == ExchangeMethod::Closed;
  return std::min(pair.Error, (rule ? 0.02 : 0.1) * (pair.Error - pair.Rounding) + pair.Rounding);
}

} // namespace

/// Follows one item down to pairs of triangles and strata.
class ViewFactorPairs::Worker
{
public:
  explicit Worker(const ViewFactorPairs& pairs)
    : P(pairs)
    , Tree(pairs.Tree)
  {
  }

  void Run(const Item& item)
  {
    if (item.A == item.B)
    {
      this->Begin(item.A, item.B);
      this->Own(item.A);
      this->Finish(this->IsWhole(item.A, item.B));
      return;
    }
    const PatchTree::Node& b = Tree[item.B];
    if (b.OneGroup() && b.FirstGroup == Tree[item.A].FirstGroup)
    {
      this->Begin(item.A, item.B);
      this->Descend(item.A, item.B, !P.Between);
      this->Finish(false);
      return;
    }
    this->Cross(item.A, item.B, !P.Between);
  }

  std::vector<Part> Parts;
  std::vector<ExchangeStratum> Strata;
  std::int64_t Pairs = 0, Rays = 0;

private:
  bool IsWhole(std::int32_t a, std::int32_t b) const
  {
    return Tree.Root(Tree[a].FirstGroup) == a && Tree.Root(Tree[b].FirstGroup) == b;
  }

  /// b may hold several groups, of which those before a's own are not wanted.
  void Cross(std::int32_t a, std::int32_t b, bool open)
  {
    const PatchTree::Node& na = Tree[a];
    const PatchTree::Node& nb = Tree[b];
    if (nb.LastGroup < na.FirstGroup || (nb.OneGroup() && nb.FirstGroup == na.FirstGroup) ||
      !Tree.MayFace(na, nb))
    {
      return;
    }
    if (nb.OneGroup())
    {
      this->Begin(a, b);
      this->Descend(a, b, open);
      this->Finish(this->IsWhole(a, b));
      return;
    }
    if (!open && na.Flat && nb.Flat)
    {
      const Proof proof = P.Prove(a, b);
      if (proof == Proof::Hidden)
      {
        return;
      }
      open = proof == Proof::Visible;
    }
    this->Cross(a, nb.Left, open);
    this->Cross(a, nb.Right, open);
  }

  void Begin(std::int32_t a, std::int32_t b)
  {
    this->Current =
      Part{ Tree[a].FirstGroup, Tree[b].FirstGroup, 0.0, 0.0, 0.0, this->Strata.size(), 0, 0 };
  }

  /// Keeps what the item gave to its row; a row that lies all within the item is refined at once.
  void Finish(bool whole)
  {
    Part& part = this->Current;
    const double scale = part.I == part.J ? 2.0 : 1.0;
    part.Value *= scale;
    part.Truncation *= scale;
    const std::size_t count = this->Strata.size() - part.First;
    ExchangeStratum* strata = this->Strata.data() + part.First;
    if (whole && count > 0 && count <= LocalStrata)
    {
      GroupExchange row{ part.I, part.J, part.Value, part.Truncation, 0.0 };
      const double known = row.Value;
      P.Begin(row, scale, strata, count);
      do
      {
        for (std::size_t k = 0; k < count; ++k)
        {
          P.Sample(strata[k]);
        }
      } while (!P.Plan(row, known, strata, count, P.TimeIsUp()));
      for (std::size_t k = 0; k < count; ++k)
      {
        this->Rays += strata[k].Rays;
      }
      part.Value = row.Value;
      part.Sampling = row.Sampling;
      this->Strata.resize(part.First);
    }
    part.Strata = this->Strata.size() - part.First;
    if (part.Value > 0.0 || part.Strata > 0)
    {
      this->Parts.push_back(part);
    }
  }

  /// The exchange of a node's elements with each other, each pair once.
  void Own(std::int32_t a)
  {
    const PatchTree::Node& node = Tree[a];
    if (node.Single() || node.Flat)
    {
      return;
    }
    if (P.Hierarchical && P.Small(node, node))
    {
      this->Add(a, a, -1.0, !P.Between);
      this->Strata.back().Near = true;
      this->Strata.back().Share = 0.5;
      return;
    }
    this->Own(node.Left);
    this->Own(node.Right);
    this->Descend(node.Left, node.Right, !P.Between);
  }

  void Descend(std::int32_t a, std::int32_t b, bool open)
  {
    const PatchTree::Node& na = Tree[a];
    const PatchTree::Node& nb = Tree[b];
    if (!Tree.MayFace(na, nb))
    {
      return;
    }
    if (na.Single() && nb.Single())
    {
      this->Leaf(a, b, open);
      return;
    }
    const bool apart = P.Hierarchical && P.Apart(na, nb);
    const bool small = P.Hierarchical && P.Small(na, nb);
    if (!small && !open && na.Flat && nb.Flat)
    {
      const Proof proof = P.Prove(a, b);
      if (proof == Proof::Hidden)
      {
        return;
      }
      open = proof == Proof::Visible;
    }
    if (small || (apart && static_cast<std::int64_t>(na.Size()) * nb.Size() > FewPairs))
    {
      this->Add(a, b, -1.0, open);
      this->Strata.back().Near = !apart;
      return;
    }
    if (nb.Single() || (!na.Single() && na.Radius > nb.Radius))
    {
      this->Descend(na.Left, b, open);
      this->Descend(na.Right, b, open);
    }
    else
    {
      this->Descend(a, nb.Left, open);
      this->Descend(a, nb.Right, open);
    }
  }

  void Leaf(std::int32_t a, std::int32_t b, bool open)
  {
    const PairExchangeResult pair =
      PairExchange(Tree.Shape(Tree[a].Begin), Tree.Shape(Tree[b].Begin), P.PairTolerance);
    if (!(pair.Value > 0.0))
    {
      return;
    }
    ++this->Pairs;
    if (!open)
    {
      const Proof proof = P.Prove(a, b);
      if (proof == Proof::Hidden)
      {
        return;
      }
      open = proof == Proof::Visible;
    }
    this->Current.Truncation += Truncated(pair);
    if (open)
    {
      this->Current.Value += pair.Value;
      return;
    }
    this->Add(a, b, pair.Value, false);
  }

  void Add(std::int32_t a, std::int32_t b, double exact, bool open)
  {
    ExchangeStratum stratum;
    stratum.A = a;
    stratum.B = b;
    stratum.Exact = exact;
    stratum.Open = open;
    stratum.Wanted = exact < 0.0 ? 4 : 1;
    this->Strata.push_back(stratum);
  }

  const ViewFactorPairs& P;
  const PatchTree& Tree;
  Part Current{};
};

ViewFactorPairs::ViewFactorPairs(const PatchTree& tree, const OcclusionScene& occluders,
  const Blockers* blockers, const ViewFactorOptions& options, bool hierarchical,
  double pairTolerance)
  : Tree(tree)
  , Occluders(occluders)
  , Between(blockers)
  , Options(options)
  , Hierarchical(hierarchical)
  , PairTolerance(pairTolerance)
{
}

bool ViewFactorPairs::Apart(const PatchTree::Node& a, const PatchTree::Node& b) const
{
  const double reach = a.Radius + b.Radius;
  return LengthSquared(b.Center - a.Center) > 6.25 * reach * reach;
}

/// Small beside their groups: not worth dividing before samples say so.
bool ViewFactorPairs::Small(const PatchTree::Node& a, const PatchTree::Node& b) const
{
  const double whole = std::min(
    this->Tree[this->Tree.Root(a.FirstGroup)].Area, this->Tree[this->Tree.Root(b.FirstGroup)].Area);
  return std::min(a.Area, b.Area) <= SmallShare * whole;
}

ViewFactorPairs::Proof ViewFactorPairs::Prove(std::int32_t a, std::int32_t b) const
{
  const PatchTree::Node& na = this->Tree[a];
  const PatchTree::Node& nb = this->Tree[b];
  const ConvexPolygon partA = Above(this->Tree.Outline(na), nb);
  const ConvexPolygon partB = Above(this->Tree.Outline(nb), na);
  if (partA.N < 3 || partB.N < 3)
  {
    return Proof::Unknown;
  }
  const Shaft shaft(partA, partB, this->Between->Rounding());
  static thread_local std::vector<std::int32_t> inside;
  inside.clear();
  if (this->Between->InShaft(shaft, 0, inside))
  {
    return Proof::Visible;
  }
  // A few rays tell whether to look for a proof that all is hidden.
  ExchangeStratum probe;
  probe.A = a;
  probe.B = b;
  probe.Exact = 0.0;
  probe.Wanted = 2;
  this->Sample(probe);
  inside.clear();
  if (!probe.AnyHidden || probe.AnyVisible || !this->Between->InShaft(shaft, MostInside, inside))
  {
    return Proof::Unknown;
  }
  return this->Between->HideAll(partA, partB, shaft, inside) ? Proof::Hidden : Proof::Unknown;
}

void ViewFactorPairs::MakeItems(
  std::int32_t a, std::int32_t b, bool own, std::vector<Item>& items) const
{
  const PatchTree::Node& na = this->Tree[a];
  const PatchTree::Node& nb = this->Tree[b];
  if ((!own &&
        (nb.LastGroup < na.FirstGroup || (nb.OneGroup() && nb.FirstGroup == na.FirstGroup))) ||
    !this->Tree.MayFace(na, nb))
  {
    return;
  }
  const bool small = this->Hierarchical
    ? na.Size() + nb.Size() <= ItemElements || (nb.OneGroup() && this->Apart(na, nb))
    : static_cast<std::int64_t>(na.Size()) * nb.Size() <= ItemPairs;
  if (small || (na.Single() && nb.Single()))
  {
    items.push_back({ a, b });
  }
  else if (!nb.OneGroup() || na.Single() || (!nb.Single() && nb.Size() >= na.Size()))
  {
    this->MakeItems(a, nb.Left, own, items);
    this->MakeItems(a, nb.Right, own, items);
  }
  else
  {
    this->MakeItems(na.Left, b, own, items);
    this->MakeItems(na.Right, b, own, items);
  }
}

void ViewFactorPairs::MakeOwnItems(std::int32_t a, std::vector<Item>& items) const
{
  const PatchTree::Node& node = this->Tree[a];
  if (node.Single() || node.Flat)
  {
    return;
  }
  if (node.Size() <= 64)
  {
    items.push_back({ a, a });
    return;
  }
  this->MakeOwnItems(node.Left, items);
  this->MakeOwnItems(node.Right, items);
  this->MakeItems(node.Left, node.Right, true, items);
}

/// This rank's share of the items: every so-manieth, as their costs change slowly along the list. A
/// first share of those, as evenly spread, tells the time of all.
bool ViewFactorPairs::RunItems(const std::vector<Item>& items, const StageProgress& stage,
  std::vector<Part>& parts, std::vector<ExchangeStratum>& strata, const Forecast& forecast)
{
  constexpr std::size_t stride = 16;
  const auto step = static_cast<std::size_t>(this->Options.Ranks ? this->Options.Ranks->Size() : 1);
  const auto rank = static_cast<std::size_t>(this->Options.Ranks ? this->Options.Ranks->Rank() : 0);
  const std::size_t own = (items.size() + step - 1 - rank) / step;
  std::vector<std::vector<Part>> partsOf(own);
  std::vector<std::vector<ExchangeStratum>> strataOf(own);
  const auto run = [&](std::size_t k) {
      Worker worker(*this);
      worker.Run(items[k * step + rank]);
      this->PairCount += worker.Pairs;
      this->RayCount += worker.Rays;
      this->Bytes +=
        static_cast<std::int64_t>(worker.Parts.size() * 2 * (sizeof(Part) + sizeof(Row)) +
          worker.Strata.size() * 2 * sizeof(ExchangeStratum));
      if (this->Options.MemoryLimit &&
        this->Bytes > static_cast<std::int64_t>(this->Options.MemoryLimit))
      {
        constexpr double mebibyte = 1024.0 * 1024.0;
        const double done = static_cast<double>(k + 1) / static_cast<double>(own);
        const double least = static_cast<double>(this->Bytes) / done / mebibyte;
        throw InputError("MemoryLimit", -1,
          static_cast<double>(this->Options.MemoryLimit) / mebibyte,
          "some " + std::to_string(static_cast<long long>(least + 1.0)) +
            " MiB for the pairs of patches that see each other; or fewer patches");
      }
      partsOf[k] = std::move(worker.Parts);
      strataOf[k] = std::move(worker.Strata);
    };
  const std::size_t pilot = (own + stride - 1) / stride;
  StageProgress first = stage, second = stage;
  first.End = second.Begin = stage.Begin + (stage.End - stage.Begin) / stride;
  const double begin = this->Clock->Elapsed();
  ParallelFor(
    pilot, this->Options.Threads, first, [&](std::size_t k) { run(k * stride); }, 1e-3);
  const double seconds = this->Clock->Elapsed() - begin;
  if (forecast &&
    !forecast(own == 0 ? 0.0 : seconds * static_cast<double>(own - pilot) / static_cast<double>(pilot)))
  {
    return false;
  }
  ParallelFor(
    own - pilot, this->Options.Threads, second,
    [&](std::size_t k) { run(k + k / (stride - 1) + 1); }, 1e-3);
  for (std::size_t k = 0; k < own; ++k)
  {
    for (Part& part : partsOf[k])
    {
      part.First += strata.size();
      part.Item = k * step + rank;
      parts.push_back(part);
    }
    strata.insert(strata.end(), strataOf[k].begin(), strataOf[k].end());
    partsOf[k] = {};
    strataOf[k] = {};
  }
  return true;
}

/// One row for each two groups, of all ranks' parts in the order of the items.
void ViewFactorPairs::MakeRows(std::vector<Part>& parts, std::vector<ExchangeStratum>& found,
  std::vector<Row>& rows, std::vector<ExchangeStratum>& strata) const
{
  std::vector<std::size_t> partsOf, strataOf;
  GatherRecords(this->Options.Ranks, parts, &partsOf);
  GatherRecords(this->Options.Ranks, found, &strataOf);
  for (std::size_t r = 0; r + 1 < partsOf.size(); ++r)
  {
    for (std::size_t k = partsOf[r]; k < partsOf[r + 1]; ++k)
    {
      parts[k].First += strataOf[r];
    }
  }
  std::sort(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return std::tie(x.I, x.J, x.Item, x.First) < std::tie(y.I, y.J, y.Item, y.First);
  });
  strata.reserve(found.size());
  for (const Part& part : parts)
  {
    if (rows.empty() || rows.back().Exchange.I != part.I || rows.back().Exchange.J != part.J)
    {
      rows.push_back({ { part.I, part.J, 0.0, 0.0, 0.0 }, strata.size(), 0, true });
    }
    Row& row = rows.back();
    row.Exchange.Value += part.Value;
    row.Exchange.Truncation += part.Truncation;
    row.Exchange.Sampling += part.Sampling; // of a row of one part
    row.Strata += part.Strata;
    row.Met = row.Strata == 0;
    const auto first = found.begin() + static_cast<std::ptrdiff_t>(part.First);
    strata.insert(strata.end(), first, first + static_cast<std::ptrdiff_t>(part.Strata));
  }
}

std::vector<GroupExchange> ViewFactorPairs::Compute(
  const StageProgress& stage, ConvergenceRecord& record, const Forecast& forecast)
{
  this->Clock = &record;
  // Without samples the pairs are all; else the first round of samples tells more.
  const bool sampled = this->Between || this->Hierarchical;
  std::vector<Item> items;
  for (std::size_t g = 0; g < this->Tree.Groups(); ++g)
  {
    const std::int32_t root = this->Tree.Root(static_cast<std::int32_t>(g));
    this->MakeOwnItems(root, items);
    this->MakeItems(root, 0, false, items);
  }
  StageProgress first = stage, second = stage;
  first.End = second.Begin = stage.Begin + 0.7 * (stage.End - stage.Begin);
  std::vector<Row> rows;
  std::vector<ExchangeStratum> strata;
  {
    std::vector<Part> parts;
    std::vector<ExchangeStratum> found;
    if (!this->RunItems(items, first, parts, found, sampled ? Forecast() : forecast))
    {
      return {};
    }
    this->MakeRows(parts, found, rows, strata);
  }
  if (!this->Refine(rows, strata, second, record, sampled ? forecast : Forecast()))
  {
    return {};
  }
  if (this->Options.Ranks)
  {
    std::int64_t counts[] = { this->PairCount, this->RayCount, this->Late ? 1 : 0 };
    this->Options.Ranks->Sum(counts, 3);
    this->PairCount = counts[0];
    this->RayCount = counts[1];
    this->Late = counts[2] > 0;
  }

  std::vector<GroupExchange> out;
  out.reserve(rows.size());
  for (const Row& row : rows)
  {
    // Facets that rounding alone turns toward each other (of one quad, say) do not see each other.
    const double least = std::min(this->Tree[this->Tree.Root(row.Exchange.I)].Area,
      this->Tree[this->Tree.Root(row.Exchange.J)].Area);
    const double rounding =
      row.Exchange.Truncation > 0.0 ? row.Exchange.Truncation : 1e-14 * least;
    if (row.Exchange.Value > rounding)
    {
      out.push_back(row.Exchange);
    }
  }
  return out;
}

} // namespace radiometry
