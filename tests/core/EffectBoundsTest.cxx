// SPDX-License-Identifier: BSD-3-Clause
// What leaving an effect out of a picture changes at most: closed forms, and samples of the model.
#include "radiometry/shading/EffectBounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A square of 2 x 2 at the origin that faces +z, of reflectance 1 and without highlights.
BoundedSurface Floor()
{
  BoundedSurface surface;
  surface.Boxes = { { { -1.0, -1.0, 0.0 }, { 1.0, 1.0, 0.0 } } };
  surface.Peaks.Diffuse = { 1.0, 1.0, 1.0 };
  return surface;
}

DisplayLight PointAt(const Vec3& p, double intensity)
{
  DisplayLight light;
  light.Position = { { p.x, p.y, p.z, 1.0 } };
  light.Attenuation = { { 0.0, 0.0, 1.0 } };
  light.Diffuse = light.Specular = intensity * Rgb{ 1.0, 1.0, 1.0 };
  return light;
}

DisplayLight SpotAt(const Vec3& p, double degrees, double exponent)
{
  DisplayLight light = PointAt(p, 1.0);
  light.SpotDirection = { 0.0, 0.0, -1.0 };
  light.CosCutoff = std::cos(degrees * Pi / 180.0);
  light.SpotExponent = exponent;
  return light;
}

double Change(const Rgb& a, const Rgb& b)
{
  return std::max({ std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b) });
}

} // namespace

TEST(EffectBounds, PointLightGivesItsInverseSquareUnderIt)
{
  const LightingModel physical;
  EXPECT_DOUBLE_EQ(LightBound(physical, PointAt({ 0, 0, 2 }, 8.0), Floor()), 8.0 / 4.0 / Pi);
  LightingModel legacy;
  legacy.Reflection = ReflectionModel::Phong;
  EXPECT_DOUBLE_EQ(LightBound(legacy, PointAt({ 0, 0, 2 }, 8.0), Floor()), 2.0);
  EXPECT_EQ(LightBound(physical, PointAt({ 0.5, 0.5, 0.0 }, 1.0), Floor()), Infinity); // on it
  DisplayLight off = PointAt({ 0, 0, 2 }, 8.0);
  off.Enabled = false;
  EXPECT_EQ(LightBound(physical, off, Floor()), 0.0);
}

TEST(EffectBounds, BeamIsExact)
{
  DisplayLight beam;
  beam.Diffuse = { 3.0, 1.0, 0.5 };
  EXPECT_DOUBLE_EQ(LightBound({}, beam, Floor()), 3.0 / Pi);
  beam.Diffuse = { -3.0, 1.0, 0.5 };
  EXPECT_DOUBLE_EQ(LightBound({}, beam, Floor()), 3.0 / Pi); // negative light is light
}

TEST(EffectBounds, HighlightsGiveTheirPeak)
{
  BoundedSurface surface = Floor();
  surface.Peaks.Specular = { 0.5, 0.25, 0.0 };
  surface.Peaks.LeastShininess = surface.Peaks.GreatestShininess = 1e6;
  DisplayLight beam;
  EXPECT_DOUBLE_EQ(LightBound({}, beam, surface, { 0, 0, 1 }), 0.5 * (1e6 + 2.0) / 2.0 / Pi);
  LightingModel legacy;
  legacy.Reflection = ReflectionModel::BlinnPhong;
  EXPECT_DOUBLE_EQ(LightBound(legacy, beam, surface, { 0, 0, 1 }), 0.5);
  beam.Specular = {};
  EXPECT_EQ(LightBound({}, beam, surface, { 0, 0, 1 }), 0.0);
}

TEST(EffectBounds, SpotShapeIsWhatTheConeTakes)
{
  // Corners at 3: atan(sqrt(2)/3) = 25.2 degrees off the axis, of the ball about the box 28.1.
  const LightingModel model;
  EXPECT_EQ(SpotShapeBound(model, SpotAt({ 0, 0, 3 }, 40, 0), Floor()), 0.0);
  EXPECT_DOUBLE_EQ(SpotShapeBound(model, SpotAt({ 0, 0, 3 }, 10, 0), Floor()), 1.0 / 9.0 / Pi);
  const double most = SpotShapeBound(model, SpotAt({ 0, 0, 3 }, 40, 5), Floor());
  const double corner = (1.0 - std::pow(3.0 / std::sqrt(11.0), 5.0)) / 11.0 / Pi;
  EXPECT_GT(most, corner);
  EXPECT_LT(most, 2.0 * corner);
  // A spot that looks elsewhere gives nothing.
  DisplayLight away = SpotAt({ 0, 0, 3 }, 40, 0);
  away.SpotDirection = { 1.0, 0.0, 0.3 };
  EXPECT_EQ(LightBound(model, away, Floor()), 0.0);
  EXPECT_DOUBLE_EQ(SpotShapeBound(model, away, Floor()), 1.0 / 9.0 / Pi);
}

