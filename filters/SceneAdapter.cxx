// SPDX-License-Identifier: BSD-3-Clause
#include "SceneAdapter.h"

#include "LightPolyData.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SceneBuilder.h"
#include "radiometry/scene/Units.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::SceneBuilder;
using radiometry::Vec3;

namespace
{

/// The leaves of any data object as polydata.
void Collect(vtkDataObject* data, const std::string& name, std::vector<SceneAdapter::Block>& blocks)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    int index = 0;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      Collect(iterator->GetCurrentDataObject(), "block " + std::to_string(index++) + ", ", blocks);
    }
    return;
  }
  SceneAdapter::Block block;
  block.Name = name;
  if (auto* polydata = vtkPolyData::SafeDownCast(data))
  {
    block.Data = polydata;
  }
  else if (auto* dataset = vtkDataSet::SafeDownCast(data))
  {
    vtkNew<vtkGeometryFilter> surface;
    surface->SetInputData(dataset);
    surface->Update();
    block.Data = surface->GetOutput();
  }
  else
  {
    block.Data = vtkSmartPointer<vtkPolyData>::New(); // a table, say: keeps its place, gives nothing
  }
  block.Cells = block.Data->GetNumberOfCells();
  block.Sensors = block.Data->GetNumberOfPolys() == 0 && block.Data->GetNumberOfStrips() == 0 &&
    block.Data->GetPointData()->GetArray(names::Normals) != nullptr;
  blocks.push_back(block);
}

struct Triangulation
{
  std::vector<Vec3> Points;
  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<std::int32_t> Cell; // of the whole surface
};

void AddPolygon(vtkPolyData* data, const vtkIdType* ids, vtkIdType count, std::int32_t cell,
  Triangulation& out)
{
  const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c) {
    out.Triangles.push_back({ static_cast<std::int32_t>(ids[a]), static_cast<std::int32_t>(ids[b]),
      static_cast<std::int32_t>(ids[c]) });
    out.Cell.push_back(cell);
  };
  if (count == 3)
  {
    add(0, 1, 2);
    return;
  }
  if (count < 3)
  {
    return;
  }
  vtkNew<vtkPolygon> polygon;
  polygon->Initialize(static_cast<int>(count), ids, data->GetPoints());
  vtkNew<vtkIdList> corners;
  if (!polygon->NonDegenerateTriangulate(corners) && !polygon->EarCutTriangulation(corners))
  {
    return; // without area, or crossing itself: counted, gets 0
  }
  for (vtkIdType k = 0; k + 2 < corners->GetNumberOfIds(); k += 3)
  {
    add(corners->GetId(k), corners->GetId(k + 1), corners->GetId(k + 2));
  }
}

void CheckIds(const SceneAdapter::Block& block, const char* cells, vtkIdType cell,
  const vtkIdType* ids, vtkIdType count, vtkIdType points)
{
  for (vtkIdType k = 0; k < count; ++k)
  {
    if (ids[k] < 0 || ids[k] >= points)
    {
      throw InputError(block.Name + cells, cell, static_cast<double>(ids[k]),
        "the number of a point, below " + std::to_string(points));
    }
  }
}

Triangulation Triangulate(const SceneAdapter::Block& block)
{
  Triangulation out;
  vtkPolyData* data = block.Data;
  const vtkIdType count = data->GetNumberOfPoints();
  if (count > std::numeric_limits<std::int32_t>::max() / 2)
  {
    throw InputError(block.Name + "Points", -1, static_cast<double>(count), "at most 2^30 points");
  }
  out.Points.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    out.Points[i] = { p[0], p[1], p[2] };
  }
  vtkIdType cell = static_cast<vtkIdType>(block.FirstCell) + data->GetNumberOfVerts() +
    data->GetNumberOfLines();
  const auto polygons = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell(), ++cell)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    polygons->GetCurrentCell(n, ids);
    CheckIds(block, "Polys", cell - static_cast<vtkIdType>(block.FirstCell), ids, n, count);
    for (vtkIdType k = 0; k < n; ++k)
    {
      const Vec3& p = out.Points[ids[k]];
      if (!IsFinite(p)) // before VTK triangulates it
      {
        throw InputError(block.Name + "Points", ids[k],
          !std::isfinite(p.x) ? p.x : (!std::isfinite(p.y) ? p.y : p.z), "finite coordinates");
      }
    }
    AddPolygon(data, ids, n, static_cast<std::int32_t>(cell), out);
  }
  const auto strips = vtk::TakeSmartPointer(data->GetStrips()->NewIterator());
  for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell(), ++cell)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    strips->GetCurrentCell(n, ids);
    CheckIds(block, "Strips", cell - static_cast<vtkIdType>(block.FirstCell), ids, n, count);
    for (vtkIdType k = 0; k + 2 < n; ++k)
    {
      const vtkIdType a = k % 2 == 0 ? ids[k] : ids[k + 1];
      const vtkIdType b = k % 2 == 0 ? ids[k + 1] : ids[k];
      const vtkIdType triangle[3] = { a, b, ids[k + 2] };
      AddPolygon(data, triangle, 3, static_cast<std::int32_t>(cell), out);
    }
  }
  return out;
}

