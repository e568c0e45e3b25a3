// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkViewFactorFilter_h
#define vtkViewFactorFilter_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"
#include "vtkSmartPointer.h"

class ControllerCommunicator;
class vtkMultiProcessController;

/// View factors (form factors) between patches, groups of a surface's cells.
///   Ports   0 surface; 1 occluders, which only block (repeatable, optional). Polydata, composite
///           data, or any dataset, whose outer surface is then taken
///   Outputs 0 the surface; 1 the view factors; 2 EffectPlan; 3 Convergence (vtkTable)
///   Reads   the integer cell array PatchArray (a cell's patch; below 0: of no patch, it only
///           blocks; none named: every cell is a patch, named by its number over all blocks);
///           TwoSided (docs/arrays.md)
///   Writes  output 0, cell data, each cell the value of its patch [1]: ViewFactorSum,
///           EnvironmentViewFactor (sees nothing), SkyViewFactor and GroundViewFactor (its parts above
///           and below the horizon), BlockedViewFactor (occluders, backs that do not receive), each
///           with its Error; ClosureDefect.
///           Output 1, a row for each ordered pair of patches that see each other: From, To,
///           ViewFactor, ViewFactorError; with EnvironmentRows also To = -1 (sees nothing) and -2
///           (blocked). Field data of outputs 0 and 1: PatchIds, PatchAreas [m^2], what corrections
///           changed, method, version, options
///   Model   F_IJ = (1/A_I) int_I int_J V cos cos/(pi r^2) dA dA. A patch sees with all receiving
///           sides of its cells: front and back of a two-sided cell belong to one patch, and A_I
///           counts both
///   Error   covers 95 %
///   Cost    O(pairs of cells) where each is a patch; O(n) and samples for a few patches of n cells
///   Fails   a PatchArray that is missing, not of integers, not of one component or not finite;
///           values out of range; a memory limit too small
class VTKRADIOMETRYFILTERS_EXPORT vtkViewFactorFilter : public vtkDataObjectAlgorithm
{
public:
  static vtkViewFactorFilter* New();
  vtkTypeMacro(vtkViewFactorFilter, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Method.
  enum Methods
  {
    METHOD_AUTO = 0,
    DENSE = 1,
    HIERARCHICAL = 2,
    MONTE_CARLO = 3
  };
  /// The values of the switches.
  enum Switches
  {
    AUTO = 0,
    ON = 1,
    OFF = 2
  };

  /// Further surfaces that only block (input port 1, repeatable).
  void AddOccludersConnection(vtkAlgorithmOutput* occluders);
  void AddOccludersData(vtkDataObject* occluders);
  void RemoveOccludersConnections();

  ///@{
  /// Name of the integer cell array that tells a cell's patch. Default: none ("" or "None"), every
  /// cell is its own.
  vtkSetStringMacro(PatchArray);
  vtkGetStringMacro(PatchArray);
  ///@}
  ///@{
  /// Error that each view factor is computed to, relative to it. Default 0.01. Range [0, 1].
  vtkSetMacro(RelativeTolerance, double);
  vtkGetMacro(RelativeTolerance, double);
  ///@}
  ///@{
  /// Error of a view factor that is good enough whatever its value [1]. Default 1e-4. At least 0.
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
  /// Memory that the run may take [MiB]. Default 0: half of the machine's.
  vtkSetMacro(MemoryLimit, double);
  vtkGetMacro(MemoryLimit, double);
  ///@}
  ///@{
  /// 0 Auto (default), 1 Dense (every pair of triangles), 2 Hierarchical (pairs of clusters of
  /// triangles, for patches of many cells), 3 MonteCarlo (rays from each patch).
  vtkSetClampMacro(Method, int, METHOD_AUTO, MONTE_CARLO);
  vtkGetMacro(Method, int);
  ///@}
  ///@{
  /// Whether surfaces stand in each other's way: 0 Auto (default; where they can), 1 On, 2 Off.
  vtkSetClampMacro(Occlusion, int, AUTO, OFF);
  vtkGetMacro(Occlusion, int);
  ///@}
  ///@{
  /// Whether two-sided cells see with their backs: 0 Auto (default; they do), 1 On, 2 Off.
  vtkSetClampMacro(BackFaces, int, AUTO, OFF);
  vtkGetMacro(BackFaces, int);
  ///@}
  ///@{
  /// Whether cells see with both sides. Default off: the front only (where points turn
  /// counter-clockwise). A cell array TwoSided overrides it cell by cell.
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}
  ///@{
  /// Whether the view factors of patches that see nothing but patches are made to sum to one, by the
  /// least change in units of their errors, and sums above one are brought to one. Exchange stays
  /// symmetric: A_i F_ij = A_j F_ji. Default on. Field data tell the defects before and after.
  vtkSetMacro(Correction, bool);
  vtkGetMacro(Correction, bool);
  vtkBooleanMacro(Correction, bool);
  ///@}
  ///@{
  /// Whether the table has rows for what patches see beside each other: To = -1 the environment,
  /// -2 what blocks. Default off.
  vtkSetMacro(EnvironmentRows, bool);
  vtkGetMacro(EnvironmentRows, bool);
  vtkBooleanMacro(EnvironmentRows, bool);
  ///@}
  ///@{
  /// The direction up, which parts sky from ground. Default (0, 0, 1). Any length but 0.
  vtkSetVector3Macro(SkyUp, double);
  vtkGetVector3Macro(SkyUp, double);
  ///@}
  ///@{
  /// Metres per unit of the coordinates. Default 1. > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}
  ///@{
  /// Threads to use; 0 (default): all. The result has the same bytes for any number.
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
  ///@}
  ///@{
  /// The processes that hold the pieces of the scene (docs/scaling.md); all of them must update the
  /// filter. Each writes its own cells, the first one the tables. Default: the global controller, so
  /// the ranks of pvbatch and pvserver. Null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

protected:
  vtkViewFactorFilter();
  ~vtkViewFactorFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* PatchArray = nullptr;
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 1e-4;
  double TimeBudget = 0.0;
  double MemoryLimit = 0.0;
  int Method = METHOD_AUTO;
  int Occlusion = AUTO;
  int BackFaces = AUTO;
  bool TwoSided = false;
  bool Correction = true;
  bool EnvironmentRows = false;
  double SkyUp[3] = { 0.0, 0.0, 1.0 };
  double MetersPerUnit = 1.0;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkViewFactorFilter(const vtkViewFactorFilter&) = delete;
  void operator=(const vtkViewFactorFilter&) = delete;

  void Compute(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs);
};

#endif
