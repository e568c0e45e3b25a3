// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightGlyphs_h
#define LightGlyphs_h

class vtkDataObject;
class vtkPolyData;

namespace vtkradiometry
{

/// Lines that stand for the enabled lights of `lights` (a polydata or a tree of them), `size` long.
void MakeLightGlyphs(vtkDataObject* lights, double size, vtkPolyData* glyphs);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: LightGlyphs.h
