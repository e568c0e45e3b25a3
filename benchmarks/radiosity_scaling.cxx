// SPDX-License-Identifier: BSD-3-Clause

/// Question: how do time and memory of radiosity grow with the number of cells, for each operator?
///
/// A furnished scene (benchmarks/FurnishedScene.h) of 1e2 to 1e6 triangles, each one element, 3 % of
/// the exchange asked, one band. Each operator and size runs in a process of its own, so that its peak
/// of memory is its own. An operator's next size is left out when it is expected to take more than
/// `limit` seconds (by the slope of its last two sizes).
///
/// Prints JSON: seconds of the occlusion structure, of building the operator, of one product F B, of
/// the solve by it and of all; bytes of the operator and of the process; and the exponents p of
/// c n^p over the sizes from 1000 elements on that take more than 2 ms (products: 0.1 ms).
///
///   radiosity_scaling [greatest=1e6] [threads=0: all] [limit=60] [operators=DHM]

#include "benchmarks/ChildProcess.h"
#include "benchmarks/FurnishedScene.h"
#include "benchmarks/Provenance.h"
#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/solver/RadiositySolver.h"

#include <chrono>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

using namespace radiometry;
using nlohmann::json;

namespace
{

constexpr double Tolerance = 0.03;
/// Rays an element for which the spread of a row's irradiance is some 3 % in such scenes.
constexpr int Rays = 512;

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::unique_ptr<FormFactorOperator> Build(char kind, const Scene& scene,
  const OcclusionScene& occluders, const ElementSet& elements, const ExchangeOptions& options)
{
  switch (kind)
  {
    case 'D':
      return std::make_unique<DenseOperator>(scene, occluders, elements, options);
    case 'H':
      return std::make_unique<HierarchicalOperator>(scene, occluders, elements, options);
    default:
      return std::make_unique<MonteCarloOperator>(occluders, elements, options, Rays);
  }
}

json Measure(char kind, std::size_t wanted, int threads)
{
  const double empty = benchmark::Resident("VmRSS");
  Scene scene = benchmark::FurnishedScene(wanted).ToScene();
  ExchangeOptions options;
  options.RelativeTolerance = Tolerance;
  options.Threads = threads;

  const double begin = Now();
  const OcclusionScene occluders(scene);
  occluders.Prepare();
  const ElementSet elements(scene, true);
  const double occlusion = Now();
  const auto F = Build(kind, scene, occluders, elements, options);
  const double built = Now();
  const double afterBuild = benchmark::Resident("VmHWM") - empty;

  const std::size_t n = F->Size();
  std::vector<double> reflectance(n);
  std::vector<double> source(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto cell = static_cast<std::size_t>(elements.GetPatches()[i].Cell);
    reflectance[i] = scene.Optics.DiffuseReflectance[0][cell];
    source[i] = scene.Optics.EmittedExitance[0][cell];
  }
  std::vector<double> product(n);
  const double beforeApply = Now();
  int applications = 0;
  do
  {
    F->Apply(reflectance.data(), product.data(), 1);
    ++applications;
  } while (Now() - beforeApply < 0.2);
  const double apply = (Now() - beforeApply) / applications;
  SolveOptions solving;
  solving.Tolerance = 0.1 * Tolerance;
  const double beforeSolve = Now();
  const SolveResult solved = SolveRadiosity(*F, reflectance, source, 1, solving);
  const double solve = Now() - beforeSolve;

  double power = 0.0; // W absorbed: one figure that all operators must agree on
  for (std::size_t i = 0; i < n; ++i)
  {
    power += F->Areas()[i] * (1.0 - reflectance[i]) * solved.Irradiance[i];
  }
  json row;
  row["elements"] = n;
  row["occlusionSeconds"] = occlusion - begin;
  row["buildSeconds"] = built - occlusion;
  row["applySeconds"] = apply;
  row["solveSeconds"] = solve;
  row["seconds"] = built - begin + solve;
  row["iterations"] = solved.Iterations;
  row["operatorBytes"] = F->MemoryBytes();
  row["buildBytes"] = afterBuild;
  row["bytes"] = benchmark::Resident("VmHWM") - empty;
  row["samples"] = F->Samples();
  row["absorbed"] = power;
  row["description"] = F->Description();
  return row;
}

/// p of value = c n^p, least squares of the logarithms over sizes from 1000 on; null: too few.
json Exponent(const json& rows, const char* key, double least)
{
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const json& row : rows)
  {
    if (row.value("elements", 0.0) >= 900.0 && row.value(key, 0.0) > least)
    {
      const double x = std::log(row["elements"].get<double>());
      const double y = std::log(row[key].get<double>());
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return n < 2 ? json() : json((n * sxy - sx * sy) / (n * sxx - sx * sx));
}

json OverSizes(char kind, double greatest, int threads, double limit)
{
  json rows = json::array();
  double before[2] = { 0.0, 0.0 }; // seconds of the last two sizes
  for (double wanted = 1e2; wanted <= greatest * 1.001; wanted *= std::sqrt(10.0))
  {
    const double growth = before[0] > 0.05 ? before[1] / before[0] : kind == 'D' ? 10.0 : 3.5;
    if (before[1] * growth > limit)
    {
      std::cerr << kind << ' ' << wanted << ": left out, some " << before[1] * growth << " s\n";
      break;
    }
    rows.push_back(benchmark::Apart(
      [&] { return Measure(kind, static_cast<std::size_t>(std::lround(wanted)), threads); }));
    std::cerr << kind << ' ' << rows.back().dump() << '\n';
    if (rows.back().contains("failed"))
    {
      break;
    }
    before[0] = before[1];
    before[1] = rows.back()["seconds"].get<double>();
  }
  return rows;
}

} // namespace

int main(int argc, char** argv)
{
  const double greatest = argc > 1 ? std::atof(argv[1]) : 1e6;
  const int threads = argc > 2 ? std::atoi(argv[2]) : 0;
  const double limit = argc > 3 ? std::atof(argv[3]) : 60.0;
  const std::string kinds = argc > 4 ? argv[4] : "DHM";
  json out;
  out["question"] = "time and memory of radiosity at 3 % against elements, for each operator";
  benchmark::AddProvenance(out);
  out["threads"] = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  out["tolerance"] = Tolerance;
  out["rays"] = Rays;
  for (const char kind : kinds)
  {
    const char* name = kind == 'D' ? "Dense" : kind == 'H' ? "Hierarchical" : "MonteCarlo";
    out["operators"][name] = OverSizes(kind, greatest, threads, limit);
    for (const char* key : { "buildSeconds", "applySeconds", "solveSeconds", "seconds" })
    {
      // A product's seconds are the mean of many, which is good for shorter ones.
      const double least = key == std::string("applySeconds") ? 1e-4 : 2e-3;
      out["exponents"][name][key] = Exponent(out["operators"][name], key, least);
    }
    for (const char* key : { "operatorBytes", "bytes" })
    {
      out["exponents"][name][key] = Exponent(out["operators"][name], key, 1e5);
    }
  }
  std::cout << out.dump(1) << '\n';
  return 0;
}
