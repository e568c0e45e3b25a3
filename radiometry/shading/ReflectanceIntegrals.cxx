// SPDX-License-Identifier: BSD-3-Clause
// The integrals of a BRDF, over coordinates in which its lobe is flat.
#include "radiometry/shading/Reflectance.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/shading/AdaptiveCubature.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr long long ReflectanceEvaluations = 200000;

/// A direction and the measure (sr, times what of f stands in it) that belongs to it.
struct WeightedDirection
{
  Vec3 Direction;
  double Mass = 0.0;
};
using SquareMap = std::function<WeightedDirection(double, double)>;

/// Two unit vectors that are square to the unit vector `axis` and to each other; the first in the
/// plane of `axis` and `toward` where they differ.
void Frame(const Vec3& axis, const Vec3& toward, Vec3& first, Vec3& second)
{
  second = Cross(axis, toward);
  if (Length(second) < 1e-12)
  {
    second = Cross(axis, std::abs(axis.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 });
  }
  second = Normalized(second);
  first = Cross(second, axis);
}

/// The cosine-weighted hemisphere; its mass is pi.
SquareMap CosineMap(const Vec3& N)
{
  Vec3 X, Y;
  Frame(N, N, X, Y);
  return [N, X, Y](double u, double v) {
    const double c = std::sqrt(u);
    const double s = std::sqrt(1.0 - u);
    const double psi = 2.0 * Pi * v;
    return WeightedDirection{ c * N + (s * std::cos(psi)) * X + (s * std::sin(psi)) * Y, Pi };
  };
}

/// The hemisphere alike in all directions; its mass is 2 pi.
SquareMap UniformMap(const Vec3& N)
{
  Vec3 X, Y;
  Frame(N, N, X, Y);
  return [N, X, Y](double u, double v) {
    const double s = std::sqrt((1.0 - u) * (1.0 + u));
    const double psi = 2.0 * Pi * v;
    return WeightedDirection{ u * N + (s * std::cos(psi)) * X + (s * std::sin(psi)) * Y, 2.0 * Pi };
  };
}

/// The part of the lobe max(R.w, 0)^n above the horizon of N, R the mirror image of `from`; its mass
/// is the lobe's integral. t = cos^(n + 1)(alpha) makes it flat, psi stops at the horizon.
/// `whole` is the part that the horizon does not reach (alpha < pi/2 - theta), else the rest.
SquareMap PhongMap(const Vec3& N, const Vec3& from, double n, bool whole)
{
  const double c = std::clamp(Dot(N, from), 0.0, 1.0);
  const double s = std::sqrt((1.0 - c) * (1.0 + c));
  const Vec3 R = 2.0 * c * N - from;
  Vec3 X, Y;
  Frame(R, N, X, Y);
  const double edge = s > 0.0 ? std::exp(0.5 * (n + 1.0) * std::log1p(-c * c)) : 0.0;
  const double low = whole ? edge : 0.0;
  const double high = whole ? 1.0 : edge;
  return [=](double u, double v) {
    // The cut part is taken by the cube: all t of sharp lobes lie near its upper end already.
    const double t = low + (high - low) * u;
    const double logCos = std::log(t) / (n + 1.0);
    const double cosine = std::exp(logCos);
    const double sine = std::sqrt(-std::expm1(2.0 * logCos));
    const double far = cosine * c / std::max(sine * s, 1e-300);
    const double psiMax = whole || far >= 1.0 ? Pi : std::acos(-far);
    const double psi = psiMax * (2.0 * v - 1.0);
    return WeightedDirection{ cosine * R + (sine * std::cos(psi)) * X +
        (sine * std::sin(psi)) * Y,
      2.0 * psiMax * (high - low) / (n + 1.0) };
  };
}

/// The lobe max(N.H, 0)^n in the coordinates of H; d omega = 4 (from.H) d omega_H.
SquareMap BlinnMap(const Vec3& N, const Vec3& from, double n)
{
  Vec3 X, Y;
  Frame(N, from, X, Y);
  return [=](double u, double v) {
    const double logCos = std::log(u) / (n + 1.0);
    const double cosine = std::exp(logCos);
    const double sine = std::sqrt(-std::expm1(2.0 * logCos));
    const double psi = Pi * (2.0 * v - 1.0);
    const Vec3 H = cosine * N + (sine * std::cos(psi)) * X + (sine * std::sin(psi)) * Y;
    const double projection = Dot(from, H);
    return WeightedDirection{ 2.0 * projection * H - from,
      projection > 0.0 ? 4.0 * projection * 2.0 * Pi / (n + 1.0) : 0.0 };
  };
}

void Add(IntegratedValue& sum, const SquareMap& map, double scale, double tolerance,
  long long evaluations, const std::function<double(const Vec3&)>& g)
{
  const CubatureResult part = IntegrateUnitSquare(
    [&](double u, double v) {
      const WeightedDirection d = map(u, v);
      return d.Mass > 0.0 ? d.Mass * g(d.Direction) : 0.0;
    },
    tolerance, evaluations);
  sum.Value += scale * part.Value;
  sum.Error += std::abs(scale) * part.Error;
}

