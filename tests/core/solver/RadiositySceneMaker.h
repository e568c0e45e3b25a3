// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/TestScenes.h"

#include <cmath>
#include <random>
#include <vector>

/// What the scenes of RadiosityScenes*.cxx are put together from.
namespace test
{

using namespace radiometry;

class Maker
{
public:
  Mesh Surface;

  Scene Make(double reflectance) { return this->Surface.ToScene(reflectance); }
  std::size_t Cells() const { return this->Surface.Triangles.size(); }
  void Box(const Vec3& lo, const Vec3& hi, int n, bool inward)
  {
    this->Surface.AddBox(lo, hi, n, inward);
  }
  void Grid(const Vec3& o, const Vec3& a, const Vec3& b, int n, int m)
  {
    this->Surface.AddGrid(o, a, b, n, m);
  }
};

/// Reflectances of cells [from, to), each by itself, front and back.
inline void Texture(Scene& scene, std::size_t from, std::size_t to, double lo, double hi)
{
  std::mt19937_64 random(42);
  for (std::size_t c = from; c < to; ++c)
  {
    for (auto& side : scene.Optics.DiffuseReflectance)
    {
      side[c] = lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
    }
  }
}

inline void Emit(Scene& scene, std::size_t from, std::size_t to, double exitance)
{
  auto& emitted = scene.Optics.EmittedExitance[0];
  emitted.resize(scene.Cells, 0.0);
  for (std::size_t c = from; c < to; ++c)
  {
    emitted[c] = exitance;
  }
}

inline void BothSides(Scene& scene, std::size_t from, std::size_t to)
{
  for (std::size_t c = from; c < to; ++c)
  {
    scene.Optics.TwoSided[c] = 1;
  }
}

inline void Lamp(Scene& scene, const Vec3& at, double flux)
{
  Light light;
  light.Position = at - scene.Origin;
  light.Intensity.assign(
    static_cast<std::size_t>(scene.Optics.Bands), flux / (4.0 * std::acos(-1.0)));
  scene.Lights.push_back(light);
}

inline void Sun(Scene& scene, const Vec3& direction, double irradiance)
{
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = Normalized(direction);
  sun.Intensity = { irradiance };
  scene.Lights.push_back(sun);
}

/// The same optics in three bands, each cell's reflectance times a colour.
inline void Colour(Scene& scene, const std::vector<Vec3>& colours)
{
  Materials& optics = scene.Optics;
  optics.Bands = 3;
  for (auto* array : { &optics.DiffuseReflectance[0], &optics.DiffuseReflectance[1],
         &optics.EmittedExitance[0] })
  {
    std::vector<double> bands;
    for (std::size_t c = 0; c < array->size(); ++c)
    {
      const bool emission = array == &optics.EmittedExitance[0];
      const Vec3 colour = emission ? Vec3{ 1.0, 0.8, 0.4 } : colours[c];
      for (const double share : { colour.x, colour.y, colour.z })
      {
        bands.push_back((*array)[c] * share);
      }
    }
    *array = bands;
  }
}

} // namespace test
