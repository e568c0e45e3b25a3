// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/ContourExchange.h"

#include "radiometry/geometry/Quadrature.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// A stretch of an outer edge against a whole inner edge.
struct Stretch
{
  Vec3 Outer; // unit direction of the outer edge
  Vec3 Inner; // unit direction of the inner edge
  double InnerLength;
  Vec3 FromBegin; // the inner edge's first corner seen from the stretch's begin
  Vec3 FromEnd;   // ... and from its end
  double Length;
  double Cosine; // Outer.Inner
  bool Smooth;   // no singularity near: Gauss-Legendre
};

/// int_0^L ln|d + t u| dt, in closed form. `d` is the first corner as seen from the outer point.
double InnerIntegral(const Vec3& d, const Vec3& u, double length)
{
  const double t0 = Dot(d, u);
  const double t1 = t0 + length;
  const double h2 = LengthSquared(Cross(d, u));
  const double h = std::sqrt(h2);
  const double r0 = t0 * t0 + h2;
  const double r1 = t1 * t1 + h2;
  double sum = -length;
  if (r1 > 0.0)
  {
    sum += 0.5 * t1 * std::log(r1);
  }
  if (r0 > 0.0)
  {
    sum -= 0.5 * t0 * std::log(r0);
  }
  if (h > 0.0)
  {
    sum += h * std::atan2(h * length, h2 + t0 * t1);
  }
  return sum;
}

double Evaluate(const Stretch& s, double fromBegin)
{
  return InnerIntegral(s.FromBegin - fromBegin * s.Outer, s.Inner, s.InnerLength);
}
double EvaluateFromEnd(const Stretch& s, double fromEnd)
{
  return InnerIntegral(s.FromEnd + fromEnd * s.Outer, s.Inner, s.InnerLength);
}

void AddStretches(
  std::vector<Stretch>& stretches, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a;
  const Vec3 cd = d - c;
  const double outerLength = Length(ab);
  const double innerLength = Length(cd);
  if (outerLength == 0.0 || innerLength == 0.0)
  {
    return;
  }
  const Vec3 u = ab / outerLength;
  const Vec3 v = cd / innerLength;
  const double cosine = Dot(u, v);
  if (cosine == 0.0)
  {
    return;
  }
  // Singular or nearly so: the feet of the inner corners, and where the two lines pass each other.
  double splits[5] = { 0.0, Dot(c - a, u), Dot(d - a, u), 0.0, outerLength };
  const double sine2 = LengthSquared(Cross(u, v));
  if (sine2 > 1e-12)
  {
    const Vec3 w = c - a;
    splits[3] = (Dot(w, u) - cosine * Dot(w, v)) / sine2;
  }
  for (double& s : splits)
  {
    s = std::clamp(s, 0.0, outerLength);
    // A foot that rounding cannot tell from an end is that end.
    s = s < 4.0 * Epsilon * outerLength ? 0.0 : s;
    s = outerLength - s < 4.0 * Epsilon * outerLength ? outerLength : s;
  }
  std::sort(splits, splits + 5);
  for (int k = 0; k < 4; ++k)
  {
    const double begin = splits[k];
    const double end = splits[k + 1];
    if (!(end > begin))
    {
      continue;
    }
    Stretch s;
    s.Outer = u;
    s.Inner = v;
    s.InnerLength = innerLength;
    s.FromBegin = begin == 0.0 ? c - a : (begin == outerLength ? c - b : c - (a + begin * u));
    s.FromEnd = end == outerLength ? c - b : c - (a + end * u);
    s.Length = end - begin;
    s.Cosine = cosine;
    // The distance of the stretch's ends from the inner edge bounds how near a singularity is.
    const auto away = [&](const Vec3& from) {
      const double t = std::clamp(-Dot(from, v), 0.0, innerLength);
      return LengthSquared(from + t * v);
    };
    const double near = 0.25 * s.Length * s.Length;
    s.Smooth = away(s.FromBegin) > near && away(s.FromEnd) > near;
    stretches.push_back(s);
  }
}

} // namespace

double ContourExchange(const SmallPolygon& outer, const SmallPolygon& inner,
  double relativeTolerance, double absolute, double& error)
{
  // In units of the outer polygon's size: contour integrals of a constant vanish, their rounding
  // does not.
  const Vec3 origin = outer.P[0];
  double unit = 0.0;
  for (int k = 1; k < outer.N; ++k)
  {
    unit = std::max(unit, Length(outer.P[k] - origin));
  }
  const double scale = unit * unit / (2.0 * Pi);
  const auto scaled = [&](const Vec3& p) { return (p - origin) / unit; };

  static thread_local std::vector<Stretch> stretches;
  stretches.clear();
  for (int i = 0; i < outer.N; ++i)
  {
    const Vec3 a = scaled(outer.P[i]);
    const Vec3 b = scaled(outer.P[(i + 1) % outer.N]);
    for (int j = 0; j < inner.N; ++j)
    {
      AddStretches(stretches, a, b, scaled(inner.P[j]), scaled(inner.P[(j + 1) % inner.N]));
    }
  }

  double smooth = 0.0, smoothChange = 0.0;
  double singular = 0.0, singularChange = 0.0;
  double magnitude = 0.0;
  double value = 0.0;
  for (int level = 0; level < DoubleExponentialLevels; ++level)
  {
    // Smooth stretches: a fresh Gauss rule of twice the points, while it still changes.
    const int points = 4 << level;
    if (level == 0 || (points <= 64 && smoothChange > Epsilon * magnitude))
    {
      const LineRule& rule = GaussLegendre(points);
      double sum = 0.0;
      for (const Stretch& s : stretches)
      {
        if (s.Smooth)
        {
          double part = 0.0;
          for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
          {
            part += rule.Weights[k] * Evaluate(s, rule.Nodes[k] * s.Length);
          }
          sum += part * s.Length * s.Cosine;
          magnitude = std::max(magnitude, std::abs(part * s.Length * s.Cosine));
        }
      }
      smoothChange = level == 0 ? std::numeric_limits<double>::infinity() : std::abs(sum - smooth);
      smooth = sum;
    }
    // Singular stretches: the new nodes of a halved step, added to half of the old sum.
    const DoubleExponentialLevel& rule = DoubleExponential(level);
    double added = 0.0;
    bool any = false;
    for (const Stretch& s : stretches)
    {
      if (s.Smooth)
      {
        continue;
      }
      any = true;
      double part = 0.0;
      for (std::size_t k = 0; k < rule.Distance.size(); ++k)
      {
        const double distance = rule.Distance[k] * s.Length;
        const bool middle = rule.HasMiddle && k + 1 == rule.Distance.size();
        double f = Evaluate(s, distance);
        if (!middle)
        {
          f += EvaluateFromEnd(s, distance);
        }
        part += rule.Weight[k] * f;
      }
      added += part * s.Length * s.Cosine;
      magnitude = std::max(magnitude, std::abs(part * s.Length * s.Cosine));
    }
    const double next = 0.5 * singular + added;
    singularChange = !any
      ? 0.0
      : (level < 2 ? std::numeric_limits<double>::infinity() : std::abs(next - singular));
    singular = level == 0 ? added : next;
    value = smooth + singular;
    error = smoothChange + singularChange + 8.0 * Epsilon * magnitude;
    if (error <= std::max(relativeTolerance * std::abs(value), absolute / scale))
    {
      break;
    }
  }
  error *= scale;
  return value * scale;
}

} // namespace radiometry
