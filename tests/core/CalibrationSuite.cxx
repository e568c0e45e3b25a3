// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationSuite.h"

#include <algorithm>
#include <cmath>

namespace test
{

std::vector<SuitePart> SuiteParts(const std::string& group)
{
  std::vector<SuitePart> parts;
  AddDirectParts(parts);
  AddViewFactorParts(parts);
  AddRadianceParts(parts);
  AddRadiosityParts(parts);
  if (!group.empty())
  {
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                  [&](const SuitePart& part) { return part.Group != group; }),
      parts.end());
  }
  return parts;
}

void AddDirectParts(std::vector<SuitePart>& parts)
{
  for (const CalibrationCase& one : CalibrationCases())
  {
    const bool open = one.Blockers == "none";
    const bool own = one.Light.find(", ") != std::string::npos && !open &&
      (one.Blockers == "4 panes" || one.Blockers == "6 triangles");
    const bool crowded = one.Blockers == "3000 triangles" || one.Blockers == "400 triangles";
    const bool cells = one.Receivers == "cells";
    const double seconds = one.Slow ? 10.0 : crowded ? (cells ? 1.0 : 0.1) : cells ? 0.3 : 0.02;
    parts.push_back({ "direct light", one.Light + (open || own ? "" : ", shadows"), one.Receivers,
      one.Run, seconds });
  }
}

std::vector<SuiteRow> RunSuite(const std::vector<SuitePart>& parts, double seconds, int mostSeeds,
  double longest, const std::function<void(const SuiteRow&)>& done)
{
  std::vector<SuiteRow> rows;
  for (const SuitePart& part : parts)
  {
    if (part.Seconds > longest)
    {
      continue;
    }
    SuiteRow row{ part.Group, part.Effect, part.Method, {} };
    const int seeds =
      std::clamp(static_cast<int>(seconds / part.Seconds), 1, std::max(1, mostSeeds));
    for (int seed = 1; seed <= seeds; ++seed)
    {
      for (const Judged& value : part.Run(static_cast<std::uint64_t>(seed)))
      {
        row.Sum.Add(value);
      }
    }
    if (done)
    {
      done(row);
    }
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const SuiteRow& r) {
      return r.Group == row.Group && r.Effect == row.Effect && r.Method == row.Method;
    });
    if (same == rows.end())
    {
      rows.push_back(std::move(row));
    }
    else
    {
      same->Sum.Add(row.Sum);
    }
  }
  return rows;
}

double ChanceOfFewer(std::size_t covered, std::size_t count, double share)
{
  const auto n = static_cast<double>(count);
  double sum = 0.0;
  for (std::size_t k = 0; k <= std::min(covered, count); ++k)
  {
    const auto x = static_cast<double>(k);
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(x + 1.0) - std::lgamma(n - x + 1.0) +
      x * std::log(share) + (n - x) * std::log1p(-share));
  }
  return sum;
}

} // namespace test
