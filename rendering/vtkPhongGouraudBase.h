// SPDX-License-Identifier: BSD-3-Clause
/**
 * What vtkPhongGouraudMapper and its helper derive from, by the version of VTK: the one place that
 * knows. VTK 9.3 renamed the mapper of composite data, and its helper became the delegate of a
 * "delegator" that the mapper makes.
 *
 * Applications need the first part only; the second is for the sources of this module.
 */
#ifndef vtkPhongGouraudBase_h
#define vtkPhongGouraudBase_h

#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
#define vtkPhongGouraudMapperBase vtkCompositePolyDataMapper
#define vtkPhongGouraudProduct vtkCompositePolyDataMapperDelegator
#define vtkPhongGouraudFactory CreateADelegator
#else
#include "vtkCompositePolyDataMapper2.h"
#define vtkPhongGouraudMapperBase vtkCompositePolyDataMapper2
#define vtkPhongGouraudProduct vtkCompositeMapperHelper2
#define vtkPhongGouraudFactory CreateHelper
#endif

#ifdef VTKRADIOMETRY_RENDERING_SOURCES
#include "vtkHardwareSelector.h" // 9.2's helper needs it before itself
#include "vtkOpenGLCellToVTKCellMap.h"
#include "vtkStateStorage.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkObjectFactory.h"
#include "vtkOpenGLBatchedPolyDataMapper.h"
#include "vtkOpenGLCompositePolyDataMapperDelegator.h"
#define vtkPhongGouraudBlocks VTKPolyDataToGLBatchElement

namespace vtkradiometry
{

using HelperBase = vtkOpenGLBatchedPolyDataMapper;
using DrawnBlock = vtkOpenGLBatchedPolyDataMapper::GLBatchElement;

inline vtkPolyData* DataOf(const DrawnBlock& block) { return block.Parent.PolyData; }

/// Hands the mapper's blocks to a Helper.
template <typename Helper>
class HelperDelegator : public vtkOpenGLCompositePolyDataMapperDelegator
{
public:
  static HelperDelegator* New() { VTK_STANDARD_NEW_BODY(HelperDelegator); }

protected:
  HelperDelegator()
  {
    this->GLDelegate = Helper::New();
    this->Delegate = vtk::TakeSmartPointer(this->GLDelegate);
  }
};

template <typename Helper>
vtkPhongGouraudProduct* NewProduct()
{
  return HelperDelegator<Helper>::New();
}

} // namespace vtkradiometry
#else
#include "vtkCompositeMapperHelper2.h"
#define vtkPhongGouraudBlocks Data

namespace vtkradiometry
{

using HelperBase = vtkCompositeMapperHelper2;
using DrawnBlock = vtkCompositeMapperHelperData;

inline vtkPolyData* DataOf(const DrawnBlock& block) { return block.Data; }

template <typename Helper>
vtkPhongGouraudProduct* NewProduct()
{
  return Helper::New();
}

} // namespace vtkradiometry
#endif
#endif // VTKRADIOMETRY_RENDERING_SOURCES

#endif
// VTK-HeaderTest-Exclude: vtkPhongGouraudBase.h
