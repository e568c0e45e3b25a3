// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClusterLinks.h"

#include "radiometry/formfactor/ClusterExchange.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/visibility/PairVisibility.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double FarEnough = 0.7; // sum of radii over distance at which a rule is asked
// Shares of the tolerance that one link may miss of a row. Some hundred links make a row; their
// errors add by squares.
constexpr double FormShare = 0.02;
constexpr double SightShare = 0.08;     // of what differs by the far elements
constexpr double OwnSightShare = 0.02;  // of what differs by the near ones: alike in many links
constexpr std::int32_t MostProven = 64; // elements of a cluster for which proofs are tried
constexpr std::size_t MostBetween = 12; // triangles between
constexpr double Negligible = 0.05; // share of the allowance below which what is hidden is left out
constexpr double Unmixed = 0.3;     // of the doubt, where rays of larger clusters agreed, too
constexpr double Bent = 1.7;        // the rule sees four mean normals of a curved cluster, not all
// What of the unevenness of the kernel over the far elements shows in a row, root mean square.
constexpr double FarShare = 0.5;

std::uint64_t KeyOf(NodePair pair)
{
  return (static_cast<std::uint64_t>(pair.first) << 32) | static_cast<std::uint64_t>(pair.second);
}

/// What k rays that all agree may have missed, mean square, for visible shares uniform in (0, 1).
double Unnoticed(double k) { return 4.0 / ((k + 1.0) * (k + 2.0) * (k + 3.0)); }

} // namespace

ClusterRefiner::ClusterRefiner(const ElementTree& tree, const ElementSet& elements,
  const OcclusionScene& occluders, const PatchBlockers* blockers, const ExchangeOptions& options,
  double loosened, const std::vector<std::uint8_t>& covered)
  : Tree(tree)
  , Elements(elements)
  , Occluders(occluders)
  , Tolerance(std::clamp(options.RelativeTolerance, 1e-7, 0.5) * loosened)
  , FormAllowance(FormShare * Tolerance)
  , SightAllowance(SightShare * Tolerance)
  , OwnSightAllowance(OwnSightShare * Tolerance)
  , Seed(options.Seed)
  , Blockers(blockers)
{
  this->Shapes.reserve(elements.Size());
  this->Triangles.reserve(elements.Size());
  for (const std::int32_t item : tree.Order())
  {
    const Patch& patch = elements.GetPatches()[static_cast<std::size_t>(item)];
    this->Shapes.emplace_back(patch.Corners);
    this->Triangles.push_back(patch.Triangle);
  }
  if (blockers)
  {
    this->Placed.reserve(elements.Size());
    for (const std::int32_t item : tree.Order())
    {
      this->Placed.push_back(
        blockers->Place(elements.GetPatches()[static_cast<std::size_t>(item)]));
    }
    this->Boxes.resize(tree.Size());
    for (std::size_t k = tree.Size(); k-- > 0;)
    {
      const ElementTree::Node& node = tree[static_cast<std::int32_t>(k)];
      if (!node.Leaf())
      {
        this->Boxes[k] = this->Boxes[k + 1];
        this->Boxes[k].Add(this->Boxes[static_cast<std::size_t>(node.Second)]);
        continue;
      }
      for (const Vec3& corner : this->Placed[static_cast<std::size_t>(node.First)].Corners)
      {
        this->Boxes[k].Add(corner);
      }
    }
  }
  this->Covered.assign(tree.Size(), 0);
  for (std::size_t k = tree.Size(); k-- > 0 && !covered.empty();)
  {
    const ElementTree::Node& node = tree[static_cast<std::int32_t>(k)];
    const auto item = static_cast<std::size_t>(tree.Order()[static_cast<std::size_t>(node.First)]);
    this->Covered[k] = node.Leaf()
      ? covered[item] == 1
      : this->Covered[k + 1] && this->Covered[static_cast<std::size_t>(node.Second)];
  }
  const std::vector<float>* rows = options.RowTolerance;
  this->RowFactor.assign(rows ? tree.Size() : 0, 1.0f);
  for (std::size_t k = this->RowFactor.size(); k-- > 0;)
  {
    const ElementTree::Node& node = tree[static_cast<std::int32_t>(k)];
    const auto item = static_cast<std::size_t>(tree.Order()[static_cast<std::size_t>(node.First)]);
    this->RowFactor[k] = node.Leaf()
      ? (*rows)[item]
      : std::min(this->RowFactor[k + 1], this->RowFactor[static_cast<std::size_t>(node.Second)]);
  }
}

