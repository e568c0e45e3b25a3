// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SourceFlux.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/geometry/Quadrature.h"

#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

AxialDistribution MakeDistribution(const Light& light, bool spotShape)
{
  if (!Compiled(Effect::SpotShape) || light.Type != LightType::Spot || !spotShape)
  {
    return AxialDistribution(0.0, -1.0);
  }
  const auto versine = [](double exact, double cosine) {
    return exact >= 0.0 ? exact : 1.0 - cosine;
  };
  return AxialDistribution::FromVersines(light.Exponent,
    versine(light.VersineCutoff, light.CosCutoff), light.SmoothEdge,
    versine(light.VersineInnerCutoff, light.CosInnerCutoff));
}

} // namespace

SourceFlux::SourceFlux(const Light& light, bool spotShape, bool attenuation)
  : Source(light)
  , Distribution(MakeDistribution(light, spotShape))
  , Web(Compiled(Effect::CandelaWebs) && light.Web && light.Type == LightType::Point
        ? std::make_shared<WebFlux>(light.Web, light.Direction, light.Reference)
        : nullptr)
  , Legacy(Compiled(Effect::Attenuation) && attenuation &&
      light.Type != LightType::Directional && !light.InverseSquare())
{
}

bool SourceFlux::InFront(const Vec3& point, const Vec3& normal) const
{
  return this->Directional() ? Dot(normal, this->Source.Direction) < 0.0
                             : Dot(normal, this->Source.Position - point) > 0.0;
}

double SourceFlux::Falloff(double r) const
{
  const double* k = this->Source.Attenuation;
  return Compiled(Effect::Attenuation) && this->Legacy ? 1.0 / (k[0] + r * (k[1] + r * k[2]))
                                                       : 1.0 / (r * r);
}

double SourceFlux::AtPoint(const Vec3& point, const Vec3& normal) const
{
  if (this->Directional())
  {
    return std::fmax(0.0, -Dot(normal, this->Source.Direction));
  }
  const Vec3 toLight = this->Source.Position - point;
  const double r = Length(toLight);
  if (!(r > 0.0))
  {
    return 0.0; // the irradiance at the light itself is not defined
  }
  const double cosine = Dot(normal, toLight) / r;
  return cosine <= 0.0 ? 0.0
                       : cosine * this->Falloff(r) *
      this->Intensity(-toLight, r);
}

double SourceFlux::Intensity(const Vec3& p, double r) const
{
  return Compiled(Effect::CandelaWebs) && this->Web
    ? this->Web->Intensity(p)
    : this->Distribution.IntensityAt(Versine(p / r, this->Source.Direction));
}

double SourceFlux::OnPolygon(
  const Vec3* polygon, std::size_t count, const Vec3& normal, double& error) const
{
  if (count < 3 || !this->InFront(polygon[0], normal))
  {
    return 0.0;
  }
  if (this->Directional())
  {
    Vec3 area2;
    for (std::size_t k = 2; k < count; ++k)
    {
      area2 += Cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    }
    return std::fmax(0.0, -0.5 * Dot(area2, this->Source.Direction));
  }

  const bool legacy = Compiled(Effect::Attenuation) && this->Legacy;
  if (Compiled(Effect::CandelaWebs) && !legacy && this->Web)
  {
    return std::fmax(0.0, this->Web->OnPolygon(polygon, count, error, this->Source.Position));
  }
  if (!legacy)
  {
    double rounding = 0.0;
    const double flux = std::fmax(0.0,
      AxialFlux(polygon, count, this->Source.Direction, this->Distribution, this->Source.Position,
        &rounding));
    if (Compiled(Effect::SpotShape) && flux > 0.0 && !this->Distribution.Isotropic())
    {
      error += rounding;
      // Directions are rounded by eps: of a cone of half-angle a, that is eps/a of the flux.
      error += 4.0 * std::numeric_limits<double>::epsilon() * flux /
        std::sqrt(this->Distribution.VersineLimit());
    }
    return flux;
  }

  double sum = 0.0;
  const Vec3 first = polygon[0] - this->Source.Position;
  for (std::size_t k = 2; k < count; ++k)
  {
    const Vec3 second = polygon[k - 1] - this->Source.Position;
    const Vec3 third = polygon[k] - this->Source.Position;
    const double whole = this->Weighted(first, second, third);
    sum += this->Attenuated(first, second, third, whole, 0, 1e-9, error);
  }
  return sum;
}

/// int I f r^2 d omega over a triangle: the exact flux without attenuation, so that no narrow beam is
/// missed, times the mean of f r^2 weighted by the intensity.
double SourceFlux::Weighted(const Vec3& a, const Vec3& b, const Vec3& c) const
{
  const Vec3 triangle[3] = { a, b, c };
  double rounding = 0.0;
  const double flux = Compiled(Effect::CandelaWebs) && this->Web
    ? this->Web->OnPolygon(triangle, 3, rounding)
    : AxialFlux(triangle, 3, this->Source.Direction, this->Distribution);
  if (!(flux > 0.0))
  {
    return 0.0;
  }
  double weighted = 0.0;
  double weights = 0.0;
  double plain = 0.0;
  double plainWeights = 0.0;
  for (const TriangleRule::Node& q : TriangleRuleOfDegree(7).Nodes)
  {
    const Vec3 p = q.B0 * a + q.B1 * b + q.B2 * c;
    const double r = Length(p);
    const double density = q.Weight / (r * r * r);
    const double value = density * this->Intensity(p, r);
    const double factor = r * r * this->Falloff(r);
    weighted += value * factor;
    weights += value;
    plain += density * factor;
    plainWeights += density;
  }
  return flux * (weights > 0.0 ? weighted / weights : plain / plainWeights);
}

double SourceFlux::Attenuated(const Vec3& a, const Vec3& b, const Vec3& c, double whole, int depth,
  double tolerance, double& error) const
{
  const Vec3 ab = 0.5 * (a + b);
  const Vec3 bc = 0.5 * (b + c);
  const Vec3 ca = 0.5 * (c + a);
  const double parts[4] = { this->Weighted(a, ab, ca), this->Weighted(ab, b, bc),
    this->Weighted(ca, bc, c), this->Weighted(ab, bc, ca) };
  const double sum = parts[0] + parts[1] + parts[2] + parts[3];
  const double difference = std::fabs(sum - whole);
  constexpr int deepest = 7;
  if (difference <= tolerance * sum || depth >= deepest)
  {
    error += difference;
    return sum;
  }
  return this->Attenuated(a, ab, ca, parts[0], depth + 1, tolerance, error) +
    this->Attenuated(ab, b, bc, parts[1], depth + 1, tolerance, error) +
    this->Attenuated(ca, bc, c, parts[2], depth + 1, tolerance, error) +
    this->Attenuated(ab, bc, ca, parts[3], depth + 1, tolerance, error);
}

} // namespace radiometry
