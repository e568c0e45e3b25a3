// SPDX-License-Identifier: BSD-3-Clause
#include "ControllerCommunicator.h"

#include "radiometry/scene/Collective.h"
#include "radiometry/scene/Monitor.h"
#include "radiometry/scene/Parallel.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cstring>

namespace
{

constexpr int Fine = 0;
constexpr int Stopped = 1;
constexpr int Failed = 2;

/// Values in one message; MPI counts them in int.
constexpr std::size_t MostValues = std::size_t{ 1 } << 26;

std::int64_t HashOf(const std::string& text)
{
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : text)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  }
  return static_cast<std::int64_t>(hash >> 1);
}

} // namespace

std::unique_ptr<ControllerCommunicator> ControllerCommunicator::Make(vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return nullptr;
  }
  return std::unique_ptr<ControllerCommunicator>(new ControllerCommunicator(controller));
}

ControllerCommunicator::ControllerCommunicator(vtkMultiProcessController* controller)
  : Controller(controller)
  , Own(controller->GetLocalProcessId())
  , Count(controller->GetNumberOfProcesses())
{
  vtksys::SystemInformation machine;
  machine.RunOSCheck();
  const char* name = machine.GetHostname();
  const long long here = HashOf(name ? name : "");
  std::vector<long long> places(static_cast<std::size_t>(this->Count));
  this->Controller->AllGather(&here, places.data(), 1);
  this->Neighbours = static_cast<int>(std::count(places.begin(), places.end(), here));
}

std::string ControllerCommunicator::Messages(const std::string& own) const
{
  const auto length = static_cast<vtkIdType>(own.size());
  const auto size = static_cast<std::size_t>(this->Count);
  std::vector<vtkIdType> lengths(size), offsets(size, 0);
  this->Controller->AllGather(&length, lengths.data(), 1);
  for (std::size_t r = 1; r < size; ++r)
  {
    offsets[r] = offsets[r - 1] + lengths[r - 1];
  }
  std::string all(static_cast<std::size_t>(offsets.back() + lengths.back()), ' ');
  this->Controller->AllGatherV(own.data(), &all[0], length, lengths.data(), offsets.data());
  std::string first;
  bool same = true;
  bool tells = false;
  for (std::size_t r = 0; r < size; ++r)
  {
    const std::string text = all.substr(
      static_cast<std::size_t>(offsets[r]), static_cast<std::size_t>(lengths[r]));
    same = same && (r == 0 || text == all.substr(0, static_cast<std::size_t>(lengths[0])));
    // A rank that stopped because of another one has nothing to tell.
    if (!text.empty() && (first.empty() || !tells))
    {
      tells = text != radiometry::AnotherRankFailed;
      first = "rank " + std::to_string(r) + ": " + text;
    }
  }
  return same ? own : first;
}

void ControllerCommunicator::Agree() const
{
  int worst = Fine;
  this->Controller->AllReduce(&Fine, &worst, 1, vtkCommunicator::MAX_OP);
  if (worst == Fine)
  {
    return;
  }
  this->Ended = true;
  const std::string message = this->Messages("");
  if (worst == Stopped)
  {
    throw radiometry::Aborted();
  }
  throw OtherRankFailed(message);
}

std::string ControllerCommunicator::Fail(const std::string& message) const
{
  if (this->Ended)
  {
    return message;
  }
  this->Ended = true;
  const int state = message.empty() ? Stopped : Failed;
  int worst = Fine;
  this->Controller->AllReduce(&state, &worst, 1, vtkCommunicator::MAX_OP);
  return this->Messages(message);
}

template <class T>
void ControllerCommunicator::Reduce(T* values, std::size_t count, int operation) const
{
  this->Agree();
  std::vector<T> sums(std::min(count, MostValues));
  for (std::size_t done = 0; done < count; done += MostValues)
  {
    const std::size_t part = std::min(MostValues, count - done);
    this->Controller->AllReduce(
      values + done, sums.data(), static_cast<vtkIdType>(part), operation);
    std::copy_n(sums.begin(), part, values + done);
  }
}