bool ClusterRefiner::Refine(
  NodePair pair, std::size_t most, std::vector<ClusterLink>& links, Tally& tally) const
{
  Work work;
  work.Stack.push_back({ pair, 0, false, nullptr });
  while (!work.Stack.empty())
  {
    this->Step(work, links);
    if (links.size() > most)
    {
      return false;
    }
  }
  tally.Pairs += work.Count.Pairs;
  tally.Rays += work.Count.Rays;
  return true;
}

std::vector<NodePair> ClusterRefiner::Tasks(
  std::size_t wanted, std::vector<ClusterLink>& links, Tally& tally) const
{
  std::vector<NodePair> tasks{ { 0, 0 } }, next;
  for (int round = 0; round < 64 && tasks.size() < wanted && !tasks.empty(); ++round)
  {
    next.clear();
    for (const NodePair& pair : tasks)
    {
      Work work;
      work.Stack.push_back({ pair, 0, false, nullptr });
      this->Step(work, links);
      for (const Open& open : work.Stack)
      {
        next.push_back(open.Pair);
      }
      tally.Pairs += work.Count.Pairs;
      tally.Rays += work.Count.Rays;
    }
    tasks.swap(next);
  }
  return tasks;
}

void ClusterRefiner::Divide(const Open& open, Work& work) const
{
  const ElementTree::Node& a = this->Tree[open.Pair.first];
  const ElementTree::Node& b = this->Tree[open.Pair.second];
  this->Divide(open, b.Leaf() || (!a.Leaf() && a.Radius >= b.Radius), work);
}

void ClusterRefiner::Divide(const Open& open, bool first, Work& work) const
{
  const std::int32_t whole = first ? open.Pair.first : open.Pair.second;
  const std::int32_t other = first ? open.Pair.second : open.Pair.first;
  const std::int32_t middle = this->Tree[this->Tree[whole].Second].First;
  for (const std::int32_t child : { whole + 1, this->Tree[whole].Second })
  {
    Open part{ { std::min(child, other), std::max(child, other) }, 0, open.Mixed, open.Between };
    const bool swapped = (child < other) != first;
    for (const Sample& sample : work.Own)
    {
      const std::int32_t at = first ? sample.I : sample.J;
      if ((at < middle) == (child == whole + 1))
      {
        work.Samples.push_back(sample);
        if (swapped)
        {
          Sample& turned = work.Samples.back();
          std::swap(turned.I, turned.J);
          std::swap(turned.Place[0], turned.Place[2]);
          std::swap(turned.Place[1], turned.Place[3]);
        }
        ++part.Samples;
      }
    }
    work.Stack.push_back(part);
  }
}

