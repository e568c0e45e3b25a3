// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SkyRadiance.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/SkyTable.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SolarPosition.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace radiometry;
using test::SkyLight;

namespace
{

const double Pi = std::acos(-1.0);

double Open(const Light& light, const Vec3& normal, double* relativeError = nullptr)
{
  std::vector<double> bands(light.Intensity.size());
  const double error = SkyTable(light).Irradiance(Normalized(normal), bands.data());
  if (relativeError)
  {
    *relativeError = error;
  }
  return bands[0];
}

/// Another route than the table's: Gauss-Legendre over elevation, split where the plane's horizon
/// turns, and over the azimuths that the plane sees, split at the sun's. Zenith (0, 0, 1).
double Brute(const SkyRadiance& sky, const Vec3& normal)
{
  const Vec3 n = Normalized(normal);
  const double out = std::hypot(n.x, n.y);
  const double toward = std::atan2(n.x, n.y);
  const Vec3& s = sky.ToSun();
  std::vector<double> cuts{ -0.5 * Pi, 0.0, 0.5 * Pi, std::atan2(s.z, std::hypot(s.x, s.y)) };
  cuts.push_back(std::atan2(out, std::fabs(n.z)));
  cuts.push_back(-cuts.back());
  std::sort(cuts.begin(), cuts.end());
  const LineRule& rule = GaussLegendre(128);
  const auto smooth = [](double x) { return x * x * (3.0 - 2.0 * x); }; // closes up on both ends
  const auto slope = [](double x) { return 6.0 * x * (1.0 - x); };
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
  {
    for (std::size_t i = 0; i < rule.Nodes.size(); ++i)
    {
      const double width = cuts[k + 1] - cuts[k];
      const double g = cuts[k] + width * smooth(rule.Nodes[i]);
      const double c = -std::tan(g) * n.z / out;
      const double half = c >= 1.0 ? 0.0 : (c <= -1.0 ? Pi : std::acos(c));
      std::vector<double> stops{ toward - half, toward + half };
      for (int turn = -1; turn <= 1; ++turn)
      {
        const double sun = std::atan2(s.x, s.y) + 2.0 * Pi * turn;
        if (sun > stops.front() && sun < toward + half)
        {
          stops.push_back(sun);
        }
      }
      std::sort(stops.begin(), stops.end());
      for (std::size_t m = 0; m + 1 < stops.size(); ++m)
      {
        for (std::size_t j = 0; j < rule.Nodes.size(); ++j)
        {
          const double span = stops[m + 1] - stops[m];
          const double a = stops[m] + span * smooth(rule.Nodes[j]);
          const Vec3 w{ std::cos(g) * std::sin(a), std::cos(g) * std::cos(a), std::sin(g) };
          sum += rule.Weights[i] * width * slope(rule.Nodes[i]) * rule.Weights[j] * span *
            slope(rule.Nodes[j]) * std::cos(g) * sky.At(w) * std::max(0.0, Dot(n, w));
        }
      }
    }
  }
  return sum;
}

TEST(SkyRadiance, FrameIsACompass)
{
  const SkyFrame frame({ 0, 0, -2 }, { 0, 3, 5 }); // north is +y whatever its height
  EXPECT_EQ(frame.North.y, 1.0);
  EXPECT_EQ(frame.East.x, 1.0);
  EXPECT_EQ(frame.Up.z, 1.0);
  const SkyFrame tilted({ 1, -2, 0.5 }, { 0.3, 0.1, 0.9 });
  EXPECT_NEAR(Dot(tilted.East, Cross(tilted.North, tilted.Up)), 1.0, 1e-15);
  const Vec3 v{ 0.3, -0.4, 0.7 };
  EXPECT_NEAR(Length(tilted.ToWorld(tilted.ToSky(v)) - v), 0.0, 1e-15);
}

TEST(SkyRadiance, CieSkiesAreOneAtTheZenith)
{
  for (int type = 1; type <= SkyRadiance::Types; ++type)
  {
    const auto sky =
      SkyRadiance::General(SkyRadiance::TypeCoefficients(type), { 0.3, 0.4, 0.8 });
    EXPECT_NEAR(sky->At({ 0, 0, 1 }), 1.0, 1e-14) << type;
    EXPECT_EQ(sky->At({ 1, 0, -1e-9 }), 0.0);
  }
  // Type 1 at the horizon and at 30 degrees, by hand: phi = 1, 1 + 4 e^{-1.4}, over 1 + 4 e^{-0.7}.
  const auto overcast = SkyRadiance::General(SkyRadiance::TypeCoefficients(1), { 0, 0, 1 });
  const double zenith = 1.0 + 4.0 * std::exp(-0.7);
  EXPECT_NEAR(overcast->At({ 1, 0, 0 }), 1.0 / zenith, 1e-15);
  EXPECT_NEAR(
    overcast->At({ std::sqrt(0.75), 0, 0.5 }), (1.0 + 4.0 * std::exp(-1.4)) / zenith, 1e-15);
  // Type 12 toward the sun at 45 degrees: f(0) = 1 + 10 (1 - e^{-1.5 pi}) + 0.45.
  const double h = std::sqrt(0.5);
  const auto clear = SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0, h, h });
  const auto f = [](double chi) {
    return 1.0 + 10.0 * (std::exp(-3.0 * chi) - std::exp(-1.5 * Pi)) +
      0.45 * std::cos(chi) * std::cos(chi);
  };
  const double phi = (1.0 - std::exp(-0.32 / h)) / (1.0 - std::exp(-0.32));
  EXPECT_NEAR(clear->At({ 0, h, h }), f(0.0) * phi / f(Pi / 4), 1e-13);
}