TEST(EffectBounds, AreaLightAndSky)
{
  const LightingModel model;
  DisplayLight panel;
  panel.Diffuse = { 5.0, 5.0, 5.0 };
  panel.Polygon = { { -0.5, -0.5, 10 }, { -0.5, 0.5, 10 }, { 0.5, 0.5, 10 }, { 0.5, -0.5, 10 } };
  EXPECT_NEAR(LightBound(model, panel, Floor()), 5.0 / Pi / (Pi * 100.0), 1e-15);
  for (Vec3& p : panel.Polygon)
  {
    p.z = 1e-9;
  }
  EXPECT_DOUBLE_EQ(LightBound(model, panel, Floor()), 5.0 / Pi); // a form factor ends at 1
  DisplayLight sky;
  auto uniform = std::make_shared<SkyQuadric>();
  uniform->Constant = { Pi, Pi, Pi };
  sky.Sky = uniform;
  sky.Diffuse = { 2.0, 2.0, 2.0 };
  EXPECT_DOUBLE_EQ(LightBound(model, sky, Floor()), 2.0);
}

TEST(EffectBounds, AttenuationIsTheGreaterOfTwoFallOffs)
{
  DisplayLight light = PointAt({ 0, 0, 2 }, 1.0);
  light.Attenuation = { { 1.0, 0.0, 0.0 } };
  EXPECT_DOUBLE_EQ(AttenuationBound({}, light, Floor(), 1.0), 1.0 / Pi);
  EXPECT_DOUBLE_EQ(AttenuationBound({}, light, Floor(), 0.01), 25.0 / Pi);
}

