// SPDX-License-Identifier: BSD-3-Clause

/// Question: are the stated errors of direct light true? Random scenes of fixed seeds for each kind
/// of light, blocker and receiver, against references that share no code with the engine
/// (tests/core/Calibration.h). Prints JSON, one row a case: how many values are exact to rounding,
/// how many estimated, the share of each that is covered by its error, and the median of
/// error / |true error| over the estimated ones.
///
/// Cases whose references are slow get a third of the seeds.
///
///   direct_coverage [seeds=20] [first seed=1] [only: part of the light's name]

#include "benchmarks/Provenance.h"
#include "tests/core/Calibration.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{

double Share(std::size_t part, std::size_t whole)
{
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

nlohmann::json Row(const test::Calibration& c)
{
  nlohmann::json row;
  row["exact"] = c.Exact;
  row["exactCoverage"] = Share(c.ExactCovered, c.Exact);
  row["greatestExactDifference"] = c.WorstExact;
  row["estimated"] = c.Estimated;
  row["estimatedCoverage"] = Share(c.EstimatedCovered, c.Estimated);
  row["medianRatio"] = c.Median();
  row["undecided"] = c.Undecided;
  row["coverage"] = c.Coverage();
  return row;
}

} // namespace

int main(int argc, char** argv)
{
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const std::string only = argc > 3 ? argv[3] : "";
  nlohmann::json out;
  out["question"] = "coverage of the stated errors of direct light";
  benchmark::AddProvenance(out);
  out["seeds"] = seeds;
  test::Calibration all;
  for (const test::CalibrationCase& one : test::CalibrationCases())
  {
    if (one.Light.find(only) == std::string::npos)
    {
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    test::Calibration sum;
    const int count = one.Slow ? (seeds + 2) / 3 : seeds;
    for (int k = 0; k < count; ++k)
    {
      for (const test::Judged& value : one.Run(first + static_cast<std::uint64_t>(k)))
      {
        sum.Add(value);
      }
    }
    nlohmann::json row = Row(sum);
    row["light"] = one.Light;
    row["blockers"] = one.Blockers;
    row["receivers"] = one.Receivers;
    row["seconds"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    out["rows"].push_back(row);
    all.Add(sum);
    std::cerr << row.dump() << '\n';
  }
  out["all"] = Row(all);
  std::cout << out.dump(1) << '\n';
  return 0;
}
