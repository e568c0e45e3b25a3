// SPDX-License-Identifier: BSD-3-Clause
// Candela webs: symmetry, interpolation, the flux of types C, B and A against closed forms.
#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
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
    angles.push_back(count == 1 ? from : from + (to - from) * k / (count - 1));
  }
  return angles;
}

/// A web of a function of the direction in the luminaire's frame.
CandelaWeb Make(WebType type, const std::vector<double>& horizontal,
  const std::vector<double>& vertical, const std::function<double(const Vec3&)>& f)
{
  // Any valid web of the type tells the directions of its angles.
  const CandelaWeb frame(type, type == WebType::C ? std::vector<double>{ 0 } : Steps(-90, 90, 2),
    type == WebType::C ? Steps(0, 180, 2) : Steps(-90, 90, 2),
    std::vector<double>(type == WebType::C ? 2 : 4, 1.0));
  std::vector<double> values;
  for (const double h : horizontal)
  {
    for (const double v : vertical)
    {
      values.push_back(f(frame.DirectionOf(h, v)));
    }
  }
  return CandelaWeb(type, horizontal, vertical, values);
}

double Lambert(const Vec3& d) { return std::max(0.0, -d.z); }

TEST(CandelaWeb, FluxOfConstantWebs)
{
  const CandelaWeb sphere(WebType::C, { 0 }, Steps(0, 180, 37), std::vector<double>(37, 7.0));
  EXPECT_NEAR(sphere.TotalFlux(), 4 * Pi, 1e-14);
  EXPECT_EQ(sphere.GetGreatest(), 7.0);
  const CandelaWeb half(WebType::C, Steps(0, 360, 13), Steps(0, 90, 10), std::vector<double>(130, 2.0));
  EXPECT_NEAR(half.TotalFlux(), 2 * Pi, 1e-14);
  for (const WebType type : { WebType::B, WebType::A })
  {
    const CandelaWeb web(type, Steps(-90, 90, 19), Steps(-90, 90, 7), std::vector<double>(133, 2.0));
    EXPECT_NEAR(web.TotalFlux(), 2 * Pi, 1e-14);
    const CandelaWeb quarter(type, Steps(0, 90, 19), Steps(0, 90, 7), std::vector<double>(133, 2.0));
    EXPECT_NEAR(quarter.TotalFlux(), 2 * Pi, 1e-14);
    EXPECT_EQ(quarter.GetHorizontal().size(), 37u);
    EXPECT_EQ(quarter.GetVertical().front(), -90.0);
    // A part of the range: sine of latitude times longitude; B's latitude is horizontal, A's vertical.
    const CandelaWeb part(type, Steps(-30, 30, 5), Steps(-60, 60, 5), std::vector<double>(25, 2.0));
    const double latitude = type == WebType::B ? 30 : 60;
    const double longitude = type == WebType::B ? 60 : 30;
    EXPECT_NEAR(part.TotalFlux(),
      2 * std::sin(latitude * Pi / 180) * 2 * longitude * Pi / 180, 1e-14);
  }
}

TEST(CandelaWeb, FluxIsExactForTheInterpolant)
{
  // I = a + b gamma: 2 pi (a (1 - cos g) + b (sin g - g cos g)) up to g = last angle, narrow or wide.
  for (const double last : { 180.0, 90.0, 10.0, 0.1, 1e-4 })
  {
    const double g = last * Pi / 180;
    std::vector<double> values;
    for (const double angle : Steps(0, last, 7))
    {
      values.push_back(1.0 - 0.5 * angle / last);
    }
    const CandelaWeb web(WebType::C, { 0 }, Steps(0, last, 7), values);
    const double versine = 2 * std::sin(g / 2) * std::sin(g / 2);
    const double moment = g < 0.01 ? g * g * g / 3 * (1 - g * g / 10) : std::sin(g) - g * std::cos(g);
    EXPECT_NEAR(web.TotalFlux() / (2 * Pi * (versine - 0.5 / g * moment)), 1.0, 1e-11) << last;
  }
}

