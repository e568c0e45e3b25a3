// SPDX-License-Identifier: BSD-3-Clause
#include "StudyTables.h"

#include "radiometry/accuracy/ErrorCurve.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <sstream>

namespace
{

constexpr double NotKnown = -1.0;
constexpr double Targets[] = { 0.1, 0.01, 0.001, 0.0001 };

template <typename Array>
Array* AddColumn(vtkTable* table, const std::string& name)
{
  vtkNew<Array> column;
  column->SetName(name.c_str());
  table->AddColumn(column);
  return column; // kept alive by the table
}

using NumberOf = std::function<double(const StudyRun&)>;
using WordsOf = std::function<std::string(const StudyRun&)>;

void AddNumbers(
  vtkTable* table, const std::string& name, const StudyRecord& study, const NumberOf& number)
{
  vtkNew<vtkDoubleArray> column; // filled first: a table wants columns of one length
  column->SetName(name.c_str());
  for (const StudyRun& run : study.Runs)
  {
    column->InsertNextValue(number(run));
  }
  table->AddColumn(column);
}

void AddWords(
  vtkTable* table, const std::string& name, const StudyRecord& study, const WordsOf& words)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name.c_str());
  for (const StudyRun& run : study.Runs)
  {
    column->InsertNextValue(words(run));
  }
  table->AddColumn(column);
}

std::string Text(double number)
{
  std::ostringstream text;
  text.precision(3);
  text << number;
  return text.str();
}

std::string Percent(double share)
{
  return Text(100.0 * share) + " %";
}

/// The rows of the summary.
class Rows
{
public:
  explicit Rows(vtkTable* table)
    : Figure(AddColumn<vtkStringArray>(table, "Figure"))
    , Relation(AddColumn<vtkStringArray>(table, "Relation"))
    , Value(AddColumn<vtkDoubleArray>(table, "Value"))
    , Unit(AddColumn<vtkStringArray>(table, "Unit"))
    , Note(AddColumn<vtkStringArray>(table, "Note"))
  {
  }
  void Add(const std::string& figure, const char* relation, double value, const char* unit,
    const std::string& note) const
  {
    this->Figure->InsertNextValue(figure);
    this->Relation->InsertNextValue(relation);
    this->Value->InsertNextValue(value);
    this->Unit->InsertNextValue(unit);
    this->Note->InsertNextValue(note);
  }

  /// A number that is not known is -1.
  void AddIf(bool known, const std::string& figure, double value, const std::string& note) const
  {
    this->Add(figure, known ? "=" : "unknown", known ? value : NotKnown, "1", note);
  }

private:
  vtkStringArray* Figure;
  vtkStringArray* Relation;
  vtkDoubleArray* Value;
  vtkStringArray* Unit;
  vtkStringArray* Note;
};

void AddSlope(const Rows& rows, const std::string& which, const radiometry::ErrorCurve& curve)
{
  const radiometry::PowerLaw law = radiometry::FitPowerLaw(curve);
  const bool falls = law.Falls();
  std::string note;
  if (falls)
  {
    note = which + " error = " + Text(law.Factor) + " seconds^" + Text(law.Exponent) + ", from " +
      std::to_string(law.Points) + " runs";
  }
  else if (law.Points < 3)
  {
    note = "not known: " + std::to_string(law.Points) + " runs have such an error above 0, three are "
                                                        "wanted";
  }
  else if (!law.Known)
  {
    note = "not known: the runs took nearly the same time";
  }
  else
  {
    note = "none: the error does not fall steadily with the time";
  }
  // A slope may be -1: where there is none it is 0, that of an error that does not fall.
  rows.Add("Slope of the " + which + " error", falls ? "=" : "unknown", falls ? law.Exponent : 0.0,
    "1", note);
}

void AddArrivals(const Rows& rows, const std::string& which, const radiometry::ErrorCurve& curve)
{
  for (const double target : Targets)
  {
    const std::string figure = "Seconds to " + Percent(target) + " " + which + " error";
    const radiometry::Arrival arrival = radiometry::ArriveAt(target, curve);
    if (arrival.Kind == radiometry::Arrival::Between)
    {
      rows.Add(figure, "=", arrival.Seconds, "s", "interpolated between runs");
    }
    else if (arrival.Kind == radiometry::Arrival::Already)
    {
      rows.Add(figure, "<=", arrival.Seconds, "s",
        "the shortest run already has " + Percent(curve.InTime().Errors.front()));
    }
    else if (curve.Errors.empty())
    {
      rows.Add(figure, "unknown", NotKnown, "s", "no run has a " + which + " error");
    }
    else
    {
      const double longest = *std::max_element(curve.Seconds.begin(), curve.Seconds.end());
      const double later = radiometry::FitPowerLaw(curve).SecondsTo(target);
      rows.Add(figure, ">", longest, "s",
        "the best run still has " +
          Percent(*std::min_element(curve.Errors.begin(), curve.Errors.end())) +
          (later > longest ? "; by the slope about " + Text(later) + " s" : ""));
    }
  }
}