/// scale times the integral of the lobe times g over the hemisphere of N.
void AddLobe(IntegratedValue& sum, const Brdf& brdf, const Vec3& N, const Vec3& from, double scale,
  double tolerance, long long evaluations, const std::function<double(const Vec3&)>& g)
{
  const double n = brdf.Shininess;
  if (std::isinf(n))
  {
    return;
  }
  if (n == 0.0)
  {
    Add(sum, UniformMap(N), scale, tolerance, evaluations, g);
    return;
  }
  if (brdf.Reflection == ReflectionModel::BlinnPhong)
  {
    Add(sum, BlinnMap(N, from, n), scale, tolerance, evaluations, g);
    return;
  }
  for (const bool whole : { true, false })
  {
    Add(sum, PhongMap(N, from, n, whole), scale, tolerance, evaluations / 2, g);
  }
}

bool IsMirror(const Brdf& brdf)
{
  return brdf.Reflection == ReflectionModel::Physical && brdf.Shininess >= MirrorShininess;
}

} // namespace

IntegratedValue IntegrateReflectance(
  const Brdf& brdf, double cosTheta, double relativeTolerance)
{
  CheckBrdf(brdf);
  const bool physical = brdf.Reflection == ReflectionModel::Physical;
  if (!(cosTheta >= 0.0 && cosTheta <= 1.0) || (!physical && cosTheta == 0.0))
  {
    throw InputError("cosTheta", -1, cosTheta,
      physical ? "a cosine in [0, 1]" : "a cosine in (0, 1]: the legacy models divide by it");
  }
  const Vec3 N{ 0.0, 0.0, 1.0 };
  const Vec3 in{ std::sqrt((1.0 - cosTheta) * (1.0 + cosTheta)), 0.0, cosTheta };
  IntegratedValue sum;
  Add(sum, CosineMap(N), brdf.Diffuse / Pi, relativeTolerance, ReflectanceEvaluations,
    [](const Vec3&) { return 1.0; });
  if (IsMirror(brdf))
  {
    sum.Value += brdf.Specular;
  }
  else if (brdf.Specular > 0.0)
  {
    const double scale = physical ? brdf.Specular * (brdf.Shininess + 2.0) / (2.0 * Pi)
                                  : brdf.Specular / (Pi * cosTheta);
    AddLobe(sum, brdf, N, in, scale, relativeTolerance, ReflectanceEvaluations,
      [](const Vec3& out) { return std::max(out.z, 0.0); });
  }
  return sum;
}

IntegratedValue IntegrateAlbedo(const Brdf& brdf, double relativeTolerance)
{
  CheckBrdf(brdf);
  // 2 rho(c) c dc by four Gauss points on each piece of [0, 1]; the error is what halving changes.
  constexpr double node[4] = { 0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
    0.93056815579702629 };
  constexpr double weight[4] = { 0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
    0.17392742256872693 };
  const auto rule = [&](int pieces) {
    IntegratedValue sum;
    for (int i = 0; i < 4 * pieces; ++i)
    {
      const double c = (i / 4 + node[i % 4]) / pieces;
      const IntegratedValue rho = IntegrateReflectance(brdf, c, 0.5 * relativeTolerance);
      sum.Value += 2.0 * weight[i % 4] * rho.Value * c / pieces;
      sum.Error += 2.0 * weight[i % 4] * rho.Error * c / pieces;
    }
    return sum;
  };
  IntegratedValue last = rule(1);
  for (int pieces = 2;; pieces *= 2)
  {
    IntegratedValue next = rule(pieces);
    const double change = std::abs(next.Value - last.Value);
    if (change <= 0.5 * relativeTolerance * next.Value || pieces >= 64)
    {
      next.Error += change;
      return next;
    }
    last = next;
  }
}

IntegratedValue ReflectedRadiance(const Brdf& brdf, const Vec3& normal, const Vec3& out,
  const std::function<double(const Vec3&)>& incident, double relativeTolerance,
  long long evaluations)
{
  CheckBrdf(brdf);
  const Vec3 N = IsFinite(normal) ? Normalized(normal) : Vec3{};
  const Vec3 V = IsFinite(out) ? Normalized(out) : Vec3{};
  if (N == Vec3{} || V == Vec3{})
  {
    throw InputError(N == Vec3{} ? "normal" : "out", -1, Length(N == Vec3{} ? normal : out),
      "a finite vector with a direction");
  }
  IntegratedValue sum;
  if (!(Dot(N, V) > 0.0))
  {
    return sum;
  }
  const auto radiance = [&](const Vec3& in) {
    const double value = incident(in);
    if (!std::isfinite(value))
    {
      throw InputError("incident radiance", -1, value, "a finite number");
    }
    return value;
  };
  if (brdf.Diffuse > 0.0)
  {
    Add(sum, CosineMap(N), brdf.Diffuse / Pi, relativeTolerance, evaluations / 2, radiance);
  }
  if (IsMirror(brdf) && brdf.Specular > 0.0)
  {
    sum.Value += brdf.Specular * radiance(2.0 * Dot(N, V) * N - V);
  }
  else if (brdf.Specular > 0.0 && brdf.Reflection == ReflectionModel::Physical)
  {
    AddLobe(sum, brdf, N, V, brdf.Specular * (brdf.Shininess + 2.0) / (2.0 * Pi),
      relativeTolerance, evaluations / 2,
      [&](const Vec3& in) { return std::max(Dot(N, in), 0.0) * radiance(in); });
  }
  else if (brdf.Specular > 0.0) // f cos(theta_in) has no cosine left
  {
    AddLobe(sum, brdf, N, V, brdf.Specular / Pi, relativeTolerance, evaluations / 2,
      [&](const Vec3& in) { return Dot(N, in) > 0.0 ? radiance(in) : 0.0; });
  }
  return sum;
}

} // namespace radiometry
