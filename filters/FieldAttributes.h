// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: field data as attributes of an OpenEXR file.
#ifndef FieldAttributes_h
#define FieldAttributes_h

#include "io/ExrImage.h"

class vtkAbstractArray;

/// One array of field data as an attribute; false where it has no value, or so many that it is
/// data and no description.
bool Describe(vtkAbstractArray* array, radiometry::io::ExrAttribute& out);

#endif
