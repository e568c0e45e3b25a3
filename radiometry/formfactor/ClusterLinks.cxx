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

/// What k rays that all agree may have missed, mean square, for visible shares uniform in (0, 1).
double Unnoticed(double k)
{
  return 4.0 / ((k + 1.0) * (k + 2.0) * (k + 3.0));
}

} // namespace

ClusterRefiner::ClusterRefiner(const ElementTree& tree, const ElementSet& elements,
  const OcclusionScene& occluders, const ExchangeOptions& options, bool occlusion, double loosened)
  : Tree(tree)
  , Elements(elements)
  , Occluders(occluders)
  , Tolerance(std::clamp(options.RelativeTolerance, 1e-7, 0.5) * loosened)
  , FormAllowance(0.02 * Tolerance)
  , SightAllowance(0.1 * Tolerance)
  , Seed(options.Seed)
  , Occlusion(occlusion)
{
  this->Shapes.reserve(elements.Size());
  for (const std::int32_t item : tree.Order())
  {
    this->Shapes.emplace_back(elements.GetPatches()[static_cast<std::size_t>(item)].Corners);
  }
}

bool ClusterRefiner::Refine(
  NodePair pair, std::size_t most, std::vector<ClusterLink>& links, Tally& tally) const
{
  std::vector<NodePair> open{ pair };
  while (!open.empty())
  {
    const NodePair next = open.back();
    open.pop_back();
    this->Step(next, links, open, tally);
    if (links.size() > most)
    {
      return false;
    }
  }
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
      this->Step(pair, links, next, tally);
    }
    tasks.swap(next);
  }
  return tasks;
}

void ClusterRefiner::Divide(NodePair pair, std::vector<NodePair>& more) const
{
  const ElementTree::Node& a = this->Tree[pair.first];
  const ElementTree::Node& b = this->Tree[pair.second];
  const bool first = b.Leaf() || (!a.Leaf() && a.Radius >= b.Radius);
  const std::int32_t whole = first ? pair.first : pair.second;
  const std::int32_t other = first ? pair.second : pair.first;
  for (const std::int32_t child : { whole + 1, this->Tree[whole].Second })
  {
    more.emplace_back(std::min(child, other), std::max(child, other));
  }
}

void ClusterRefiner::Step(NodePair pair, std::vector<ClusterLink>& links,
  std::vector<NodePair>& more, Tally& tally) const
{
  const auto [ia, ib] = pair;
  const ElementTree::Node& a = this->Tree[ia];
  const ElementTree::Node& b = this->Tree[ib];
  if (ia == ib)
  {
    if (!a.Leaf())
    {
      more.emplace_back(ia + 1, ia + 1);
      more.emplace_back(a.Second, a.Second);
      more.emplace_back(ia + 1, a.Second);
    }
    return;
  }
  if (!this->Tree.MayFace(ia, ib))
  {
    return;
  }
  if (a.Leaf() && b.Leaf())
  {
    this->LinkElements(pair, links, tally);
    return;
  }
  const double distance = Length(b.Center - a.Center);
  const bool tooBig = std::max(a.Leaf() ? a.Radius : 0.0, b.Leaf() ? b.Radius : 0.0) > 0.4 * distance;
  if (tooBig || a.Radius + b.Radius > FarEnough * distance)
  {
    this->Divide(pair, more);
    return;
  }
  ++tally.Pairs;
  const ClusterEstimate estimate = EstimateExchange(this->Tree, this->Elements, ia, ib);
  const double inA = estimate.Exchange / a.Area;
  const double inB = estimate.Exchange / b.Area;
  if (!(estimate.Exchange > 0.0))
  {
    // Seen at grazing angles at most: what an element of either may get of the other.
    const double away = distance - a.Radius - b.Radius;
    const double most = std::max(a.Area, b.Area) / (Pi * away * away);
    if (most * FarEnough > this->FormAllowance)
    {
      this->Divide(pair, more);
    }
    return;
  }
  if (std::max(inA * estimate.SpreadA, inB * estimate.SpreadB) > this->FormAllowance)
  {
    this->Divide(pair, more);
    return;
  }
  Sight sight;
  if (this->Occlusion)
  {
    const double factor = std::max(inA, inB);
    sight = this->Look(pair, factor, tally);
    if (factor * sight.Spread > this->SightAllowance)
    {
      this->Divide(pair, more);
      return;
    }
    if (sight.Fraction == 0.0)
    {
      return;
    }
  }
  ClusterLink link;
  link.A = ia;
  link.B = ib;
  link.Kernel = static_cast<float>(
    sight.Fraction * estimate.Exchange / a.Area * (this->Tree[0].Area / b.Area));
  link.Slope = static_cast<float>(estimate.Slope);
  link.FormA = static_cast<float>(inA * sight.Fraction * estimate.SpreadA);
  link.FormB = static_cast<float>(inB * sight.Fraction * estimate.SpreadB);
  link.SightA = static_cast<float>(inA * std::hypot(sight.Spread, sight.Error));
  link.SightB = static_cast<float>(inB * std::hypot(sight.Spread, sight.Error));
  links.push_back(link);
}

