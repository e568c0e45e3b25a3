// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Nodes and weights of the 8-point Gauss-Legendre rule on [-1, 1], positive half.
constexpr std::array<double, 4> Node{ { 0.1834346424956498, 0.5255324099163290,
  0.7966664774136267, 0.9602898564975363 } };
constexpr std::array<double, 4> Weight{ { 0.3626837833783620, 0.3137066458778873,
  0.2223810344533745, 0.1012285362903763 } };

template <typename F>
double Integrate(double a, double b, int pieces, const F& f)
{
  double sum = 0.0;
  const double half = 0.5 * (b - a) / pieces;
  for (int p = 0; p < pieces; ++p)
  {
    const double middle = a + (2 * p + 1) * half;
    for (std::size_t i = 0; i < Node.size(); ++i)
    {
      sum += Weight[i] * half * (f(middle - half * Node[i]) + f(middle + half * Node[i]));
    }
  }
  return sum;
}

/// Integral over psi in [0, 2 pi] of max(0, A + B cos psi), B >= 0.
double ClampedCosineIntegral(double A, double B)
{
  if (A >= B)
  {
    return 2.0 * Pi * A;
  }
  if (A <= -B)
  {
    return 0.0;
  }
  const double psi = std::acos(-A / B);
  return 2.0 * (A * psi + std::sqrt((B - A) * (B + A)));
}

} // namespace

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
  // Inside alpha0 = pi/2 - theta the horizon cuts nothing and the integral over psi is
  // 2 pi cos(alpha) cos(theta): the integral over alpha is elementary.
  const double whole = 2.0 * Pi * c * -std::expm1((n + 2.0) * std::log(s)) / (n + 2.0);
  // Beyond, the lobe is cut; it is followed until it has fallen by exp(-45). alpha = alpha0 + w u^2
  // takes the power 3/2 out of the beginning.
  const double alpha0 = std::atan2(c, s);
  const double fall = std::exp(-45.0 / n);
  const double sinSquared = c * c - s * s * std::expm1(-90.0 / n);
  const double width = std::atan2(std::sqrt(sinSquared), s * fall) - alpha0;
  const auto cut = [&](double u) {
    const double alpha = alpha0 + width * u * u;
    const double sine = std::sin(alpha);
    const double power = std::exp(0.5 * n * std::log1p(-sine * sine));
    return 2.0 * width * u * power * sine * ClampedCosineIntegral(std::cos(alpha) * c, sine * s);
  };
  const double share = (n + 2.0) / (2.0 * Pi) * (whole + Integrate(0.0, 1.0, 32, cut));
  return rho * std::min(share, 1.0);
}

} // namespace radiometry
