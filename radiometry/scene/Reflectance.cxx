// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// The continued fraction of the incomplete beta function, by Lentz's method (Abramowitz and
/// Stegun 26.5.8). Converges fast for x < (a + 1)/(a + b + 2).
double BetaFraction(double a, double b, double x)
{
  constexpr double tiny = 1e-300;
  const auto nonZero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1.0;
  double d = 1.0 / nonZero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m < 100000; ++m)
  {
    const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
    d = 1.0 / nonZero(1.0 + even * d);
    c = nonZero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
    d = 1.0 / nonZero(1.0 + odd * d);
    c = nonZero(1.0 + odd / c);
    const double step = d * c;
    fraction *= step;
    if (std::abs(step - 1.0) < 1e-16)
    {
      break;
    }
  }
  return fraction;
}

/// I_x(1/2, b), regularised, for x = c^2, 1 - x = s^2.
double IncompleteBetaOfHalf(double b, double c, double s)
{
  if (c == 0.0)
  {
    return 0.0;
  }
  if (s == 0.0)
  {
    return 1.0;
  }
  const double x = c * c;
  const double front = c * std::exp(b * std::log1p(-x)) / BetaWithHalf(b);
  return x < 1.5 / (b + 2.5) ? front / 0.5 * BetaFraction(0.5, b, x)
                             : 1.0 - front / b * BetaFraction(b, 0.5, s * s);
}

} // namespace

double BetaWithHalf(double p)
{
  double product = 1.0;
  for (; p < 32.0; p += 1.0)
  {
    product *= (p + 0.5) / p;
  }
  const double x = 1.0 / p;
  const double series =
    1.0 + x * (1.0 / 8 + x * (1.0 / 128 + x * (-5.0 / 1024 + x * (-21.0 / 32768 +
    x * (399.0 / 262144 + x * (869.0 / 4194304 - x * (39325.0 / 33554432)))))));
  return product * std::sqrt(Pi * x) * series;
}

double LambertianBrdf(double rho)
{
  return rho / Pi;
}

double PhongLobeBrdf(
  double rho, double shininess, const Vec3& normal, const Vec3& in, const Vec3& out)
{
  const double cosIn = Dot(normal, in);
  if (!(cosIn > 0.0) || !(Dot(normal, out) > 0.0))
  {
    return 0.0;
  }
  const Vec3 mirrored = 2.0 * cosIn * normal - in;
  const double cosine = 1.0 - 0.5 * LengthSquared(mirrored - out);
  const double lobe =
    shininess == 0.0 ? 1.0 : (cosine > 0.0 ? std::pow(cosine, shininess) : 0.0);
  return rho * (shininess + 2.0) / (2.0 * Pi) * lobe;
}

double PhongLobeReflectance(double rho, double shininess, double cosTheta)
{
  const double c = std::clamp(cosTheta, 0.0, 1.0);
  const double s = std::sqrt((1.0 - c) * (1.0 + c));
  const double n = shininess;
  if (s == 0.0 || n == 0.0)
  {
    return rho; // n = 0 is a constant over the hemisphere: rho/pi
  }
  const double inside = 0.5 * c * (1.0 + IncompleteBetaOfHalf(0.5 * n + 1.0, c, s));
  const double cut = (n + 2.0) / (2.0 * Pi * (n + 1.0)) * BetaWithHalf(0.5 * n + 1.5) *
    std::exp((0.5 * n + 1.0) * std::log1p(-c * c));
  return rho * std::min(inside + cut, 1.0);
}

} // namespace radiometry
