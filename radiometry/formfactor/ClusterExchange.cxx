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

  Rule(const ElementTree& tree, const ElementSet& elements, std::int32_t at)
  {
    const ElementTree::Node& node = tree[at];
    if (node.Count <= 2)
    {
      this->AddElement(tree, elements, node.Leaf() ? at : at + 1, node.Area);
      if (!node.Leaf())
      {
        this->AddElement(tree, elements, node.Second, node.Area);
      }
      return;
    }
    // Parts of the same shape, half as large, hold 3/4 of the second moment between them.
    constexpr double outward = 1.1547005383792515;
    for (const std::int32_t child : { at + 1, node.Second })
    {
      const ElementTree::Node& c = tree[child];
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
      const Vec3 r = q.Place[j] - p.Place[i];
      const double r2 = LengthSquared(r);
      k[i][j] = std::max(0.0, Dot(p.Normal[i], r)) * std::max(0.0, -Dot(q.Normal[j], r)) / (r2 * r2);
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
  const double reach = model.Reach(na) + model.Reach(nb);
  out.Slope = reach > 0.95 ? 0.95 / reach : 1.0;

  // Rows see the mean over the other's points of what the model misses, and some of its spread.
  double missA[Rule::Most] = {}, missB[Rule::Most] = {}, all = 0.0;
  for (int i = 0; i < p.N; ++i)
  {
    const double atA = out.Slope * Dot(model.Slope, p.Place[i] - na.Center);
    for (int j = 0; j < q.N; ++j)
    {
      const double atB = out.Slope * Dot(model.Slope, q.Place[j] - nb.Center);
      const double miss = k[i][j] / mean - (1.0 + atA - atB);
      missA[i] += q.Weight[j] * miss;
      missB[j] += p.Weight[i] * miss;
      all += p.Weight[i] * q.Weight[j] * miss * miss;
    }
  }
  constexpr double share = 0.1; // of the mean square that a source's own unevenness brings out
  double meanA = 0.0, meanB = 0.0;
  for (int i = 0; i < p.N; ++i)
  {
    meanA += p.Weight[i] * missA[i] * missA[i];
  }
  for (int j = 0; j < q.N; ++j)
  {
    meanB += q.Weight[j] * missB[j] * missB[j];
  }
  out.SpreadA = std::sqrt(meanA + share * all);
  out.SpreadB = std::sqrt(meanB + share * all);
  return out;
}

} // namespace radiometry