TEST(EffectBounds, LobeChangeIsClosed)
{
  EXPECT_EQ(LobeChange(0.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(LobeChange(1.0, 0.01), 0.01);
  EXPECT_DOUBLE_EQ(LobeChange(2.0, 0.01), 0.01); // (cos^2)' = -sin 2a
  EXPECT_DOUBLE_EQ(LobeChange(0.5, 0.04), 0.2);
  EXPECT_EQ(LobeChange(1e6, 0.1), 1.0);
  EXPECT_EQ(LobeChange(Infinity, 0.1), 0.0);
  const auto lobe = [](double a, double n) { return std::pow(std::max(std::cos(a), 0.0), n); };
  for (const double n : { 0.1, 0.5, 0.9, 1.0, 1.3, 1.7, 2.0, 5.0, 40.0, 1e4 })
  {
    for (const double turn : { 1e-4, 1e-3, 1e-2, 0.1, 0.7, 3.0 })
    {
      double most = 0.0;
      for (double a = 0.0; a < 2.0; a += 1e-4)
      {
        most = std::max(most, std::fabs(lobe(a, n) - lobe(a + turn, n)));
      }
      EXPECT_LE(most, LobeChange(n, turn) * (1.0 + 1e-12)) << n << ' ' << turn;
      if (n >= 2.0 && turn * std::sqrt(n) < 0.1)
      {
        EXPECT_GE(most, 0.95 * LobeChange(n, turn)) << n << ' ' << turn;
      }
    }
  }
}

TEST(EffectBounds, FarViewerIsAsGoodAsOneAtInfinity)
{
  BoundedSurface surface = Floor();
  surface.Peaks.Specular = { 1.0, 1.0, 1.0 };
  surface.Peaks.LeastShininess = surface.Peaks.GreatestShininess = 2.0;
  LightingModel legacy;
  legacy.Reflection = ReflectionModel::Phong;
  DisplayLight beam;
  const auto at = [&](double d) {
    return ViewerBound(legacy, beam, surface, { 0, 0, d }, { 0, 0, 1 });
  };
  EXPECT_NEAR(at(1e6), std::sqrt(2.0) / 1e6, 1e-12); // the angle of the corner
  EXPECT_DOUBLE_EQ(at(0.5), 1.0);
  legacy.Reflection = ReflectionModel::BlinnPhong;
  EXPECT_NEAR(at(1e6), std::sqrt(2.0) / 2e6, 1e-11); // H turns by half
  surface.Peaks.LeastShininess = surface.Peaks.GreatestShininess = 0.0;
  EXPECT_EQ(at(0.5), 0.0); // a lobe without a shape
  surface.Peaks.GreatestShininess = 5.0;
  EXPECT_DOUBLE_EQ(at(2.0), 1.0);
}

TEST(EffectBounds, NothingIsNeverNoNumber)
{
  BoundedSurface black = Floor();
  black.Peaks.Diffuse = {};
  const DisplayLight on = PointAt({ 0, 0, 0 }, 1.0); // an infinite fall-off, of nothing
  EXPECT_EQ(LightBound({}, on, black), 0.0);
  EXPECT_EQ(AttenuationBound({}, on, black, 1.0), 0.0);
  EXPECT_EQ(SpotShapeBound({}, SpotAt({ 0, 0, 0 }, 10, 1), black), 0.0);
  EXPECT_EQ(ViewerBound({}, on, black, {}, { 0, 0, 1 }), 0.0);
  const BoundedSurface none;
  EXPECT_EQ(LightBound({}, on, none), 0.0);
  DisplayLight nowhere = PointAt({ 0, 0, 2 }, 1.0);
  nowhere.SpotDirection = {};
  nowhere.CosCutoff = 0.5;
  EXPECT_FALSE(std::isnan(SpotShapeBound({}, nowhere, Floor())));
}

TEST(EffectBounds, RandomSamplesStayWithin)
{
  std::mt19937 engine(7);
  const auto in = [&engine](double a, double b) {
    return a + (b - a) * (static_cast<double>(engine()) / 4294967296.0);
  };
  const auto vector = [&](double a, double b) { return Vec3{ in(a, b), in(a, b), in(a, b) }; };
  double least = Infinity;
  for (int k = 0; k < 3000; ++k)
  {
    LightingModel model;
    model.Reflection = static_cast<ReflectionModel>(engine() % 3);
    BoundedSurface surface;
    const Vec3 low = vector(-1.0, 0.0);
    surface.Boxes = { { low, low + vector(0.0, 0.5) } };
    const double n = in(0.0, 1.0) < 0.2 ? in(0.0, 2.0) : in(0.0, 200.0);
    surface.Peaks.Specular = { 1.0, 1.0, 1.0 };
    surface.Peaks.Diffuse = { in(0, 1), in(0, 1), in(0, 1) };
    surface.Peaks.LeastShininess = surface.Peaks.GreatestShininess = n;
    DisplayLight light = PointAt(vector(-3.0, 3.0), 1.0);
    const double legacy = in(0.0, 1.0);
    if (legacy < 0.5)
    {
      light.Attenuation = { { in(0, 1), in(0, 1), in(0, 1) } };
    }
    light.SpotDirection = vector(-1.0, 1.0);
    if (in(0.0, 1.0) < 0.6)
    {
      light.CosCutoff = in(0.0, 1.0);
      light.SpotExponent = in(0.0, 1.0) < 0.5 ? 0.0 : in(0.0, 30.0);
      light.SmoothEdge = in(0.0, 1.0) < 0.5;
      light.CosInnerCutoff = in(light.CosCutoff, 1.0);
    }
    DisplayLight point = light;
    point.CosCutoff = -1.0;
    DisplayLight square = light;
    square.Attenuation = { { 0.0, 0.0, 1.0 } };
    const Vec3 eye = vector(-20.0, 20.0);
    const Vec3 viewer = Normalized(eye + vector(-1.0, 1.0));
    DisplayMaterial material;
    material.Diffuse = surface.Peaks.Diffuse;
    material.Specular = surface.Peaks.Specular;
    material.Shininess = n;
    const double all = LightBound(model, light, surface);
    const double shape = SpotShapeBound(model, light, surface);
    const double fall = AttenuationBound(model, light, surface, 1.0);
    const double view = ViewerBound(model, light, surface, eye, viewer);
    for (int s = 0; s < 20; ++s)
    {
      ShadingSample sample;
      const SurfaceBox& box = surface.Boxes[0];
      sample.Point = { in(box.Low.x, box.High.x), in(box.Low.y, box.High.y),
        in(box.Low.z, box.High.z) };
      sample.Normal = vector(-1.0, 1.0);
      sample.Eye = eye;
      sample.Viewer = viewer;
      const auto shade = [&](const DisplayLight& l, bool local) {
        LightingModel m = model;
        m.LocalViewer = local;
        return Shade(m, { l }, material, material, sample).Color;
      };
      const Rgb lit = shade(light, true);
      const auto within = [&](double change, double bound, const char* what) {
        EXPECT_LE(change, bound * (1.0 + 1e-9) + 1e-12) << what << ' ' << k;
        if (change > 0.0)
        {
          least = std::min(least, bound / change);
        }
      };
      within(Change(lit, {}), all, "light");
      within(Change(lit, shade(point, true)), shape, "shape");
      within(Change(lit, shade(square, true)), fall, "fall-off");
      within(Change(lit, shade(light, false)), view, "viewer");
    }
  }
  EXPECT_LT(least, 2.0); // and comes close
}
