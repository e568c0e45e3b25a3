// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/ContourExchange.h"

#include "radiometry/geometry/Quadrature.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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

// The functions below are of plain arithmetic, without branches, so that loops over them become
// vector instructions; the loop is compiled for wide ones, too, where the machine may have them.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
#define RADIOMETRY_WIDE __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define RADIOMETRY_WIDE
#endif

/// The natural logarithm of a positive normal number, to some units of the last place.
inline double Log(double x)
{
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  // The exponent as a double: in the low bits of 2^52.
  const std::uint64_t shifted = (bits >> 52) | 0x4330000000000000ull;
  const std::uint64_t fraction = (bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull;
  double e, m;
  std::memcpy(&e, &shifted, sizeof e);
  std::memcpy(&m, &fraction, sizeof m);
  e -= 4503599627370496.0 + 1023.0;
  const bool high = m > 1.4142135623730951;
  m = high ? 0.5 * m : m;
  e = high ? e + 1.0 : e;
  // ln m = 2 artanh((m - 1)/(m + 1)), the argument below 0.172.
  const double z = (m - 1.0) / (m + 1.0);
  const double z2 = z * z;
  double series = 1.0 / 23.0;
  for (int k = 21; k >= 3; k -= 2)
  {
    series = series * z2 + 1.0 / k;
  }
  // ln 2 in two parts, the first of few digits.
  return e * 0.693147180369123816490 +
    (e * 1.90821492927058770002e-10 + 2.0 * (z + z * z2 * series));
}

/// The angle of (x, y) for y >= 0, not both zero: 0 to pi.
inline double Angle(double y, double x)
{
  const double ax = x < 0.0 ? -x : x;
  const bool steep = y > ax;
  const double ratio = (steep ? ax : y) / (steep ? y : ax);
  // Twice halved: tan(a/2) = tan a/(1 + sqrt(1 + tan^2 a)), below 0.199.
  const double half = ratio / (1.0 + std::sqrt(1.0 + ratio * ratio));
  const double z = half / (1.0 + std::sqrt(1.0 + half * half));
  const double z2 = z * z;
  double series = -1.0 / 27.0;
  for (int k = 25; k >= 3; k -= 2)
  {
    series = (k % 4 == 1 ? 1.0 : -1.0) / k + series * z2;
  }
  const double angle = 4.0 * (z + z * z2 * series);
  const double folded = steep ? 0.5 * Pi - angle : angle;
  return x < 0.0 ? Pi - folded : folded;
}

/// sum of w_k int_0^L ln|d_k + t u| dt, in closed form, over `count` points of a stretch at given
/// distances from its begin or its end; d_k is the inner edge's first corner as seen from there.
RADIOMETRY_WIDE
double InnerIntegrals(const Stretch& s, bool fromEnd, const double* distance, const double* weight,
  std::size_t count)
{
  const Vec3 d = fromEnd ? s.FromEnd : s.FromBegin;
  const double step = fromEnd ? s.Length : -s.Length;
  const double begin = Dot(d, s.Inner), slope = step * s.Cosine;
  const Vec3 across = Cross(d, s.Inner), turn = step * Cross(s.Outer, s.Inner);
  const double length = s.InnerLength;
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t k = 0; k < count; ++k)
  {
    const double at = distance[k];
    const double t0 = begin + at * slope;
    const double t1 = t0 + length;
    const double cx = across.x + at * turn.x;
    const double cy = across.y + at * turn.y;
    const double cz = across.z + at * turn.z;
    const double h2 = cx * cx + cy * cy + cz * cz;
    const double h = std::sqrt(h2);
    const double r0 = t0 * t0 + h2;
    const double r1 = t1 * t1 + h2;
    // Where r is zero so is t, or h: the product with a finite logarithm or angle is, too.
    constexpr double tiny = 1e-290;
    const double y = h * length;
    const double angle = Angle(y > tiny ? y : tiny, h2 + t0 * t1);
    sum += weight[k] *
      (0.5 * (t1 * Log(r1 > tiny ? r1 : tiny) - t0 * Log(r0 > tiny ? r0 : tiny)) - length +
        h * angle);
  }
  return sum;
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
  double relativeTolerance, double absolute, double& error, double& lost)
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
          const double part = InnerIntegrals(
            s, false, rule.Nodes.data(), rule.Weights.data(), rule.Nodes.size());
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
      const std::size_t count = rule.Distance.size();
      const double part =
        InnerIntegrals(s, false, rule.Distance.data(), rule.Weight.data(), count) +
        InnerIntegrals(s, true, rule.Distance.data(), rule.Weight.data(),
          rule.HasMiddle ? count - 1 : count);
      added += part * s.Length * s.Cosine;
      magnitude = std::max(magnitude, std::abs(part * s.Length * s.Cosine));
    }
    const double next = 0.5 * singular + added;
    singularChange = !any
      ? 0.0
      : (level < 2 ? std::numeric_limits<double>::infinity() : std::abs(next - singular));
    singular = level == 0 ? added : next;
    value = smooth + singular;
    lost = 8.0 * Epsilon * magnitude;
    error = smoothChange + singularChange + lost;
    if (error <= std::max(relativeTolerance * std::abs(value), absolute / scale))
    {
      break;
    }
  }
  error *= scale;
  lost *= scale;
  return value * scale;
}

} // namespace radiometry
