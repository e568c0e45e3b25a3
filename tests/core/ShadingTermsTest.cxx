// SPDX-License-Identifier: BSD-3-Clause
// The whole lighting model in one place, every number worked out by hand.
#include "radiometry/shading/LightingModel.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;

} // namespace

TEST(ShadingTerms, EveryTermAtOnceByHand)
{
  // A point at the origin, N = z; the eye at (0, -3, 4), so V = (0, -0.6, 0.8).
  ShadingSample sample;
  sample.Point = { 0.0, 0.0, 0.0 };
  sample.Normal = { 0.0, 0.0, 2.0 };
  sample.Eye = { 0.0, -3.0, 4.0 };

  // A spot at (0, 6, 8)/2 = (0, 3, 4): r = 5, L = (0, 0.6, 0.8), straight at the viewer over z.
  // Its axis is 0.6 rad off; fall-off 1/(0.5 + 0.1 r + 0.04 r^2) = 1/2.
  DisplayLight spot;
  spot.Position = { { 0.0, 6.0, 8.0, 2.0 } };
  spot.SpotDirection = 3.0 *
    Vec3{ std::sin(0.6), -0.6 * std::cos(0.6), -0.8 * std::cos(0.6) };
  spot.CosCutoff = std::cos(0.7);
  spot.SpotExponent = 4.0;
  spot.Attenuation = { { 0.5, 0.1, 0.04 } };
  spot.Ambient = { 0.1, 0.2, 0.3 };
  spot.Diffuse = { 2.0, 3.0, 4.0 };
  spot.Specular = { 7.0, 6.0, 5.0 };
  const double spotFactor = 0.5 * std::pow(std::cos(0.6), 4.0);
  // A directional light from (3, 0, 4)/5 with colours of its own; the point light is off.
  DisplayLight sun;
  sun.Position = { { 30.0, 0.0, 40.0, 0.0 } };
  sun.Ambient = { 0.4, 0.0, 0.0 };
  sun.Diffuse = { 1.0, 1.0, 0.5 };
  sun.Specular = { 0.25, 0.5, 1.0 };
  DisplayLight off;
  off.Position = { { 0.0, 0.0, 1.0, 1.0 } };
  off.Ambient = { 9.0, 9.0, 9.0 };
  off.Enabled = false;

  DisplayMaterial front;
  front.Ambient = { 0.2, 0.4, 0.6 };
  front.Diffuse = { 0.5, 0.25, 0.75 };
  front.Specular = { 0.3, 0.6, 0.9 };
  front.Emission = { 0.01, 0.02, 0.03 };
  front.Shininess = 8.0;
  front.Alpha = 0.5;
  const Rgb global{ 0.05, 0.06, 0.07 };

  // Highlights: the spot is mirrored into V: N.H = R.V = 1. The sun: L + V = (0.6, -0.6, 1.6), so
  // N.H = 1.6/sqrt(3.28); R = (-0.6, 0, 0.8), R.V = 0.64. Both N.L are 0.8.
  const double blinn = std::pow(1.6 / std::sqrt(3.28), 8.0);
  const double phong = std::pow(0.64, 8.0);
  const double scale = 10.0 / (2.0 * Pi) * 0.8; // of Physical's highlight, with N.L
  const struct
  {
    ReflectionModel Reflection;
    double Diffuse, Spot, Sun;
  } models[] = { { ReflectionModel::BlinnPhong, 0.8, 1.0, blinn },
    { ReflectionModel::Phong, 0.8, 1.0, phong },
    { ReflectionModel::Physical, 0.8 / Pi, scale, scale * phong } };
  for (const auto& m : models)
  {
    LightingModel model;
    model.Reflection = m.Reflection;
    model.GlobalAmbient = global;
    const ShadedColor seen = Shade(model, { off, spot, sun }, front, DisplayMaterial(), sample);
    EXPECT_NEAR(seen.Color.r,
      0.01 + 0.2 * (0.05 + spotFactor * 0.1 + 0.4) + 0.5 * m.Diffuse * (spotFactor * 2.0 + 1.0) +
        0.3 * (m.Spot * spotFactor * 7.0 + m.Sun * 0.25),
      1e-14);
    EXPECT_NEAR(seen.Color.g,
      0.02 + 0.4 * (0.06 + spotFactor * 0.2) + 0.25 * m.Diffuse * (spotFactor * 3.0 + 1.0) +
        0.6 * (m.Spot * spotFactor * 6.0 + m.Sun * 0.5),
      1e-14);
    EXPECT_NEAR(seen.Color.b,
      0.03 + 0.6 * (0.07 + spotFactor * 0.3) + 0.75 * m.Diffuse * (spotFactor * 4.0 + 0.5) +
        0.9 * (m.Spot * spotFactor * 5.0 + m.Sun * 1.0),
      1e-14);
    EXPECT_EQ(seen.Alpha, 0.5);
  }
}
