// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/SceneBuilder.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

/// Small meshes that the tests of the core share.
namespace test
{

struct Mesh
{
  std::vector<radiometry::Vec3> Points;
  std::vector<std::array<std::int32_t, 3>> Triangles;

  /// A parallelogram grid of 2 n m triangles with corner o and sides a, b; its front is along a x b.
  void AddGrid(const radiometry::Vec3& o, const radiometry::Vec3& a, const radiometry::Vec3& b,
    int n, int m)
  {
    using namespace radiometry;
    const auto first = static_cast<std::int32_t>(this->Points.size());
    for (int j = 0; j <= m; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        this->Points.push_back(o + (static_cast<double>(i) / n) * a + (static_cast<double>(j) / m) * b);
      }
    }
    for (int j = 0; j < m; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const std::int32_t p = first + j * (n + 1) + i;
        this->Triangles.push_back({ p, p + 1, p + n + 2 });
        this->Triangles.push_back({ p, p + n + 2, p + n + 1 });
      }
    }
  }

  /// A closed axis-aligned box, n x n quads a face; fronts outward, or inward when `inward`.
  void AddBox(const radiometry::Vec3& lo, const radiometry::Vec3& hi, int n, bool inward)
  {
    using radiometry::Vec3;
    const Vec3 x{ hi.x - lo.x, 0, 0 };
    const Vec3 y{ 0, hi.y - lo.y, 0 };
    const Vec3 z{ 0, 0, hi.z - lo.z };
    const auto face = [&](const Vec3& o, const Vec3& a, const Vec3& b) {
      inward ? this->AddGrid(o, b, a, n, n) : this->AddGrid(o, a, b, n, n);
    };
    face(lo, y, x);
    face(lo + z, x, y);
    face(lo, x, z);
    face(lo + y, z, x);
    face(lo, z, y);
    face(lo + x, y, z);
  }

  /// A sphere of latitude bands; fronts outward, or inward when `inward`.
  void AddSphere(const radiometry::Vec3& c, double radius, int bands, bool inward)
  {
    using radiometry::Vec3;
    const double pi = std::acos(-1.0);
    const int around = 2 * bands;
    const auto first = static_cast<std::int32_t>(this->Points.size());
    for (int j = 0; j <= bands; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const double theta = pi * j / bands;
        const double phi = 2.0 * pi * i / around;
        const double s = j == 0 || j == bands ? 0.0 : std::sin(theta);
        this->Points.push_back(c +
          radius * Vec3{ s * std::cos(phi), s * std::sin(phi), j == bands ? -1.0 : std::cos(theta) });
      }
    }
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t d) {
      inward ? this->Triangles.push_back({ a, d, b }) : this->Triangles.push_back({ a, b, d });
    };
    for (int j = 0; j < bands; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const std::int32_t a = first + j * around + i;
        const std::int32_t b = first + j * around + (i + 1) % around;
        if (j > 0)
        {
          add(a, a + around, b);
        }
        if (j < bands - 1)
        {
          add(b, a + around, b + around);
        }
      }
    }
  }

  /// Every triangle a cell of one band, Lambertian with this reflectance.
  radiometry::Scene ToScene(double reflectance = 0.5) const
  {
    radiometry::SceneBuilder builder;
    std::vector<std::int32_t> cell(this->Triangles.size());
    for (std::size_t t = 0; t < cell.size(); ++t)
    {
      cell[t] = static_cast<std::int32_t>(t);
    }
    builder.AddMesh(
      radiometry::SceneBuilder::Role::Receiver, this->Points, this->Triangles, cell, 1.0);
    radiometry::Scene scene = builder.Finish(this->Triangles.size());
    scene.Optics.DiffuseReflectance[0].assign(scene.Cells, reflectance);
    scene.Optics.DiffuseReflectance[1].assign(scene.Cells, reflectance);
    scene.Optics.TwoSided.assign(scene.Cells, 0);
    return scene;
  }
};

/// An environment with its azimuth 0 along y.
inline radiometry::Light SkyLight(
  std::shared_ptr<const radiometry::SkyRadiance> sky, std::vector<double> intensity = { 1.0 })
{
  radiometry::Light light;
  light.Type = radiometry::LightType::Environment;
  light.Reference = { 0.0, 1.0, 0.0 };
  light.Intensity = std::move(intensity);
  light.Environment = std::move(sky);
  return light;
}

} // namespace test