/// A material array of a block: cell data, or field data of one tuple.
vtkDataArray* FindArray(const SceneAdapter::Block& block, const std::string& name)
{
  if (vtkDataArray* array = block.Data->GetCellData()->GetArray(name.c_str()))
  {
    if (array->GetNumberOfTuples() != block.Cells)
    {
      throw InputError(block.Name + name, -1, std::to_string(array->GetNumberOfTuples()) + " tuples",
        std::to_string(block.Cells) + ", one a cell");
    }
    return array;
  }
  vtkDataArray* array =
    vtkDataArray::SafeDownCast(block.Data->GetFieldData()->GetAbstractArray(name.c_str()));
  if (array && array->GetNumberOfTuples() != 1)
  {
    throw InputError(block.Name + name + " (field data)", -1,
      std::to_string(array->GetNumberOfTuples()) + " tuples", "one tuple, for the whole block");
  }
  return array;
}

const char* const SpectralNames[] = { names::DiffuseReflectance, names::SpecularReflectance,
  names::EmittedExitance, names::Transmittance };

} // namespace

void SceneAdapter::AddSurface(vtkDataObject* data)
{
  Collect(data, "", this->Surface);
}

void SceneAdapter::AddOccluder(vtkDataObject* data)
{
  Collect(data, "occluder ", this->Occluders);
}

void SceneAdapter::AddLights(vtkDataObject* data)
{
  Collect(data, "lights, ", this->Lights);
}

int SceneAdapter::FindBands() const
{
  int bands = 1;
  std::string where = "one band";
  const auto see = [&](vtkDataArray* array, const std::string& name) {
    if (!array || array->GetNumberOfComponents() == 1)
    {
      return;
    }
    const int n = array->GetNumberOfComponents();
    if (bands != 1 && n != bands)
    {
      throw InputError(name, -1, std::to_string(n) + " bands",
        "1 or " + std::to_string(bands) + " bands, as " + where);
    }
    if (n > 1024)
    {
      throw InputError(name, -1, std::to_string(n) + " bands", "at most 1024 bands");
    }
    bands = n;
    where = name;
  };
  for (const Block& block : this->Surface)
  {
    for (const char* name : SpectralNames)
    {
      see(FindArray(block, name), block.Name + name);
      see(FindArray(block, std::string(names::BackPrefix) + name),
        block.Name + names::BackPrefix + name);
    }
  }
  for (const Block& block : this->Lights)
  {
    see(block.Data->GetPointData()->GetArray(names::Intensity), block.Name + names::Intensity);
  }
  return bands;
}

radiometry::Scene SceneAdapter::Build()
{
  const int bands = this->FindBands();
  SceneBuilder builder;
  std::size_t cells = 0;
  std::vector<std::uint8_t> covered;
  for (Block& block : this->Surface)
  {
    block.FirstCell = cells;
    cells += static_cast<std::size_t>(block.Cells);
    if (!block.Sensors)
    {
      const Triangulation t = Triangulate(block);
      builder.AddMesh(SceneBuilder::Role::Receiver, t.Points, t.Triangles, t.Cell,
        this->MetersPerUnit, block.Name + "Points");
    }
  }
  for (const Block& block : this->Occluders)
  {
    const Triangulation t = Triangulate(block);
    builder.AddMesh(SceneBuilder::Role::Occluder, t.Points, t.Triangles, t.Cell,
      this->MetersPerUnit, block.Name + "Points");
  }
  radiometry::Scene scene = builder.Finish(cells);
  covered.assign(cells, 0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    covered[scene.TriangleCell[t]] = 1;
  }
  this->Empty = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 0));

  scene.Optics.Bands = bands;
  this->ReadMaterials(scene);
  for (const Block& block : this->Lights)
  {
    for (const radiometry::LightRecord& record : ReadLights(block.Data, bands, block.Name))
    {
      scene.Lights.push_back(
        radiometry::ToLight(record, this->MetersPerUnit, scene.Origin, scene.Lights.size()));
    }
  }
  return scene;
}

