// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/GltfScene.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

/// The surface of a scene with its material arrays (docs/arrays.md) and names.
void WriteSurface(const radiometry::io::GltfScene& scene, vtkPolyData* output);

/// The cameras of a scene, one vertex each.
void WriteCameras(const radiometry::io::GltfScene& scene, vtkPolyData* output);

/// The point on the camera's axis at the depth of the centre of the scene's bounds, or 1 m ahead
/// where that is behind the camera.
radiometry::Vec3 FocalPoint(
  const radiometry::io::GltfScene& scene, const radiometry::io::GltfCamera& camera);

/// A field array of strings.
void AddStrings(const char* name, const std::vector<std::string>& strings, vtkDataObject* output);
