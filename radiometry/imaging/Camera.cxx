// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/imaging/Camera.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace radiometry
{
namespace
{

void CheckFNumber(double fNumber)
{
  if (!(fNumber > 0.0) || !std::isfinite(fNumber))
  {
    throw InputError("FNumber", -1, fNumber, "a positive finite number");
  }
}

void CheckMagnification(double magnification)
{
  if (!(magnification >= 0.0) || !std::isfinite(magnification))
  {
    throw InputError("Magnification", -1, magnification, "a finite number of at least 0");
  }
}

/// Irradiance for unit radiance.
double CosFourth(double fNumber, double cosAlpha)
{
  const double c = cosAlpha > 0.0 ? cosAlpha : 0.0;
  const double a = c * c / fNumber;
  return 0.25 * units::Pi * a * a;
}

double ThinLens(double fNumber, double cosAlpha, double magnification)
{
  if (!(cosAlpha > 0.0))
  {
    return 0.0;
  }
  const double r = 0.5 / (fNumber * (1.0 + magnification));
  const double c2 = cosAlpha * cosAlpha;
  // All over 1 + T^2 = 1/cos^2: nothing overflows toward 90 degrees.
  const double r2 = r * r * c2;
  const double q = 1.0 - r2;
  const double s = std::sqrt(q * q + 4.0 * r2 * c2);
  // (s - q)/(2 s) without a difference of nearly equal numbers.
  return units::Pi * (q > 0.0 ? 2.0 * r2 * c2 / (s * (s + q)) : 0.5 * (s - q) / s);
}

} // namespace

double ImageIrradiance(double radiance, double fNumber, double cosAlpha)
{
  CheckFNumber(fNumber);
  return radiance * CosFourth(fNumber, cosAlpha);
}

std::vector<double> ImageIrradiance(const std::vector<double>& radiance, int bands, double fNumber,
  const std::vector<double>& cosAlpha)
{
  CheckFNumber(fNumber);
  std::vector<double> image(radiance.size());
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    image[k] = radiance[k] * CosFourth(fNumber, cosAlpha[k / static_cast<std::size_t>(bands)]);
  }
  return image;
}

void AddCosFourthSpread(const std::vector<double>& radiance, int bands, double fNumber,
  const std::vector<double>& cosAlpha, const std::vector<double>& meanCosFourth,
  std::vector<double>& errors)
{
  CheckFNumber(fNumber);
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    const std::size_t tuple = k / static_cast<std::size_t>(bands);
    if (!std::isnan(meanCosFourth[tuple]))
    {
      const double mean = 0.25 * units::Pi * meanCosFourth[tuple] / (fNumber * fNumber);
      errors[k] += radiance[k] * std::fabs(CosFourth(fNumber, cosAlpha[tuple]) - mean);
    }
  }
}

double ThinLensImageIrradiance(
  double radiance, double fNumber, double cosAlpha, double magnification)
{
  CheckFNumber(fNumber);
  CheckMagnification(magnification);
  return radiance * ThinLens(fNumber, cosAlpha, magnification);
}

double AplanaticImageIrradiance(double radiance, double fNumber, double magnification)
{
  CheckFNumber(fNumber);
  CheckMagnification(magnification);
  const double sine = 0.5 / (fNumber * (1.0 + magnification));
  if (sine > 1.0)
  {
    throw InputError("FNumber", -1, fNumber, "at least 1/2: no lens in air is faster");
  }
  return radiance * units::Pi * sine * sine;
}

double CosFourthDeviation(double fNumber, double cosAlpha, double magnification)
{
  CheckFNumber(fNumber);
  CheckMagnification(magnification);
  const double exact = ThinLens(fNumber, cosAlpha, magnification);
  return exact > 0.0 ? CosFourth(fNumber, cosAlpha) / exact - 1.0 : 0.0;
}

double ImageDistance(double focalLength, double distance)
{
  const double beyond = distance - focalLength;
  return beyond == 0.0 ? std::numeric_limits<double>::infinity()
                       : (std::isinf(distance) ? focalLength : focalLength * distance / beyond);
}

double Magnification(double focalLength, double distance)
{
  const double beyond = distance - focalLength;
  return beyond == 0.0 ? std::numeric_limits<double>::infinity() : focalLength / beyond;
}

} // namespace radiometry
