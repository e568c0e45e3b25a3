// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/EffectBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Of factors at least 0, one of which may be infinite: nothing of whatever is nothing.
double Product(double a, double b)
{
  return a == 0.0 || b == 0.0 ? 0.0 : a * b;
}

double Greatest(const Rgb& a, const Rgb& b)
{
  return std::max({ std::abs(a.r * b.r), std::abs(a.g * b.g), std::abs(a.b * b.b) });
}

Vec3 Middle(const SurfaceBox& box)
{
  return 0.5 * (box.Low + box.High);
}

/// Half of the box's diagonal: the radius of the ball about it.
double Radius(const SurfaceBox& box)
{
  return 0.5 * Length(box.High - box.Low);
}

/// Distance between two boxes; 0 where they meet.
double Distance(const SurfaceBox& a, const SurfaceBox& b)
{
  Vec3 gap;
  for (int c = 0; c < 3; ++c)
  {
    gap[c] = std::max({ 0.0, a.Low[c] - b.High[c], b.Low[c] - a.High[c] });
  }
  return Length(gap);
}

Vec3 PlaceOf(const DisplayLight& light)
{
  const auto& p = light.Position;
  return p[3] == 0.0 ? Vec3{ p[0], p[1], p[2] } : Vec3{ p[0], p[1], p[2] } / p[3];
}

double AngleBetween(const Vec3& a, const Vec3& b)
{
  return std::atan2(Length(Cross(a, b)), Dot(a, b));
}

/// The greatest angle between the direction from `from` to a place in the ball and the one to its
/// middle; pi within it.
double Spread(const Vec3& from, const SurfaceBox& box)
{
  const double r = Radius(box);
  const double d = Length(Middle(box) - from);
  return d > r ? std::asin(r / d) : Pi;
}

/// The shape of a spot (1: of others) at the angle `phi` off its axis; falls with phi.
double ShapeAt(const DisplayLight& light, double phi)
{
  DisplayLight cone = light;
  cone.Attenuation = { { 1.0, 0.0, 0.0 } };
  cone.SpotDirection = { 0.0, 0.0, 1.0 };
  return LightFactor(cone, 1.0, { std::sin(phi), 0.0, std::cos(phi) });
}

struct Range
{
  double Least;
  double Most;
};

Range ShapeIn(const DisplayLight& light, const SurfaceBox& box)
{
  if (light.Position[3] == 0.0 || light.CosCutoff <= -1.0)
  {
    return { 1.0, 1.0 };
  }
  constexpr double Rounding = 1e-9; // of angles: the cone's edge is a step
  const double angle = AngleBetween(light.SpotDirection, Middle(box) - PlaceOf(light));
  const double spread = Spread(PlaceOf(light), box) + Rounding;
  return { ShapeAt(light, std::min(Pi, angle + spread)),
    ShapeAt(light, std::max(0.0, angle - spread)) };
}

/// The greatest fall-off of a finite light over a box; 1 for directional lights.
double FallOffIn(const DisplayLight& light, const SurfaceBox& box)
{
  if (light.Position[3] == 0.0)
  {
    return 1.0;
  }
  const Vec3 p = PlaceOf(light);
  const double d = Distance({ p, p }, box);
  const double sum = light.Attenuation[0] + d * (light.Attenuation[1] + d * light.Attenuation[2]);
  return sum > 0.0 ? 1.0 / sum : Infinity;
}

/// The greatest of f(box).
template <typename F>
double Most(const BoundedSurface& surface, const F& f)
{
  double most = 0.0;
  for (const SurfaceBox& box : surface.Boxes)
  {
    most = std::max(most, f(box));
  }
  return most;
}

/// The greatest value of h.
double LobePeak(const LightingModel& model, const MaterialPeaks& peaks)
{
  return model.Reflection == ReflectionModel::Physical ? 0.5 * (peaks.GreatestShininess + 2.0)
                                                       : 1.0;
}

/// k_a A + k_d D + k_s S h at the greatest of each.
double TermsOf(const LightingModel& model, const DisplayLight& light, const MaterialPeaks& peaks,
  const LightTerms& terms)
{
  const double unit = model.Reflection == ReflectionModel::Physical ? 1.0 / Pi : 1.0;
  return Product(terms.Ambient, Greatest(peaks.Ambient, light.Ambient)) +
    Product(terms.Diffuse * unit, Greatest(peaks.Diffuse, light.Diffuse)) +
    Product(terms.Specular * unit,
      Product(LobePeak(model, peaks), Greatest(peaks.Specular, light.Specular)));
}

/// Of a sky of radiance 1 times its intensity, about any normal.
Rgb SkyPeak(const SkyQuadric& sky)
{
  const auto band = [&sky](double Rgb::*c) {
    double sum = std::abs(sky.Constant.*c);
    sum += std::hypot(sky.Linear[0].*c, sky.Linear[1].*c, sky.Linear[2].*c);
    sum += std::max({ std::abs(sky.Quadratic[0].*c), std::abs(sky.Quadratic[1].*c),
      std::abs(sky.Quadratic[2].*c) });
    for (int k = 3; k < 6; ++k)
    {
      sum += 0.5 * std::abs(sky.Quadratic[static_cast<std::size_t>(k)].*c);
    }
    return sum;
  };
  return { band(&Rgb::r), band(&Rgb::g), band(&Rgb::b) };
}

