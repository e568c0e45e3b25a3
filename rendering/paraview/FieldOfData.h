// SPDX-License-Identifier: BSD-3-Clause
#ifndef FieldOfData_h
#define FieldOfData_h

#include <string>

class vtkDataObject;

namespace vtkradiometry
{

/// A field that is shown as light: Scale turns it into radiance, W/(m^2 sr).
struct ShownField
{
  std::string Name; // empty: none
  int Association = 0; // 0 points, 1 cells
  double Scale = 1.0;
};

/// The first of Radiance, Radiosity, Luminance and LuminousExitance that a data set, or some block of
/// a tree, has in its points or its cells. Photometric ones are divided by the field array
/// LuminousEfficacy, else by 683.002 lm/W; exitances by pi, as of a matte surface.
ShownField FindLightOfData(vtkDataObject* data);

/// Whether a data set, or some block of a tree, has an array of docs/arrays.md that says what it
/// reflects or emits, of its cells or as field data of the whole block.
bool HasMaterials(vtkDataObject* data);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: FieldOfData.h
