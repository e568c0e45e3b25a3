// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMultiProcessController;

/// The processes of a vtkMultiProcessController as the core's ranks (radiometry::Communicator).
///
/// Every call first agrees on whether all ranks are still at it. A rank that cannot go on (bad input,
/// an abort) calls Fail, once, in the place of whatever call the others make next: these then throw
/// what it said. So no rank waits for one that has left, wherever that happened.
class ControllerCommunicator : public radiometry::Communicator
{
public:
  /// Null where there is no other process.
  static std::unique_ptr<ControllerCommunicator> Make(vtkMultiProcessController* controller);

  int Rank() const override { return this->Own; }
  int Size() const override { return this->Count; }
  void Sum(double* values, std::size_t count) const override;
  void Sum(std::int64_t* values, std::size_t count) const override;
  void Largest(double* values, std::size_t count) const override;
  void Gather(double* values, const std::vector<std::size_t>& begin) const override;
  void Gather(std::int32_t* values, const std::vector<std::size_t>& begin) const override;

  /// The bytes of every rank, rank by rank; with a root only there (else empty).
  std::vector<std::vector<char>> GatherBytes(const std::vector<char>& own, int root = -1) const;

  /// Ranks that run on this one's machine, this one included.
  int RanksHere() const { return this->Neighbours; }

  /// A run begins: an earlier one's failure is forgotten.
  void Begin() const { this->Ended = false; }
  /// This rank ends with this message (empty: it was asked to stop). The message of the run is
  /// returned: with its rank in front where not all say the same. Nothing is sent where the end is
  /// already agreed on.
  std::string Fail(const std::string& message) const;
  /// This rank has all that it wants of the others. Throws where another one failed.
  void Finish() const { this->Agree(); }

private:
  explicit ControllerCommunicator(vtkMultiProcessController* controller);
  void Agree() const;
  std::string Messages(const std::string& own) const;
  template <class T>
  void Reduce(T* values, std::size_t count, int operation) const;
  template <class T>
  void Collect(T* values, const std::vector<std::size_t>& begin) const;

  vtkMultiProcessController* Controller;
  int Own;
  int Count;
  int Neighbours = 1;
  mutable bool Ended = false; // a failure is agreed on
};

/// Thrown on the ranks that could have gone on.
class OtherRankFailed : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Threads for this process where none are asked for (0): its share of its machine's processors.
/// `ranks` may be null.
int ThreadsOfRank(const ControllerCommunicator* ranks, int wanted);
