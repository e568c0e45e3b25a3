// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SolarPosition.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

using units::Degrees;
using units::Radians;

void Check(const char* name, double value, double least, double most, const char* expected)
{
  if (!(value >= least && value <= most))
  {
    throw InputError(name, -1, value, expected);
  }
}

/// Julian day of 0 h UTC (Meeus, eq. 7.1, Gregorian calendar).
double JulianDay(int year, int month, int day)
{
  const int y = month > 2 ? year : year - 1;
  const int m = month > 2 ? month : month + 12;
  const int century = static_cast<int>(std::floor(y / 100.0));
  return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + day + 2 - century +
    std::floor(century / 4.0) - 1524.5;
}

int DaysOf(int year, int month)
{
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  constexpr int days[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  return days[month - 1] + (month == 2 && leap ? 1 : 0);
}

/// Degrees by which the atmosphere lifts what stands at an altitude.
double Refraction(double altitude)
{
  const double t = std::tan(Radians(altitude));
  double seconds = 0.0;
  if (altitude > 85.0)
  {
    return 0.0;
  }
  if (altitude > 5.0)
  {
    seconds = 58.1 / t - 0.07 / (t * t * t) + 0.000086 / (t * t * t * t * t);
  }
  else if (altitude > -0.575)
  {
    seconds =
      1735.0 + altitude * (-518.2 + altitude * (103.4 + altitude * (-12.79 + altitude * 0.711)));
  }
  else
  {
    seconds = -20.774 / t;
  }
  return seconds / 3600.0;
}

} // namespace

SunAngles SolarPosition(const PlaceAndTime& when)
{
  Check("Latitude", when.Latitude, -90.0, 90.0, "degrees in [-90, 90]");
  Check("Longitude", when.Longitude, -180.0, 180.0, "degrees in [-180, 180]");
  Check("Year", when.Year, 1583, 9999, "a year of the Gregorian calendar");
  Check("Month", when.Month, 1, 12, "1 to 12");
  Check("Day", when.Day, 1, DaysOf(when.Year, when.Month), "a day of that month");
  Check("Hour", when.Hour, 0.0, 24.0, "hours in [0, 24]");
  Check("TimeZone", when.TimeZone, -14.0, 14.0, "hours in [-14, 14]");

  const double day =
    JulianDay(when.Year, when.Month, when.Day) + (when.Hour - when.TimeZone) / 24.0;
  const double t = (day - 2451545.0) / 36525.0;
  const double longitude = std::fmod(280.46646 + t * (36000.76983 + 0.0003032 * t), 360.0);
  const double anomaly = Radians(357.52911 + t * (35999.05029 - 0.0001537 * t));
  const double eccentricity = 0.016708634 - t * (0.000042037 + 0.0000001267 * t);
  const double center = std::sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) +
    std::sin(2.0 * anomaly) * (0.019993 - 0.000101 * t) + std::sin(3.0 * anomaly) * 0.000289;
  const double node = Radians(125.04 - 1934.136 * t);
  const double apparent = Radians(longitude + center - 0.00569 - 0.00478 * std::sin(node));
  const double obliquity =
    Radians(23.0 + (26.0 + (21.448 - t * (46.815 + t * (0.00059 - t * 0.001813))) / 60.0) / 60.0 +
      0.00256 * std::cos(node));
  const double declination = std::asin(std::sin(obliquity) * std::sin(apparent));

  const double y = std::tan(0.5 * obliquity) * std::tan(0.5 * obliquity);
  const double l = Radians(longitude);
  const double minutes = 4.0 *
    Degrees(y * std::sin(2.0 * l) - 2.0 * eccentricity * std::sin(anomaly) +
      4.0 * eccentricity * y * std::sin(anomaly) * std::cos(2.0 * l) -
      0.5 * y * y * std::sin(4.0 * l) - 1.25 * eccentricity * eccentricity * std::sin(2.0 * anomaly));
  const double solar =
    60.0 * (when.Hour - when.TimeZone) + minutes + 4.0 * when.Longitude; // minutes after midnight
  const double hour = Radians(0.25 * solar - 180.0);

  const double latitude = Radians(when.Latitude);
  const double east = -std::cos(declination) * std::sin(hour);
  const double north = std::cos(latitude) * std::sin(declination) -
    std::sin(latitude) * std::cos(declination) * std::cos(hour);
  const double up = std::sin(latitude) * std::sin(declination) +
    std::cos(latitude) * std::cos(declination) * std::cos(hour);
  SunAngles angles;
  angles.Altitude = Degrees(std::atan2(up, std::hypot(east, north)));
  angles.Altitude += Refraction(angles.Altitude);
  angles.Azimuth = Degrees(std::atan2(east, north));
  angles.Azimuth += angles.Azimuth < 0.0 ? 360.0 : 0.0;
  return angles;
}

Vec3 TowardSun(const SunAngles& angles)
{
  const double altitude = Radians(angles.Altitude);
  const double azimuth = Radians(angles.Azimuth);
  return { std::cos(altitude) * std::sin(azimuth), std::cos(altitude) * std::cos(azimuth),
    std::sin(altitude) };
}

} // namespace radiometry
