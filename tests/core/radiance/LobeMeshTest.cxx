// SPDX-License-Identifier: BSD-3-Clause
// A BRDF as a mesh: its shape, its integral, its refusals.
#include "radiometry/scene/InputError.h"
#include "radiometry/shading/LobeMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

Brdf Make(ReflectionModel model, double diffuse, double specular, double n)
{
  Brdf brdf;
  brdf.Reflection = model;
  brdf.Diffuse = diffuse;
  brdf.Specular = specular;
  brdf.Shininess = n;
  return brdf;
}

LobeShape At(double degrees, int resolution = 64)
{
  LobeShape shape;
  shape.Toward = TowardAtAngle(shape.Normal, degrees * Pi / 180.0);
  shape.Resolution = resolution;
  return shape;
}

} // namespace

TEST(LobeMesh, LambertIsAHemisphere)
{
  LobeShape shape = At(60.0);
  shape.Radius = 0.0; // 1 m for 1/sr
  const LobeMesh mesh = MakeLobeMesh(Make(ReflectionModel::Physical, 0.5, 0.0, 10.0), shape);
  for (const Vec3& p : mesh.Points)
  {
    EXPECT_NEAR(Length(p), 0.5 / Pi, 1e-15);
    EXPECT_GE(p.z, 0.0);
  }
  EXPECT_NEAR(MeshReflectance(mesh), 0.5, 1e-3);
  shape.Cosine = true; // ... and a sphere that touches the surface, by f cos
  for (const Vec3& p : MakeLobeMesh(Make(ReflectionModel::Physical, 0.5, 0.0, 10.0), shape).Points)
  {
    EXPECT_NEAR(Length(p - Vec3{ 0, 0, 0.25 / Pi }), 0.25 / Pi, 1e-12);
  }
}

TEST(LobeMesh, CarriesTheReflectance)
{
  // What the mesh reflects as it is drawn is the directional-hemispherical reflectance, however sharp.
  for (const double n : { 0.0, 1.0, 20.0, 1000.0, 1e5 })
  {
    for (const double degrees : { 0.0, 30.0, 60.0, 85.0 })
    {
      for (const ReflectionModel model : { ReflectionModel::Physical, ReflectionModel::Phong })
      {
        const Brdf brdf = Make(model, 0.2, 0.6, n);
        const double exact = *ClosedReflectance(brdf, std::cos(degrees * Pi / 180.0));
        const double coarse = MeshReflectance(MakeLobeMesh(brdf, At(degrees)));
        const double fine = MeshReflectance(MakeLobeMesh(brdf, At(degrees, 256)));
        EXPECT_NEAR(coarse / exact, 1.0, 0.015) << n << ' ' << degrees;
        EXPECT_NEAR(fine / exact, 1.0, 0.0025) << n << ' ' << degrees;
      }
    }
  }
  const Brdf blinn = Make(ReflectionModel::BlinnPhong, 0.2, 0.6, 400.0);
  for (const double degrees : { 0.0, 40.0, 80.0 })
  {
    const double exact = IntegrateReflectance(blinn, std::cos(degrees * Pi / 180.0)).Value;
    EXPECT_NEAR(MeshReflectance(MakeLobeMesh(blinn, At(degrees))) / exact, 1.0, 0.02) << degrees;
  }
}

TEST(LobeMesh, PeakAtTheMirrorDirection)
{
  LobeShape shape = At(50.0);
  const LobeMesh mesh = MakeLobeMesh(Make(ReflectionModel::Physical, 0.0, 0.5, 1000.0), shape);
  const Vec3 mirror{ -shape.Toward.x, -shape.Toward.y, shape.Toward.z };
  EXPECT_NEAR(Length(mesh.Points[0] - mirror), 0.0, 1e-12);
  EXPECT_NEAR(mesh.Values[0], 0.5 * 1002.0 / (2.0 * Pi), 1e-9);
  // Cells are small where the lobe is: neighbours differ by little of its height.
  double step = 0.0;
  for (std::size_t c = 0; c + 1 < mesh.Offsets.size(); ++c)
  {
    double least = 1e300, most = 0.0;
    for (std::int64_t k = mesh.Offsets[c]; k < mesh.Offsets[c + 1]; ++k)
    {
      const double v = mesh.Values[static_cast<std::size_t>(mesh.Corners[static_cast<std::size_t>(k)])];
      least = std::min(least, v);
      most = std::max(most, v);
    }
    step = std::max(step, (most - least) / mesh.Values[0]);
  }
  EXPECT_LT(step, 0.05);
}