TEST(CandelaWeb, TypeBIsNotTypeC)
{
  // The same light, a Lambertian one, given in each type of angles.
  const CandelaWeb c = Make(WebType::C, Steps(0, 360, 73), Steps(0, 90, 181), Lambert);
  const CandelaWeb b = Make(WebType::B, Steps(-90, 90, 361), Steps(-90, 90, 361), Lambert);
  const CandelaWeb a = Make(WebType::A, Steps(-90, 90, 361), Steps(-90, 90, 361), Lambert);
  EXPECT_NEAR(c.TotalFlux(), Pi, 1e-4);
  EXPECT_NEAR(b.TotalFlux(), Pi, 1e-4);
  EXPECT_NEAR(a.TotalFlux(), Pi, 1e-4);
  // Unsymmetric lights, so that a turned or mirrored axis shows.
  const auto lopsided = [](const Vec3& d) {
    return Lambert(d) * (1.0 + 0.5 * d.x + 0.3 * d.y + 0.2 * d.x * d.y);
  };
  const CandelaWeb lc = Make(WebType::C, Steps(0, 360, 181), Steps(0, 90, 181), lopsided);
  const CandelaWeb lb = Make(WebType::B, Steps(-90, 90, 361), Steps(-90, 90, 361), lopsided);
  const CandelaWeb la = Make(WebType::A, Steps(-90, 90, 361), Steps(-90, 90, 361), lopsided);
  EXPECT_NEAR(lb.TotalFlux() * lb.GetGreatest(), lc.TotalFlux() * lc.GetGreatest(), 2e-4);
  EXPECT_NEAR(la.TotalFlux() * la.GetGreatest(), lc.TotalFlux() * lc.GetGreatest(), 2e-4);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 300; ++k)
  {
    Vec3 d = Normalized({ normal(random), normal(random), -std::fabs(normal(random)) });
    for (const CandelaWeb* web : { &lc, &lb, &la })
    {
      EXPECT_NEAR(web->Intensity(d) * web->GetGreatest(), lopsided(d), 3e-4);
    }
  }
}

TEST(CandelaWeb, AnglesOfTheTypes)
{
  const auto expect = [](WebType type, double h, double v, const Vec3& d) {
    const CandelaWeb web(type, type == WebType::C ? std::vector<double>{ 0 } : Steps(-90, 90, 2),
      type == WebType::C ? Steps(0, 180, 2) : Steps(-90, 90, 2),
      std::vector<double>(type == WebType::C ? 2 : 4, 1.0));
    EXPECT_LT(Length(web.DirectionOf(h, v) - d), 1e-15) << static_cast<int>(type) << " " << h << " " << v;
  };
  for (const WebType type : { WebType::C, WebType::B, WebType::A })
  {
    expect(type, 0, 0, { 0, 0, -1 }); // the axis
  }
  expect(WebType::C, 0, 90, { 1, 0, 0 });
  expect(WebType::C, 90, 90, { 0, 1, 0 }); // counter-clockwise seen from above
  expect(WebType::C, 0, 180, { 0, 0, 1 });
  expect(WebType::B, 0, 90, { 1, 0, 0 });
  expect(WebType::B, 90, 0, { 0, -1, 0 }); // clockwise
  expect(WebType::A, 0, 90, { 1, 0, 0 });
  expect(WebType::A, 90, 0, { 0, -1, 0 });
}

TEST(CandelaWeb, Symmetries)
{
  const std::vector<double> vertical = Steps(0, 180, 19);
  const auto f = [](double c, double g) { // has the symmetry of four quadrants
    return std::sin(g) * (2 + std::cos(2 * c)) + 1.1 + std::cos(g);
  };
  const auto web = [&](const std::vector<double>& planes, const std::function<double(double, double)>& value) {
    std::vector<double> values;
    for (const double c : planes)
    {
      for (const double g : vertical)
      {
        values.push_back(value(c * Pi / 180, g * Pi / 180));
      }
    }
    return CandelaWeb(WebType::C, planes, vertical, values);
  };
  const auto same = [&](const CandelaWeb& x, const CandelaWeb& y) {
    EXPECT_NEAR(x.TotalFlux(), y.TotalFlux(), 1e-13);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 d{ normal(random), normal(random), normal(random) };
      EXPECT_NEAR(x.Intensity(d), y.Intensity(d), 1e-13);
    }
  };
  const CandelaWeb full = web(Steps(0, 360, 25), f);
  same(web(Steps(0, 90, 7), f), full);
  same(web(Steps(0, 180, 13), f), full);
  same(web(Steps(90, 270, 13), f), full);
  same(web(Steps(-90, 90, 13), f), full);
  same(web(Steps(0, 345, 24), f), full); // closed with its first plane
  // Halves that differ: 0..180 mirrors about the plane of C = 0, 90..270 about that of C = 90.
  const auto front = [](double c, double g) { return 2 + std::cos(c) * std::sin(g); };
  const auto right = [](double c, double g) { return 2 + std::sin(c) * std::sin(g); };
  same(web(Steps(0, 180, 13), front), web(Steps(0, 360, 25), front));
  same(web(Steps(90, 270, 13), right), web(Steps(0, 360, 25), right));
  same(web(Steps(-90, 90, 13), right), web(Steps(0, 360, 25), right));
  // One plane: the same all round.
  same(web({ 0 }, [](double, double g) { return 1 + std::cos(g); }),
    web(Steps(0, 360, 25), [](double, double g) { return 1 + std::cos(g); }));
}

