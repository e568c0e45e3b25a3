// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightGlyphs_h
#define LightGlyphs_h

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace vtkradiometry
{

/// Name of the cell array with the colour of each line: the light's own, brightest component 1; dark
/// grey where the light is switched off.
extern const char* const LightGlyphColors;

/// Lines that stand for lights (a polydata, or a tree of them whose structure the result has), `size`
/// long: a point light three circles with rays, a spot its cones and axis, a directional light a sun
/// with arrows, an area light its outline with an arrow to each side on which it shines, an environment
/// a dome. Lights of the camera have none. Each line carries the ids of its light's cell and each
/// point those of its light's point, so that picking a line selects the light.
vtkSmartPointer<vtkDataObject> MakeLightGlyphs(vtkDataObject* lights, double size);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: LightGlyphs.h
