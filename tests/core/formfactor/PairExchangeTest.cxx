// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PairExchange.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/Sampling.h"
#include "tests/core/formfactor/ReferenceExchange.h"
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

namespace
{

/// Random pairs of one kind.
struct PairMaker
{
  std::uint64_t Key, Count = 0;
  double U() { return static_cast<double>(Hash64(this->Key, this->Count++) >> 11) * 0x1p-53; }
  Vec3 Point(double size)
  {
    const double x = this->U() - 0.5, y = this->U() - 0.5, z = this->U() - 0.5;
    return size * Vec3{ x, y, z };
  }
  Triangle3 Any(double size, const Vec3& center)
  {
    const Vec3 a = this->Point(size), b = this->Point(size), c = this->Point(size);
    return { center + a, center + b, center + c };
  }
};

struct HardPair
{
  const char* Name;
  Triangle3 A, B;
};

HardPair MakeHard(int kind, std::uint64_t key)
{
  PairMaker m{ Hash64(static_cast<std::uint64_t>(kind), key) };
  const Triangle3 a = m.Any(1.0, {});
  const Vec3 n = Normalized(AreaNormal2(a));
  switch (kind)
  {
    case 0:
      return { "through each other", a, m.Any(1.0, {}) };
    case 1:
    {
      Triangle3 b = m.Any(1.0, {});
      b[1] = a[2];
      return { "a shared corner", a, b };
    }
    case 2:
    {
      // Edges in opposite directions: fronts may face each other.
      Triangle3 b{ a[1], a[0], m.Point(1.0) };
      return { "a shared edge", a, b };
    }
    case 3:
    {
      // A part of an edge: a T-junction.
      const Vec3 p = a[0] + 0.3 * (a[1] - a[0]), q = a[0] + 0.8 * (a[1] - a[0]);
      return { "a part of an edge", a, { q, p, m.Point(1.0) } };
    }
    case 4:
    {
      const double gap = 1e-9 * Length(a[1] - a[0]);
      return { "parallel, a gap of 1e-9", a, { a[0] + gap * n, a[2] + gap * n, a[1] + gap * n } };
    }
    case 5:
    {
      const Vec3 shift = 0.3 * (a[1] - a[0]) + 0.2 * (a[2] - a[0]);
      const double gap = 1e-6;
      return { "overlapping in part, a gap of 1e-6", a,
        { a[0] + shift + gap * n, a[2] + shift + gap * n, a[1] + shift + gap * n } };
    }
    case 6:
      return { "one a millionth of the other", a, m.Any(1e-6, 0.3 * a[0] + 0.4 * a[1] + 0.3 * a[2] + 2e-6 * n) };
    case 7:
    {
      Triangle3 b = m.Any(1.0, 0.5 * n);
      b[2] = 0.5 * (b[0] + b[1]) + 1e-4 * (b[2] - b[0]);
      return { "a sliver", a, b };
    }
    case 8:
      return { "far", a, m.Any(1.0, 30.0 * (n + m.Point(1.0))) };
    default:
    {
      // Standing on the middle of the other, touching by an edge.
      const Vec3 p = 0.6 * a[0] + 0.2 * a[1] + 0.2 * a[2], q = 0.2 * a[0] + 0.6 * a[1] + 0.2 * a[2];
      return { "standing on the middle", a, { p, q, 0.5 * (p + q) + n } };
    }
  }
}

} // namespace

TEST(PairExchange, HardPairsAgainstExtendedPrecision)
{
  for (int kind = 0; kind < 10; ++kind)
  {
    int seen = 0;
    for (std::uint64_t key = 0; key < 400 && seen < 6; ++key)
    {
      const HardPair pair = MakeHard(kind, key);
      const double exact = reference::Exchange(pair.A, pair.B);
      // What the reference itself cannot resolve, or rounding of the corners makes or unmakes.
      if (!(exact > 1e-7 * std::min(Area(pair.A), Area(pair.B))) && kind != 8)
      {
        continue;
      }
      if (!(exact > 0.0))
      {
        continue;
      }
      ++seen;
      const PairExchangeResult r = PairExchange(pair.A, pair.B, 1e-6);
      EXPECT_NEAR(r.Value / exact, 1.0, 1e-6) << pair.Name << " " << key;
      EXPECT_LE(std::abs(r.Value - exact), r.Error + 1e-12 * exact) << pair.Name << " " << key;
      // The other way round, and elsewhere in another size.
      EXPECT_NEAR(PairExchange(pair.B, pair.A, 1e-6).Value / exact, 1.0, 2e-6)
        << pair.Name << " " << key;
    }
    EXPECT_GE(seen, 5) << "kind " << kind;
  }
}

TEST(PairExchange, PolygonsAreSumsOfTheirTriangles)
{
  // An L-shaped floor below a square: by rectangles, and by its triangles.
  const auto square = Quad({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 });
  std::vector<Triangle3> ell = Quad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0.5, 0 });
  for (const Triangle3& t : Quad({ 0, 0.5, 0 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }))
  {
    ell.push_back(t);
  }
  const auto missing = Quad({ 0.5, 0.5, 0 }, { 0.5, 0, 0 }, { 0, 0.5, 0 });
  const PairExchangeResult r = PairExchange(ell, square, 1e-8);
  const double rest = PairExchange(missing, square, 1e-8).Value;
  EXPECT_NEAR(r.Value + rest, 0.199824895698387, 3e-9);
  EXPECT_LE(r.Error, 1e-8 * r.Value);
  EXPECT_EQ(PairExchange(std::vector<Triangle3>{}, square).Value, 0.0);
}
