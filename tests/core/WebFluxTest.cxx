// SPDX-License-Identifier: BSD-3-Clause
// The flux of luminaires through polygons: closed forms, additivity, the whole sphere, brute force.
#include "radiometry/geometry/AxialFlux.h"
#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/irradiance/SourceFlux.h"
#include "radiometry/irradiance/WebFlux.h"

#include <algorithm>
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <random>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

std::vector<double> Steps(double from, double to, int count)
{
  std::vector<double> angles;
  for (int k = 0; k < count; ++k)
  {
    angles.push_back(from + (to - from) * k / (count - 1));
  }
  return angles;
}

using WebPointer = std::shared_ptr<const CandelaWeb>;

/// A random web of any type: smooth, or wild from angle to angle, or with sharp beams.
WebPointer RandomWeb(std::mt19937& random, int kind)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const WebType type = static_cast<WebType>(1 + kind % 3);
  const int style = kind / 3 % 3;
  std::vector<double> h = Steps(-90, 90, 5 + static_cast<int>(random() % 20));
  std::vector<double> v = Steps(-90, 90, 5 + static_cast<int>(random() % 20));
  if (type == WebType::C)
  {
    h = random() % 3 == 0 ? std::vector<double>{ 0 } : Steps(0, random() % 2 ? 360 : 90, 9);
    v = Steps(0, random() % 2 ? 180 : 90, 7 + static_cast<int>(random() % 30));
  }
  std::vector<double> values(h.size() * v.size());
  for (double& value : values)
  {
    value = style == 0 ? 1.0 + 0.1 * unit(random) : (style == 1 ? unit(random) : (unit(random) < 0.1));
  }
  values[values.size() / 2] = 1.0;
  return std::make_shared<CandelaWeb>(type, h, v, values);
}

struct Frame
{
  Vec3 Axis, Reference;
};

Frame RandomFrame(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const Vec3 axis = Normalized({ normal(random), normal(random), normal(random) });
  const Vec3 other{ normal(random), normal(random), normal(random) };
  return { axis, Normalized(other - Dot(other, axis) * axis) };
}

double Flux(const WebFlux& web, const std::vector<Vec3>& polygon)
{
  double error = 0.0;
  const double flux = web.OnPolygon(polygon.data(), polygon.size(), error);
  EXPECT_GE(error, 0.0);
  return flux;
}

const int Faces[12][3] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 },
  { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };

/// The flux through the sides of a box about the light, as twelve triangles that face inward.
double ThroughBox(const WebFlux& web, const Vec3& low, const Vec3& high, const Frame& turn)
{
  const Vec3 y = Cross(turn.Axis, turn.Reference);
  double sum = 0.0;
  for (const auto& face : Faces)
  {
    std::vector<Vec3> corners;
    for (const int k : face)
    {
      const Vec3 p{ k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z };
      corners.push_back(p.x * turn.Reference + p.y * y + p.z * turn.Axis);
    }
    if (SolidAngle(corners.data(), 3) < 0.0)
    {
      std::swap(corners[1], corners[2]);
    }
    sum += Flux(web, corners);
  }
  return sum;
}

TEST(WebFlux, IsotropicIsTheSolidAngle)
{
  const WebFlux web(std::make_shared<CandelaWeb>(WebType::C, std::vector<double>{ 0 },
                      Steps(0, 180, 19), std::vector<double>(19, 3.0)),
    { 0, 0, -1 }, { 1, 0, 0 });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 400; ++k)
  {
    const double scale = std::pow(10.0, -4.0 * std::fabs(unit(random)));
    const Vec3 c{ unit(random), unit(random), unit(random) };
    std::vector<Vec3> t;
    for (int i = 0; i < 3; ++i)
    {
      t.push_back(c + scale * Vec3{ unit(random), unit(random), unit(random) });
    }
    if (SolidAngle(t.data(), 3) < 0.0)
    {
      std::swap(t[1], t[2]);
    }
    const double omega = SolidAngle(t.data(), 3);
    double error = 0.0;
    EXPECT_NEAR(web.OnPolygon(t.data(), 3, error), omega, 1e-12 * omega + 1e-15 * scale) << k;
    EXPECT_LT(error, 2e-11 * omega + 1e-12);
  }
}

