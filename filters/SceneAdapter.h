// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightFrames.h"
#include "radiometry/scene/Scene.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class ControllerCommunicator;
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
    bool Skin = false;     // faces of a solid
    std::int64_t Leaf = 0; // which part of the input it is, of several processes' parts alike
    /// Where cells are numbered over several processes: the number of each; -1: of none of the scene.
    std::vector<std::int32_t> Numbers;
    /// The same of the points of a sensor grid, among all points that get values.
    std::vector<std::int32_t> PointNumbers;
    bool Gathered = false; // Numbers count
    std::size_t Part = 0;  // of an own block: its place among those of all processes

    /// The number of a cell in the scene.
    std::int32_t Number(vtkIdType cell) const
    {
      return this->Gathered ? this->Numbers[static_cast<std::size_t>(cell)]
                            : static_cast<std::int32_t>(this->FirstCell) +
          static_cast<std::int32_t>(cell);
    }
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

  /// The scene is then that of all ranks, each of which has handed in its own parts; also cells
  /// that are marked as copies of others (vtkGhostType) are sorted out. `ranks` may be null.
  /// Of other arrays of cells than those of materials only these come along.
  void Gather(const ControllerCommunicator* ranks);
  std::vector<std::string> FurtherArrays;
  /// Arrays of cells or points that have the bands of the scene, too.
  std::vector<std::string> FurtherSpectra;

  /// Checks everything and makes the scene.
  radiometry::Scene Build();

  const std::vector<Block>& Blocks() const { return this->Surface; }
  bool IsGathered() const { return this->Gathered; }
  /// Those of this process, which get results.
  const std::vector<Block>& OwnBlocks() const { return this->Gathered ? this->Own : this->Surface; }
  /// Of each light of the scene that was made: type, position (area: first corner), direction, as
  /// its input has them.
  const std::vector<std::array<double, 7>>& LightKeys() const { return this->Keys; }
  /// Cells that got no triangle: verts, lines, and those without area.
  std::size_t CellsWithoutArea() const { return this->Empty; }

private:
  void ReadMaterials(radiometry::Scene& scene) const;
  void ReadTransmittance(
    const std::vector<std::int32_t>& occluderCells, radiometry::Scene& scene) const;
  void ReadAmbient(radiometry::Scene& scene) const;
  void FindAmbient();
  void GatherTransform(const ControllerCommunicator* ranks);
  int FindBands() const;

  double MetersPerUnit;
  bool TwoSided;
  double DiffuseReflectance;
  std::vector<Block> Surface;
  std::vector<Block> Own; // of Surface, once it was gathered
  bool Gathered = false;
  std::size_t GatheredCells = 0;
  std::size_t GatheredOccluders = 0; // cells of them
  std::int64_t LightInputs = 0;
  std::int64_t OccluderInputs = 0;
  std::vector<Block> Occluders;
  std::vector<Block> Lights;
  std::size_t Empty = 0;
  std::vector<std::array<double, 7>> Keys;
  radiometry::Affine ObjectTransform{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  radiometry::ViewFrame View;
  bool OwnTransform = false; // ObjectTransform is the surface's own
  double GlobalAmbient = 0.0;
  std::vector<std::pair<std::string, vtkSmartPointer<vtkDataArray>>> AmbientArrays;
};
