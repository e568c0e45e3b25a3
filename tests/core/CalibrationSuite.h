// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/Calibration.h"

#include <functional>
#include <string>
#include <vector>

/// All values whose stated error can be judged: each effect by each method, against closed forms and
/// converged references.
///   tests/core/CalibrationSuiteTest.cxx   cheap rows, with limits that fail
///   benchmarks/calibration.cxx            every row, as a table (docs/accuracy.md)
namespace test
{

/// Part of a row of the table; parts of one group, effect and method are put together.
struct SuitePart
{
  std::string Group;  // "direct light", "radiosity", "view factors", "radiance"
  std::string Effect; // what the value depends on
  std::string Method; // how it was computed, and for what receivers
  std::function<std::vector<Judged>(std::uint64_t seed)> Run;
  double Seconds = 0.01; // that a seed takes, about
};

/// The parts of every group, or of one.
std::vector<SuitePart> SuiteParts(const std::string& group = "");
void AddDirectParts(std::vector<SuitePart>& parts);
void AddRadianceParts(std::vector<SuitePart>& parts);
void AddRadiosityParts(std::vector<SuitePart>& parts);
void AddViewFactorParts(std::vector<SuitePart>& parts);

struct SuiteRow
{
  std::string Group, Effect, Method;
  Calibration Sum;
};

/// Runs the parts. Each gets as many seeds as `seconds` would pay for, at least one and at most
/// `mostSeeds`; a part of which one seed takes longer than `longest` is left out.
std::vector<SuiteRow> RunSuite(const std::vector<SuitePart>& parts, double seconds, int mostSeeds,
  double longest, const std::function<void(const SuiteRow&)>& done = {});

/// The chance that so many of `count` values or fewer are covered where each is by itself with a
/// chance of `share`.
double ChanceOfFewer(std::size_t covered, std::size_t count, double share);

} // namespace test