TEST(CandelaWeb, InterpolatesAndIsContinuous)
{
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> values(13 * 10);
  for (double& value : values)
  {
    value = unit(random);
  }
  for (int j = 0; j < 13; ++j)
  {
    values[j * 10] = 0.5; // one value at the pole
    values[j * 10 + 9] = 0.0;
    values[12 * 10 + j % 10] = values[j % 10];
  }
  values[12 * 10 + 9] = 0.0;
  const CandelaWeb web(WebType::C, Steps(0, 360, 13), Steps(0, 90, 10), values);
  for (int j = 0; j < 13; ++j)
  {
    for (int i = 0; i < 10; ++i)
    {
      EXPECT_NEAR(web.IntensityAt(30 * j, 10 * i) * web.GetGreatest(), values[j * 10 + i], 1e-13);
    }
  }
  EXPECT_NEAR(web.IntensityAt(45, 35) * web.GetGreatest(),
    0.25 * (values[13] + values[14] + values[23] + values[24]), 1e-13);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k)
  {
    const Vec3 d = Normalized({ normal(random), normal(random), normal(random) });
    const Vec3 e = d + 1e-7 * Vec3{ normal(random), normal(random), normal(random) };
    // A slope of 1 in 10 degrees, and of 1 in psi, which the pole makes steep.
    EXPECT_NEAR(web.Intensity(d), web.Intensity(e), 1e-5 / std::max(1e-3, std::hypot(d.x, d.y)));
  }
  EXPECT_EQ(web.Intensity({ 0.1, 0.2, 0.3 }), 0.0); // above the last angle
}

TEST(CandelaWeb, RefusesWhatIsNoWeb)
{
  const auto fails = [](WebType type, std::vector<double> h, std::vector<double> v,
                       std::vector<double> values, const std::string& array, long long index) {
    try
    {
      CandelaWeb(type, h, v, values, "Web");
      ADD_FAILURE() << "accepted: " << array;
    }
    catch (const InputError& error)
    {
      EXPECT_EQ(error.Array, array);
      EXPECT_EQ(error.Index, index) << error.what();
    }
  };
  const double nan = std::nan("");
  fails(WebType::C, {}, { 0, 90 }, {}, "WebHorizontal", -1);
  fails(WebType::C, { 0 }, { 0 }, { 1 }, "WebVertical", -1);
  fails(WebType::C, { 0 }, { 0, 90, 80 }, { 1, 1, 1 }, "WebVertical", 2);
  fails(WebType::C, { 0 }, { 0, 190 }, { 1, 1 }, "WebVertical", 1);
  fails(WebType::C, { 0 }, { -90, 90 }, { 1, 1 }, "WebVertical", 0);
  fails(WebType::C, { 0 }, { 0, nan }, { 1, 1 }, "WebVertical", 1);
  fails(WebType::C, { 0, 45 }, { 0, 90 }, { 1, 1, 1, 1 }, "WebHorizontal", 1);
  fails(WebType::C, { 0 }, { 0, 90 }, { 1, 1, 1 }, "Web", -1);
  fails(WebType::C, { 0 }, { 0, 90 }, { 1, -1 }, "Web", 1);
  fails(WebType::C, { 0 }, { 0, 90 }, { 1, nan }, "Web", 1);
  fails(WebType::C, { 0 }, { 0, 90 }, { 0, 0 }, "Web", -1);
  fails(WebType::B, { 0 }, { 0, 90 }, { 1, 1 }, "WebHorizontal", -1);
  fails(WebType::B, { 0, 120 }, { 0, 90 }, { 1, 1, 1, 1 }, "WebHorizontal", 1);
  fails(WebType::A, { 0, 90 }, { 0, 120 }, { 1, 1, 1, 1 }, "WebVertical", 1);
  fails(static_cast<WebType>(4), { 0 }, { 0, 90 }, { 1, 1 }, "WebType", -1);
}

} // namespace
