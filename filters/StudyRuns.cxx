// SPDX-License-Identifier: BSD-3-Clause
#include "StudyRuns.h"

#include "ControllerCommunicator.h"
#include "StatisticsGathering.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Monitor.h"
#include "vtkRadiometricAlgorithm.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace
{

constexpr double RunsShare = 0.95; // of the progress; the rest is the float comparison's

double MedianOf(std::vector<double> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  const std::size_t n = numbers.size();
  return 0.5 * (numbers[(n - 1) / 2] + numbers[n / 2]);
}

/// Where each run begins in the progress, and the last one ends: roughly as their time.
std::vector<double> ProgressOf(const std::vector<double>& levels, bool budgets)
{
  std::vector<double> ends{ 0.0 };
  for (const double level : levels)
  {
    ends.push_back(ends.back() + (budgets ? level : 1.0 / std::max(level, 1e-4)));
  }
  for (double& end : ends)
  {
    end *= RunsShare / ends.back();
  }
  return ends;
}

void SetLevel(vtkRadiometricAlgorithm* copy, double level, bool budgets)
{
  if (budgets)
  {
    copy->SetTimeBudget(level);
  }
  else
  {
    copy->SetRelativeTolerance(level);
  }
}

} // namespace

StudyRuns::StudyRuns(StudyRunner& runner, const ControllerCommunicator* ranks,
  const std::string& array, double metersPerUnit)
  : Runner(runner)
  , Ranks(ranks)
  , Array(array)
  , MetersPerUnit(metersPerUnit)
{
  this->Study.Quantity = array;
}

void StudyRuns::SetReference(vtkDataObject* reference)
{
  this->HasReference = true;
  this->Reference = this->Read(reference, "Reference ", nullptr, nullptr);
}

radiometry::StatedValues StudyRuns::Read(
  vtkDataObject* surface, const std::string& whose, vtkRadiometricAlgorithm* from, StudyRun* run)
{
  vtkSmartPointer<vtkDataObject> whole = surface;
  if (this->Ranks)
  {
    whole = GatherForStatistics(
      *this->Ranks, surface, { this->Array, this->Array + radiometry::names::ErrorSuffix });
  }
  radiometry::StatedValues values;
  if (whole)
  {
    values = ReadStatedValues(whole, this->Array, this->MetersPerUnit, whose);
    if (run)
    {
      ReadReport(from, whole, *run);
    }
  }
  if (this->Ranks)
  {
    this->Ranks->Finish(); // no rank goes on where the first one failed
  }
  return values;
}

StudyRunner::Ends StudyRuns::Agreed(StudyRunner::Ends end) const
{
  double worst = end;
  if (this->Ranks)
  {
    this->Ranks->Largest(&worst, 1);
  }
  if (worst == static_cast<double>(StudyRunner::Aborted))
  {
    throw radiometry::Aborted();
  }
  return worst > 0.0 ? StudyRunner::Late : StudyRunner::Done;
}

bool StudyRuns::RunWell(vtkRadiometricAlgorithm* copy, const std::string& name, double& seconds)
{
  std::string why = "the time limit was over";
  bool done = this->Agreed(this->Runner.IsLate() ? StudyRunner::Late : StudyRunner::Done) ==
    StudyRunner::Done;
  if (done)
  {
    done = this->Agreed(this->Runner.Run(copy, seconds)) == StudyRunner::Done;
    why = this->Runner.WhyLate().empty() ? "the time limit of another rank" : this->Runner.WhyLate();
  }
  if (!done)
  {
    this->Study.Stopped = name + " was not made: " + why;
  }
  return done;
}

void StudyRuns::Add(vtkRadiometricAlgorithm* copy, double seconds, bool fresh)
{
  StudyRun run;
  run.Tolerance = copy->GetRelativeTolerance();
  run.Budget = copy->GetTimeBudget();
  run.Seconds = run.TotalSeconds = seconds;
  if (!fresh && !this->Study.Runs.empty())
  {
    run.TotalSeconds += this->Study.Runs.back().TotalSeconds;
  }
  vtkDataObject* const surface = copy->GetOutputDataObject(0);
  run.Values = this->Read(surface, "", copy, &run);
  run.Stated = radiometry::SummarizeErrors(run.Values);
  this->Study.Runs.push_back(std::move(run));
  this->KeepFinest(surface);
}