ClusterRefiner::Sight ClusterRefiner::Look(NodePair pair, double factor, Tally& tally) const
{
  const ElementTree::Node& a = this->Tree[pair.first];
  const ElementTree::Node& b = this->Tree[pair.second];
  const double wanted = 0.5 * this->Tolerance / std::sqrt(factor);
  const int rays = static_cast<int>(std::clamp(std::ceil(0.125 / (wanted * wanted)), 4.0, 64.0));
  const SobolSequence sequence(Hash64(this->Seed,
    (static_cast<std::uint64_t>(pair.first) << 32) | static_cast<std::uint64_t>(pair.second)));
  double all = 0.0, seen = 0.0;
  int cast = 0, visible = 0;
  const auto pick = [&](const ElementTree::Node& node, double u, double v, std::int32_t& place) {
    const double at = u * node.Count;
    const auto k = std::min(static_cast<std::int32_t>(at), node.Count - 1);
    place = node.First + k;
    return TrianglePoint(this->Shapes[static_cast<std::size_t>(place)].Corners, at - k, v);
  };
  for (int k = 0; k < 4 * rays && cast < rays; ++k)
  {
    const auto u = sequence(static_cast<std::uint32_t>(k));
    std::int32_t i = 0, j = 0;
    const Vec3 x = pick(a, u[0], u[1], i);
    const Vec3 y = pick(b, u[2], u[3], j);
    const ExchangePatch& p = this->Shapes[static_cast<std::size_t>(i)];
    const ExchangePatch& q = this->Shapes[static_cast<std::size_t>(j)];
    const Vec3 r = y - x;
    const double r2 = LengthSquared(r);
    const double kernel = std::max(0.0, Dot(p.Normal, r)) * std::max(0.0, -Dot(q.Normal, r)) /
      (r2 * r2) * p.Area * q.Area;
    if (!(kernel > 0.0))
    {
      continue;
    }
    ++cast;
    all += kernel;
    const auto triangle = [&](std::int32_t place) {
      const auto item = this->Tree.Order()[static_cast<std::size_t>(place)];
      return this->Elements.GetPatches()[static_cast<std::size_t>(item)].Triangle;
    };
    if (!this->Occluders.Occluded({ x, triangle(i) }, { y, triangle(j) }))
    {
      seen += kernel;
      ++visible;
    }
  }
  tally.Rays += cast;
  Sight sight;
  if (cast == 0)
  {
    sight = { 0.5, 0.5, 0.0 };
    return sight;
  }
  sight.Fraction = visible == cast ? 1.0 : seen / all;
  if (visible > 0 && visible < cast)
  {
    // With few rays the share itself is uncertain: as if one more of each kind had been met.
    const double share = (sight.Fraction * cast + 1.0) / (cast + 2.0);
    sight.Spread = std::sqrt(share * (1.0 - share));
    sight.Error = sight.Spread / std::sqrt(static_cast<double>(cast));
  }
  else
  {
    sight.Error = 0.0 * Unnoticed(cast);
  }
  return sight;
}

void ClusterRefiner::LinkElements(
  NodePair pair, std::vector<ClusterLink>& links, Tally& tally) const
{
  const ElementTree::Node& a = this->Tree[pair.first];
  const ElementTree::Node& b = this->Tree[pair.second];
  const auto patch = [&](const ElementTree::Node& leaf) -> const Patch& {
    const auto item = this->Tree.Order()[static_cast<std::size_t>(leaf.First)];
    return this->Elements.GetPatches()[static_cast<std::size_t>(item)];
  };
  const Patch& p = patch(a);
  const Patch& q = patch(b);
  if (p.Triangle == q.Triangle)
  {
    return; // one plane
  }
  const ExchangePatch& i = this->Shapes[static_cast<std::size_t>(a.First)];
  const ExchangePatch& j = this->Shapes[static_cast<std::size_t>(b.First)];
  ++tally.Pairs;
  const double d2 = LengthSquared(i.Center - j.Center);
  const double rough = std::min(1.0, std::max(i.Area, j.Area) / (Pi * d2));
  const PairExchangeResult exchange =
    PairExchange(i, j, std::clamp(0.1 * this->FormAllowance / rough, 1e-9, 1e-2));
  if (!(exchange.Value > 0.0))
  {
    return;
  }
  PairVisibilityResult seen;
  const double factor = exchange.Value / std::min(i.Area, j.Area);
  if (this->Occlusion)
  {
    const double wanted = 0.5 * this->Tolerance / std::sqrt(factor);
    const double rays = std::clamp(0.125 / (wanted * wanted), 4.0, 64.0);
    const int first = static_cast<int>(std::exp2(std::ceil(std::log2(rays))));
    const std::uint64_t key = Hash64(this->Seed,
      (static_cast<std::uint64_t>(pair.first) << 32) | static_cast<std::uint64_t>(pair.second));
    seen = PairVisibility(
      this->Occluders, i, p.Triangle, j, q.Triangle, key, first, 4096, wanted);
    tally.Rays += seen.Rays;
    if (seen.Fraction == 0.0)
    {
      return;
    }
  }
  ClusterLink link;
  link.A = pair.first;
  link.B = pair.second;
  link.Kernel = static_cast<float>(
    seen.Fraction * exchange.Value / i.Area * (this->Tree[0].Area / j.Area));
  link.Slope = 0.0f;
  link.FormA = static_cast<float>(exchange.Error / i.Area);
  link.FormB = static_cast<float>(exchange.Error / j.Area);
  link.SightA = static_cast<float>(seen.Error * exchange.Value / i.Area);
  link.SightB = static_cast<float>(seen.Error * exchange.Value / j.Area);
  links.push_back(link);
}

} // namespace radiometry
