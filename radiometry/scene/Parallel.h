// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Monitor.h"

#include <cstddef>
#include <functional>

namespace radiometry
{

/// Where a stage's progress lies in that of the whole run.
struct StageProgress
{
  Monitor* Listener = nullptr;
  double Begin = 0.0;
  double End = 1.0;
  const char* Name = "";
};

/// Runs body(i) for every i in [0, n) on `threads` threads of oneTBB (0: all), in rounds short
/// enough that progress is reported and an abort is seen about every 0.1 s. Bodies must write
/// only what belongs to their own index: then the result does not depend on the threads.
/// `cost` is a guess of the seconds one body takes; it only sizes the first round.
/// Throws Aborted when the monitor says so, and what a body throws.
void ParallelFor(std::size_t n, int threads, const StageProgress& stage,
  const std::function<void(std::size_t)>& body, double cost = 1e-5);

/// Threads that this process may use.
int AvailableThreads();

} // namespace radiometry