TEST(SkyRadiance, MapLooksFromInside)
{
  // 4 x 2: columns run from south over west, north, east as seen from inside, north in the middle.
  const auto map = SkyRadiance::Map(4, 2, 1, { 1, 2, 3, 4, 5, 6, 7, 8 });
  const double up = 0.5;
  EXPECT_EQ(map->At(Normalized({ -0.1, -1, up })), 1.0); // just west of south
  EXPECT_EQ(map->At(Normalized({ -0.1, 1, up })), 2.0);  // just west of north
  EXPECT_EQ(map->At(Normalized({ 0.1, 1, up })), 3.0);
  EXPECT_EQ(map->At(Normalized({ 0.1, -1, up })), 4.0);
  EXPECT_EQ(map->At(Normalized({ 0.1, 1, -up })), 7.0);
}

TEST(SkyRadiance, BadSkiesAreNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto array = [](const std::function<void()>& f) {
    try
    {
      f();
    }
    catch (const InputError& error)
    {
      return error.Array + " " + std::to_string(error.Index);
    }
    return std::string("nothing");
  };
  EXPECT_EQ(array([&] { SkyRadiance::Map(2, 1, 1, { 1.0, nan }); }), "EnvironmentMap 1");
  EXPECT_EQ(array([&] { SkyRadiance::Map(1, 1, 3, { 1.0, 0.0, -1.0 }); }), "EnvironmentMap 0");
  EXPECT_EQ(array([&] { SkyRadiance::Map(2, 2, 1, { 1.0 }); }), "EnvironmentMap -1");
  EXPECT_EQ(array([&] { SkyRadiance::Overcast(-0.1); }), "GroundRadiance -1");
  EXPECT_EQ(array([&] { SkyRadiance::General({ 1, -1, nan, -1, 0 }, { 0, 0, 1 }); }),
    "SkyCoefficients 2");
  EXPECT_EQ(array([&] { SkyRadiance::General({ -3, -1, 0, -1, 0 }, { 0, 0, 1 }); }),
    "SkyCoefficients -1");
  EXPECT_EQ(array([&] { SkyRadiance::General({ 1, -1, 0, -1, 0 }, { 0, 0, 0 }); }),
    "SunDirection -1");
  EXPECT_EQ(array([&] { SkyRadiance::TypeCoefficients(16); }), "SkyType -1");
}

TEST(SolarPosition, PublishedValues)
{
  // Reda and Andreas, NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024 degrees.
  PlaceAndTime when;
  when.Latitude = 39.742476;
  when.Longitude = -105.1786;
  when.Year = 2003;
  when.Month = 10;
  when.Day = 17;
  when.Hour = 12.0 + 30.0 / 60.0 + 30.0 / 3600.0;
  when.TimeZone = -7.0;
  const SunAngles angles = SolarPosition(when);
  EXPECT_NEAR(angles.Altitude, 90.0 - 50.11162, 0.01);
  EXPECT_NEAR(angles.Azimuth, 194.34024, 0.01);
}