void ControllerCommunicator::Sum(double* values, std::size_t count) const
{
  this->Reduce(values, count, vtkCommunicator::SUM_OP);
}
void ControllerCommunicator::Sum(std::int64_t* values, std::size_t count) const
{
  this->Reduce(values, count, vtkCommunicator::SUM_OP);
}
void ControllerCommunicator::Largest(double* values, std::size_t count) const
{
  this->Reduce(values, count, vtkCommunicator::MAX_OP);
}

template <class T>
void ControllerCommunicator::Collect(T* values, const std::vector<std::size_t>& begin) const
{
  this->Agree();
  const auto size = static_cast<std::size_t>(this->Count);
  if (begin[size] - begin[0] <= MostValues)
  {
    std::vector<vtkIdType> lengths(size), offsets(size);
    for (std::size_t r = 0; r < size; ++r)
    {
      lengths[r] = static_cast<vtkIdType>(begin[r + 1] - begin[r]);
      offsets[r] = static_cast<vtkIdType>(begin[r] - begin[0]);
    }
    const auto own = static_cast<std::size_t>(this->Own);
    const std::vector<T> mine(values + begin[own], values + begin[own + 1]);
    this->Controller->AllGatherV(
      mine.data(), values + begin[0], lengths[own], lengths.data(), offsets.data());
    return;
  }
  for (std::size_t r = 0; r < size; ++r)
  {
    for (std::size_t done = begin[r]; done < begin[r + 1]; done += MostValues)
    {
      const std::size_t part = std::min(MostValues, begin[r + 1] - done);
      this->Controller->Broadcast(values + done, static_cast<vtkIdType>(part), static_cast<int>(r));
    }
  }
}

void ControllerCommunicator::Gather(double* values, const std::vector<std::size_t>& begin) const
{
  this->Collect(values, begin);
}
void ControllerCommunicator::Gather(std::int32_t* values, const std::vector<std::size_t>& begin) const
{
  this->Collect(values, begin);
}

std::vector<std::vector<char>> ControllerCommunicator::GatherBytes(
  const std::vector<char>& own, int root) const
{
  this->Agree();
  const auto length = static_cast<long long>(own.size());
  std::vector<long long> lengths(static_cast<std::size_t>(this->Count));
  this->Controller->AllGather(&length, lengths.data(), 1);
  constexpr int tag = 721083;
  std::vector<std::vector<char>> all(lengths.size());
  for (int r = 0; r < this->Count; ++r)
  {
    const auto count = static_cast<std::size_t>(lengths[static_cast<std::size_t>(r)]);
    std::vector<char>& bytes = all[static_cast<std::size_t>(r)];
    if (r == this->Own)
    {
      bytes = own;
    }
    else if (root < 0 || this->Own == root)
    {
      bytes.resize(count);
    }
    for (std::size_t done = 0; done < count; done += MostValues)
    {
      const auto part = static_cast<vtkIdType>(std::min(MostValues, count - done));
      if (root < 0)
      {
        this->Controller->Broadcast(bytes.data() + done, part, r);
      }
      else if (r == this->Own && r != root)
      {
        this->Controller->Send(bytes.data() + done, part, root, tag);
      }
      else if (r != root && this->Own == root)
      {
        this->Controller->Receive(bytes.data() + done, part, r, tag);
      }
    }
  }
  return root < 0 || this->Own == root ? all : std::vector<std::vector<char>>();
}

int ThreadsOfRank(const ControllerCommunicator* ranks, int wanted)
{
  if (wanted > 0 || !ranks)
  {
    return wanted;
  }
  // What mpiexec bound this process to may already be its share.
  vtksys::SystemInformation machine;
  machine.RunCPUCheck();
  const int processors = std::max<int>(1, static_cast<int>(machine.GetNumberOfLogicalCPU()));
  return std::max(
    1, std::min(radiometry::AvailableThreads(), processors / std::max(1, ranks->RanksHere())));
}
