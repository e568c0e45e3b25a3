// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <chrono>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace radiometry
{

int AvailableThreads()
{
  return tbb::this_task_arena::max_concurrency();
}

void ParallelFor(std::size_t n, int threads, const StageProgress& stage,
  const std::function<void(std::size_t)>& body, double cost)
{
  using clock = std::chrono::steady_clock;
  constexpr double roundSeconds = 0.1;
  const int available = AvailableThreads();
  tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
  const double workers = arena.max_concurrency();

  Report(stage.Listener, stage.Begin, stage.Name);
  std::size_t done = 0;
  double round = std::max(workers, 0.2 * roundSeconds * workers / cost);
  while (done < n)
  {
    const std::size_t end = std::min(n, done + static_cast<std::size_t>(round));
    const auto start = clock::now();
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(done, end), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          body(i);
        }
      });
    });
    const double seconds = std::chrono::duration<double>(clock::now() - start).count();
    // The next round aims at the wanted length, but grows no faster than fourfold, and keeps all
    // threads busy where one body takes longer than that.
    const double wanted = round * roundSeconds / std::max(seconds, 1e-6);
    round = std::max(workers, std::min(4.0 * round, wanted));
    done = end;
    Report(stage.Listener,
      stage.Begin + (stage.End - stage.Begin) * static_cast<double>(done) / static_cast<double>(n),
      stage.Name);
  }
}

} // namespace radiometry
