// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/ReferenceIntegral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace test
{
namespace
{

using Interval = std::pair<double, double>;

// Gauss-Legendre of 5 and 8 points on [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
constexpr std::array<double, 5> X5{ -0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683,
  0.906179845938664 };
constexpr std::array<double, 5> W5{ 0.236926885056189, 0.478628670499366, 0.568888888888889,
  0.478628670499366, 0.236926885056189 };
constexpr std::array<double, 8> X8{ -0.960289856497536, -0.796666477413627, -0.525532409916329,
  -0.183434642495650, 0.183434642495650, 0.525532409916329, 0.796666477413627, 0.960289856497536 };
constexpr std::array<double, 8> W8{ 0.101228536290376, 0.222381034453374, 0.313706645877887,
  0.362683783378362, 0.362683783378362, 0.313706645877887, 0.222381034453374, 0.101228536290376 };

/// Where the line y crosses a convex polygon.
bool Span(const Convex2& polygon, double y, Interval& span)
{
  span = { std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Point2& a = polygon[i];
    const Point2& b = polygon[(i + 1) % polygon.size()];
    if ((a.y <= y) != (b.y <= y))
    {
      const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
      span.first = std::min(span.first, x);
      span.second = std::max(span.second, x);
    }
  }
  return span.first < span.second;
}

Interval Extent(const Convex2& polygon)
{
  Interval e{ std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (const Point2& p : polygon)
  {
    e.first = std::min(e.first, p.y);
    e.second = std::max(e.second, p.y);
  }
  return e;
}

class LineIntegrator
{
public:
  /// `allowed`: what an interval along x may be wrong by.
  LineIntegrator(const Convex2& region, const RegionIntegrand& f, bool hidden, double allowed)
    : Region(region)
    , Function(f)
    , Hidden(hidden)
    , Allowed(allowed)
  {
  }

  /// Five lines of a strip in which the shadows `active` lie.
  double Strip(double lo, double hi, const std::vector<const Convex2*>& active)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < X5.size(); ++i)
    {
      sum += W5[i] * this->Line(0.5 * ((lo + hi) + (hi - lo) * X5[i]), active);
    }
    return 0.5 * (hi - lo) * sum;
  }

  Integral Refined(double lo, double hi, double whole, const std::vector<const Convex2*>& active,
    double allowed, int depth)
  {
    const double middle = 0.5 * (lo + hi);
    const double left = this->Strip(lo, middle, active);
    const double right = this->Strip(middle, hi, active);
    const double change = std::fabs(left + right - whole);
    if (change <= allowed || depth == 0)
    {
      return { left + right, change };
    }
    const Integral a = this->Refined(lo, middle, left, active, 0.5 * allowed, depth - 1);
    const Integral b = this->Refined(middle, hi, right, active, 0.5 * allowed, depth - 1);
    return { a.Value + b.Value, a.Error + b.Error };
  }

private:
  double Line(double y, const std::vector<const Convex2*>& active)
  {
    Interval whole;
    if (!Span(this->Region, y, whole))
    {
      return 0.0;
    }
    this->Dark.clear();
    for (const Convex2* shadow : active)
    {
      Interval s;
      if (Span(*shadow, y, s) && s.second > whole.first && s.first < whole.second)
      {
        this->Dark.emplace_back(std::max(s.first, whole.first), std::min(s.second, whole.second));
      }
    }
    std::sort(this->Dark.begin(), this->Dark.end());
    this->Cuts.clear();
    if (this->Function.OnLine)
    {
      this->Function.OnLine({ 0.0, y }, { 1.0, 0.0 }, this->Cuts);
      std::sort(this->Cuts.begin(), this->Cuts.end());
    }
    double sum = 0.0;
    double reached = whole.first;
    for (const Interval& d : this->Dark)
    {
      if (this->Hidden)
      {
        sum += this->Piece(std::max(reached, d.first), d.second, y);
      }
      else
      {
        sum += this->Piece(reached, d.first, y);
      }
      reached = std::max(reached, d.second);
    }
    return this->Hidden ? sum : sum + this->Piece(reached, whole.second, y);
  }

  double Piece(double lo, double hi, double y) const
  {
    double sum = 0.0;
    double from = lo;
    for (const double cut : this->Cuts)
    {
      if (cut > from && cut < hi)
      {
        sum += this->Smooth(from, cut, y);
        from = cut;
      }
    }
    return sum + this->Smooth(from, hi, y);
  }

  double Smooth(double lo, double hi, double y) const
  {
    return hi > lo ? this->Halved(lo, hi, y, this->Gauss(lo, hi, y), 12) : 0.0;
  }

  /// Halves are asked until they agree with the whole: f may bend sharply beside a line on which it
  /// has a kink.
  double Halved(double lo, double hi, double y, double whole, int depth) const
  {
    const double middle = 0.5 * (lo + hi);
    const double left = this->Gauss(lo, middle, y);
    const double right = this->Gauss(middle, hi, y);
    if (depth == 0 ||
      std::fabs(left + right - whole) <= this->Allowed + 1e-13 * std::fabs(whole))
    {
      return left + right;
    }
    return this->Halved(lo, middle, y, left, depth - 1) +
      this->Halved(middle, hi, y, right, depth - 1);
  }

  double Gauss(double lo, double hi, double y) const
  {
    const double half = 0.5 * (hi - lo);
    double sum = 0.0;
    for (std::size_t i = 0; i < X8.size(); ++i)
    {
      sum += W8[i] * this->Function.Value(lo + half * (1.0 + X8[i]), y);
    }
    return half * sum;
  }

  const Convex2& Region;
  const RegionIntegrand& Function;
  bool Hidden;
  double Allowed;
  std::vector<Interval> Dark;
  std::vector<double> Cuts;
};

struct Edge
{
  Point2 A;
  Point2 B;
};

void AddEdges(const Convex2& polygon, std::vector<Edge>& edges)
{
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    edges.push_back({ polygon[i], polygon[(i + 1) % polygon.size()] });
  }
}

