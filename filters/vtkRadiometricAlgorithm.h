// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricAlgorithm_h
#define vtkRadiometricAlgorithm_h

#include "vtkCommand.h"
#include "vtkDataObjectAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class ControllerCommunicator;
class vtkMultiProcessController;

/// What every filter that computes on a whole surface shares: ports, limits, ranks, how it fails.
///   Ports   0 the surface; the last one occluders, which only block light (repeatable, optional);
///           others are the subclass's. Polydata, composite data, or any dataset, whose outer surface
///           is then taken
///   Outputs 0 the surface with its results (composite data keeps its structure); then vtkTables
///   Fails   what the subclass throws becomes one error event on every rank, and empty outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricAlgorithm : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkRadiometricAlgorithm, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of the effect switches and of Refinement.
  enum Switches
  {
    AUTO = 0,
    ON = 1,
    OFF = 2
  };

  /// Invoked in an execution when it is known how long the whole of it will take
  /// (GetPredictedSeconds); call data: a double, the seconds.
  enum Events
  {
    PredictedEvent = vtkCommand::UserEvent + 7001
  };

  /// Takes over every property of a filter of the same class; not its inputs, nor what it keeps
  /// between executions. A subclass adds its own; tests/filters/test_copy_settings.py finds a property
  /// that was forgotten.
  ///   Fails   a filter of another class: an error event, nothing is changed
  void CopySettings(vtkRadiometricAlgorithm* from);

  /// Further surfaces that only block light (the last input port, repeatable).
  void AddOccludersConnection(vtkAlgorithmOutput* occluders);
  void AddOccludersData(vtkDataObject* occluders);
  void RemoveOccludersConnections();

  ///@{
  /// Error that each value is computed to, relative to the value. Default 0.01. Range [0, 1].
  vtkSetMacro(RelativeTolerance, double);
  vtkGetMacro(RelativeTolerance, double);
  ///@}
  ///@{
  /// Error that is good enough whatever the value, in the result's unit (W/m^2; 1 for view factors).
  /// Default 0 (1e-4 for view factors). At least 0.
  vtkSetMacro(AbsoluteTolerance, double);
  vtkGetMacro(AbsoluteTolerance, double);
  ///@}
  ///@{
  /// Seconds after which refinement stops, tolerance met or not; the result says which. Default 0,
  /// no limit. The first estimate of every value is always finished.
  vtkSetMacro(TimeBudget, double);
  vtkGetMacro(TimeBudget, double);
  ///@}
  ///@{
  /// What the last execution said that it would take, before it spent it, and what it took [s];
  /// below 0: nothing was said (before the first one, or a filter that does not predict).
  vtkGetMacro(PredictedSeconds, double);
  vtkGetMacro(ElapsedSeconds, double);
  ///@}
  /// Seconds that an execution with the present settings will take, by running the pilot of one;
  /// outputs stay empty until the next update, which goes on from there. Below 0: it cannot be said.
  double PredictSeconds();
  /// A sentence an effect, line by line: why the last execution kept it or left it out, and what that
  /// may change. Empty before the first one. The same as field data EffectPlan.
  std::string Explain() const { return this->Explanation; }
  ///@{
  /// Memory that the run may take [MiB]. Default 0: half of the machine's.
  vtkSetMacro(MemoryLimit, double);
  vtkGetMacro(MemoryLimit, double);
  ///@}
  ///@{
  /// Whether surfaces receive, emit, reflect and see on both sides. Default off: the front only (where
  /// points turn counter-clockwise). A cell array TwoSided overrides it cell by cell.
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}
  ///@{
  /// Metres per unit of the coordinates, of surface, occluders and lights alike. Default 1. > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}
  ///@{
  /// Threads to use; 0 (default): all, of each of several ranks its share of the machine's. The
  /// result has the same bytes for any number.
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
  ///@}
  ///@{
  /// The processes that hold the pieces of the scene and compute it together (docs/scaling.md); all of
  /// them must update the filter. Each writes its own cells, the first one the tables. Default: the
  /// global controller, so the ranks of pvbatch and pvserver. Null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

protected:
  vtkRadiometricAlgorithm();
  ~vtkRadiometricAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /// The whole of an execution, on every rank (null: one process alone); outputs are empty before it.
  virtual void Compute(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs) = 0;

  /// The members of CopySettings; `from` is of this object's class. Begins with its superclass's.
  virtual void CopyMembers(vtkRadiometricAlgorithm* from);

  /// Throws an InputError where a number is not in [least, most].
  static void CheckRange(
    const char* name, double value, double least, double most, const char* expected);
  /// CheckRange of the properties above.
  void CheckLimits() const;
  /// MemoryLimit in bytes: of each of several ranks on a machine its share, the least of all ranks.
  std::size_t MemoryBytes(const ControllerCommunicator* ranks) const;

  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0;
  double TimeBudget = 0.0;
  double MemoryLimit = 0.0;
  bool TwoSided = false;
  double MetersPerUnit = 1.0;
  int NumberOfThreads = 0;
  double PredictedSeconds = -1.0;
  double ElapsedSeconds = 0.0;
  bool PilotOnly = false; // an execution ends where its cost is known
  std::string Explanation;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  /// The ranks of an execution; null: this process alone. Those of earlier controllers stay: what is
  /// kept between executions may refer to them.
  const ControllerCommunicator* Ranks();
  std::vector<std::unique_ptr<ControllerCommunicator>> Communicators;
  vtkMultiProcessController* CommunicatorsLast = nullptr; // to which the last one belongs

  vtkRadiometricAlgorithm(const vtkRadiometricAlgorithm&) = delete;
  void operator=(const vtkRadiometricAlgorithm&) = delete;
};

#endif
