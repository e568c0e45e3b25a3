// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StudyRun.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkTable;

/// What an Accuracy Study found.
struct StudyRecord
{
  std::vector<StudyRun> Runs; // from coarse to fine
  std::size_t Wanted = 0;     // runs that were asked for
  std::string Stopped;        // why there are fewer; empty: there are not
  std::string Quantity;       // name of the array

  /// The finest run once more with input rounded to single precision.
  struct Rounding
  {
    bool Asked = false;
    std::string Failure; // empty: it went well
    radiometry::RelativeDifference Run;
    radiometry::RelativeDifference Storage; // of the result as float
  };
  Rounding Float;
};

/// A row a run (vtkAccuracyStudy.h names the columns).
void WriteStudyRuns(const StudyRecord& study, vtkTable* table);
/// Figure, Relation, Value, Unit, Note.
void WriteStudySummary(const StudyRecord& study, vtkTable* table);
/// What a chart of error against time draws.
void WriteStudyCurves(const StudyRecord& study, vtkTable* table);
