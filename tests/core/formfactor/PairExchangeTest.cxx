// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PairExchange.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/Quadrature.h"
#include "tests/core/formfactor/Shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace radiometry;
using shapes::Divided;
using shapes::Quad;
using shapes::QuadOther;

namespace
{

constexpr double Pi = 3.14159265358979323846;

/// A F between two sets of triangles; `error` sums the estimates.
double Sum(const std::vector<Triangle3>& a, const std::vector<Triangle3>& b, double tolerance,
  double* error = nullptr)
{
  double sum = 0.0;
  for (const Triangle3& i : a)
  {
    for (const Triangle3& j : b)
    {
      const PairExchangeResult r = PairExchange(i, j, tolerance);
      sum += r.Value;
      if (error)
      {
        *error += r.Error;
      }
    }
  }
  return sum;
}

/// Parallel rectangles a x b at distance c, Howell C-11.
double ParallelRectangles(double a, double b, double c)
{
  const double x = a / c, y = b / c;
  const double x2 = 1.0 + x * x, y2 = 1.0 + y * y;
  return 2.0 / (Pi * x * y) *
    (0.5 * std::log(x2 * y2 / (x2 + y * y)) + x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
      y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

/// Rectangle w x l to the perpendicular h x l with which it shares the edge l, Howell C-14.
double PerpendicularRectangles(double l, double h, double w)
{
  const double H = h / l, W = w / l;
  const double h2 = H * H, w2 = W * W, s = std::sqrt(h2 + w2);
  const double a = (1 + w2) * (1 + h2) / (1 + w2 + h2);
  const double b = w2 * (1 + w2 + h2) / ((1 + w2) * (w2 + h2));
  const double c = h2 * (1 + h2 + w2) / ((1 + h2) * (h2 + w2));
  return (W * std::atan(1 / W) + H * std::atan(1 / H) - s * std::atan(1 / s) +
           0.25 * (std::log(a) + w2 * std::log(b) + h2 * std::log(c))) /
    (Pi * W);
}

/// A F of a unit square and one that shares its edge at the angle `wedge`, by another route: the
/// closed form to the whole square from double-exponential points on both axes of the first.
double WedgeByPoints(double wedge, double length)
{
  SmallPolygon second;
  second.N = 4;
  const Vec3 up{ 0.0, std::cos(wedge), std::sin(wedge) };
  second.P[0] = { 0, 0, 0 };
  second.P[1] = Vec3{ 0, 0, 0 } + length * up;
  second.P[2] = Vec3{ 1, 0, 0 } + length * up;
  second.P[3] = { 1, 0, 0 };
  double last = 0.0;
  std::vector<std::pair<double, double>> nodes; // position, weight; of all levels up to 5
  for (int level = 0; level < 6; ++level)
  {
    const DoubleExponentialLevel& rule = DoubleExponential(level);
    const double scale = std::ldexp(1.0, level - 5);
    for (std::size_t k = 0; k < rule.Distance.size(); ++k)
    {
      nodes.emplace_back(rule.Distance[k], rule.Weight[k] * scale);
      if (!(rule.HasMiddle && k + 1 == rule.Distance.size()))
      {
        nodes.emplace_back(1.0 - rule.Distance[k], rule.Weight[k] * scale);
      }
    }
  }
  for (const auto& x : nodes)
  {
    for (const auto& y : nodes)
    {
      last += x.second * y.second * PointToPolygon({ x.first, y.first, 0.0 }, { 0, 0, 1 }, second);
    }
  }
  return last;
}

} // namespace

TEST(PairExchange, ParallelSquares)
{
  for (const auto& gap : { 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0 })
  {
    const double exact = ParallelRectangles(1.0, 1.0, gap);
    const auto floor = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    for (const auto& ceiling : { Quad({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }),
           QuadOther({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }) })
    {
      for (double tolerance : { 1e-2, 1e-4, 1e-6, 1e-9 })
      {
        double error = 0.0;
        const double value = Sum(floor, ceiling, tolerance, &error);
        EXPECT_NEAR(value / exact, 1.0, std::min(tolerance, 1e-6))
          << "gap " << gap << " tolerance " << tolerance;
        EXPECT_LE(std::abs(value - exact), error + 2e-8 * exact)
          << "gap " << gap << " tolerance " << tolerance;
      }
    }
  }
  EXPECT_NEAR(Sum(Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }),
                Quad({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }), 1e-12),
    0.199824895698387, 1e-12);
  EXPECT_NEAR(Sum(Quad({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }),
                Quad({ 0, 0, 1 }, { 0, 1, 0 }, { 2, 0, 0 }), 1e-12) /
      2.0,
    0.28587538485, 1e-10);
}

