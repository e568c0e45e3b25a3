// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkRadiometricAlgorithm;
class vtkAlgorithm;

/// Makes copies of a simulating filter and runs them on behalf of another algorithm: their progress is
/// its progress, its abort theirs, their errors are thrown.
class StudyRunner
{
public:
  /// How a run ended.
  enum Ends
  {
    Done = 0,
    Late = 1,   // it went, or would have gone, beyond the limit
    Aborted = 2 // as the algorithm was
  };

  /// `limit`: seconds for all runs together, from now on; 0: none.
  StudyRunner(vtkAlgorithm* owner, vtkRadiometricAlgorithm* filter, double limit)
    : Owner(owner)
    , Filter(filter)
    , Limit(limit)
  {
  }

  /// A filter with the settings and, as they are now, the inputs of the one to study; these rounded
  /// to single precision where wanted.
  ///   Fails   std::runtime_error: it has no surface
  vtkSmartPointer<vtkRadiometricAlgorithm> Copy(bool rounded = false) const;

  /// What the next runs are called, and their part of the owner's progress.
  void Announce(const std::string& name, double begin, double end);
  /// Updates a copy; `seconds` is what that took.
  ///   Fails   std::runtime_error with what it said
  Ends Run(vtkRadiometricAlgorithm* copy, double& seconds);
  /// Whether the limit is over.
  bool IsLate() const { return this->Limit > 0.0 && this->Elapsed() >= this->Limit; }
  /// Why the last run was Late.
  const std::string& WhyLate() const { return this->Why; }
  /// What runs warned of, each once.
  const std::vector<std::string>& Warnings() const { return this->Warned; }

private:
  class Listener;
  double Elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

  vtkAlgorithm* Owner;
  vtkRadiometricAlgorithm* Filter;
  double Limit;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  std::string Name;
  double Begin = 0.0;
  double End = 1.0;
  std::string Why;
  std::vector<std::string> Warned;
};