TEST(SolarPosition, SeasonsAndBadDates)
{
  // At an equinox the noon sun stands at the co-latitude, at the June solstice 23.44 degrees higher.
  PlaceAndTime when;
  when.Latitude = 50.0;
  when.Month = 3;
  when.Day = 20;
  double highest = -90.0;
  for (int k = 0; k <= 200; ++k)
  {
    when.Hour = 11.0 + 0.01 * k;
    highest = std::max(highest, SolarPosition(when).Altitude);
  }
  EXPECT_NEAR(highest, 40.0, 0.3);
  when.Month = 6;
  when.Day = 21;
  for (int k = 0; k <= 200; ++k)
  {
    when.Hour = 11.0 + 0.01 * k;
    highest = std::max(highest, SolarPosition(when).Altitude);
  }
  EXPECT_NEAR(highest, 40.0 + 23.44, 0.03);
  when.Hour = 6.0;
  EXPECT_LT(SolarPosition(when).Azimuth, 90.0); // in the north-east
  when.Hour = 18.0;
  EXPECT_GT(SolarPosition(when).Azimuth, 270.0);
  when.Month = 2;
  when.Day = 30;
  EXPECT_THROW(SolarPosition(when), InputError);
}

TEST(SkyTable, HorizontalIrradianceIsConverged)
{
  for (int type = 1; type <= SkyRadiance::Types; ++type)
  {
    const auto sky = SkyRadiance::General(SkyRadiance::TypeCoefficients(type), { 0.5, -0.3, 0.35 });
    EXPECT_NEAR(HorizontalIrradiance(sky) / Brute(*sky, { 1e-9, 0, 1 }), 1.0, 1e-6) << type;
  }
}

TEST(SkyTable, ClosedForms)
{
  for (const Vec3 n : { Vec3{ 0, 0, 1 }, Vec3{ 1, 0, 0 }, Vec3{ 0.3, -0.7, -0.2 } })
  {
    EXPECT_NEAR(Open(SkyLight(SkyRadiance::Uniform(), { 3.0 }), n), 3.0 * Pi, 1e-13);
  }
  const Light overcast = SkyLight(SkyRadiance::Overcast());
  EXPECT_NEAR(Open(overcast, { 0, 0, 1 }), 7.0 * Pi / 9.0, 1e-14);
  EXPECT_NEAR(Open(overcast, { 1, 0, 0 }), Pi / 6.0 + 4.0 / 9.0, 1e-14); // 0.396 of the horizontal
  EXPECT_NEAR(Open(overcast, { 0, 0, -1 }), 0.0, 1e-14);
  // The sky of uniform luminance (CIE type 5) sends pi L down and half of it to a wall.
  const Light even = SkyLight(SkyRadiance::General(SkyRadiance::TypeCoefficients(5), { 0, 0, 1 }));
  EXPECT_NEAR(Open(even, { 0, 0, 1 }), Pi, 1e-12);
  for (const Vec3 n : { Vec3{ 1, 0, 0 }, Vec3{ 0.3, 0.7, 0 }, Vec3{ 0.3, -0.7, -0.2 } })
  {
    double error = 0.0;
    const double tilt = std::acos(Normalized(n).z);
    const double exact = Pi * (1.0 + std::cos(tilt)) / 2.0;
    const double value = Open(even, n, &error);
    EXPECT_LE(std::fabs(value - exact), error * exact);
    EXPECT_LE(error, 4e-5);
  }
  // Ground under an overcast sky: seen by a plane that looks down.
  EXPECT_NEAR(Open(SkyLight(SkyRadiance::Overcast(0.2)), { 0, 0, -1 }), 0.2 * Pi, 1e-14);
}

TEST(SkyTable, TableAgreesWithBruteForce)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const int type : { 1, 4, 9, 12, 15 })
  {
    const auto sky =
      SkyRadiance::General(SkyRadiance::TypeCoefficients(type), { 0.5, -0.3, 0.35 }, 0.1);
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 n = Normalized({ normal(random), normal(random), normal(random) });
      double error = 0.0;
      const double value = Open(SkyLight(sky), n, &error);
      const double brute = Brute(*sky, n);
      EXPECT_NEAR(value / brute, 1.0, error) << type;
      EXPECT_LE(error, 8e-5);
    }
  }
}

