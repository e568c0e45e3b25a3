// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: an image as a part of an OpenEXR file.
#ifndef OpenEXRAssembly_h
#define OpenEXRAssembly_h

#include "io/ExrImage.h"
#include "vtkOpenEXRWriter.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataArray;
class vtkImageData;

/// Gathers the part to write, and keeps what had to be converted for it.
struct vtkOpenEXRWriter::Assembly
{
  vtkOpenEXRWriter* Self;
  radiometry::io::ExrPart Part;
  std::vector<vtkSmartPointer<vtkDataArray>> Kept;

  void Place(vtkImageData* image);
  void AddArrays(vtkImageData* image);
  void AddArray(vtkDataArray* array, bool picture);
  void AddAttributes(vtkImageData* image);
};

#endif
