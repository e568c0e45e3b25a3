// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkViewFactorFilter_h
#define vtkViewFactorFilter_h

#include "vtkRadiometricAlgorithm.h"

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
class VTKRADIOMETRYFILTERS_EXPORT vtkViewFactorFilter : public vtkRadiometricAlgorithm
{
public:
  static vtkViewFactorFilter* New();
  vtkTypeMacro(vtkViewFactorFilter, vtkRadiometricAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Method.
  enum Methods
  {
    METHOD_AUTO = 0,
    DENSE = 1,
    HIERARCHICAL = 2,
    MONTE_CARLO = 3
  };
  ///@{
  /// Name of the integer cell array that tells a cell's patch. Default: none ("" or "None"), every
  /// cell is its own.
  vtkSetStringMacro(PatchArray);
  vtkGetStringMacro(PatchArray);
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
protected:
  vtkViewFactorFilter();
  ~vtkViewFactorFilter() override;

  void CopyMembers(vtkRadiometricAlgorithm* from) override;
  void Compute(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  char* PatchArray = nullptr;
  int Method = METHOD_AUTO;
  int Occlusion = AUTO;
  int BackFaces = AUTO;
  bool Correction = true;
  bool EnvironmentRows = false;
  double SkyUp[3] = { 0.0, 0.0, 1.0 };

private:
  vtkViewFactorFilter(const vtkViewFactorFilter&) = delete;
  void operator=(const vtkViewFactorFilter&) = delete;
};

#endif