void ClusterRefiner::Step(Work& work, std::vector<ClusterLink>& links) const
{
  Open open = work.Stack.back();
  work.Stack.pop_back();
  work.Own.assign(work.Samples.end() - open.Samples, work.Samples.end());
  work.Samples.resize(work.Samples.size() - static_cast<std::size_t>(open.Samples));
  const auto [ia, ib] = open.Pair;
  open.Mixed = open.Mixed || this->Covered[static_cast<std::size_t>(ia)] ||
    this->Covered[static_cast<std::size_t>(ib)];
  const ElementTree::Node& a = this->Tree[ia];
  const ElementTree::Node& b = this->Tree[ib];
  if (ia == ib)
  {
    if (!a.Leaf())
    {
      for (const NodePair& part : { NodePair{ ia + 1, ia + 1 }, NodePair{ a.Second, a.Second },
             NodePair{ ia + 1, a.Second } })
      {
        work.Stack.push_back({ part, 0, false, nullptr });
      }
    }
    return;
  }
  if (!this->Tree.MayFace(ia, ib))
  {
    return;
  }
  if (a.Leaf() && b.Leaf())
  {
    this->LinkElements(open, work, links);
    return;
  }
  const double row = this->FinestRow(open.Pair);
  const double distance = Length(b.Center - a.Center);
  const double largestLeaf = std::max(a.Leaf() ? a.Radius : 0.0, b.Leaf() ? b.Radius : 0.0);
  if (largestLeaf > 0.4 * distance || a.Radius + b.Radius > FarEnough * distance)
  {
    this->Divide(open, work);
    return;
  }
  // What stands on an element in part hides the same from all it exchanges with.
  const bool partA = this->Covered[static_cast<std::size_t>(ia)] && !a.Leaf();
  const bool partB = this->Covered[static_cast<std::size_t>(ib)] && !b.Leaf();
  if (partA || partB)
  {
    const double most = std::max(partA ? b.Area : 0.0, partB ? a.Area : 0.0);
    if (most > row * this->OwnSightAllowance * distance * distance)
    {
      this->Divide(open, partA && (!partB || b.Area > a.Area), work);
      return;
    }
  }
  ++work.Count.Pairs;
  const ClusterEstimate estimate = EstimateExchange(this->Tree, this->Elements, ia, ib);
  const double inA = estimate.Exchange / a.Area;
  const double inB = estimate.Exchange / b.Area;
  if (!(estimate.Exchange > 0.0))
  {
    // Seen at grazing angles at most: what an element of either may get of the other.
    const double away = distance - a.Radius - b.Radius;
    const double most = std::max(a.Area, b.Area) / (Pi * away * away);
    if (most * FarEnough > row * this->FormAllowance)
    {
      this->Divide(open, work);
    }
    return;
  }
  const double far = FarShare * estimate.Both;
  if (std::max(inA * std::hypot(estimate.SpreadA, FarShare * estimate.SpreadB, far),
        inB * std::hypot(estimate.SpreadB, FarShare * estimate.SpreadA, far)) >
    row * this->FormAllowance)
  {
    this->Divide(open, work);
    return;
  }
  View sight;
  if (this->Blockers)
  {
    sight = this->Look(open, std::max(inA, inB), work);
    // Dividing a cluster helps its own elements, and the far ones by half as much.
    const double byA = std::max(
      inA * sight.SpreadA / this->OwnSightAllowance, inB * sight.SpreadA / this->SightAllowance);
    const double byB = std::max(
      inB * sight.SpreadB / this->OwnSightAllowance, inA * sight.SpreadB / this->SightAllowance);
    if (std::max(byA, byB) > row)
    {
      open.Mixed = true;
      this->Divide(open, !a.Leaf() && (byA >= byB || b.Leaf()), work);
      return;
    }
    if (sight.Fraction == 0.0 &&
      std::max(inA, inB) * sight.Error < Negligible * this->SightAllowance)
    {
      return;
    }
  }
  ClusterLink link;
  link.A = ia;
  link.B = ib;
  link.Kernel =
    static_cast<float>(sight.Fraction * estimate.Exchange / a.Area * (this->Tree[0].Area / b.Area));
  link.Slope = static_cast<float>(estimate.Slope);
  const double bent = a.Flat() && b.Flat() ? 1.0 : Bent;
  link.FormA = static_cast<float>(bent * sight.Fraction * std::hypot(estimate.SpreadA, far));
  link.FormB = static_cast<float>(bent * sight.Fraction * std::hypot(estimate.SpreadB, far));
  link.SightA = static_cast<float>(std::hypot(sight.SpreadA, sight.Error));
  link.SightB = static_cast<float>(std::hypot(sight.SpreadB, sight.Error));
  link.Factor = static_cast<float>(inA);
  links.push_back(link);
}

std::pair<Vec3, Vec3> ClusterRefiner::Ends(const Sample& sample) const
{
  const auto at = [&](std::int32_t item, const float* place) {
    return TrianglePoint(this->Shapes[static_cast<std::size_t>(item)].Corners,
      static_cast<double>(place[0]), static_cast<double>(place[1]));
  };
  return { at(sample.I, sample.Place), at(sample.J, sample.Place + 2) };
}

ClusterRefiner::Sample ClusterRefiner::Cast(NodePair pair, const std::array<double, 4>& u) const
{
  Sample sample;
  const auto pick = [&](std::int32_t at, double s, double t, std::int32_t& item, float* place) {
    const ElementTree::Node& node = this->Tree[at];
    const double where = s * node.Count;
    const auto k = std::min(static_cast<std::int32_t>(where), node.Count - 1);
    item = node.First + k;
    place[0] = static_cast<float>(where - k);
    place[1] = static_cast<float>(t);
  };
  pick(pair.first, u[0], u[1], sample.I, sample.Place);
  pick(pair.second, u[2], u[3], sample.J, sample.Place + 2);
  const auto i = static_cast<std::size_t>(sample.I), j = static_cast<std::size_t>(sample.J);
  const auto [x, y] = this->Ends(sample);
  const ExchangePatch& p = this->Shapes[i];
  const ExchangePatch& q = this->Shapes[j];
  const Vec3 r = y - x;
  const double r2 = LengthSquared(r);
  const double kernel =
    std::max(0.0, Dot(p.Normal, r)) * std::max(0.0, -Dot(q.Normal, r)) / (r2 * r2);
  sample.Weight = static_cast<float>(kernel * p.Area * (q.Area / this->Tree[0].Area));
  sample.Visible = sample.Weight > 0.0f &&
    !this->Occluders.Occluded({ x, this->Triangles[i] }, { y, this->Triangles[j] });
  return sample;
}

