// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Adds the three points with barycentric coordinates (a, b, b) in all orders.
void Add3(TriangleRule& rule, double weight, double b)
{
  const double a = 1.0 - 2.0 * b;
  rule.Nodes.push_back({ a, b, b, weight });
  rule.Nodes.push_back({ b, a, b, weight });
  rule.Nodes.push_back({ b, b, a, weight });
}

/// Adds the six points with barycentric coordinates (a, b, c) in all orders.
void Add6(TriangleRule& rule, double weight, double a, double b)
{
  const double c = 1.0 - a - b;
  for (const auto& p : { std::array<double, 3>{ a, b, c }, { a, c, b }, { b, a, c }, { b, c, a },
         { c, a, b }, { c, b, a } })
  {
    rule.Nodes.push_back({ p[0], p[1], p[2], weight });
  }
}

std::vector<TriangleRule> MakeTriangleRules()
{
  std::vector<TriangleRule> rules;
  constexpr double third = 1.0 / 3.0;

  rules.push_back({ 1, { { third, third, third, 1.0 } } });

  TriangleRule two{ 2, {} };
  Add3(two, third, 1.0 / 6.0);
  rules.push_back(two);

  TriangleRule four{ 4, {} };
  Add3(four, 0.223381589678011, 0.445948490915965);
  Add3(four, 0.109951743655322, 0.091576213509771);
  rules.push_back(four);

  TriangleRule five{ 5, { { third, third, third, 9.0 / 40.0 } } };
  const double root = std::sqrt(15.0);
  Add3(five, (155.0 - root) / 1200.0, (6.0 - root) / 21.0);
  Add3(five, (155.0 + root) / 1200.0, (6.0 + root) / 21.0);
  rules.push_back(five);

  TriangleRule six{ 6, {} };
  Add3(six, 0.116786275726379, 0.249286745170910);
  Add3(six, 0.050844906370207, 0.063089014491502);
  Add6(six, 0.082851075618374, 0.053145049844817, 0.310352451033784);
  rules.push_back(six);

  TriangleRule eight{ 8, { { third, third, third, 0.144315607677787 } } };
  Add3(eight, 0.095091634267285, 0.459292588292723);
  Add3(eight, 0.103217370534718, 0.170569307751760);
  Add3(eight, 0.032458497623198, 0.050547228317031);
  Add6(eight, 0.027230314174435, 0.008394777409958, 0.263112829634638);
  rules.push_back(eight);

  for (TriangleRule& rule : rules)
  {
    double sum = 0.0; // the printed weights end at 15 digits
    for (const auto& node : rule.Nodes)
    {
      sum += node.Weight;
    }
    for (auto& node : rule.Nodes)
    {
      node.Weight /= sum;
    }
  }
  return rules;
}

LineRule MakeGaussLegendre(int n)
{
  LineRule rule;
  for (int k = n; k >= 1; --k)
  {
    double x = std::cos(Pi * (k - 0.25) / (n + 0.5));
    double derivative = 1.0;
    for (int iteration = 0; iteration < 100; ++iteration)
    {
      double p0 = 1.0, p1 = x;
      for (int m = 2; m <= n; ++m)
      {
        const double p2 = ((2.0 * m - 1.0) * x * p1 - (m - 1.0) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      derivative = n * (x * p1 - p0) / (x * x - 1.0);
      const double step = p1 / derivative;
      x -= step;
      if (std::abs(step) < 1e-16)
      {
        break;
      }
    }
    rule.Nodes.push_back(0.5 * (1.0 + x));
    rule.Weights.push_back(1.0 / ((1.0 - x * x) * derivative * derivative));
  }
  return rule;
}

DoubleExponentialLevel MakeDoubleExponential(int level)
{
  DoubleExponentialLevel out;
  const double step = std::ldexp(1.0, -level);
  // Beyond t = 3.4 a node is nearer to its end than 1e-20 of the length and its weight is nothing.
  for (int k = static_cast<int>(3.4 / step); k >= 0; --k)
  {
    if (level > 0 && k % 2 == 0)
    {
      continue;
    }
    const double t = k * step;
    const double e = std::exp(-Pi * std::sinh(t));
    out.Distance.push_back(e / (1.0 + e));
    out.Weight.push_back(step * Pi * std::cosh(t) * e / ((1.0 + e) * (1.0 + e)));
    out.HasMiddle = k == 0;
  }
  return out;
}

} // namespace

const TriangleRule& TriangleRuleOfDegree(int degree)
{
  static const std::vector<TriangleRule> rules = MakeTriangleRules();
  for (const TriangleRule& rule : rules)
  {
    if (rule.Degree >= degree)
    {
      return rule;
    }
  }
  return rules.back();
}

const LineRule& GaussLegendre(int n)
{
  static const std::vector<LineRule> rules = [] {
    std::vector<LineRule> all(1);
    for (int k = 1; k <= 128; ++k)
    {
      all.push_back(MakeGaussLegendre(k));
    }
    return all;
  }();
  return rules[static_cast<std::size_t>(std::clamp(n, 1, 128))];
}

const DoubleExponentialLevel& DoubleExponential(int level)
{
  static const std::vector<DoubleExponentialLevel> levels = [] {
    std::vector<DoubleExponentialLevel> all;
    for (int k = 0; k < DoubleExponentialLevels; ++k)
    {
      all.push_back(MakeDoubleExponential(k));
    }
    return all;
  }();
  return levels[static_cast<std::size_t>(std::clamp(level, 0, DoubleExponentialLevels - 1))];
}

} // namespace radiometry
