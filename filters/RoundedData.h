// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataObject;

/// A copy of polydata, of another dataset or of composite data in which the coordinates of points and
/// all point, cell and field data in double precision are rounded to single precision (and kept in
/// double). Numbers beyond the range of single precision stay as they are. Null for null.
vtkSmartPointer<vtkDataObject> RoundedToFloat(vtkDataObject* data);
