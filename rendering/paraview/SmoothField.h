// SPDX-License-Identifier: BSD-3-Clause
#ifndef SmoothField_h
#define SmoothField_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataObject;

namespace vtkradiometry
{

/// Data whose cell array `name` (and that of the back, `name`Back) became a point array: at each corner
/// of a cell the mean, by area, of the cells that meet there and lie on the same smooth surface.
/// Cells meet where their points have the same coordinates; they lie on the same smooth surface where
/// their normals are within 30 degrees and they have the same MaterialIndex, if any. Each cell gets
/// points of its own. Blocks without such an array, with a point array of that name, or with vertices,
/// lines or strips are passed on. Of vtkPolyData and trees of them; null for anything else.
///   Cost    O(cells x cells that meet at a point)
vtkSmartPointer<vtkDataObject> SmoothField(vtkDataObject* data, const std::string& name);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: SmoothField.h
