// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkAccuracyStudy_h
#define vtkAccuracyStudy_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"
#include "vtkSmartPointer.h"

#include <vector> // for the lists

class ControllerCommunicator;
class vtkMultiProcessController;
class vtkRadiometricAlgorithm;

/// What accuracy costs: runs a simulating filter at a list of tolerances or time budgets and compares.
///   Ports   0 any output of the filter (Irradiance, Radiosity, Radiance, View Factors), or of what
///           stands behind it: the study goes upstream to the nearest one. Optional with SetFilter.
///           1 reference (optional): a surface with the same cells or points and the same array; with
///           an Error array, or taken as exact without one
///   Runs    copies of the filter with its settings and its inputs, from coarse to fine; the filter
///           itself is not touched. Copies do not cut cells along shadows, nor read or write operators
///   Writes  output 0, vtkTable, a row a run: RelativeTolerance, TimeBudget [s], Seconds (of the
///           update), TotalSeconds (with the runs that it continues), PredictedSeconds (said before),
///           EstimatedError (area-weighted mean of stated errors over the mean value), AbsoluteError
///           and GreatestError (mean and greatest stated error, unit of the array), TrueError (RMS of
///           value - reference over the mean of the reference), TrueAbsoluteError, TrueGreatestError,
///           Coverage (share of values within hypot(error, error of the reference) of the reference),
///           Sharpness (median of error/|value - reference|), ReferenceError (that the reference states
///           of itself: true errors below it may be its own), Samples, MemoryMiB, "Error: ..." (mean
///           error by source, where the filter tells), Reference, Effects (that were simulated),
///           Outcome, Method. -1: not known (the reference itself has no true error)
///           output 1, vtkTable: Figure, Relation (of the figure to the value: =, <=, > or unknown),
///           Value, Unit, Note. Slopes p of error = c seconds^p; seconds to 10 %, 1 %, 0.1 %, 0.01 %
///           (between runs, in logarithms); predictions; float against double
///           output 2: the surface of the finest run: that with the least estimated error, which is
///           the reference where none is given
///           output 3, vtkTable for a line chart with logarithmic axes: Time [s], EstimatedError,
///           TrueError, errors below rounding as rounding; a row a run that has a true error (where
///           none has, a row a run without that column)
///   Ranks   all of them update the study; the first one has the tables, each has its surface
///   Cost    the sum of the runs; one copy of the array and its errors for each
///   Fails   no filter; lists that are empty, not finite or out of range; a reference that does not
///           fit; whatever makes the filter fail: one error, empty outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkAccuracyStudy : public vtkDataObjectAlgorithm
{
public:
  static vtkAccuracyStudy* New();
  vtkTypeMacro(vtkAccuracyStudy, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Mode.
  enum Modes
  {
    TOLERANCES = 0,
    TIME_BUDGETS = 1
  };

  ///@{
  /// The filter to study, in place of one upstream of port 0. It is not executed. Default: none.
  void SetFilter(vtkRadiometricAlgorithm* filter);
  vtkRadiometricAlgorithm* GetFilter();
  ///@}
  /// The filter that an update would study: that of SetFilter, or the nearest upstream of port 0. Null:
  /// none.
  vtkRadiometricAlgorithm* FindFilter();

  ///@{
  /// The reference (port 1).
  void SetReferenceConnection(vtkAlgorithmOutput* reference);
  void SetReferenceData(vtkDataObject* reference);
  ///@}

  ///@{
  /// Whether Tolerances (0, default) or TimeBudgets (1) are gone through. The other one of
  /// RelativeTolerance and TimeBudget stays as the filter has it, and whichever comes first ends a run.
  vtkSetClampMacro(Mode, int, TOLERANCES, TIME_BUDGETS);
  vtkGetMacro(Mode, int);
  ///@}
  ///@{
  /// Relative tolerances, in any order; equal ones count once. In [0, 1]. Default 0.1, 0.05, 0.02,
  /// 0.01, 0.005.
  void AddTolerance(double tolerance);
  void ClearTolerances();
  int GetNumberOfTolerances() const { return static_cast<int>(this->Tolerances.size()); }
  double GetTolerance(int index) const;
  ///@}
  ///@{
  /// Time budgets [s], in any order; equal ones count once. Finite, above 0. Default 0.5, 1, 2, 4, 8.
  void AddTimeBudget(double seconds);
  void ClearTimeBudgets();
  int GetNumberOfTimeBudgets() const { return static_cast<int>(this->TimeBudgets.size()); }
  double GetTimeBudget(int index) const;
  ///@}
  ///@{
  /// Whether every run begins from nothing, so that seconds can be compared (default on), or from
  /// what the run before found: what refining costs.
  vtkSetMacro(Fresh, bool);
  vtkGetMacro(Fresh, bool);
  vtkBooleanMacro(Fresh, bool);
  ///@}
  ///@{
  /// The array to study. Default none ("" or "None"): Irradiance, of Radiance its Radiance, of View
  /// Factors ViewFactorSum.
  vtkSetStringMacro(Array);
  vtkGetStringMacro(Array);
  ///@}
  ///@{
  /// Seconds for the whole study; a run that is predicted to go beyond is not made, one that does
  /// so all the same is ended, and the table ends before it. Default 0: no limit.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}
  ///@{
  /// Times that each run is made, for the median of their seconds; Fresh only. Default 1. [1, 100].
  vtkSetClampMacro(Repeats, int, 1, 100);
  vtkGetMacro(Repeats, int);
  ///@}
  ///@{
  /// Whether the finest run is made once more with the points, lights and materials of its inputs
  /// rounded to single precision. Default off.
  vtkSetMacro(FloatComparison, bool);
  vtkGetMacro(FloatComparison, bool);
  vtkBooleanMacro(FloatComparison, bool);
  ///@}
  ///@{
  /// The processes that hold the pieces of the surface. Default: the global controller.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  vtkMTimeType GetMTime() override;
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs, int port, vtkMTimeType* mtime) override;

protected:
  vtkAccuracyStudy();
  ~vtkAccuracyStudy() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Mode = TOLERANCES;
  std::vector<double> Tolerances{ 0.1, 0.05, 0.02, 0.01, 0.005 };
  std::vector<double> TimeBudgets{ 0.5, 1.0, 2.0, 4.0, 8.0 };
  bool Fresh = true;
  char* Array = nullptr;
  double TimeLimit = 0.0;
  int Repeats = 1;
  bool FloatComparison = false;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  void Study(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs);

  vtkSmartPointer<vtkRadiometricAlgorithm> Filter;

  vtkAccuracyStudy(const vtkAccuracyStudy&) = delete;
  void operator=(const vtkAccuracyStudy&) = delete;
};

#endif
