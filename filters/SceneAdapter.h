// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightFrames.h"
#include "radiometry/scene/Scene.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkPolyData;

/// Turns VTK data into the core's Scene: finds the arrays, checks them, triangulates cells.
///   Reads   surface and occluders: points, cells, the material arrays of docs/arrays.md (cell
///           data, or field data of one tuple for a whole block); lights: the light arrays
///   Fails   radiometry::InputError naming array, index and value
class SceneAdapter
{
public:
  /// One polydata of the surface, in the order of the input's leaves.
  struct Block
  {
    vtkSmartPointer<vtkPolyData> Data;
    std::size_t FirstCell = 0;
    vtkIdType Cells = 0;
    bool Sensors = false; // vertices with normals and no surface
    std::string Name;     // prefix for messages; empty for a lone block
  };

  SceneAdapter(double metersPerUnit, bool twoSided, double diffuseReflectance)
    : MetersPerUnit(metersPerUnit)
    , TwoSided(twoSided)
    , DiffuseReflectance(diffuseReflectance)
  {
  }

  /// Where lights that are attached to the object or to the camera stand, in the caller's unit. A
  /// field array ObjectTransform of the surface goes before `object`. To be set before AddSurface.
  void SetFrames(const radiometry::Affine& object, const radiometry::ViewFrame& view);
  /// Irradiance of every point, in each band, beside what the field arrays of lights give [W/m^2].
  void SetGlobalAmbient(double irradiance) { this->GlobalAmbient = irradiance; }

  /// Surface data: polydata, any composite of datasets, or a dataset whose outer surface is taken.
  void AddSurface(vtkDataObject* data);
  /// The same, only blocking light.
  void AddOccluder(vtkDataObject* data);
  /// Light data: polydata or a composite of it.
  void AddLights(vtkDataObject* data);

  /// Checks everything and makes the scene.
  radiometry::Scene Build();

  const std::vector<Block>& Blocks() const { return this->Surface; }
  /// Cells that got no triangle: verts, lines, and those without area.
  std::size_t CellsWithoutArea() const { return this->Empty; }

private:
  void ReadMaterials(radiometry::Scene& scene) const;
  void ReadTransmittance(
    const std::vector<std::int32_t>& occluderCells, radiometry::Scene& scene) const;
  void ReadAmbient(radiometry::Scene& scene) const;
  int FindBands() const;

  double MetersPerUnit;
  bool TwoSided;
  double DiffuseReflectance;
  std::vector<Block> Surface;
  std::vector<Block> Occluders;
  std::vector<Block> Lights;
  std::size_t Empty = 0;
  radiometry::Affine ObjectTransform{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  radiometry::ViewFrame View;
  bool OwnTransform = false; // ObjectTransform is the surface's own
  double GlobalAmbient = 0.0;
  std::vector<std::pair<std::string, vtkSmartPointer<vtkDataArray>>> AmbientArrays;
};