TEST(WebFlux, ABoxAboutTheLightTakesAll)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.02, 1.0);
  for (int k = 0; k < 180; ++k)
  {
    const WebPointer data = RandomWeb(random, k);
    const Frame frame = k % 2 ? RandomFrame(random) : Frame{ { 0, 0, -1 }, { 1, 0, 0 } };
    const Frame turn = k % 4 < 2 ? RandomFrame(random) : Frame{ { 0, 0, 1 }, { 1, 0, 0 } };
    const WebFlux web(data, frame.Axis, frame.Reference);
    const bool close = k % 5 == 0; // one wall 1e-6 away: nearly a hemisphere each side of it
    const double wall = close ? 1e-6 : unit(random);
    const double all = ThroughBox(web, { -unit(random), -unit(random), -unit(random) },
      { unit(random), wall, unit(random) }, turn);
    EXPECT_NEAR(all / data->TotalFlux(), 1.0, close ? 1e-11 : 2e-12) << k;
  }
}

TEST(WebFlux, PartsSumToTheWhole)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int checked = 0;
  for (int k = 0; k < 3000; ++k)
  {
    static WebPointer data;
    if (k % 20 == 0)
    {
      data = RandomWeb(random, k / 20);
    }
    const Frame frame = RandomFrame(random);
    const WebFlux web(data, frame.Axis, frame.Reference);
    const double scale = std::pow(10.0, -7.0 * std::fabs(unit(random)));
    const Vec3 c{ unit(random), unit(random), unit(random) };
    Vec3 p[3];
    for (Vec3& q : p)
    {
      q = c + scale * Vec3{ unit(random), unit(random), unit(random) };
    }
    if (SolidAngle(p[0], p[1], p[2]) < 0.0)
    {
      std::swap(p[1], p[2]);
    }
    const Vec3 m = 0.5 * (p[0] + p[1]), n = 0.5 * (p[1] + p[2]), o = 0.5 * (p[2] + p[0]);
    double error = 0.0;
    const Vec3 all[3] = { p[0], p[1], p[2] };
    const double whole = web.OnPolygon(all, 3, error);
    double parts = 0.0;
    for (const auto& t : { std::array<Vec3, 3>{ p[0], m, o }, { m, p[1], n }, { o, n, p[2] }, { m, n, o } })
    {
      parts += web.OnPolygon(t.data(), 3, error);
    }
    // The middle points are rounded to 1e-16 of coordinates of order 1.
    const double rounding = 4e-16 * scale / std::min({ 1.0, Dot(p[0], p[0]), Dot(c, c) });
    EXPECT_LE(std::fabs(whole - parts), error + rounding)
      << k << " scale " << scale << " whole " << whole << " of " << SolidAngle(p[0], p[1], p[2]) << " at " << Length(c) << " error " << error;
    checked += whole > 0.0;
  }
  EXPECT_GT(checked, 1000);
}

TEST(WebFlux, CloseAboveTheInsideAnEdgeAndACorner)
{
  std::mt19937 random(14);
  const WebPointer round = std::make_shared<CandelaWeb>(
    WebType::C, Steps(0, 360, 13), Steps(0, 180, 19), std::vector<double>(13 * 19, 1.0));
  const Vec3 corners[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  for (int k = 0; k < 240; ++k)
  {
    const double height = std::pow(10.0, -1.0 - 11.0 * (k % 12) / 11.0);
    const Vec3 places[3] = { { 0.3, 0.4, height }, { 0.5, 0, height }, { 0, 0, height } };
    const Vec3 light = places[k % 3];
    // Axes square to the plane, within it (both poles then nearly on the rim), and any.
    const Frame frames[3] = { { { 0, 0, -1 }, { 1, 0, 0 } }, { { 1, 0, 0 }, { 0, 0, 1 } }, RandomFrame(random) };
    const Frame frame = frames[k / 3 % 3];
    Vec3 square[4];
    for (int i = 0; i < 4; ++i)
    {
      square[i] = corners[i] - light;
    }
    double error = 0.0;
    const double omega = SolidAngle(square, 4);
    EXPECT_NEAR(WebFlux(round, frame.Axis, frame.Reference).OnPolygon(square, 4, error), omega, 2e-14)
      << k << " height " << height;
    // A rough but continuous web: the square and its sixteen parts.
    std::vector<double> values(13 * 19);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = i >= 12 * 19 ? values[i - 12 * 19] : (i % 19 == 0 || i % 19 == 18 ? 0.5 : unit(random));
    }
    const WebFlux web(std::make_shared<CandelaWeb>(WebType::C, Steps(0, 360, 13), Steps(0, 180, 19), values),
      frame.Axis, frame.Reference);
    error = 0.0;
    const double whole = web.OnPolygon(square, 4, error);
    double parts = 0.0;
    for (int i = 0; i < 16; ++i)
    {
      const Vec3 low = Vec3{ 0.25 * (i % 4), 0.25 * (i / 4), 0 } - light;
      const Vec3 part[4] = { low, low + Vec3{ 0.25, 0, 0 }, low + Vec3{ 0.25, 0.25, 0 },
        low + Vec3{ 0, 0.25, 0 } };
      parts += web.OnPolygon(part, 4, error);
    }
    EXPECT_LE(std::fabs(whole - parts), error + 1e-15) << k << " height " << height;
    // Only where a pole of the web lies in the plane does rounding grow with closeness.
    EXPECT_LT(error, height < 1e-9 ? 1e-28 / (height * height) + 2e-11 : 2e-11) << k << " height " << height;
  }
}

