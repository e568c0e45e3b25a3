// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

namespace radiometry
{

/// A place and a moment.
struct PlaceAndTime
{
  double Latitude = 0.0;  // degrees, north positive, [-90, 90]
  double Longitude = 0.0; // degrees, east positive, [-180, 180]
  int Year = 2000;        // Gregorian calendar
  int Month = 6;          // 1 to 12
  int Day = 21;           // 1 to 31
  double Hour = 12.0;     // of the clock, with its fraction, [0, 24]
  double TimeZone = 0.0;  // hours that the clock is ahead of UTC, [-14, 14]
};

/// Where the sun stands, in degrees.
struct SunAngles
{
  double Altitude = 0.0; // above the horizon, refraction included
  double Azimuth = 0.0;  // clockwise from north, [0, 360)
};

/// The sun's position in the sky.
///   Model   the equations of the NOAA solar calculator: low-accuracy solar coordinates, equation of
///           time, refraction of a standard atmosphere
///   Limits  within 0.01 degrees of the full theory for the years 1950 to 2050, and within some
///           0.03 for 1800 to 2100; refraction within 0.02 degrees above 5 degrees of altitude
///   Source  Meeus, Astronomical Algorithms (1991), chapters 25 and 28
///   Fails   InputError naming the member that is out of range
SunAngles SolarPosition(const PlaceAndTime& when);

/// The direction toward the sun: East, North, Up.
Vec3 TowardSun(const SunAngles& angles);

} // namespace radiometry
