// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrThreads.h"

#include <IlmThreadPool.h>
#include <algorithm>
#include <atomic>
#include <mutex>
#include <tbb/task_arena.h>
#include <thread>
#include <unistd.h>

namespace radiometry::io
{
namespace
{

/// Runs OpenEXR's tasks in an arena of its own. They are enqueued, not spawned: oneTBB then has at
/// least one worker for them even on one core, and the thread that waits for them may block.
class ArenaProvider : public IlmThread::ThreadPoolProvider
{
public:
  ~ArenaProvider() override { this->ArenaProvider::finish(); }
  int numThreads() const override { return this->Threads; }
  void setNumThreads(int) override {}
  void addTask(IlmThread::Task* task) override
  {
    if (getpid() != this->Process)
    {
      Run(task); // a forked child has the arena but not its workers
      return;
    }
    ++this->Pending;
    this->Arena.enqueue([this, task] {
      Run(task);
      --this->Pending;
    });
  }
  void finish() override
  {
    while (getpid() == this->Process && this->Pending > 0)
    {
      std::this_thread::yield();
    }
  }

private:
  static void Run(IlmThread::Task* task)
  {
    IlmThread::TaskGroup* group = task->group();
    task->execute();
    delete task;
    if (group)
    {
      group->finishOneTask();
    }
  }

  const int Threads = tbb::this_task_arena::max_concurrency();
  const pid_t Process = getpid();
  tbb::task_arena Arena{ this->Threads, 1 }; // one slot is for the thread that waits
  std::atomic<int> Pending{ 0 };
};

} // namespace

int ExrThreads(int wanted)
{
  const int all = tbb::this_task_arena::max_concurrency();
  const int threads = wanted > 0 ? std::min(wanted, all) : all;
  if (threads < 2)
  {
    return 0;
  }
  static std::once_flag once;
  std::call_once(once, [] {
    IlmThread::ThreadPool& pool = IlmThread::ThreadPool::globalThreadPool();
    if (pool.numThreads() == 0)
    {
      pool.setThreadProvider(new ArenaProvider);
    }
  });
  return threads;
}

} // namespace radiometry::io
