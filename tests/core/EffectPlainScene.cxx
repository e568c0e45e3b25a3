// SPDX-License-Identifier: BSD-3-Clause

/// Simulates a plain scene once, on one thread, for counting its instructions with valgrind's callgrind:
/// --toggle-collect=radiometry_simulate counts the simulation alone. Prints the sum of its values.
///
///   direct     a ground of 800 triangles with a hill, one occluder above it, two point lights
///   radiosity  a plain room of 12 triangles, one point light
///
///   plain_scene direct|radiosity

#include "radiometry/solver/PlannedRadiosity.h"
#include "tests/core/TestScenes.h"

#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include <tbb/global_control.h>

using namespace radiometry;

namespace
{

Light PointLight(const Scene& scene, const Vec3& position)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { 100.0 };
  return light;
}

Scene Ground()
{
  test::Mesh mesh;
  mesh.AddGrid({ -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 20, 20);
  for (Vec3& p : mesh.Points)
  {
    p.z = std::exp(-0.5 * (p.x * p.x + p.y * p.y));
  }
  mesh.AddGrid({ 1, 1, 2 }, { 1.5, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { -2, 1, 4 }), PointLight(scene, { 3, 3, 5 }) };
  return scene;
}

Scene Room()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 5, 3 }, 1, true);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 1.3, 2.1, 2.2 }) };
  return scene;
}

double Sum(const FieldValues& values)
{
  return std::accumulate(values.Values.begin(), values.Values.end(), 0.0);
}

} // namespace

/// What is counted.
extern "C" __attribute__((noinline)) double radiometry_simulate(const Scene& scene, bool bounces)
{
  if (!bounces)
  {
    IrradianceOptions options;
    options.Threads = 1;
    return Sum(SimulateIrradiance(scene, {}, options).Cells[0]);
  }
  RadiosityOptions options;
  options.Threads = 1;
  options.Refinement = RefinementMode::Off;
  const std::vector<EffectSwitch> all(EffectCount);
  return Sum(SimulatePlannedRadiosity(scene, {}, true, all, options).Cells.Irradiance[0]);
}

int main(int argc, char** argv)
{
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const bool bounces = argc > 1 && std::string(argv[1]) == "radiosity";
  const Scene scene = bounces ? Room() : Ground();
  std::printf("%.17g\n", radiometry_simulate(scene, bounces));
  return 0;
}
