// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace radiometry
{

/// What a run cost, and what it said of that before.
struct RunCost
{
  double Seconds = 0.0;           // of the whole run
  double PredictedSeconds = -1.0; // that the whole run would take, said before they were spent;
                                  // below 0: nothing was said
  double PredictedAt = 0.0;       // seconds spent when it was said: its pilot, a part of the run
  std::int64_t Samples = 0;       // rays, pairs, or evaluations
  std::size_t Bytes = 0;          // of the operator, or of what is kept a value, at the peak
};

} // namespace radiometry
