// SPDX-License-Identifier: BSD-3-Clause

/// Question: how do time and memory of direct light grow with cells and with lights?
///
/// Cells: a floor and a ball over it in one mesh, one point light, 1e3 to 1e7 triangles, 1 % asked.
/// Lights: 1 to 1e4 of them over a floor of 2048 cells with 64 boxes on it, in two scenes. "every
/// light matters": all hang under the ceiling of one hall of 20 m. "few matter": lamps 3 m above a
/// plain that grows with their number, one each 100 m^2; the cells are spread over all of it.
///
/// Each size runs in a process of its own, so that its peak of memory is its own. Prints JSON:
/// seconds by stage (the least of the repeats), bytes, and the exponents fitted to time = c n^p over
/// sizes that take more than 10 ms.
///
/// On one thread the seconds are the processor's.
///
///   direct_scaling [greatest cells=1e7] [greatest lights=1e4] [threads=0: all] [repeats=3]

#include "benchmarks/ChildProcess.h"
#include "benchmarks/Provenance.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "tests/core/TestScenes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <thread>

using namespace radiometry;
using nlohmann::json;

namespace
{

/// Processor seconds of one thread, which other work on the machine hardly changes, or else the
/// clock's.
bool ProcessorSeconds = false;

double Now()
{
  if (ProcessorSeconds)
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Setting
{
  int Threads = 0;
  int Repeats = 3;
};

/// Times the stages of one run; the scene is made by `make` and its patches are those of `cells`
/// first triangles (0: all).
json Measure(const std::function<test::Mesh()>& make, std::size_t cells,
  const std::function<void(Scene&)>& light, const Setting& setting)
{
  json row;
  const double before = benchmark::Resident("VmRSS");
  test::Mesh mesh = make();
  Scene scene = mesh.ToScene();
  mesh = {};
  light(scene);
  std::vector<Patch> patches = MakePatches(scene, 0);
  if (cells > 0)
  {
    patches.resize(cells);
  }
  const double input = benchmark::Resident("VmRSS") - before;
  DirectOptions options;
  options.Threads = setting.Threads;
  double building = 1e300;
  double first = 1e300;
  double again = 1e300;
  DirectResult result;
  const double begin = Now();
  for (int k = 0; k < setting.Repeats && (k == 0 || Now() - begin < 10.0); ++k)
  {
    double start = Now();
    const OcclusionScene occluders(scene);
    occluders.Prepare();
    building = std::min(building, Now() - start);
    start = Now();
    result = ComputeDirectIrradiance(scene, occluders, patches, options);
    first = std::min(first, Now() - start);
    start = Now();
    result = ComputeDirectIrradiance(scene, occluders, patches, options);
    again = std::min(again, Now() - start);
  }
  std::size_t exact = 0;
  double value = 0.0;
  double error = 0.0;
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    const double area = Area(patches[i].Corners);
    exact += result.Error[i] <= 1e-9 * result.Irradiance[i] ? 1 : 0;
    value += area * result.Irradiance[i];
    error += area * result.Error[i];
  }
  const double peak = benchmark::Resident("VmHWM") - before;
  const auto n = static_cast<double>(patches.size());
  row["cells"] = patches.size();
  row["triangles"] = scene.Triangles.size();
  row["lights"] = scene.Lights.size();
  row["buildingSeconds"] = building;
  row["seconds"] = first;
  row["secondsAgain"] = again; // the lines at which shadows begin are known by then
  row["inputBytesPerCell"] = input / n;
  row["peakBytesPerCell"] = peak / n;
  row["rays"] = result.Rays;
  row["shareExact"] = static_cast<double>(exact) / n;
  row["meanError"] = value > 0.0 ? error / value : 0.0;
  return row;
}

/// p of time = c n^p, least squares of the logarithms.
double Exponent(const json& rows, const char* size, const char* time)
{
  double n = 0;
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (const json& row : rows)
  {
    if (row.is_object() && row[time].get<double>() > 0.01)
    {
      const double x = std::log(row[size].get<double>());
      const double y = std::log(row[time].get<double>());
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return n < 2 ? 0.0 : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

json OverCells(double greatest, const Setting& setting)
{
  json rows = json::array();
  for (double wanted = 1e3; wanted <= greatest * 1.001; wanted *= std::sqrt(10.0))
  {
    const auto make = [wanted] {
      test::Mesh mesh;
      const int floor = static_cast<int>(std::sqrt(0.25 * wanted));
      mesh.AddGrid({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 }, floor, floor);
      mesh.AddSphere({ 0, 0, 1 }, 0.5, static_cast<int>(std::sqrt(0.125 * wanted)), false);
      return mesh;
    };
    rows.push_back(benchmark::Apart([&] {
      return Measure(
        make, 0,
        [](Scene& scene) {
          Light light;
          light.Position = Vec3{ 0.2, 0.1, 3 } - scene.Origin;
          light.Intensity = { 1.0 };
          scene.Lights = { light };
        },
        setting);
    }));
    std::cerr << rows.back().dump() << '\n';
  }
  return rows;
}

/// Lamps at the centres of a square grid of `width`, at a height, filled row by row.
std::vector<Vec3> Lamps(int count, double width, double height)
{
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<Vec3> lamps;
  for (int k = 0; k < count; ++k)
  {
    lamps.push_back({ width * ((k % side + 0.5) / side - 0.5),
      width * ((k / side + 0.5) / side - 0.5), height });
  }
  return lamps;
}

json OverLights(double greatest, bool plain, const Setting& setting)
{
  json rows = json::array();
  for (double wanted = 1; wanted <= greatest * 1.001; wanted *= std::sqrt(10.0))
  {
    const int count = static_cast<int>(std::lround(wanted));
    const double width = plain ? 10.0 * std::ceil(std::sqrt(static_cast<double>(count))) : 20.0;
    const auto make = [width] {
      test::Mesh mesh;
      mesh.AddGrid(
        { -0.5 * width, -0.5 * width, 0 }, { width, 0, 0 }, { 0, width, 0 }, 32, 32);
      for (int j = 0; j < 8; ++j)
      {
        for (int i = 0; i < 8; ++i)
        {
          const Vec3 foot{ width * ((i + 0.37) / 8 - 0.5), width * ((j + 0.61) / 8 - 0.5), 0 };
          mesh.AddBox(foot, foot + Vec3{ 0.8, 0.6, 1.1 }, 1, false);
        }
      }
      return mesh;
    };
    rows.push_back(benchmark::Apart([&] {
      return Measure(
        make, 2048,
        [&](Scene& scene) {
          for (const Vec3& lamp : Lamps(count, plain ? width : 0.95 * width, plain ? 3.0 : 6.0))
          {
            Light light;
            light.Position = lamp - scene.Origin;
            light.Intensity = { 100.0 };
            scene.Lights.push_back(light);
          }
        },
        setting);
    }));
    std::cerr << rows.back().dump() << '\n';
  }
  return rows;
}

} // namespace

int main(int argc, char** argv)
{
  const double cells = argc > 1 ? std::atof(argv[1]) : 1e7;
  const double lights = argc > 2 ? std::atof(argv[2]) : 1e4;
  Setting setting;
  setting.Threads = argc > 3 ? std::atoi(argv[3]) : 0;
  setting.Repeats = argc > 4 ? std::atoi(argv[4]) : 3;
  ProcessorSeconds = setting.Threads == 1;
  json out;
  out["processorSeconds"] = ProcessorSeconds;
  out["question"] = "time and memory of direct light at 1 % against cells and lights";
  benchmark::AddProvenance(out);
  out["threads"] = setting.Threads > 0 ? setting.Threads
                                       : static_cast<int>(std::thread::hardware_concurrency());
  out["overCells"] = OverCells(cells, setting);
  out["overLightsThatAllMatter"] = OverLights(lights, false, setting);
  out["overLightsOfWhichFewMatter"] = OverLights(lights, true, setting);
  for (const char* sweep : { "overCells", "overLightsThatAllMatter", "overLightsOfWhichFewMatter" })
  {
    const char* size = std::string(sweep) == "overCells" ? "cells" : "lights";
    for (const char* time : { "seconds", "secondsAgain", "buildingSeconds" })
    {
      out["exponents"][sweep][time] = Exponent(out[sweep], size, time);
    }
  }
  std::cout << out.dump(1) << '\n';
  return 0;
}