void SceneAdapter::ReadMaterials(radiometry::Scene& scene) const
{
  radiometry::Materials& optics = scene.Optics;
  const int bands = optics.Bands;
  const std::size_t size = scene.Cells * static_cast<std::size_t>(bands);
  if (!(this->DiffuseReflectance >= 0.0 && this->DiffuseReflectance <= 1.0))
  {
    throw InputError("DiffuseReflectance", -1, this->DiffuseReflectance, "a number in [0, 1]");
  }

  // Reads one array of every block; `values` stays empty when no block has it.
  const auto read = [&](const std::string& name, double least, double most, double fallback,
                      std::vector<double>& values) {
    for (const Block& block : this->Surface)
    {
      vtkDataArray* array = FindArray(block, name);
      if (!array)
      {
        continue;
      }
      if (values.empty())
      {
        values.assign(size, fallback);
      }
      const bool whole = array->GetNumberOfTuples() == 1 && block.Cells != 1;
      const int components = array->GetNumberOfComponents();
      for (vtkIdType c = 0; c < block.Cells; ++c)
      {
        for (int b = 0; b < bands; ++b)
        {
          const double value = array->GetComponent(whole ? 0 : c, components == 1 ? 0 : b);
          if (!(value >= least && value <= most))
          {
            throw InputError(block.Name + name, whole ? 0 : c, value,
              std::isinf(most) ? "a finite number of at least 0"
                               : "a number in [0, 1]");
          }
          if (std::isinf(value))
          {
            throw InputError(block.Name + name, whole ? 0 : c, value, "a finite number");
          }
          values[(block.FirstCell + c) * bands + b] = value;
        }
      }
    }
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const auto readSides = [&](const char* name, double most, double fallback,
                           std::array<std::vector<double>, 2>& sides) {
    read(name, 0.0, most, fallback, sides[0]);
    sides[1] = sides[0];
    read(std::string(names::BackPrefix) + name, 0.0, most, fallback, sides[1]);
    if (sides[0].empty() && !sides[1].empty())
    {
      sides[0].assign(size, fallback);
    }
  };
  readSides(names::DiffuseReflectance, 1.0, this->DiffuseReflectance, optics.DiffuseReflectance);
  readSides(names::SpecularReflectance, 1.0, 0.0, optics.SpecularReflectance);
  readSides(names::EmittedExitance, infinite, 0.0, optics.EmittedExitance);
  read(names::Transmittance, 0.0, 1.0, 0.0, optics.Transmittance);
  for (auto& side : optics.DiffuseReflectance)
  {
    if (side.empty())
    {
      side.assign(size, this->DiffuseReflectance);
    }
  }
  optics.TwoSided.assign(scene.Cells, this->TwoSided ? 1 : 0);
  for (const Block& block : this->Surface)
  {
    if (vtkDataArray* array = FindArray(block, names::TwoSided))
    {
      const bool whole = array->GetNumberOfTuples() == 1 && block.Cells != 1;
      for (vtkIdType c = 0; c < block.Cells; ++c)
      {
        optics.TwoSided[block.FirstCell + c] = array->GetComponent(whole ? 0 : c, 0) != 0.0;
      }
    }
  }

  // What is reflected and transmitted may not exceed what came.
  for (const Block& block : this->Surface)
  {
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      for (int b = 0; b < bands; ++b)
      {
        const std::size_t at = (block.FirstCell + c) * bands + b;
        for (int side = 0; side < 2; ++side)
        {
          const double sum = optics.DiffuseReflectance[side][at] +
            (optics.SpecularReflectance[side].empty() ? 0.0
                                                      : optics.SpecularReflectance[side][at]) +
            (optics.Transmittance.empty() ? 0.0 : optics.Transmittance[at]);
          if (sum > 1.0 + 1e-12)
          {
            throw InputError(block.Name +
                "DiffuseReflectance + SpecularReflectance + Transmittance",
              c, sum, "at most 1 in each band");
          }
        }
      }
    }
  }
}