TEST(WebFlux, PowersOfTheCosine)
{
  // A web of cos^n in fine steps against the closed boundary integral of the same.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double n : { 1.0, 2.0, 8.0, 40.0 })
  {
    std::vector<double> values;
    for (const double g : Steps(0, 90, 1801))
    {
      values.push_back(g < 90 ? std::pow(std::cos(g * Pi / 180), n) : 0.0);
    }
    const Frame frame = RandomFrame(random);
    const WebFlux web(
      std::make_shared<CandelaWeb>(WebType::C, std::vector<double>{ 0 }, Steps(0, 90, 1801), values),
      frame.Axis, frame.Reference);
    const AxialDistribution power(n, -1.0);
    for (int k = 0; k < 50; ++k)
    {
      Vec3 t[3];
      for (Vec3& p : t)
      {
        p = frame.Axis + Vec3{ unit(random), unit(random), unit(random) };
      }
      if (SolidAngle(t[0], t[1], t[2]) < 0.0)
      {
        std::swap(t[1], t[2]);
      }
      double error = 0.0;
      const double exact = AxialFlux(t, 3, frame.Axis, power);
      // Chords below the arcs of the cosine: (0.05 degrees)^2/12 times its curvature.
      const double chord = 1e-7 * n * n * SolidAngle(t[0], t[1], t[2]);
      EXPECT_NEAR(web.OnPolygon(t, 3, error), exact, chord + 1e-14) << n << " " << k;
    }
  }
}

/// An independent route: quartered until the rule of degree 7 on the parts agrees.
double Fine(const WebFlux& web, const Vec3& a, const Vec3& b, const Vec3& c, int depth)
{
  if (depth > 0)
  {
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    return Fine(web, a, ab, ca, depth - 1) + Fine(web, ab, b, bc, depth - 1) +
      Fine(web, ca, bc, c, depth - 1) + Fine(web, ab, bc, ca, depth - 1);
  }
  return SolidAngle(a, b, c) * web.Intensity(a + b + c);
}

TEST(WebFlux, MatchesBruteForce)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 90; ++k)
  {
    const Frame frame = RandomFrame(random);
    const WebFlux web(RandomWeb(random, k), frame.Axis, frame.Reference);
    const double scale = k % 3 == 0 ? 1.0 : (k % 3 == 1 ? 0.1 : 0.01);
    const Vec3 c{ unit(random), unit(random), unit(random) };
    Vec3 t[3];
    for (Vec3& p : t)
    {
      p = c + scale * Vec3{ unit(random), unit(random), unit(random) };
    }
    if (SolidAngle(t[0], t[1], t[2]) < 0.0)
    {
      std::swap(t[1], t[2]);
    }
    double error = 0.0;
    const double value = web.OnPolygon(t, 3, error);
    const double omega = SolidAngle(t[0], t[1], t[2]);
    const double coarse = Fine(web, t[0], t[1], t[2], 6);
    const double fine = Fine(web, t[0], t[1], t[2], 7);
    EXPECT_NEAR(value, fine, std::fabs(fine - coarse) + 2e-3 * scale * omega) << k << " " << omega;
    EXPECT_LT(error, 1e-9 * omega + 1e-13);
  }
}