bool HasTrueError(const StudyRun& run)
{
  return run.Compared && run.True.Relative >= 0.0;
}

/// How far the reference can be trusted.
void AddReference(const Rows& rows, const StudyRecord& study)
{
  const auto compared = std::find_if(
    study.Runs.begin(), study.Runs.end(), [](const StudyRun& run) { return run.Compared; });
  const bool known = compared != study.Runs.end() && compared->ReferenceError >= 0.0;
  const auto within = std::count_if(study.Runs.begin(), study.Runs.end(), [](const StudyRun& run) {
    return HasTrueError(run) && run.True.Relative < run.ReferenceError;
  });
  rows.AddIf(known, "Estimated error of the reference", known ? compared->ReferenceError : NotKnown,
    known ? compared->Reference + "; " + std::to_string(within) +
        " true errors are below it and may be its own"
          : std::string("no run is compared"));
}

void AddPredictions(const Rows& rows, const StudyRecord& study)
{
  std::size_t said = 0;
  std::size_t within = 0;
  for (const StudyRun& run : study.Runs)
  {
    if (run.PredictedSeconds >= 0.0)
    {
      ++said;
      within += run.PredictedSeconds <= 2.0 * run.Seconds &&
        run.Seconds <= 2.0 * run.PredictedSeconds;
    }
  }
  rows.AddIf(said > 0, "Runs predicted within a factor of two",
    static_cast<double>(within) / static_cast<double>(std::max<std::size_t>(said, 1)),
    std::to_string(within) + " of " + std::to_string(said) +
      " that said beforehand how long they would take");
}

void AddFloat(const Rows& rows, const StudyRecord::Rounding& rounding)
{
  if (!rounding.Asked)
  {
    return;
  }
  const bool known = rounding.Failure.empty() && rounding.Run.Values > 0;
  const std::string run = !rounding.Failure.empty()
    ? "not known: " + rounding.Failure
    : (known ? "the finest run, and the same with points, lights and materials rounded to single "
               "precision"
             : "not known: every value is 0");
  const std::string storage = "of the finest run's values if they were stored as float";
  rows.AddIf(known, "Float input: greatest relative difference", rounding.Run.Greatest, run);
  rows.AddIf(known, "Float input: median relative difference", rounding.Run.Median, run);
  const bool stored = rounding.Storage.Values > 0;
  rows.AddIf(
    stored, "Float result: greatest relative difference", rounding.Storage.Greatest, storage);
  rows.AddIf(
    stored, "Float result: median relative difference", rounding.Storage.Median, storage);
}

radiometry::ErrorCurve EstimatedCurve(const StudyRecord& study)
{
  radiometry::ErrorCurve curve;
  for (const StudyRun& run : study.Runs)
  {
    if (run.Stated.Relative >= 0.0)
    {
      curve.Seconds.push_back(run.TotalSeconds);
      curve.Errors.push_back(run.Stated.Relative);
    }
  }
  return curve;
}

radiometry::ErrorCurve TrueCurve(const StudyRecord& study)
{
  radiometry::ErrorCurve curve;
  for (const StudyRun& run : study.Runs)
  {
    if (HasTrueError(run))
    {
      curve.Seconds.push_back(run.TotalSeconds);
      curve.Errors.push_back(run.True.Relative);
    }
  }
  return curve;
}

/// A number that only runs have that were compared with a reference.
NumberOf IfCompared(double radiometry::Deviation::*member)
{
  return [member](const StudyRun& run) { return run.Compared ? run.True.*member : NotKnown; };
}

} // namespace

