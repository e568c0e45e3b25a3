// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/StatedValues.h"

#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkRadiometricAlgorithm;

/// One run of an Accuracy Study: a row of its table.
struct StudyRun
{
  double Tolerance = 0.0;
  double Budget = 0.0;
  double Seconds = 0.0;      // of the update
  double TotalSeconds = 0.0; // of this run and of those that it continues
  double PredictedSeconds = -1.0;
  double Samples = -1.0;
  double MemoryMiB = -1.0;
  std::vector<std::pair<std::string, double>> Parts; // of the error, by source
  std::string Effects; // that were simulated
  std::string Outcome;
  std::string Method;

  radiometry::StatedValues Values;
  radiometry::StatedError Stated;
  bool Compared = false; // with a reference, which is what TrueError is of
  radiometry::Deviation True;
  std::string Reference; // its name
  double ReferenceError = -1.0; // that it states of itself, as Stated.Relative
};

/// The array that is first among a filter's results.
std::string FirstQuantity(vtkRadiometricAlgorithm* filter);

/// The values of an array of a surface (the whole of it, whatever the ranks), of its cells where it is
/// there, else of its points; weights are areas [m^2]. Sensors count by the pieces of surface that
/// they stand for.
///   Fails   InputError: no block has the array; a value that is not finite; errors of another shape
radiometry::StatedValues ReadStatedValues(
  vtkDataObject* surface, const std::string& array, double metersPerUnit, const std::string& whose);

/// Reads what a filter's outputs say beside the values: cost, plan, outcome.
///   `surface`  its output 0
void ReadReport(vtkRadiometricAlgorithm* filter, vtkDataObject* surface, StudyRun& run);