/// The y at which two edges cross.
void Cross(const Edge& e, const Edge& f, std::vector<double>& lines)
{
  if (std::max(e.A.y, e.B.y) < std::min(f.A.y, f.B.y) ||
    std::max(f.A.y, f.B.y) < std::min(e.A.y, e.B.y) ||
    std::max(e.A.x, e.B.x) < std::min(f.A.x, f.B.x) ||
    std::max(f.A.x, f.B.x) < std::min(e.A.x, e.B.x))
  {
    return;
  }
  const Point2 d{ e.B.x - e.A.x, e.B.y - e.A.y };
  const Point2 g{ f.B.x - f.A.x, f.B.y - f.A.y };
  const double turn = d.x * g.y - d.y * g.x;
  const double s = ((f.A.x - e.A.x) * g.y - (f.A.y - e.A.y) * g.x) / turn; // parallel: no number
  const double t = ((f.A.x - e.A.x) * d.y - (f.A.y - e.A.y) * d.x) / turn;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
  {
    lines.push_back(e.A.y + s * d.y);
  }
}

/// Every y at which the integral over a line is not smooth in y.
std::vector<double> Kinks(const Convex2& region, const std::vector<Convex2>& shadows,
  const RegionIntegrand& f)
{
  std::vector<Edge> edges;
  AddEdges(region, edges);
  for (const Convex2& s : shadows)
  {
    AddEdges(s, edges);
  }
  std::vector<double> lines = f.Extremes;
  std::vector<double> met;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Edge& e = edges[i];
    lines.push_back(e.A.y);
    for (std::size_t j = 0; j < i; ++j)
    {
      Cross(e, edges[j], lines);
    }
    if (f.OnLine)
    {
      const Point2 d{ e.B.x - e.A.x, e.B.y - e.A.y };
      met.clear();
      f.OnLine(e.A, d, met);
      for (const double s : met)
      {
        lines.push_back(e.A.y + s * d.y);
      }
    }
  }
  const Interval range = Extent(region);
  lines.push_back(range.first);
  lines.push_back(range.second);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                [&](double y) { return !(y >= range.first && y <= range.second); }),
    lines.end());
  return lines;
}

bool BoxesMeet(const Convex2& a, const Convex2& b)
{
  const auto apart = [](const Convex2& p, const Convex2& q, double Point2::*axis) {
    double high = -std::numeric_limits<double>::infinity();
    double low = std::numeric_limits<double>::infinity();
    for (const Point2& v : p)
    {
      high = std::max(high, v.*axis);
    }
    for (const Point2& v : q)
    {
      low = std::min(low, v.*axis);
    }
    return high < low;
  };
  return !apart(a, b, &Point2::x) && !apart(b, a, &Point2::x) && !apart(a, b, &Point2::y) &&
    !apart(b, a, &Point2::y);
}

} // namespace

Integral IntegrateRegion(const Convex2& region, const std::vector<Convex2>& allShadows,
  const RegionIntegrand& f, double tolerance, bool hidden)
{
  std::vector<Convex2> shadows;
  for (const Convex2& s : allShadows)
  {
    if (BoxesMeet(s, region))
    {
      shadows.push_back(s);
    }
  }
  const std::vector<double> lines = Kinks(region, shadows, f);
  std::vector<std::pair<Interval, const Convex2*>> extents;
  for (const Convex2& s : shadows)
  {
    extents.emplace_back(Extent(s), &s);
  }
  const double height = lines.back() - lines.front();
  // The scale of the integral: f without shadows, coarsely.
  const double coarse = std::numeric_limits<double>::infinity();
  const double scale = std::fabs(
    LineIntegrator(region, f, false, coarse).Strip(lines.front(), lines.back(), {}));
  LineIntegrator integrator(
    region, f, hidden, std::max(0.01 * tolerance, 1e-14) * scale / height);
  Integral sum;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k)
  {
    const double lo = lines[k];
    const double hi = lines[k + 1];
    std::vector<const Convex2*> active;
    for (const auto& [extent, shadow] : extents)
    {
      if (extent.first < hi && extent.second > lo)
      {
        active.push_back(shadow);
      }
    }
    const double whole = integrator.Strip(lo, hi, active);
    const Integral strip = integrator.Refined(
      lo, hi, whole, active, tolerance * scale * (hi - lo) / height, 14);
    sum.Value += strip.Value;
    sum.Error += strip.Error;
  }
  sum.Error += 1e-13 * scale;
  return sum;
}

} // namespace test
