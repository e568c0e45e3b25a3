// SPDX-License-Identifier: BSD-3-Clause

/// Question: do the stated errors hold? Every effect by every method of tests/core/CalibrationSuite.h
/// against closed forms and converged references that share no code with the engine. Prints JSON:
///   { "question", "commit", "processor", "load", "effort", "seeds",
///     "rows": [ { "group", "effect", "method",
///       "exact": values that are stated exact to rounding, "exact_covered": share of them within it,
///       "values": estimated values, "covered": share of them within their stated error,
///       "sharpness": median of stated/true error over the estimated values (null: none),
///       "undecided": values whose reference is coarser than a third of the stated error,
///       "seconds" } ],
///     "groups": { group: the same of all its rows }, "all": the same of all }
/// The median of a group or of all gives each value the same weight.
///
///   calibration [seconds a part=4] [seeds, at most=20] [longest part, s=100] [only: part of a row]
///   benchmarks/record calibration build/bin/calibration      some ten minutes on four cores

#include "benchmarks/Provenance.h"
#include "tests/core/CalibrationSuite.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

namespace
{

nlohmann::json Figures(const test::Calibration& c)
{
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? nlohmann::json()
                      : nlohmann::json(static_cast<double>(part) / static_cast<double>(whole));
  };
  nlohmann::json row;
  row["exact"] = c.Exact;
  row["exact_covered"] = share(c.ExactCovered, c.Exact);
  row["values"] = c.Estimated;
  row["covered"] = share(c.EstimatedCovered, c.Estimated);
  row["sharpness"] = c.Ratios.empty() ? nlohmann::json() : nlohmann::json(c.Median());
  row["undecided"] = c.Undecided;
  return row;
}

nlohmann::json Named(const test::SuiteRow& one)
{
  nlohmann::json row = Figures(one.Sum);
  row["group"] = one.Group;
  row["effect"] = one.Effect;
  row["method"] = one.Method;
  return row;
}

} // namespace

int main(int argc, char** argv)
{
  const double seconds = argc > 1 ? std::atof(argv[1]) : 4.0;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 20;
  const double longest = argc > 3 ? std::atof(argv[3]) : 100.0;
  const std::string only = argc > 4 ? argv[4] : "";
  std::vector<test::SuitePart> parts = test::SuiteParts();
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                [&](const test::SuitePart& p) {
                  return (p.Group + " | " + p.Effect + " | " + p.Method).find(only) ==
                    std::string::npos;
                }),
    parts.end());
  nlohmann::json out;
  out["question"] = "coverage of stated errors, effect by effect and method by method";
  benchmark::AddProvenance(out);
  out["effort"] = seconds;
  out["seeds"] = seeds;
  std::map<std::string, double> spent;
  auto last = std::chrono::steady_clock::now();
  const std::vector<test::SuiteRow> rows =
    test::RunSuite(parts, seconds, seeds, longest, [&](const test::SuiteRow& row) {
      const auto now = std::chrono::steady_clock::now();
      nlohmann::json said = Named(row);
      said["seconds"] = std::chrono::duration<double>(now - last).count();
      spent[row.Group + row.Effect + row.Method] += said["seconds"].get<double>();
      last = now;
      std::cerr << said.dump() << '\n';
    });
  test::Calibration all;
  std::map<std::string, test::Calibration> groups;
  for (const test::SuiteRow& row : rows)
  {
    nlohmann::json said = Named(row);
    said["seconds"] = spent[row.Group + row.Effect + row.Method];
    out["rows"].push_back(said);
    groups[row.Group].Add(row.Sum);
    all.Add(row.Sum);
  }
  for (const auto& [name, sum] : groups)
  {
    out["groups"][name] = Figures(sum);
  }
  out["all"] = Figures(all);
  std::cout << out.dump(1) << '\n';
  return 0;
}
