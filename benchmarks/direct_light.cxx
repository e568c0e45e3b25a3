// SPDX-License-Identifier: BSD-3-Clause

/// Question: what does a 1 % run of direct light cost against a bare loop that traces one shadow ray
/// a triangle with Embree, on the same threads, in the same process?
///
/// A finely divided floor and ball under one point light. Prints JSON: seconds of both and their ratio,
/// by the clock and by the processor's time (which other programs disturb less); the same for the
/// filter's own visibility query with one ray a triangle (packets, ends decided in double) against
/// the bare loop; the share of cells whose value is exact. Figures are ratios of one run: absolute
/// times depend on the machine and its load. Most cells of the run need no ray of their own.
///
///   direct_light [triangles=1000000] [repeats=3]

#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/visibility/ShadowLines.h"
#include "tests/core/TestScenes.h"

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

using namespace radiometry;

namespace
{

double Seconds(const std::chrono::steady_clock::time_point& since)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

std::string Processor()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown";
}

/// The limit: triangles in Embree, a float ray from each centroid to the light, nothing else.
struct BareLoop
{
  RTCDevice Device = rtcNewDevice(nullptr);
  RTCScene Handle = rtcNewScene(Device);
  std::vector<float> Origins;
  float Light[3];

  BareLoop(const Scene& scene, const Vec3& light)
  {
    RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, scene.Points.size()));
    auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, scene.Triangles.size()));
    for (const Vec3& p : scene.Points)
    {
      for (int a = 0; a < 3; ++a)
      {
        *v++ = static_cast<float>(p[a]);
      }
    }
    for (std::size_t k = 0; k < scene.Triangles.size(); ++k)
    {
      const Vec3 c = Centroid(scene.TriangleAt(k));
      const Vec3 n = Normalized(AreaNormal2(scene.TriangleAt(k)));
      for (int a = 0; a < 3; ++a)
      {
        *t++ = static_cast<unsigned>(scene.Triangles[k][a]);
        this->Origins.push_back(static_cast<float>(c[a] + 1e-4 * n[a]));
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      this->Light[a] = static_cast<float>(light[a]);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(this->Handle, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(this->Handle);
  }
  ~BareLoop()
  {
    rtcReleaseScene(this->Handle);
    rtcReleaseDevice(this->Device);
  }
  std::int64_t Run() const
  {
    std::atomic<std::int64_t> lit{ 0 };
    tbb::parallel_for(std::size_t{ 0 }, this->Origins.size() / 3, [&](std::size_t i) {
      RTCRay ray{};
      const float* o = &this->Origins[3 * i];
      ray.org_x = o[0];
      ray.org_y = o[1];
      ray.org_z = o[2];
      ray.dir_x = this->Light[0] - o[0];
      ray.dir_y = this->Light[1] - o[1];
      ray.dir_z = this->Light[2] - o[2];
      ray.tnear = 0.0f;
      ray.tfar = 1.0f;
      ray.mask = ~0u;
#if RTC_VERSION_MAJOR >= 4
      rtcOccluded1(this->Handle, &ray, nullptr);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded1(this->Handle, &context, &ray);
#endif
      lit += ray.tfar > 0.0f ? 1 : 0;
    });
    return lit;
  }
};

} // namespace

int main(int argc, char** argv)
{
  const double wanted = argc > 1 ? std::atof(argv[1]) : 1e6;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  const int floor = static_cast<int>(std::sqrt(0.25 * wanted));
  const int bands = static_cast<int>(std::sqrt(0.125 * wanted));
  test::Mesh mesh;
  mesh.AddGrid({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 }, floor, floor);
  mesh.AddSphere({ 0, 0, 1 }, 0.5, bands, false);
  Scene scene = mesh.ToScene();
  Light light;
  light.Position = Vec3{ 0.2, 0.1, 3 } - scene.Origin;
  light.Intensity = { 1.0 };
  scene.Lights = { light };

  const BareLoop bare(scene, light.Position);
  const OcclusionScene occluders(scene);
  occluders.Prepare();
  const std::vector<Patch> patches = MakePatches(scene, 0);
  const auto built = std::chrono::steady_clock::now();
  occluders.Lines(scene, 0);
  const double linesSeconds = Seconds(built);
  double bareSeconds = 1e300;
  double runSeconds = 1e300;
  double raySeconds = 1e300;
  double bareProcessor = 1e300;
  double runProcessor = 1e300;
  double rayProcessor = 1e300;
  const auto timed = [](double& seconds, double& processor, const auto& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t spent = std::clock();
    body();
    processor = std::min(processor, static_cast<double>(std::clock() - spent) / CLOCKS_PER_SEC);
    seconds = std::min(seconds, Seconds(start));
  };
  std::atomic<std::size_t> hiddenSum{ 0 };
  const auto traceAll = [&] {
    constexpr std::size_t chunk = 64;
    const std::size_t chunks = (patches.size() + chunk - 1) / chunk;
    tbb::parallel_for(std::size_t{ 0 }, chunks, [&](std::size_t c) {
      RayEnd from[chunk];
      std::uint8_t hidden[chunk];
      const std::size_t n = std::min(chunk, patches.size() - c * chunk);
      for (std::size_t k = 0; k < n; ++k)
      {
        const Patch& p = patches[c * chunk + k];
        from[k] = { Centroid(p.Corners), p.Triangle };
      }
      occluders.Occluded(from, n, { light.Position, -1 }, hidden);
      hiddenSum += static_cast<std::size_t>(std::count(hidden, hidden + n, 1));
    });
  };
  DirectResult result;
  for (int k = 0; k < repeats; ++k) // in turn, so that both meet the same load
  {
    timed(bareSeconds, bareProcessor, [&] { bare.Run(); });
    timed(runSeconds, runProcessor,
      [&] { result = ComputeDirectIrradiance(scene, occluders, patches, DirectOptions{}); });
    timed(raySeconds, rayProcessor, traceAll);
  }
  std::size_t exact = 0;
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    exact += result.Error[i] <= 1e-9 * result.Irradiance[i] ? 1 : 0;
  }
  const double n = static_cast<double>(scene.Triangles.size());
  nlohmann::json out;
  out["question"] = "direct light at 1 % against one bare Embree shadow ray a triangle";
  out["processor"] = Processor();
  out["triangles"] = scene.Triangles.size();
  out["seconds"] = runSeconds;
  out["bareSeconds"] = bareSeconds;
  out["shadowLinesSeconds"] = linesSeconds; // once a geometry, as Embree's own hierarchy
  out["ratio"] = runSeconds / bareSeconds;
  out["processorRatio"] = runProcessor / bareProcessor;
  out["rays"] = result.Rays;
  out["raysPerTriangle"] = static_cast<double>(result.Rays) / n;
  out["bareRaysPerSecond"] = n / bareSeconds;
  out["queryRaysPerSecond"] = n / raySeconds; // the filter's visibility query alone
  out["queryThroughput"] = bareSeconds / raySeconds;
  out["queryThroughputByProcessor"] = bareProcessor / rayProcessor;
  out["hidden"] = hiddenSum.load() / static_cast<std::size_t>(repeats);
  out["shareExact"] = static_cast<double>(exact) / static_cast<double>(patches.size());
  std::cout << out.dump(2) << '\n';
  return 0;
}
