// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SkyRadiance.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace radiometry
{
namespace
{

struct SkyType
{
  std::array<double, 5> Coefficients;
  const char* Name;
};

/// CIE S 011:2003, table 1: a, b, c, d, e.
const SkyType Table[SkyRadiance::Types] = {
  { { 4.0, -0.70, 0.0, -1.0, 0.00 }, "CIE standard overcast sky, steep gradation to the zenith" },
  { { 4.0, -0.70, 2.0, -1.5, 0.15 }, "Overcast, steep gradation, slightly brighter to the sun" },
  { { 1.1, -0.80, 0.0, -1.0, 0.00 }, "Overcast, moderate gradation" },
  { { 1.1, -0.80, 2.0, -1.5, 0.15 }, "Overcast, moderate gradation, slightly brighter to the sun" },
  { { 0.0, -1.00, 0.0, -1.0, 0.00 }, "Sky of uniform luminance" },
  { { 0.0, -1.00, 2.0, -1.5, 0.15 }, "Partly cloudy, no gradation, slightly brighter to the sun" },
  { { 0.0, -1.00, 5.0, -2.5, 0.30 }, "Partly cloudy, no gradation, brighter around the sun" },
  { { 0.0, -1.00, 10.0, -3.0, 0.45 }, "Partly cloudy, no gradation, distinct solar corona" },
  { { -1.0, -0.55, 2.0, -1.5, 0.15 }, "Partly cloudy, the sun obscured" },
  { { -1.0, -0.55, 5.0, -2.5, 0.30 }, "Partly cloudy, brighter around the sun" },
  { { -1.0, -0.55, 10.0, -3.0, 0.45 }, "White-blue sky, distinct solar corona" },
  { { -1.0, -0.32, 10.0, -3.0, 0.45 }, "CIE standard clear sky, low turbidity" },
  { { -1.0, -0.32, 16.0, -3.0, 0.30 }, "CIE standard clear sky, polluted atmosphere" },
  { { -1.0, -0.15, 16.0, -3.0, 0.30 }, "Cloudless turbid sky, broad solar corona" },
  { { -1.0, -0.15, 24.0, -2.8, 0.15 }, "White-blue turbid sky, broad solar corona" },
};

const SkyType& TypeOf(int type)
{
  if (type < 1 || type > SkyRadiance::Types)
  {
    throw InputError("SkyType", -1, type, "1 to 15");
  }
  return Table[type - 1];
}

double Gradation(const std::array<double, 5>& k, double cosZenith)
{
  return 1.0 + (cosZenith > 0.0 && k[0] != 0.0 ? k[0] * std::exp(k[1] / cosZenith) : 0.0);
}

double Indicatrix(const std::array<double, 5>& k, double cosSun)
{
  const double c = std::clamp(cosSun, -1.0, 1.0);
  const double circumsolar =
    k[2] != 0.0 ? k[2] * (std::exp(k[3] * std::acos(c)) - std::exp(0.5 * units::Pi * k[3])) : 0.0;
  return 1.0 + circumsolar + k[4] * c * c;
}

void CheckGround(double ground)
{
  if (!std::isfinite(ground) || ground < 0.0)
  {
    throw InputError(names::GroundRadiance, -1, ground, "a finite number, not negative");
  }
}

void CheckCoefficients(const std::array<double, 5>& k)
{
  for (std::size_t i = 0; i < k.size(); ++i)
  {
    if (!std::isfinite(k[i]))
    {
      throw InputError(
        names::SkyCoefficients, static_cast<long long>(i), k[i], "finite numbers a to e");
    }
  }
  // Each factor is monotonous but for e cos^2: its least value is found on a fine grid.
  double low = Gradation(k, 1.0);
  double indicatrix = Indicatrix(k, 1.0);
  for (int i = 0; i <= 1024; ++i)
  {
    low = std::min(low, Gradation(k, i / 1024.0));
    indicatrix = std::min(indicatrix, Indicatrix(k, i / 512.0 - 1.0));
  }
  if (k[1] > 0.0 || !(low >= 0.0) || !(indicatrix >= 0.0) || !(Gradation(k, 1.0) > 0.0))
  {
    throw InputError(names::SkyCoefficients, -1,
      "(" + std::to_string(k[0]) + ", " + std::to_string(k[1]) + ", " + std::to_string(k[2]) +
        ", " + std::to_string(k[3]) + ", " + std::to_string(k[4]) + ")",
      "a sky that is nowhere negative, with b not above 0");
  }
}

} // namespace

SkyFrame::SkyFrame(const Vec3& down, const Vec3& reference)
{
  this->Up = -Normalized(down);
  Vec3 north = reference - Dot(this->Up, reference) * this->Up;
  if (!(Length(north) > 1e-12 * Length(reference)))
  {
    const Vec3 other = std::fabs(this->Up.x) < 0.9 ? Vec3{ 1.0, 0.0, 0.0 } : Vec3{ 0.0, 1.0, 0.0 };
    north = other - Dot(this->Up, other) * this->Up;
  }
  this->North = Normalized(north);
  this->East = Cross(this->North, this->Up);
}

std::shared_ptr<const SkyRadiance> SkyRadiance::Uniform()
{
  return std::shared_ptr<const SkyRadiance>(new SkyRadiance);
}

std::shared_ptr<const SkyRadiance> SkyRadiance::Overcast(double groundRadiance)
{
  CheckGround(groundRadiance);
  std::shared_ptr<SkyRadiance> sky(new SkyRadiance);
  sky->Kind = SkyModel::TraditionalOvercast;
  sky->Ground = groundRadiance;
  return sky;
}

std::shared_ptr<const SkyRadiance> SkyRadiance::General(
  const std::array<double, 5>& coefficients, const Vec3& toSun, double groundRadiance)
{
  CheckGround(groundRadiance);
  CheckCoefficients(coefficients);
  if (!IsFinite(toSun) || !(Length(toSun) > 0.0))
  {
    throw InputError(names::SunDirection, -1, "zero or not finite", "a direction toward the sun");
  }
  std::shared_ptr<SkyRadiance> sky(new SkyRadiance);
  sky->Kind = SkyModel::General;
  sky->Ground = groundRadiance;
  sky->Abcde = coefficients;
  sky->Sun = Normalized(toSun);
  sky->AtZenith = Indicatrix(coefficients, sky->Sun.z) * Gradation(coefficients, 1.0);
  if (!(sky->AtZenith > 0.0))
  {
    throw InputError(names::SkyCoefficients, -1, sky->AtZenith, "light at the zenith");
  }
  return sky;
}

std::shared_ptr<const SkyRadiance> SkyRadiance::Map(
  int width, int height, int bands, std::vector<double> values)
{
  if (width < 1 || height < 1 || bands < 1 ||
    values.size() != static_cast<std::size_t>(width) * height * bands)
  {
    throw InputError(names::EnvironmentMap, -1,
      std::to_string(values.size()) + " values",
      std::to_string(height) + " rows of " + std::to_string(width) + " pixels of " +
        std::to_string(bands) + " bands");
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!std::isfinite(values[i]) || values[i] < 0.0)
    {
      throw InputError(names::EnvironmentMap,
        static_cast<long long>(i / static_cast<std::size_t>(bands)), values[i],
        "a finite radiance, not negative");
    }
  }
  std::shared_ptr<SkyRadiance> sky(new SkyRadiance);
  sky->Kind = SkyModel::Map;
  sky->BandCount = bands;
  sky->Columns = width;
  sky->Rows = height;
  sky->Pixels = std::move(values);
  return sky;
}

