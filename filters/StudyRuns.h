// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StudyRunner.h"
#include "StudyTables.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class ControllerCommunicator;
class vtkDataObject;
class vtkRadiometricAlgorithm;

/// The runs of an Accuracy Study and what they say of each other. Collective: every rank makes the same
/// calls; the first one has the values. Throws Aborted when the runner's owner was, and what makes a run
/// fail.
class StudyRuns
{
public:
  /// `ranks`: null, this process alone. `array`: the quantity to study.
  StudyRuns(StudyRunner& runner, const ControllerCommunicator* ranks, const std::string& array,
    double metersPerUnit);

  /// A surface that all runs are compared with, in place of the finest of them: that with the least
  /// estimated error (the last one of equal ones).
  void SetReference(vtkDataObject* reference);
  /// Makes the runs, one for each tolerance or time budget; ends early where the runner is late.
  /// `fresh`: each from nothing, `repeats` times; else each goes on from the one before.
  void Make(const std::vector<double>& levels, bool budgets, bool fresh, int repeats);
  /// The true errors of the runs that were made.
  void Compare();
  /// The finest run once more with rounded input. After Compare.
  void CompareFloat();

  const StudyRecord& Record() const { return this->Study; }
  /// The surface of the finest run; null: none was made.
  vtkDataObject* Surface() const { return this->FinestSurface; }

private:
  radiometry::StatedValues Read(
    vtkDataObject* surface, const std::string& whose, vtkRadiometricAlgorithm* from, StudyRun* run);
  StudyRunner::Ends Agreed(StudyRunner::Ends end) const;
  bool RunWell(vtkRadiometricAlgorithm* copy, const std::string& name, double& seconds);
  void Add(vtkRadiometricAlgorithm* copy, double seconds, bool fresh);
  void KeepFinest(vtkDataObject* surface);
  std::string RunRounded(radiometry::StatedValues& values);

  StudyRunner& Runner;
  const ControllerCommunicator* Ranks;
  std::string Array;
  double MetersPerUnit;
  StudyRecord Study;
  bool HasReference = false;
  radiometry::StatedValues Reference;
  radiometry::StatedValues Finest;
  std::size_t FinestRun = 0;
  vtkSmartPointer<vtkDataObject> FinestSurface;
};
