// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: what a run left out, how its error fell and what it cost, as data.
#ifndef RunReport_h
#define RunReport_h

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/effects/EffectPlan.h"

#include <string>
#include <utility>
#include <vector>

class vtkFieldData;
class vtkTable;

/// The rows of an EffectPlan table: effects, what else was left out, and parts of the error.
class PlanReport
{
public:
  /// `unit` of the bounds.
  explicit PlanReport(std::string unit)
    : Unit(std::move(unit))
  {
  }

  /// The effects that the computation knows.
  void Add(const std::vector<radiometry::EffectDecision>& effects);
  /// What was dropped beside them.
  void AddDropped(const std::string& name, const std::string& why, double bound);
  /// A part of the error.
  void AddEstimate(const std::string& name, const std::string& what, double value);

  /// Columns Effect, Switch, Decision, Bound, Unit, Seconds, Why.
  void Write(vtkTable* table) const;
  /// A sentence for each row but the parts of the error.
  const std::vector<std::string>& Sentences() const { return this->Lines; }
  /// The same, line by line.
  std::string Text() const;

private:
  struct Row
  {
    std::string Effect, Switch, Decision;
    double Bound, Seconds;
    std::string Why;
  };
  std::string Unit;
  std::vector<Row> Rows;
  std::vector<std::string> Lines;
};

/// Columns Seconds, EstimatedError, AbsoluteError, Samples, Stage, and one for each part of the error.
void WriteConvergence(const radiometry::ConvergenceRecord& record, vtkTable* table);

/// Writes the field array RadiometryCost (docs/arrays.md).
void AddRunCost(const radiometry::RunCost& cost, vtkFieldData* data);

#endif