TEST(LobeMesh, FrontsOutwardAndTurned)
{
  // Any normal: the same shape, turned; cells counter-clockwise from outside.
  const Brdf brdf = Make(ReflectionModel::Physical, 0.3, 0.3, 10.0);
  LobeShape shape = At(30.0, 16);
  for (const Vec3& normal : { Vec3{ 0, 0, 2 }, Vec3{ 1, 0, 0 }, Vec3{ -1, 2, -3 } })
  {
    shape.Normal = normal;
    shape.Toward = TowardAtAngle(normal, 0.6);
    const LobeMesh mesh = MakeLobeMesh(brdf, shape);
    EXPECT_NEAR(mesh.CosIncident, std::cos(0.6), 1e-14);
    double volume = 0.0;
    for (std::size_t c = 0; c + 1 < mesh.Offsets.size(); ++c)
    {
      const std::int64_t* id = &mesh.Corners[static_cast<std::size_t>(mesh.Offsets[c])];
      const auto p = [&](int k) { return mesh.Points[static_cast<std::size_t>(id[k])]; };
      volume += Dot(p(0), Cross(p(1), p(2)));
      EXPECT_GE(Dot(p(0), Cross(p(1), p(2))), -1e-15);
    }
    EXPECT_GT(volume, 0.0);
    for (const Vec3& w : mesh.Directions)
    {
      EXPECT_GE(Dot(w, Normalized(normal)), -1e-12);
    }
  }
}

TEST(LobeMesh, Logarithm)
{
  LobeShape shape = At(45.0);
  shape.Decades = 4.0;
  shape.Radius = 2.0;
  const LobeMesh mesh = MakeLobeMesh(Make(ReflectionModel::Physical, 0.1, 0.5, 1000.0), shape);
  for (std::size_t k = 0; k < mesh.Points.size(); ++k)
  {
    const double r = 2.0 * std::max(0.0, 1.0 + std::log10(mesh.Values[k] / mesh.Greatest) / 4.0);
    EXPECT_NEAR(Length(mesh.Points[k]), r, 1e-12);
  }
}

TEST(LobeMesh, Refuses)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Brdf good = Make(ReflectionModel::Physical, 0.3, 0.3, 10.0);
  EXPECT_THROW(MakeLobeMesh(Make(ReflectionModel::Physical, 0.3, 0.8, 10.0), At(10)), InputError);
  EXPECT_THROW(MakeLobeMesh(Make(ReflectionModel::Physical, nan, 0.3, 10.0), At(10)), InputError);
  EXPECT_THROW(MakeLobeMesh(Make(ReflectionModel::Physical, 0.3, 0.3, 1e6), At(10)), InputError);
  EXPECT_THROW(MakeLobeMesh(good, At(90)), InputError);
  EXPECT_THROW(MakeLobeMesh(good, At(120)), InputError);
  LobeShape shape = At(10);
  shape.Normal = {};
  EXPECT_THROW(MakeLobeMesh(good, shape), InputError);
  shape = At(10, 3);
  EXPECT_THROW(MakeLobeMesh(good, shape), InputError);
  shape = At(10);
  shape.Radius = nan;
  EXPECT_THROW(MakeLobeMesh(good, shape), InputError);
  // Nothing reflected is a point, not a NaN.
  const LobeMesh black = MakeLobeMesh(Make(ReflectionModel::Physical, 0.0, 0.0, 10.0), At(10));
  for (const Vec3& p : black.Points)
  {
    EXPECT_EQ(Length(p), 0.0);
  }
  shape.Radius = 1.0;
  shape.Decades = 3.0;
  for (const Vec3& p :
    MakeLobeMesh(Make(ReflectionModel::Physical, 0.0, 0.0, 10.0), shape).Points)
  {
    EXPECT_EQ(Length(p), 0.0);
  }
}
