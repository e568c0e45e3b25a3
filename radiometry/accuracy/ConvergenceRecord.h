// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace radiometry
{

/// How the estimated error of a run fell as it spent time: the rows of the Convergence table.
class ConvergenceRecord
{
public:
  struct Row
  {
    double Seconds;       // since the run began
    double RelativeError; // estimated: area-weighted mean error over area-weighted mean value
    double AbsoluteError; // the area-weighted mean error in the unit of the result
    std::int64_t Samples; // rays, pairs or iterations spent so far
    std::string Stage;
    std::vector<double> Parts; // of AbsoluteError, as PartNames; empty where not told apart
  };

  /// Seconds since construction.
  double Elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }
  void Add(std::string stage, double relativeError, double absoluteError, std::int64_t samples,
    std::vector<double> parts = {})
  {
    this->Rows.push_back({ this->Elapsed(), relativeError, absoluteError, samples,
      std::move(stage), std::move(parts) });
  }

  std::vector<Row> Rows;
  std::vector<std::string> PartNames; // one word each; none: errors are not told apart

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace radiometry
