// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace test
{

/// Threads that act as the ranks of a computation: each runs the same body with a Communicator of
/// its own. A body that throws stops the others at their next call; Run rethrows the first.
///
///   test::ThreadRanks(3).Run([&](const radiometry::Communicator& ranks) { ... });
class ThreadRanks
{
public:
  explicit ThreadRanks(int size)
    : Size(size)
    , Places(static_cast<std::size_t>(size), nullptr)
  {
  }

  template <class Body>
  void Run(Body&& body)
  {
    std::vector<std::exception_ptr> errors(this->Places.size());
    std::vector<std::thread> threads;
    for (int r = 0; r < this->Size; ++r)
    {
      threads.emplace_back([&, r] {
        try
        {
          const Member member(*this, r);
          body(static_cast<const radiometry::Communicator&>(member));
        }
        catch (...)
        {
          errors[static_cast<std::size_t>(r)] = std::current_exception();
        }
        this->Leave();
      });
    }
    for (std::thread& t : threads)
    {
      t.join();
    }
    // What the others saw then is that they were left alone.
    std::exception_ptr left;
    for (const auto& error : errors)
    {
      try
      {
        if (error)
        {
          std::rethrow_exception(error);
        }
      }
      catch (const LeftAlone&)
      {
        left = error;
      }
    }
    if (left)
    {
      std::rethrow_exception(left);
    }
  }

private:
  /// A rank has ended while others still wait for it: their calls do not match.
  struct LeftAlone : std::runtime_error
  {
    LeftAlone()
      : std::runtime_error("a rank ended before a collective call of the others")
    {
    }
  };

  /// Waits for all; throws when one has ended.
  void Wait()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    if (this->Gone > 0)
    {
      throw LeftAlone();
    }
    const long round = this->Round;
    if (++this->Waiting == this->Size)
    {
      this->Waiting = 0;
      ++this->Round;
      this->Changed.notify_all();
      return;
    }
    this->Changed.wait(lock, [&] { return this->Round != round || this->Gone > 0; });
    if (this->Round == round)
    {
      throw LeftAlone();
    }
  }
  void Leave()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    ++this->Gone;
    this->Changed.notify_all();
  }

  class Member : public radiometry::Communicator
  {
  public:
    Member(ThreadRanks& all, int rank)
      : All(all)
      , Own(rank)
    {
    }
    int Rank() const override { return this->Own; }
    int Size() const override { return this->All.Size; }
    void Sum(double* values, std::size_t count) const override
    {
      this->Reduce(values, count, [](double a, double b) { return a + b; });
    }
    void Sum(std::int64_t* values, std::size_t count) const override
    {
      this->Reduce(values, count, [](std::int64_t a, std::int64_t b) { return a + b; });
    }
    void Largest(double* values, std::size_t count) const override
    {
      this->Reduce(values, count, [](double a, double b) { return std::max(a, b); });
    }
    void Gather(double* values, const std::vector<std::size_t>& begin) const override
    {
      this->Collect(values, begin);
    }
    void Gather(std::int32_t* values, const std::vector<std::size_t>& begin) const override
    {
      this->Collect(values, begin);
    }

  private:
    template <class T>
    T* Of(int rank) const
    {
      return static_cast<T*>(this->All.Places[static_cast<std::size_t>(rank)]);
    }
    void Meet(void* values) const
    {
      this->All.Places[static_cast<std::size_t>(this->Own)] = values;
      this->All.Wait();
    }
    template <class T, class F>
    void Reduce(T* values, std::size_t count, F&& f) const
    {
      this->Meet(values);
      std::vector<T> all(this->Of<T>(0), this->Of<T>(0) + count);
      for (int r = 1; r < this->Size(); ++r)
      {
        for (std::size_t k = 0; k < count; ++k)
        {
          all[k] = f(all[k], this->Of<T>(r)[k]);
        }
      }
      this->All.Wait();
      std::copy(all.begin(), all.end(), values);
    }
    template <class T>
    void Collect(T* values, const std::vector<std::size_t>& begin) const
    {
      this->Meet(values);
      for (int r = 0; r < this->Size(); ++r)
      {
        const std::size_t from = begin[static_cast<std::size_t>(r)];
        const std::size_t to = begin[static_cast<std::size_t>(r) + 1];
        if (r != this->Own)
        {
          std::copy(this->Of<T>(r) + from, this->Of<T>(r) + to, values + from);
        }
      }
      this->All.Wait();
    }

    ThreadRanks& All;
    int Own;
  };

  int Size;
  std::vector<void*> Places;
  std::mutex Mutex;
  std::condition_variable Changed;
  int Waiting = 0;
  int Gone = 0;
  long Round = 0;
};

} // namespace test