void StudyRuns::KeepFinest(vtkDataObject* surface)
{
  const std::vector<StudyRun>& runs = this->Study.Runs;
  const auto error = [&](std::size_t run) {
    const double relative = runs[run].Stated.Relative;
    return relative >= 0.0 ? relative : std::numeric_limits<double>::infinity();
  };
  double finest = error(runs.size() - 1) <= error(this->FinestRun) ? 1.0 : 0.0;
  if (this->Ranks) // the first one knows
  {
    finest = this->Ranks->Rank() == 0 ? finest : 0.0;
    this->Ranks->Largest(&finest, 1);
  }
  if (finest > 0.0)
  {
    this->FinestRun = runs.size() - 1;
    this->FinestSurface = vtk::TakeSmartPointer(surface->NewInstance());
    this->FinestSurface->ShallowCopy(surface);
  }
}

void StudyRuns::Make(const std::vector<double>& levels, bool budgets, bool fresh, int repeats)
{
  this->Study.Wanted = levels.size();
  const std::vector<double> progress = ProgressOf(levels, budgets);
  vtkSmartPointer<vtkRadiometricAlgorithm> copy;
  for (std::size_t k = 0; k < levels.size(); ++k)
  {
    std::ostringstream name;
    name << "run " << k + 1 << " of " << levels.size() << " ("
         << (budgets ? "TimeBudget " : "RelativeTolerance ") << levels[k] << ")";
    this->Runner.Announce(name.str(), progress[k], progress[k + 1]);
    std::vector<double> seconds;
    for (int repeat = 0; repeat < (fresh ? repeats : 1); ++repeat)
    {
      if (fresh || !copy)
      {
        copy = nullptr; // its memory first
        copy = this->Runner.Copy();
      }
      SetLevel(copy, levels[k], budgets);
      seconds.push_back(0.0);
      if (!this->RunWell(copy, name.str(), seconds.back()))
      {
        return;
      }
    }
    this->Add(copy, MedianOf(seconds), fresh);
  }
}

void StudyRuns::Compare()
{
  std::vector<StudyRun>& runs = this->Study.Runs;
  if (runs.empty())
  {
    return;
  }
  const StudyRun& best = runs[this->FinestRun];
  this->Finest = best.Values;
  const radiometry::StatedValues& reference = this->HasReference ? this->Reference : this->Finest;
  std::ostringstream finest;
  finest << "run " << this->FinestRun + 1 << ", of the least estimated error (RelativeTolerance "
         << best.Tolerance << ", TimeBudget " << best.Budget << ")";
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    StudyRun& run = runs[k];
    run.Reference = "none: this run is the reference";
    if (this->HasReference || k != this->FinestRun)
    {
      run.True = radiometry::Compare(run.Values, reference);
      run.Compared = run.True.Values > 0;
      run.ReferenceError = radiometry::SummarizeErrors(reference).Relative;
      run.Reference = this->HasReference ? "the reference that was given" : finest.str();
    }
    run.Values = {};
  }
}

std::string StudyRuns::RunRounded(radiometry::StatedValues& values)
{
  const auto copy = this->Runner.Copy(true);
  copy->SetRelativeTolerance(this->Study.Runs[this->FinestRun].Tolerance);
  copy->SetTimeBudget(this->Study.Runs[this->FinestRun].Budget);
  this->Runner.Announce("the finest run with input in single precision", RunsShare, 1.0);
  StudyRunner::Ends end = StudyRunner::Late;
  try
  {
    double seconds = 0.0;
    end = this->Runner.IsLate() ? end : this->Runner.Run(copy, seconds);
  }
  catch (const std::runtime_error& error) // rounded input may be bad input
  {
    return error.what();
  }
  if (this->Agreed(end) != StudyRunner::Done)
  {
    return "the time limit left no time for it";
  }
  values = this->Read(copy->GetOutputDataObject(0), "", nullptr, nullptr);
  return {};
}

void StudyRuns::CompareFloat()
{
  StudyRecord::Rounding& found = this->Study.Float;
  found.Asked = true;
  if (this->Study.Runs.empty())
  {
    found.Failure = "no run was made";
    return;
  }
  found.Storage = radiometry::FloatStorage(this->Finest);
  radiometry::StatedValues values;
  found.Failure = this->RunRounded(values);
  if (found.Failure.empty() && values.Values.size() != this->Finest.Values.size())
  {
    found.Failure = "rounding changed the number of values from " +
      std::to_string(this->Finest.Values.size()) + " to " + std::to_string(values.Values.size());
  }
  if (found.Failure.empty())
  {
    found.Run = radiometry::Differences(this->Finest, values);
  }
}