TEST(PairExchange, SharedEdge)
{
  const auto floor = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  const auto wall = Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  double error = 0.0;
  EXPECT_NEAR(Sum(floor, wall, 1e-6, &error), 0.200043776075403, 2e-7);
  EXPECT_LE(error, 4e-6 * 0.2);
  EXPECT_NEAR(Sum(floor, wall, 1e-12), 0.200043776075403, 1e-12);
  // Moved apart by a tenth, each in its own plane.
  EXPECT_NEAR(Sum(Quad({ 0.1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }),
                Quad({ 0, 0, 0.1 }, { 0, 1, 0 }, { 0, 0, 1 }), 1e-12),
    0.154206868494109, 1e-12);
  // Rectangles from long and flat to narrow and tall.
  for (double h : { 1e-3, 0.1, 1.0, 10.0, 1e3 })
  {
    for (double w : { 1e-3, 0.1, 1.0, 10.0, 1e3 })
    {
      const double exact = w * PerpendicularRectangles(1.0, h, w);
      const double value = Sum(Quad({ 0, 0, 0 }, { w, 0, 0 }, { 0, 1, 0 }),
        Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, h }), 1e-8);
      EXPECT_NEAR(value / exact, 1.0, 1e-6) << h << " " << w;
    }
  }
}

TEST(PairExchange, WedgesByAnotherRoute)
{
  for (double degrees : { 1.0, 30.0, 90.0, 150.0, 170.0, 179.0, 179.9 })
  {
    const double wedge = degrees * Pi / 180.0;
    const Vec3 up{ 0.0, std::cos(wedge), std::sin(wedge) };
    const auto floor = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    const auto wall = Quad({ 0, 0, 0 }, up, { 1, 0, 0 });
    const double value = Sum(floor, wall, 1e-9);
    const double reference = WedgeByPoints(wedge, 1.0);
    EXPECT_NEAR(value / reference, 1.0, 1e-6) << degrees;
  }
}

TEST(PairExchange, NearlyTouching)
{
  // A gap of 1e-9: all but the rim sees the other; the exact value is 1 - 2 gap + O(gap^2 log).
  for (double gap : { 1e-9, 1e-6 })
  {
    const double value = Sum(Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }),
      Quad({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }), 1e-9);
    EXPECT_NEAR(value, 1.0 - 2.0 * gap, 1e-9 + 1e2 * gap * gap) << gap;
  }
  // Perpendicular squares whose common edge opens by 1e-9: the shared edge in the limit.
  EXPECT_NEAR(Sum(Quad({ 1e-9, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }),
                Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1e-9),
    0.200043776075403, 2e-8);
  // A T-junction: a half-length edge against a whole one, against the sum rule of closed forms.
  const double half = Sum(Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0.5, 0 }),
    Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1e-9);
  EXPECT_NEAR(half, 0.5 * 0.200043776075403, 1e-9);
}

TEST(PairExchange, ScaleDoesNotMatter)
{
  for (double scale : { 1e-9, 1e-3, 1.0, 1e6 })
  {
    const double value = Sum(Quad({ 0, 0, 0 }, { scale, 0, 0 }, { 0, scale, 0 }),
      Quad({ 0, 0, 0 }, { 0, scale, 0 }, { 0, 0, scale }), 1e-9);
    EXPECT_NEAR(value / (scale * scale), 0.200043776075403, 1e-9) << scale;
  }
  // Sizes 1 : 1e6, a small square in the corner of a large one and over its middle.
  for (double size : { 1e-6, 1e-3 })
  {
    const double touching = Sum(Quad({ 0, 0.3, 0 }, { size, 0, 0 }, { 0, size, 0 }),
      Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1e-8);
    // The sum rule: strips of the same width as the small square, by Howell C-14.
    const auto strip = [&](double length) {
      return length * size * PerpendicularRectangles(1.0, 1.0 / length, size / length);
    };
    // Mid-edge of an (almost) unbounded wall: 1/2 less what the wall lacks; by fine division.
    const double parts = Sum(Divided(Divided(Quad({ 0, 0.3, 0 }, { size, 0, 0 }, { 0, size, 0 }))),
      Divided(Divided(Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }))), 1e-9);
    EXPECT_NEAR(touching / parts, 1.0, 1e-6) << size;
    EXPECT_GT(touching, 0.25 * strip(1.0) * size);
    EXPECT_NEAR(touching / (size * size), 0.5, 2.0 * size + 0.3);
    const double over = Sum(Quad({ 0.3, 0.3, size }, { 0, size, 0 }, { size, 0, 0 }),
      Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }), 1e-9);
    EXPECT_NEAR(over / (size * size), 1.0, 40.0 * size * size + 1e-9);
  }
}