PatchGroup ClusterRefiner::GroupOf(std::int32_t node) const
{
  PatchGroup group;
  group.Patches = this->Placed.data() + this->Tree[node].First;
  group.Count = this->Tree[node].Count;
  group.Bounds = this->Boxes[static_cast<std::size_t>(node)];
  group.Center = group.Bounds.Center();
  group.Half = 0.5 * group.Bounds.Size();
  return group;
}

/// What can be said for certain. What may stand between is kept for the parts of the pair.
Sight ClusterRefiner::Prove(Open& open, Work& work) const
{
  const std::int32_t count =
    std::max(this->Tree[open.Pair.first].Count, this->Tree[open.Pair.second].Count);
  if (count > MostProven)
  {
    return Sight::Mixed;
  }
  const Sight sight = this->Blockers->Between(this->GroupOf(open.Pair.first),
    this->GroupOf(open.Pair.second), open.Between.get(), work.Found, MostBetween);
  if (sight == Sight::Mixed && work.Found.Complete)
  {
    open.Between = std::make_shared<const PatchBlockers::Candidates>(work.Found);
  }
  return sight;
}

ClusterRefiner::View ClusterRefiner::Look(Open& open, double factor, Work& work) const
{
  const Sight sight = this->Prove(open, work);
  if (sight != Sight::Mixed)
  {
    View view;
    view.Fraction = sight == Sight::Clear ? 1.0 : 0.0;
    return view;
  }
  return this->LookByRays(open, factor, work);
}

ClusterRefiner::View ClusterRefiner::LookByRays(const Open& open, double factor, Work& work) const
{
  const double wanted = 0.5 * this->FinestRow(open.Pair) * this->Tolerance / std::sqrt(factor);
  const int rays = static_cast<int>(
    std::clamp(std::ceil(0.125 / (wanted * wanted)), open.Mixed ? 12.0 : 4.0, 64.0));
  double all = 0.0, seen = 0.0;
  int cast = 0, visible = 0;
  const auto count = [&](const Sample& sample) {
    ++cast;
    all += static_cast<double>(sample.Weight);
    seen += sample.Visible ? static_cast<double>(sample.Weight) : 0.0;
    visible += sample.Visible;
  };
  for (const Sample& sample : work.Own)
  {
    count(sample);
  }
  const SobolSequence sequence(Hash64(this->Seed, KeyOf(open.Pair)));
  for (int k = 0; k < 4 * rays && cast < rays; ++k)
  {
    const Sample sample = this->Cast(open.Pair, sequence(static_cast<std::uint32_t>(k)));
    if (sample.Weight > 0.0f)
    {
      ++work.Count.Rays;
      work.Own.push_back(sample);
      count(sample);
    }
  }
  View sight;
  if (cast == 0)
  {
    sight.Fraction = 0.5;
    sight.SpreadA = sight.SpreadB = sight.Error = 0.35;
    return sight;
  }
  sight.Fraction = visible == cast ? 1.0 : seen / all;
  if (visible > 0 && visible < cast)
  {
    // With few rays the share itself is uncertain: as if one more of each kind had been met.
    const double share = (sight.Fraction * cast + 1.0) / (cast + 2.0);
    const double spread = std::sqrt(share * (1.0 - share));
    sight.Error = spread / std::sqrt(static_cast<double>(cast));
    // A blocker near one cluster hides alike from all of the other: what is seen differs by the
    // places in the first. Between: by how much the edge of a shadow is blurred on either.
    const ElementTree::Node& a = this->Tree[open.Pair.first];
    const ElementTree::Node& b = this->Tree[open.Pair.second];
    const double place = this->BlockerPlace(work);
    const double onA = a.Leaf() ? 0.0 : a.Radius * (1.0 - place);
    const double onB = b.Leaf() ? 0.0 : b.Radius * place;
    const double shareA = onA + onB > 0.0 ? onA / (onA + onB) : 0.5;
    sight.SpreadA = spread * std::sqrt(shareA);
    sight.SpreadB = spread * std::sqrt(1.0 - shareA);
  }
  else
  {
    // Of pairs for which there is no proof fewer are seen in part where no ray said so above.
    sight.Error = (open.Mixed ? 1.0 : Unmixed) * std::sqrt(Unnoticed(cast));
  }
  return sight;
}

