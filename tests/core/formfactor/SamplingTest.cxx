// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/Sampling.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace radiometry;

namespace
{
double Factorial(int n) { return n < 2 ? 1.0 : n * Factorial(n - 1); }
} // namespace

TEST(Quadrature, TriangleRulesAreExactToTheirDegree)
{
  for (int degree = 1; degree <= 8; ++degree)
  {
    const TriangleRule& rule = TriangleRuleOfDegree(degree);
    EXPECT_GE(rule.Degree, degree);
    for (int p = 0; p <= rule.Degree; ++p)
    {
      for (int q = 0; p + q <= rule.Degree; ++q)
      {
        double sum = 0.0;
        for (const auto& n : rule.Nodes)
        {
          sum += n.Weight * std::pow(n.B1, p) * std::pow(n.B2, q);
          EXPECT_GT(n.Weight, 0.0);
        }
        EXPECT_NEAR(sum, 2.0 * Factorial(p) * Factorial(q) / Factorial(p + q + 2), 1e-14)
          << rule.Degree << ": " << p << " " << q;
      }
    }
    // And no further: the next degree must fail somewhere, or the label is wrong.
    double worst = 0.0;
    for (int p = 0; p <= rule.Degree + 1; ++p)
    {
      const int q = rule.Degree + 1 - p;
      double sum = 0.0;
      for (const auto& n : rule.Nodes)
      {
        sum += n.Weight * std::pow(n.B1, p) * std::pow(n.B2, q);
      }
      worst =
        std::max(worst, std::abs(sum - 2.0 * Factorial(p) * Factorial(q) / Factorial(p + q + 2)));
    }
    EXPECT_GT(worst, 1e-9);
  }
}

TEST(Quadrature, GaussLegendre)
{
  for (int n : { 1, 2, 5, 16, 64, 128 })
  {
    const LineRule& rule = GaussLegendre(n);
    for (int p : { 0, 1, n, 2 * n - 1 })
    {
      double sum = 0.0;
      for (int k = 0; k < n; ++k)
      {
        sum += rule.Weights[k] * std::pow(rule.Nodes[k], p);
      }
      EXPECT_NEAR(sum, 1.0 / (p + 1), 1e-14) << n << " " << p;
    }
  }
}

TEST(Quadrature, DoubleExponentialSwallowsSingularEnds)
{
  double log = 0.0, root = 0.0;
  for (int level = 0; level < 5; ++level)
  {
    const DoubleExponentialLevel& rule = DoubleExponential(level);
    double addLog = 0.0, addRoot = 0.0;
    for (std::size_t k = 0; k < rule.Distance.size(); ++k)
    {
      const double x = rule.Distance[k];
      const bool middle = rule.HasMiddle && k + 1 == rule.Distance.size();
      addLog += rule.Weight[k] * (std::log(x) + (middle ? 0.0 : std::log1p(-x)));
      addRoot += rule.Weight[k] * (1.0 / std::sqrt(x * (1.0 - x))) * (middle ? 1.0 : 2.0);
    }
    log = 0.5 * log + addLog;
    root = 0.5 * root + addRoot;
    if (level == 0)
    {
      log = addLog;
      root = addRoot;
    }
  }
  EXPECT_NEAR(log, -1.0, 1e-14);
  EXPECT_NEAR(root, 3.14159265358979323846, 1e-8); // the tail beyond 1e-20 is 2e-10
}

TEST(Sampling, EveryPrefixOfSixteenIsStratified)
{
  // A (0, m, 2)-net in the first two dimensions: one point in each elementary interval.
  for (std::uint64_t key : { 0ull, 1ull, 77ull, 0xffffffffffffull })
  {
    const SobolSequence sequence(key);
    for (std::uint32_t block = 0; block < 4; ++block)
    {
      for (int bits = 0; bits <= 4; ++bits)
      {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = 0; i < 16; ++i)
        {
          const auto p = sequence(16 * block + i);
          cells.insert({ int(p[0] * (1 << bits)), int(p[1] * (1 << (4 - bits))) });
        }
        EXPECT_EQ(cells.size(), 16u) << key << " " << bits;
      }
      for (int d = 0; d < 4; ++d)
      {
        std::set<int> cells;
        for (std::uint32_t i = 0; i < 16; ++i)
        {
          cells.insert(int(sequence(16 * block + i)[d] * 16));
        }
        EXPECT_EQ(cells.size(), 16u);
      }
    }
  }
}

TEST(Sampling, KeysAreIndependentAndMeansConverge)
{
  // The mean over keys of a 64-point estimate is unbiased; its spread beats random by far.
  double mean = 0.0, square = 0.0;
  const int keys = 400;
  for (int key = 0; key < keys; ++key)
  {
    const SobolSequence sequence(Hash64(5, key));
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 64; ++i)
    {
      const auto p = sequence(i);
      sum += p[0] * p[1] * p[2] * p[3] * 16.0;
    }
    mean += sum / 64.0 / keys;
    square += (sum / 64.0 - 1.0) * (sum / 64.0 - 1.0) / keys;
  }
  const double random = std::sqrt((std::pow(4.0 / 3.0, 4) - 1.0) / 64.0); // 0.18
  EXPECT_LT(std::sqrt(square), 0.25 * random);
  EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(square / keys));
}

TEST(Sampling, CosineDirectionsAndTrianglePoints)
{
  const Vec3 n = Normalized({ 0.3, -0.5, -0.8 });
  const Triangle3 t{ { { 1, 0, 0 }, { 0, 2, 0 }, { 0, 0, 3 } } };
  const SobolSequence sequence(9);
  const int count = 1 << 14;
  double cosine = 0.0, cosine2 = 0.0;
  Vec3 mean, point;
  for (int i = 0; i < count; ++i)
  {
    const auto p = sequence(static_cast<std::uint32_t>(i));
    const Vec3 d = CosineDirection(n, p[0], p[1]);
    EXPECT_NEAR(Length(d), 1.0, 1e-14);
    EXPECT_GE(Dot(d, n), 0.0);
    cosine += Dot(d, n) / count;
    cosine2 += Dot(d, n) * Dot(d, n) / count;
    mean += d / count;
    point += TrianglePoint(t, p[2], p[3]) / count;
  }
  EXPECT_NEAR(cosine, 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(cosine2, 0.5, 1e-4);
  EXPECT_NEAR(Length(mean - (2.0 / 3.0) * n), 0.0, 2e-4);
  EXPECT_NEAR(Length(point - Centroid(t)), 0.0, 3e-4);
}