double AreaPeak(const DisplayLight& light, const BoundedSurface& surface)
{
  SurfaceBox around{ light.Polygon.front(), light.Polygon.front() };
  Vec3 twice;
  for (std::size_t k = 0; k < light.Polygon.size(); ++k)
  {
    const Vec3& p = light.Polygon[k];
    const Vec3& q = light.Polygon[(k + 1) % light.Polygon.size()];
    twice += Cross(p - light.Polygon.front(), q - light.Polygon.front());
    for (int c = 0; c < 3; ++c)
    {
      around.Low[c] = std::min(around.Low[c], p[c]);
      around.High[c] = std::max(around.High[c], p[c]);
    }
  }
  const double area = 0.5 * Length(twice);
  return Most(surface, [&](const SurfaceBox& box) {
    const double d = Distance(around, box);
    return d > 0.0 ? std::min(1.0, area / (Pi * d * d)) : 1.0;
  });
}

} // namespace

double LobeChange(double n, double turn)
{
  if (n == 0.0 || turn == 0.0)
  {
    return 0.0;
  }
  if (!(n >= 0.0) || std::isinf(n))
  {
    return 0.0; // no lobe at all
  }
  if (n < 1.0)
  {
    return std::min(1.0, std::pow(turn, n));
  }
  return std::min(1.0, std::sqrt(n) * std::pow((n - 1.0) / n, 0.5 * (n - 1.0)) * turn);
}

double LightBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, const LightTerms& terms)
{
  if (!light.Enabled || surface.Boxes.empty())
  {
    return 0.0;
  }
  const MaterialPeaks& peaks = surface.Peaks;
  if (light.Sky || !light.Polygon.empty())
  {
    const double unit = model.Reflection == ReflectionModel::Physical ? 1.0 / Pi : 1.0;
    const double diffuse = light.Sky
      ? Greatest(peaks.Diffuse, light.Diffuse * SkyPeak(*light.Sky))
      : Product(AreaPeak(light, surface), Greatest(peaks.Diffuse, light.Diffuse));
    return Product(terms.Diffuse * unit, diffuse);
  }
  const double sum = TermsOf(model, light, peaks, terms);
  return sum == 0.0 ? 0.0 : Product(sum, Most(surface, [&light](const SurfaceBox& box) {
    return Product(FallOffIn(light, box), ShapeIn(light, box).Most);
  }));
}

double SpotShapeBound(
  const LightingModel& model, const DisplayLight& light, const BoundedSurface& surface)
{
  return Product(TermsOf(model, light, surface.Peaks, {}),
    Most(surface, [&light](const SurfaceBox& box) {
      return Product(FallOffIn(light, box), 1.0 - ShapeIn(light, box).Least);
    }));
}

double AttenuationBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, double square)
{
  DisplayLight inverse = light;
  inverse.Attenuation = { { 0.0, 0.0, square } };
  return Product(TermsOf(model, light, surface.Peaks, {}),
    Most(surface, [&](const SurfaceBox& box) {
      return Product(std::max(FallOffIn(light, box), FallOffIn(inverse, box)),
        ShapeIn(light, box).Most);
    }));
}

double ViewerBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, const Vec3& eye, const Vec3& viewer)
{
  const double highlights = TermsOf(model, light, surface.Peaks, { 0.0, 0.0, 1.0 });
  if (highlights == 0.0 || light.Sky || !light.Polygon.empty())
  {
    return 0.0;
  }
  const MaterialPeaks& peaks = surface.Peaks;
  return Product(highlights, Most(surface, [&](const SurfaceBox& box) {
    const double turn =
      std::min(Pi, AngleBetween(eye - Middle(box), viewer) + Spread(eye, box));
    double ofLobe = turn;
    if (model.Reflection == ReflectionModel::BlinnPhong)
    {
      const bool finite = light.Position[3] != 0.0;
      const Vec3 toLight = finite ? PlaceOf(light) - Middle(box) : PlaceOf(light);
      const double between =
        AngleBetween(toLight, viewer) + (finite ? Spread(PlaceOf(light), box) : 0.0) + turn;
      ofLobe = between < Pi ? 0.5 * turn / std::cos(0.5 * between) : Pi;
    }
    // In between, the change falls with n up to 1, falls further and grows again: it is nowhere greater
    // than at an end or at 1. Toward 0 it is that of a step.
    const double least = peaks.LeastShininess;
    const double most = peaks.GreatestShininess;
    double change = std::max(LobeChange(least, ofLobe), LobeChange(most, ofLobe));
    if (least < most)
    {
      change = least == 0.0 ? 1.0 : std::max(change, LobeChange(1.0, ofLobe));
    }
    return Product(Product(FallOffIn(light, box), ShapeIn(light, box).Most), change);
  }));
}

} // namespace radiometry