std::shared_ptr<const SkyRadiance> SkyRadiance::WithGround(double groundRadiance) const
{
  CheckGround(groundRadiance);
  std::shared_ptr<SkyRadiance> sky(new SkyRadiance(*this));
  if (this->Kind == SkyModel::General || this->Kind == SkyModel::TraditionalOvercast)
  {
    sky->Ground = groundRadiance;
  }
  return sky;
}

const std::array<double, 5>& SkyRadiance::TypeCoefficients(int type)
{
  return TypeOf(type).Coefficients;
}

const char* SkyRadiance::TypeName(int type)
{
  return TypeOf(type).Name;
}

bool SkyRadiance::NeedsSun(int type)
{
  return TypeOf(type).Coefficients[2] != 0.0 || TypeOf(type).Coefficients[4] != 0.0;
}

double SkyRadiance::At(const Vec3& direction, int band) const
{
  if (this->Kind == SkyModel::Uniform)
  {
    return 1.0;
  }
  if (this->Kind == SkyModel::Map)
  {
    const double zenith = std::acos(std::clamp(direction.z, -1.0, 1.0));
    const double azimuth = std::atan2(direction.x, direction.y);
    const int row = std::min(static_cast<int>(zenith / units::Pi * this->Rows), this->Rows - 1);
    const int column = std::clamp(
      static_cast<int>((0.5 + azimuth / (2.0 * units::Pi)) * this->Columns), 0, this->Columns - 1);
    const std::size_t pixel = static_cast<std::size_t>(row) * this->Columns + column;
    return this->Pixels[pixel * this->BandCount + (this->BandCount > 1 ? band : 0)];
  }
  if (direction.z < 0.0)
  {
    return this->Ground;
  }
  if (this->Kind == SkyModel::TraditionalOvercast)
  {
    return (1.0 + 2.0 * direction.z) / 3.0;
  }
  return Indicatrix(this->Abcde, Dot(direction, this->Sun)) * Gradation(this->Abcde, direction.z) /
    this->AtZenith;
}

} // namespace radiometry
