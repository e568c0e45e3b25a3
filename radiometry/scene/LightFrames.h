// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/Vec3.h"

#include <array>

namespace radiometry
{

/// A map of points, row by row, as vtkMatrix4x4 holds it; the last row is 0 0 0 1.
using Affine = std::array<double, 16>;

/// Throws InputError naming `name` when the matrix cannot move lights: a number that is not finite,
/// a last row other than 0 0 0 1, or no inverse.
void ValidateAffine(const char* name, const Affine& matrix);

/// Where a viewer stands.
struct ViewFrame
{
  Vec3 Position;
  Vec3 FocalPoint; // equal to Position: there is no camera
  Vec3 ViewUp{ 0.0, 1.0, 0.0 };
};

/// From eye coordinates (the eye at the origin, x right, y up, -z into the picture) to the scene's,
/// as vtkCamera has them. Throws InputError{"CameraPosition"} where there is no camera, or its up
/// lies along the view.
Affine EyeToScene(const ViewFrame& view);

/// The light in the scene: by AttachedTo, given in the scene's coordinates (0), the object's (1) or
/// the eye's (2). The same as what rendering/LightPacking.cxx does for the picture.
///   Points       position and polygon: by the matrix
///   Directions   Direction, Reference: by its linear part, then made unit (Reference square to
///                Direction where it is used); a scale changes no intensity, cone or attenuation
///   Mirrors      an area light keeps its front (the polygon is turned round); a web turns as it
///                did about the moved axis and is not mirrored
LightRecord PlaceLight(const LightRecord& light, const Affine& objectToScene, const ViewFrame& view);

} // namespace radiometry
