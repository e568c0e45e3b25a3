// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h

#include "vtkRadiometricFilter.h"

#include <memory>

namespace radiometry
{
class IrradianceCache;
}

/// Direct irradiance on each cell (or point) of a surface.
///   Reads   lights: LightType, Intensity [W/sr or W/m^2], Direction, ...   (docs/arrays.md)
///   Writes  Irradiance, IrradianceError; where surfaces are two-sided also IrradianceBack,
///           IrradianceBackError   cell or point, N bands   [W/m^2]
///   Model   E = sum_k V_k I_k(w) cos(theta_k) / r_k^2, averaged over the cell
///   Cost    O(cells x lights) closed forms and rays, times log(occluders)
///   Source  Van Oosterom and Strackee 1983 (solid angle); Arvo 1995 (axial moments)
///   Fails   non-finite points, lights or materials: an error with array, index and value;
///           nothing is written
class VTKRADIOMETRYFILTERS_EXPORT vtkIrradianceFilter : public vtkRadiometricFilter
{
public:
  static vtkIrradianceFilter* New();
  vtkTypeMacro(vtkIrradianceFilter, vtkRadiometricFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether cells are cut along the edges of the shadows of point, spot and directional lights, so
  /// that a shadow's edge is geometry of output 0: convex pieces with the cell's data, their own
  /// average, and OriginalCellIds, the number of the cell in its block. Cells that no edge crosses
  /// stay whole. Pieces of a cell fit each other; where cells meet, one may have a corner on the
  /// other's edge. Point data is not carried over. No effect, and a warning, with SampleLocation
  /// Points. Default off.
  vtkSetMacro(RefineShadowBoundaries, bool);
  vtkGetMacro(RefineShadowBoundaries, bool);
  vtkBooleanMacro(RefineShadowBoundaries, bool);
  ///@}
  ///@{
  /// Pieces into which one cell may be cut at most; where more would be needed the largest are cut
  /// first, the rest keeps its average, and RadiometryMethod and a warning say in how many cells.
  /// Default 1000. Range [1, 1000000].
  vtkSetClampMacro(MaximumPiecesPerCell, int, 1, 1000000);
  vtkGetMacro(MaximumPiecesPerCell, int);
  ///@}
  ///@{
  /// Whether values, and what visibility was asked of, are kept for the next execution. Default on:
  /// on the same surface, lights and options a finer tolerance goes on from the values that there
  /// are, and a coarser one returns them; on the same geometry moving or dimming a light re-uses its
  /// visibility. Such values may differ from those of a fresh filter within their errors. What is
  /// kept counts towards MemoryLimit and is freed when the input changes.
  vtkSetMacro(CacheResults, bool);
  vtkGetMacro(CacheResults, bool);
  vtkBooleanMacro(CacheResults, bool);
  ///@}
  /// Frees what was kept.
  void ReleaseCache();
  /// What is kept now [MiB].
  double GetCacheMemory();

protected:
  vtkIrradianceFilter();
  ~vtkIrradianceFilter() override;

  void CopyMembers(vtkRadiometricAlgorithm* from) override;
  void Simulate(Job& job, Result& result) override;

  bool RefineShadowBoundaries = false;
  int MaximumPiecesPerCell = 1000;
  bool CacheResults = true;

private:
  std::shared_ptr<radiometry::IrradianceCache> Cache;
  const void* CachedFor = nullptr; // the ranks that share what is kept

  vtkIrradianceFilter(const vtkIrradianceFilter&) = delete;
  void operator=(const vtkIrradianceFilter&) = delete;
};

#endif
