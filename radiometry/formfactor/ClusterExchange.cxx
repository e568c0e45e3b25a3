// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClusterExchange.h"

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// The points of a cluster's rule.
struct Rule
{
  static constexpr int Most = 6;
  Vec3 Place[Most];
  Vec3 Normal[Most];
  double Weight[Most]; // sums to 1
  int N = 0;
  // Places in between, at which what the rule itself cannot see of the second degree shows.
  Vec3 Between[3];
  Vec3 BetweenNormal[3];
  int Tests = 0;

  Rule(const ElementTree& tree, const ElementSet& elements, std::int32_t at)
  {
    const ElementTree::Node& node = tree[at];
    if (node.Count <= 2)
    {
      this->AddElement(tree, elements, node.Leaf() ? at : at + 1, node.Area);
      if (!node.Leaf())
      {
        this->AddElement(tree, elements, node.Second, node.Area);
        this->AddTest(tree[at + 1], node, 1.0);
        this->AddTest(tree[node.Second], node, 1.0);
      }
      return;
    }
    this->Between[0] = node.Center;
    this->BetweenNormal[0] = node.Normal;
    this->Tests = 1;
    // Parts of the same shape, half as large, hold 3/4 of the second moment between them.
    constexpr double outward = 1.1547005383792515;
    for (const std::int32_t child : { at + 1, node.Second })
    {
      const ElementTree::Node& c = tree[child];
      this->AddTest(c, node, c.Leaf() ? 1.0 : 1.6);
      if (c.Leaf())
      {
        this->Add(c, node, outward);
        continue;
      }
      this->Add(tree[child + 1], node, outward);
      this->Add(tree[c.Second], node, outward);
    }
  }

  void Add(const ElementTree::Node& part, const ElementTree::Node& whole, double outward)
  {
    this->Place[this->N] = whole.Center + outward * (part.Center - whole.Center);
    this->Normal[this->N] = part.Normal;
    this->Weight[this->N++] = part.Area / whole.Area;
  }
  void AddTest(const ElementTree::Node& part, const ElementTree::Node& whole, double outward)
  {
    this->Between[this->Tests] = whole.Center + outward * (part.Center - whole.Center);
    this->BetweenNormal[this->Tests++] = part.Normal;
  }
  /// The rule of the second degree.
  void AddElement(
    const ElementTree& tree, const ElementSet& elements, std::int32_t leaf, double whole)
  {
    const ElementTree::Node& node = tree[leaf];
    const auto item = static_cast<std::size_t>(tree.Order()[static_cast<std::size_t>(node.First)]);
    for (const Vec3& corner : elements.GetPatches()[item].Corners)
    {
      this->Place[this->N] = 0.5 * (corner + node.Center);
      this->Normal[this->N] = node.Normal;
      this->Weight[this->N++] = node.Area / (3.0 * whole);
    }
  }
};

double Kernel(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& m)
{
  const Vec3 r = y - x;
  const double r2 = LengthSquared(r);
  return std::max(0.0, Dot(n, r)) * std::max(0.0, -Dot(m, r)) / (r2 * r2);
}

/// Mean square of what the linear model misses of what arrives at the places in between.
double MissedBetween(const Rule& at, const ElementTree::Node& node, const Vec3& slope,
  const Vec3& turn, const Rule& from, double mean)
{
  double sum = 0.0;
  for (int t = 0; t < at.Tests; ++t)
  {
    double k = 0.0;
    for (int j = 0; j < from.N; ++j)
    {
      k +=
        from.Weight[j] * Kernel(at.Between[t], at.BetweenNormal[t], from.Place[j], from.Normal[j]);
    }
    const double miss = k / mean - 1.0 - Dot(slope, at.Between[t] - node.Center) -
      Dot(turn, at.BetweenNormal[t] - node.Normal);
    sum += miss * miss;
  }
  return at.Tests > 0 ? sum / at.Tests : 0.0;
}

} // namespace

ClusterEstimate EstimateExchange(
  const ElementTree& tree, const ElementSet& elements, std::int32_t a, std::int32_t b)
{
  const Rule p(tree, elements, a), q(tree, elements, b);
  double k[Rule::Most][Rule::Most];
  double mean = 0.0;
  for (int i = 0; i < p.N; ++i)
  {
    for (int j = 0; j < q.N; ++j)
    {
      k[i][j] = Kernel(p.Place[i], p.Normal[i], q.Place[j], q.Normal[j]);
      mean += p.Weight[i] * q.Weight[j] * k[i][j];
    }
  }
  ClusterEstimate out;
  if (!(mean > 0.0))
  {
    return out;
  }
  const ElementTree::Node& na = tree[a];
  const ElementTree::Node& nb = tree[b];
  out.Exchange = mean * na.Area * nb.Area / Pi;
  const ExchangeSlope model(na, nb);
  const double reach =
    model.Reach(na) + model.Reach(nb) + model.Bend(na, model.TurnA) + model.Bend(nb, model.TurnB);
  out.Slope = reach > 0.95 ? 0.95 / reach : 1.0;

  // Rows see the mean over the other's points of what the model misses, and some of its spread.
  double missA[Rule::Most] = {}, missB[Rule::Most] = {}, all = 0.0;
  for (int i = 0; i < p.N; ++i)
  {
    const double atA = out.Slope *
      (Dot(model.Slope, p.Place[i] - na.Center) +
        model.TurnA * Dot(p.Normal[i] - na.Normal, model.R));
    for (int j = 0; j < q.N; ++j)
    {
      const double atB = out.Slope *
        (Dot(model.Slope, q.Place[j] - nb.Center) +
          model.TurnB * Dot(q.Normal[j] - nb.Normal, model.R));
      const double miss = k[i][j] / mean - (1.0 + atA - atB);
      missA[i] += q.Weight[j] * miss;
      missB[j] += p.Weight[i] * miss;
      all += p.Weight[i] * q.Weight[j] * miss * miss;
    }
  }
  double meanA = 0.0, meanB = 0.0;
  for (int i = 0; i < p.N; ++i)
  {
    meanA += p.Weight[i] * missA[i] * missA[i];
  }
  for (int j = 0; j < q.N; ++j)
  {
    meanB += q.Weight[j] * missB[j] * missB[j];
  }
  const Vec3 slope = out.Slope * model.Slope;
  meanA = (na.Leaf() ? 0.0 : meanA) +
    MissedBetween(p, na, slope, (out.Slope * model.TurnA) * model.R, q, mean);
  meanB = (nb.Leaf() ? 0.0 : meanB) +
    MissedBetween(q, nb, -slope, (-out.Slope * model.TurnB) * model.R, p, mean);
  out.SpreadA = std::sqrt(meanA);
  out.SpreadB = std::sqrt(meanB);
  out.Both = std::sqrt(all);
  return out;
}

} // namespace radiometry
