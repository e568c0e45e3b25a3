// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: patches out of cell arrays, and view factors as data.
#ifndef ViewFactorResults_h
#define ViewFactorResults_h

#include "RunReport.h"
#include "SceneAdapter.h"
#include "radiometry/formfactor/ViewFactors.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;
class vtkTable;

/// Which patch each cell of a surface belongs to.
struct SurfacePatches
{
  std::vector<std::int32_t> OfCell; // number of the patch, -1: none
  std::vector<vtkIdType> Ids;       // what the user calls it, ascending

  /// By the array `name` of each block; empty: every cell is a patch, named by its number.
  ///   Fails   InputError naming array, cell and value
  SurfacePatches(const std::vector<SceneAdapter::Block>& blocks, const std::string& name);
};

/// What was left out of view factors and what their errors are made of. `switches`: of occlusion and
/// of back faces; `backs`: some cell is two-sided; `panes`: some surface lets light through.
PlanReport ReportPlan(const radiometry::ViewFactorResult& result,
  const std::array<radiometry::EffectSwitch, 2>& switches, bool backs, bool panes);

/// Writes view factors onto the filter's outputs.
class ViewFactorResults
{
public:
  ViewFactorResults(const radiometry::ViewFactorResult& result, const PlanReport& plan,
    const SurfacePatches& patches, std::string options)
    : Result(result)
    , Plan(plan)
    , Patches(patches)
    , Options(std::move(options))
  {
  }

  void WriteSurface(const std::vector<SceneAdapter::Block>& blocks, vtkDataObject* output,
    vtkDataObject* input) const;
  void WriteTable(bool environmentRows, vtkTable* table) const;

private:
  void AddFieldData(vtkDataObject* data) const;
  void AddCells(const SceneAdapter::Block& block, vtkPolyData* leaf) const;

  const radiometry::ViewFactorResult& Result;
  const PlanReport& Plan;
  const SurfacePatches& Patches;
  std::string Options;
};

#endif