TEST(PairExchange, NothingWhereNothingIsSeen)
{
  const auto floor = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  // Coplanar: apart, sharing an edge, overlapping, identical; in odd directions too.
  EXPECT_EQ(Sum(floor, Quad({ 2, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }), 1e-6), 0.0);
  EXPECT_EQ(Sum(floor, Quad({ 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }), 1e-6), 0.0);
  EXPECT_EQ(Sum(floor, floor, 1e-6), 0.0);
  // Back to back and facing away.
  EXPECT_EQ(Sum(floor, Quad({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }), 1e-6), 0.0);
  EXPECT_EQ(Sum(floor, Quad({ 0, 0, -1 }, { 0, 1, 0 }, { 1, 0, 0 }), 1e-6), 0.0);
  EXPECT_EQ(Sum(floor, Quad({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }), 1e-6), 0.0);
  // A triangle without area.
  EXPECT_EQ(PairExchange({ { { 0, 0, 1 }, { 1, 0, 1 }, { 2, 0, 1 } } }, floor[0]).Value, 0.0);
  // Coplanar to rounding: never more than rounding.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 a{ u(random), u(random), u(random) }, b{ u(random), u(random), u(random) };
    const auto p = [&] { return u(random) * a + u(random) * b; };
    const Triangle3 s{ p(), p(), p() }, t{ p(), p(), p() };
    EXPECT_EQ(PairExchange(s, t, 1e-6).Value, 0.0);
  }
}

TEST(PairExchange, PartlyBelowTheHorizon)
{
  // A wall that reaches below the floor's plane counts by its upper half only.
  const auto floor = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  const auto wall = Quad({ 0, 0, -1 }, { 0, 1, 0 }, { 0, 0, 2 });
  EXPECT_NEAR(Sum(floor, wall, 1e-10), 0.200043776075403, 1e-10);
  // Both planes cut the other's triangle: against the pieces cut by hand.
  const auto crossing = Quad({ 0, 0, -1 }, { 0, 1, 0 }, { 0, 0, 2 });
  const auto both = Quad({ -1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 });
  EXPECT_NEAR(Sum(both, crossing, 1e-10), 0.200043776075403, 1e-10);
}

TEST(PairExchange, FarAndGrazing)
{
  // At 1e6: the exchange of two elements, with all its digits.
  for (double d : { 1e2, 1e4, 1e6 })
  {
    const Triangle3 a{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } };
    const Triangle3 b{ { { 0, 0, d }, { 0, 1, d }, { 1, 0, d } } };
    const double element = 0.25 / (Pi * d * d);
    EXPECT_NEAR(PairExchange(a, b, 1e-10).Value / element, 1.0, 1.0 / (d * d)) << d;
    // A distant wall seen at a grazing angle: both cosines are heights over the distance.
    const Triangle3 wall{ { { d, 0, 0 }, { d, 0, 1 }, { d, 1, 0 } } };
    const double grazing = 0.25 * (1.0 / 3.0) * (d - 1.0 / 3.0) / (Pi * std::pow(d - 1.0 / 3.0, 4));
    EXPECT_NEAR(PairExchange(a, wall, 1e-10).Value / grazing, 1.0, 4.0 / d) << d;
  }
}

TEST(PairExchange, RandomPairsAreAdditiveSymmetricAndHonest)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int seen = 0;
  int counted[5] = {};
  for (int k = 0; k < 400; ++k)
  {
    const auto point = [&](double shift) {
      return Vec3{ u(random), u(random), u(random) + shift };
    };
    const double apart = std::pow(10.0, 1.2 * std::abs(u(random))) - 1.0;
    const Triangle3 a{ point(0), point(0), point(0) };
    const Triangle3 b{ point(apart), point(apart), point(apart) };
    const PairExchangeResult fine = PairExchange(a, b, 1e-11);
    const PairExchangeResult back = PairExchange(b, a, 1e-11);
    EXPECT_NEAR(fine.Value, back.Value, fine.Error + back.Error) << k;
    double parts = 0.0, partsError = 0.0;
    for (const Triangle3& s : Divided({ a }))
    {
      for (const Triangle3& t : Divided({ b }))
      {
        const PairExchangeResult r = PairExchange(s, t, 1e-11);
        parts += r.Value;
        partsError += r.Error;
      }
    }
    EXPECT_NEAR(parts, fine.Value, partsError + fine.Error) << k;
    EXPECT_LE(fine.Error, 1e-8 * fine.Value + 1e-15) << k;
    seen += fine.Value > 0.0;
    for (double tolerance : { 0.03, 1e-3, 1e-6 })
    {
      const PairExchangeResult r = PairExchange(a, b, tolerance);
      EXPECT_LE(std::abs(r.Value - fine.Value), r.Error + fine.Error)
        << k << " " << tolerance << " method " << int(r.Method);
      EXPECT_LE(r.Error, tolerance * r.Value + 1e-15) << k << " " << tolerance;
      ++counted[int(r.Method)];
    }
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(counted[int(ExchangeMethod::Rule)], 10);
  EXPECT_GT(counted[int(ExchangeMethod::Contour)], 10);
}