TEST(WebFlux, NarrowBeamInALargeCellIsNotMissed)
{
  // A beam of 0.2 degrees through the middle of a wall of 100 m at 10 m.
  const std::vector<double> vertical{ 0, 0.1, 0.2, 10, 90 };
  const auto data = std::make_shared<CandelaWeb>(
    WebType::C, std::vector<double>{ 0 }, vertical, std::vector<double>{ 1, 0.5, 0, 0, 0 });
  for (const Vec3& axis : { Vec3{ 0, 0, 1 }, Normalized({ 0.3, 0.2, 1 }) })
  {
    const WebFlux web(data, axis, Normalized(Cross(axis, { 0, 1, 0 })));
    const std::vector<Vec3> wall{ { -50, -50, 10 }, { -50, 50, 10 }, { 50, 50, 10 }, { 50, -50, 10 } };
    EXPECT_NEAR(Flux(web, wall) / data->TotalFlux(), 1.0, 1e-11);
    const std::vector<Vec3> half{ { -50, -50, 10 }, { -50, 50, 10 }, { 50, 50, 10 } };
    const std::vector<Vec3> other{ { -50, -50, 10 }, { 50, 50, 10 }, { 50, -50, 10 } };
    EXPECT_NEAR((Flux(web, half) + Flux(web, other)) / data->TotalFlux(), 1.0, 1e-11);
  }
}

Light Luminaire(const WebPointer& web)
{
  Light light;
  light.Position = { 0, 0, 3 };
  light.Intensity = { 1.0 };
  light.Web = web;
  return light;
}

TEST(WebFlux, AHundredLumensAtOneMetre)
{
  const auto isotropic = std::make_shared<CandelaWeb>(
    WebType::C, std::vector<double>{ 0 }, Steps(0, 180, 19), std::vector<double>(19, 1.0));
  const SourceFlux point(Luminaire(isotropic), true, true);
  EXPECT_NEAR(100 / isotropic->TotalFlux() * point.AtPoint({ 0, 0, 2 }, { 0, 0, 1 }), 7.9577471546, 1e-9);
  std::vector<double> cosine;
  for (const double g : Steps(0, 90, 9001))
  {
    cosine.push_back(g < 90 ? std::cos(g * Pi / 180) : 0.0);
  }
  const auto lambert = std::make_shared<CandelaWeb>(
    WebType::C, std::vector<double>{ 0 }, Steps(0, 90, 9001), cosine);
  const SourceFlux panel(Luminaire(lambert), true, true);
  EXPECT_NEAR(100 / lambert->TotalFlux() * panel.AtPoint({ 0, 0, 2 }, { 0, 0, 1 }), 31.8309886184, 1e-6);
  // A cell's average tends to the point's value.
  const double h = 1e-4;
  const Vec3 cell[4] = { { -h, -h, 2 }, { h, -h, 2 }, { h, h, 2 }, { -h, h, 2 } };
  double error = 0.0;
  EXPECT_NEAR(100 / lambert->TotalFlux() * panel.OnPolygon(cell, 4, { 0, 0, 1 }, error) / (4 * h * h),
    31.8309886184, 3e-5);
}

TEST(WebFlux, TurnsWithItsLuminaire)
{
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 60; ++k)
  {
    const WebPointer data = RandomWeb(random, k);
    const Frame frame = RandomFrame(random);
    const WebFlux still(data, { 0, 0, -1 }, { 1, 0, 0 });
    const WebFlux turned(data, frame.Axis, frame.Reference);
    const Vec3 y = Cross(frame.Reference, frame.Axis);
    const auto turn = [&](const Vec3& v) { return v.x * frame.Reference + v.y * y - v.z * frame.Axis; };
    std::vector<Vec3> here, there;
    for (int i = 0; i < 3; ++i)
    {
      here.push_back({ normal(random), normal(random), normal(random) });
      there.push_back(turn(here.back()));
    }
    EXPECT_NEAR(still.Intensity(here[0]), turned.Intensity(there[0]), 1e-12);
    EXPECT_NEAR(still.Intensity(here[0]), data->Intensity(here[0]), 1e-13);
    EXPECT_NEAR(Flux(still, here), Flux(turned, there), 1e-12);
  }
}

