// SPDX-License-Identifier: BSD-3-Clause

/// Question: are the stated errors of radiosity true? The scenes of tests/core/solver are solved by
/// each operator at several tolerances and seeds and compared, value by value, with path tracing
/// that shares no code with the operators (tests/core/solver/PathReference.h), whose values are kept
/// in tests/core/solver/RadiosityReferences.txt. Prints JSON, one row a scene, method and tolerance:
/// the share of values covered by their error, the median of error / |true error|, and the greatest
/// of the parts of the error budget.
///
///   radiosity_coverage [seeds=3] [only: a scene's name] [part of the method's]
///   radiosity_coverage --references [strata=64] [cells=60]   computes the references anew (an hour)

#include "benchmarks/Provenance.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Parallel.h"
#include "tests/core/solver/PathReference.h"
#include "tests/core/solver/RadiosityCalibration.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <string>

namespace
{

using namespace radiometry;

/// So many cells of each scene, drawn at random, both sides where both receive.
void WriteReferences(int strata, std::size_t cells, const std::string& only)
{
  std::ofstream file(test::RadiosityReferencePath() + (only.empty() ? "" : "." + only));
  file << "# scene cell side band irradiance standard-error; by radiosity_coverage --references "
       << strata << ' ' << cells << '\n';
  file.precision(9);
  for (const test::RadiosityScene& scene : test::RadiosityScenes())
  {
    if (!only.empty() && only != scene.Name)
    {
      continue;
    }
    const OcclusionScene occluders(scene.World);
    std::mt19937_64 random(7);
    std::vector<std::pair<std::size_t, int>> wanted;
    for (std::size_t c = 0; c < scene.World.Cells; ++c)
    {
      if (random() % scene.World.Cells < cells)
      {
        wanted.emplace_back(c, 0);
        if (scene.World.Optics.TwoSided[c])
        {
          wanted.emplace_back(c, 1);
        }
      }
    }
    for (const bool centroids : { false, true })
    {
      std::vector<test::PathEstimate> found(wanted.size());
      const auto paths = centroids ? test::IrradianceOfCentroid : test::IrradianceByPaths;
      ParallelFor(
        wanted.size(), 0, {},
        [&](std::size_t k) {
          found[k] =
            paths(scene.World, occluders, wanted[k].first, wanted[k].second, strata, 1);
        },
        1.0);
      for (std::size_t k = 0; k < wanted.size(); ++k)
      {
        for (std::size_t b = 0; b < found[k].Irradiance.size(); ++b)
        {
          file << scene.Name << (centroids ? "@ " : " ") << wanted[k].first << ' '
               << wanted[k].second << ' ' << b << ' ' << found[k].Irradiance[b] << ' '
               << found[k].Error[b] << '\n';
        }
      }
      std::cerr << scene.Name << ' ' << wanted.size() << " values\n";
    }
  }
}

nlohmann::json Row(const test::Calibration& c)
{
  nlohmann::json row;
  row["values"] = c.Exact + c.Estimated;
  row["exact"] = c.Exact;
  row["undecided"] = c.Undecided;
  row["coverage"] = c.Coverage();
  row["medianRatio"] = c.Median();
  return row;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc > 1 && std::string(argv[1]) == "--references")
  {
    WriteReferences(argc > 2 ? std::atoi(argv[2]) : 64,
      argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : 60, argc > 4 ? argv[4] : "");
    return 0;
  }
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 3;
  const std::string only = argc > 2 ? argv[2] : "";
  const std::string onlyMethod = argc > 3 ? argv[3] : "";
  nlohmann::json out;
  out["question"] = "coverage of the stated errors of radiosity";
  benchmark::AddProvenance(out);
  out["seeds"] = seeds;
  const std::vector<test::RadiosityReference> references = test::RadiosityReferences();
  std::map<std::string, test::Calibration> byMethod;
  for (const test::RadiosityScene& scene : test::RadiosityScenes())
  {
    if (!only.empty() && only != scene.Name)
    {
      continue;
    }
    for (const auto& [name, method] : test::RadiosityMethods())
    {
      if (name.find(onlyMethod) == std::string::npos || (scene.Paths && name != "MonteCarlo"))
      {
        continue;
      }
      for (const double tolerance : { 0.1, 0.03 })
      {
        const auto start = std::chrono::steady_clock::now();
        test::Calibration sum;
        RadiosityResult result;
        for (int seed = 1; seed <= seeds; ++seed)
        {
          RadiosityOptions options;
          options.Method = method;
          options.RelativeTolerance = tolerance;
          options.Seed = static_cast<std::uint64_t>(seed);
          for (const test::Judged& value : test::JudgeRadiosity(scene, references, options, &result))
          {
            sum.Add(value);
          }
        }
        nlohmann::json row = Row(sum);
        row["scene"] = scene.Name;
        row["method"] = name;
        row["tolerance"] = tolerance;
        row["elements"] = result.Elements;
        row["outcome"] = result.Outcome;
        row["budget"] = { { "direct", result.Budget.Direct },
          { "formFactors", result.Budget.FormFactors }, { "visibility", result.Budget.Visibility },
          { "discretisation", result.Budget.Discretisation }, { "solver", result.Budget.Solver } };
        row["seconds"] =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / seeds;
        out["rows"].push_back(row);
        byMethod[name].Add(sum);
        std::cerr << row.dump() << '\n';
      }
    }
  }
  for (const auto& [name, sum] : byMethod)
  {
    out["all"][name] = Row(sum);
    std::cerr << name << ' ' << Row(sum).dump() << '\n';
  }
  std::cout << out.dump(1) << '\n';
  return 0;
}