TEST(SkyTable, OvercastTableAgreesWithItsClosedForm)
{
  // The traditional overcast sky as a fine map: exact sums against the closed form.
  const int w = 512, h = 256;
  std::vector<double> values;
  for (int r = 0; r < h; ++r)
  {
    // Mean over the pixel of (1 + 2 sin g)/3: int sin g cos g dg/(sin top - sin bottom).
    const double top = std::sin(Pi * (0.5 - static_cast<double>(r) / h));
    const double bottom = std::sin(Pi * (0.5 - (r + 1.0) / h));
    values.insert(values.end(), w, r < h / 2 ? (1.0 + top + bottom) / 3.0 : 0.0);
  }
  const Light map = SkyLight(SkyRadiance::Map(w, h, 1, values));
  const Light sky = SkyLight(SkyRadiance::Overcast());
  for (const Vec3 n : { Vec3{ 0, 0, 1 }, Vec3{ 1, 0.2, 0 }, Vec3{ 0.5, -1, 0.4 }, Vec3{ 0.2, 1, -0.5 } })
  {
    double error = 0.0;
    const double value = Open(map, n, &error);
    // The radiance is even over each pixel, 1/81 rad high: (1/81)^2/12, and some from the edges.
    EXPECT_NEAR(value / Open(sky, n), 1.0, 4e-5);
    EXPECT_LE(error, 1e-5);
  }
}

TEST(SkyTable, CoarseMapsAreExact)
{
  // One pixel is a uniform sky; two rows are a bright and a dark half.
  for (const Vec3 n : { Vec3{ 0, 0, 1 }, Vec3{ 0.6, 0, 0.8 }, Vec3{ 0.1, 0.9, -0.4 } })
  {
    EXPECT_NEAR(Open(SkyLight(SkyRadiance::Map(1, 1, 1, { 2.0 })), n), 2.0 * Pi, 1e-6);
    const double c = Normalized(n).z;
    EXPECT_NEAR(Open(SkyLight(SkyRadiance::Map(1, 2, 1, { 2.0, 1.0 })), n),
      Pi * (1.0 + c) + 0.5 * Pi * (1.0 - c), 1e-6);
  }
}

TEST(SkyTable, SumOfTwoMapsIsTheMapOfTheSum)
{
  // Blocks of pixels (a map of 1024 rows would be gathered), a hot pixel, three bands.
  const int w = 96, h = 600;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> a, b, sum;
  for (int k = 0; k < w * h * 3; ++k)
  {
    a.push_back(uniform(random));
    b.push_back(k / 3 == w * 100 + 17 ? 1e6 : uniform(random));
    sum.push_back(a[k] + b[k]);
  }
  const std::vector<double> ones{ 1, 1, 1 };
  const SkyTable first(SkyLight(SkyRadiance::Map(w, h, 3, a), ones));
  const SkyTable second(SkyLight(SkyRadiance::Map(w, h, 3, b), ones));
  const SkyTable both(SkyLight(SkyRadiance::Map(w, h, 3, sum), ones));
  for (const Vec3 n : { Vec3{ 0, 0, 1 }, Vec3{ 0.6, 0, 0.8 }, Vec3{ 0.1, 0.9, -0.4 } })
  {
    double x[3], y[3], z[3];
    first.Irradiance(Normalized(n), x);
    second.Irradiance(Normalized(n), y);
    both.Irradiance(Normalized(n), z);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(z[k], x[k] + y[k], 1e-10 * z[k]);
    }
  }
}

TEST(SkyView, DrawsByRadianceTimesCosine)
{
  // The mean weight is 1, and the mean of any function of the direction its product integral.
  std::vector<double> values(64 * 32, 0.1);
  values[5 * 64 + 40] = 5000.0;
  for (const auto& sky : { SkyRadiance::Uniform(), SkyRadiance::Overcast(0.2),
         SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0.5, -0.3, 0.35 }),
         SkyRadiance::Map(64, 32, 1, values) })
  {
    const SkyTable table(SkyLight(sky));
    for (const Vec3 n : { Vec3{ 0, 0, 1 }, Vec3{ 1, 0, 0 }, Normalized({ 0.2, 0.5, -0.3 }) })
    {
      SkyView view;
      view.Look(table, n);
      double weight = 0.0;
      double square = 0.0;
      Vec3 mean;
      const int count = 1 << 14;
      for (int k = 0; k < count; ++k)
      {
        const auto u = SobolSequence(11)(static_cast<std::uint32_t>(k));
        const SkyView::Sample s = view.Draw(u[0], u[1]);
        weight += s.Weight / count;
        square += s.Weight * s.Weight / count;
        mean += s.Weight / count * s.Direction;
      }
      EXPECT_LT(square, 1.2);
      EXPECT_NEAR(weight, 1.0, 3.0 * std::sqrt((square - weight * weight) / count));
      if (sky->Model() == SkyModel::Uniform)
      {
        EXPECT_NEAR(Length(mean - 2.0 / 3.0 * n), 0.0, 2e-3);
      }
    }
  }
}

} // namespace