/// Where between A (0) and B (1) the blockers stand, from some rays that were hidden.
double ClusterRefiner::BlockerPlace(const Work& work) const
{
  double sum = 0.0;
  int found = 0, asked = 0;
  for (const Sample& sample : work.Own)
  {
    if (sample.Visible || asked >= 3)
    {
      continue;
    }
    ++asked;
    const auto [start, end] = this->Ends(sample);
    const SurfaceHit hit = this->Occluders.Closest(
      { start, this->Triangles[static_cast<std::size_t>(sample.I)] }, end - start);
    if (hit.Triangle >= 0 && hit.Distance < 1.0)
    {
      sum += hit.Distance;
      ++found;
    }
  }
  return found > 0 ? std::clamp(sum / found, 0.02, 0.98) : 0.5;
}

void ClusterRefiner::LinkElements(Open& open, Work& work, std::vector<ClusterLink>& links) const
{
  const ElementTree::Node& a = this->Tree[open.Pair.first];
  const ElementTree::Node& b = this->Tree[open.Pair.second];
  const std::int32_t p = this->Triangles[static_cast<std::size_t>(a.First)];
  const std::int32_t q = this->Triangles[static_cast<std::size_t>(b.First)];
  if (p == q)
  {
    return; // one plane
  }
  const ExchangePatch& i = this->Shapes[static_cast<std::size_t>(a.First)];
  const ExchangePatch& j = this->Shapes[static_cast<std::size_t>(b.First)];
  ++work.Count.Pairs;
  const double row = this->FinestRow(open.Pair);
  const double d2 = LengthSquared(i.Center - j.Center);
  const double rough = std::min(1.0, std::max(i.Area, j.Area) / (Pi * d2));
  const PairExchangeResult exchange =
    PairExchange(i, j, std::clamp(0.5 * row * this->FormAllowance / rough, 1e-9, 3e-2));
  if (!(exchange.Value > 0.0))
  {
    return;
  }
  PairVisibilityResult seen;
  if (this->Blockers)
  {
    const double factor = exchange.Value / std::min(i.Area, j.Area);
    const double wanted = 0.5 * row * this->Tolerance / std::sqrt(factor);
    const double rays = std::clamp(0.125 / (wanted * wanted), open.Mixed ? 16.0 : 4.0, 64.0);
    const Sight sight = this->Prove(open, work);
    if (sight == Sight::Hidden)
    {
      return;
    }
    if (sight == Sight::Mixed)
    {
      PairSampling sampling;
      sampling.Key = Hash64(this->Seed, KeyOf(open.Pair));
      sampling.First = static_cast<int>(std::exp2(std::ceil(std::log2(rays))));
      sampling.Wanted = wanted;
      seen = PairVisibility(this->Occluders, *this->Blockers,
        this->Placed[static_cast<std::size_t>(a.First)],
        this->Placed[static_cast<std::size_t>(b.First)], work.Found, sampling);
    }
    work.Count.Rays += seen.Rays;
    if (seen.Fraction == 0.0 || seen.Fraction == 1.0)
    {
      seen.Error *= open.Mixed ? 0.8 : 0.5; // most of what held it was found alike
    }
    if (seen.Fraction == 0.0 && factor * seen.Error < Negligible * this->SightAllowance)
    {
      return;
    }
  }
  ClusterLink link;
  link.A = open.Pair.first;
  link.B = open.Pair.second;
  link.Kernel =
    static_cast<float>(seen.Fraction * exchange.Value / i.Area * (this->Tree[0].Area / j.Area));
  link.Slope = 0.0f;
  link.FormA = link.FormB = static_cast<float>(seen.Fraction * exchange.Error / exchange.Value);
  link.SightA = link.SightB = static_cast<float>(seen.Error);
  link.Factor = static_cast<float>(exchange.Value / i.Area);
  links.push_back(link);
}

} // namespace radiometry