void WriteStudyRuns(const StudyRecord& study, vtkTable* table)
{
  const auto numbers = [&](const char* name, const NumberOf& number) {
    AddNumbers(table, name, study, number);
  };
  numbers("RelativeTolerance", [](const StudyRun& run) { return run.Tolerance; });
  numbers("TimeBudget", [](const StudyRun& run) { return run.Budget; });
  numbers("Seconds", [](const StudyRun& run) { return run.Seconds; });
  numbers("TotalSeconds", [](const StudyRun& run) { return run.TotalSeconds; });
  numbers("PredictedSeconds", [](const StudyRun& run) { return run.PredictedSeconds; });
  numbers("EstimatedError", [](const StudyRun& run) { return run.Stated.Relative; });
  numbers("AbsoluteError", [](const StudyRun& run) { return run.Stated.Absolute; });
  numbers("GreatestError", [](const StudyRun& run) { return run.Stated.Greatest; });
  numbers("TrueError", IfCompared(&radiometry::Deviation::Relative));
  numbers("TrueAbsoluteError", IfCompared(&radiometry::Deviation::Absolute));
  numbers("TrueGreatestError", IfCompared(&radiometry::Deviation::Greatest));
  numbers("Coverage", IfCompared(&radiometry::Deviation::Coverage));
  numbers("Sharpness", IfCompared(&radiometry::Deviation::Sharpness));
  numbers("ReferenceError", [](const StudyRun& run) { return run.ReferenceError; });
  numbers("Samples", [](const StudyRun& run) { return run.Samples; });
  numbers("MemoryMiB", [](const StudyRun& run) { return run.MemoryMiB; });
  std::vector<std::string> parts; // in the order of their first mention
  for (const StudyRun& run : study.Runs)
  {
    for (const auto& [name, value] : run.Parts)
    {
      if (std::find(parts.begin(), parts.end(), name) == parts.end())
      {
        parts.push_back(name);
      }
    }
  }
  for (const std::string& part : parts)
  {
    AddNumbers(table, part, study, [&](const StudyRun& run) {
      const auto found = std::find_if(run.Parts.begin(), run.Parts.end(),
        [&](const auto& named) { return named.first == part; });
      return found == run.Parts.end() ? NotKnown : found->second;
    });
  }
  AddWords(table, "Reference", study, [](const StudyRun& run) { return run.Reference; });
  AddWords(table, "Effects", study, [](const StudyRun& run) { return run.Effects; });
  AddWords(table, "Outcome", study, [](const StudyRun& run) { return run.Outcome; });
  AddWords(table, "Method", study, [](const StudyRun& run) { return run.Method; });
}

void WriteStudySummary(const StudyRecord& study, vtkTable* table)
{
  const Rows rows(table);
  const std::size_t made = study.Runs.size();
  rows.Add("Runs", "=", static_cast<double>(made), "1",
    "of " + std::to_string(study.Wanted) + ", of " + study.Quantity +
      (study.Stopped.empty() ? "" : "; " + study.Stopped));
  AddSlope(rows, "estimated", EstimatedCurve(study));
  AddSlope(rows, "true", TrueCurve(study));
  AddArrivals(rows, "estimated", EstimatedCurve(study));
  AddArrivals(rows, "true", TrueCurve(study));
  AddReference(rows, study);
  AddPredictions(rows, study);
  AddFloat(rows, study.Float);
}

void WriteStudyCurves(const StudyRecord& study, vtkTable* table)
{
  // A logarithmic axis has no place for 0, nor a table for a number that is missing.
  const auto drawn = [](double error) {
    return std::max(error, std::numeric_limits<double>::epsilon());
  };
  const bool anyTrue = std::any_of(study.Runs.begin(), study.Runs.end(), HasTrueError);
  StudyRecord shown;
  std::copy_if(study.Runs.begin(), study.Runs.end(), std::back_inserter(shown.Runs),
    [&](const StudyRun& run) {
      return run.Stated.Relative >= 0.0 && (HasTrueError(run) || !anyTrue);
    });
  std::stable_sort(shown.Runs.begin(), shown.Runs.end(), // lines join them in their order
    [](const StudyRun& a, const StudyRun& b) { return a.TotalSeconds < b.TotalSeconds; });
  AddNumbers(table, "Time", shown, [](const StudyRun& run) { return run.TotalSeconds; });
  AddNumbers(table, "EstimatedError", shown,
    [&](const StudyRun& run) { return drawn(run.Stated.Relative); });
  if (anyTrue)
  {
    AddNumbers(
      table, "TrueError", shown, [&](const StudyRun& run) { return drawn(run.True.Relative); });
  }
}