TEST(WebFlux, LegacyAttenuationTakesTheWebToo)
{
  std::mt19937 random(3);
  const WebPointer data = RandomWeb(random, 0);
  Light light = Luminaire(data);
  const SourceFlux physics(light, true, true);
  light.Attenuation[2] = 2.0;
  const SourceFlux legacy(light, true, true);
  const Vec3 cell[3] = { { 0.1, 0.1, 0 }, { 0.4, 0.1, 0 }, { 0.1, 0.5, 0 } };
  double error = 0.0;
  const double exact = 0.5 * physics.OnPolygon(cell, 3, { 0, 0, 1 }, error);
  error = 0.0;
  EXPECT_NEAR(legacy.OnPolygon(cell, 3, { 0, 0, 1 }, error), exact, 1e-12 * exact + error);
  EXPECT_NEAR(legacy.AtPoint({ 0.2, 0.2, 0 }, { 0, 0, 1 }),
    0.5 * physics.AtPoint({ 0.2, 0.2, 0 }, { 0, 0, 1 }), 1e-15);
}

TEST(WebFlux, LegacyAttenuationFindsANarrowBeam)
{
  // A beam of half a degree on a wall of 100 m, without any fall-off: int I cos(theta) dA at 10 m is
  // int I r^2 d omega = 100 int I/cos^2(gamma) d omega.
  const auto data = std::make_shared<CandelaWeb>(WebType::C, std::vector<double>{ 0 },
    std::vector<double>{ 0, 0.25, 0.5, 90 }, std::vector<double>{ 1, 1, 0, 0 });
  Light light = Luminaire(data);
  light.Position = { 0.3, 0.2, 10 };
  light.Attenuation[0] = 1.0;
  light.Attenuation[2] = 0.0;
  const SourceFlux beam(light, true, true);
  const Vec3 wall[4] = { { -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 } };
  double error = 0.0;
  const double value = beam.OnPolygon(wall, 4, { 0, 0, 1 }, error);
  EXPECT_NEAR(value, 100.0 * data->TotalFlux(), 1e-4 * value + error);
  EXPECT_GT(value, 0.0);
  EXPECT_LT(error, 0.05 * value);
}

TEST(WebFlux, SmallCellsFarAwayKeepTheirDigits)
{
  // Cells of 1 m seen from 1e3 to 1e9 m, on lines of the grid and off them, at coordinates of that
  // size: their flux is intensity times solid angle.
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 400; ++k)
  {
    const double far = std::pow(10.0, 3 + 6 * unit(random));
    std::vector<double> values; // continuous at poles and all round
    for (const double c : Steps(0, 360, 13))
    {
      for (const double g : Steps(0, 180, 19))
      {
        values.push_back(1.2 + std::sin(g * Pi / 180) * std::cos(c * Pi / 180));
      }
    }
    const auto data =
      std::make_shared<CandelaWeb>(WebType::C, Steps(0, 360, 13), Steps(0, 180, 19), values);
    Light light = Luminaire(data);
    const Frame frame = k % 2 ? RandomFrame(random) : Frame{ { 0, 0, -1 }, { 1, 0, 0 } };
    light.Direction = frame.Axis;
    light.Reference = frame.Reference;
    light.Position = far * Vec3{ std::floor(3 * unit(random)), std::floor(3 * unit(random)), 1 };
    const SourceFlux source(light, true, true);
    const Vec3 cell[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    double error = 0.0;
    const double value = source.OnPolygon(cell, 4, { 0, 0, 1 }, error);
    const Vec3 middle{ 0.5, 0.5, 0 };
    const double omega = SolidAngle(cell, 4, light.Position);
    const WebFlux web(data, frame.Axis, frame.Reference);
    const double intensity = web.Intensity(middle - light.Position);
    // The intensity varies over the cell by its slope, of order 1 a radian.
    EXPECT_NEAR(value, intensity * omega, error + 4 * omega / far) << k << " " << far;
    EXPECT_LT(error, 1e-4 * omega) << k << " " << far;
  }
}

} // namespace
