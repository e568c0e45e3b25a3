// SPDX-License-Identifier: BSD-3-Clause
#include "SceneAdapter.h"

#include "LightPolyData.h"
#include "SceneGathering.h"
#include "radiometry/geometry/PolygonTriangles.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SceneBuilder.h"
#include "radiometry/visibility/LightsOnSurfaces.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkGeometryFilter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::SceneBuilder;
using radiometry::Vec3;

namespace
{

/// Whether any cell has a volume.
bool HasSolids(vtkDataSet* data)
{
  std::array<bool, 256> seen{};
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    const int type = data->GetCellType(c);
    if (type >= 0 && type < 256 && !seen[static_cast<std::size_t>(type)])
    {
      seen[static_cast<std::size_t>(type)] = true;
      const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
      if (cell && cell->GetCellDimension() == 3)
      {
        return true;
      }
    }
  }
  return false;
}

/// The leaves of any data object as polydata.
void Collect(vtkDataObject* data, const std::string& name, std::int64_t leaf,
  std::vector<SceneAdapter::Block>& blocks)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    int index = 0;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      Collect(iterator->GetCurrentDataObject(), "block " + std::to_string(index++) + ", ",
        leaf + iterator->GetCurrentFlatIndex(), blocks);
    }
    return;
  }
  SceneAdapter::Block block;
  block.Name = name;
  block.Leaf = leaf;
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
    block.Skin = HasSolids(dataset);
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

/// Cells without area, or that cross themselves, give nothing: counted, they get 0.
void AddPolygon(const vtkIdType* ids, vtkIdType count, std::int32_t cell, Triangulation& out)
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
  std::vector<Vec3> corners;
  for (vtkIdType k = 0; k < count; ++k)
  {
    corners.push_back(out.Points[ids[k]]);
  }
  for (const auto& t : radiometry::PolygonTriangles(corners))
  {
    add(t[0], t[1], t[2]);
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
  vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines();
  const auto polygons = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell(), ++cell)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    polygons->GetCurrentCell(n, ids);
    CheckIds(block, "Polys", cell, ids, n, count);
    if (block.Number(cell) < 0)
    {
      continue;
    }
    for (vtkIdType k = 0; k < n; ++k)
    {
      const Vec3& p = out.Points[ids[k]];
      if (!IsFinite(p)) // before VTK triangulates it
      {
        throw InputError(block.Name + "Points", ids[k],
          !std::isfinite(p.x) ? p.x : (!std::isfinite(p.y) ? p.y : p.z), "finite coordinates");
      }
    }
    AddPolygon(ids, n, block.Number(cell), out);
  }
  const auto strips = vtk::TakeSmartPointer(data->GetStrips()->NewIterator());
  for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell(), ++cell)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    strips->GetCurrentCell(n, ids);
    CheckIds(block, "Strips", cell, ids, n, count);
    if (block.Number(cell) < 0)
    {
      continue;
    }
    for (vtkIdType k = 0; k + 2 < n; ++k)
    {
      const vtkIdType a = k % 2 == 0 ? ids[k] : ids[k + 1];
      const vtkIdType b = k % 2 == 0 ? ids[k + 1] : ids[k];
      const vtkIdType triangle[3] = { a, b, ids[k + 2] };
      AddPolygon(triangle, 3, block.Number(cell), out);
    }
  }
  return out;
}

/// Inputs of one port follow each other by this much in Block::Leaf, which their own leaves stay below.
constexpr int InputShift = 40;

/// Whether an earlier part of the same light data, of another process, has the same ambient light.
bool IsRepeated(const std::vector<SceneAdapter::Block>& blocks, const SceneAdapter::Block& block,
  vtkDataArray* array)
{
  const auto same = [&](vtkDataArray* other) {
    bool equal = other && other->GetNumberOfValues() == array->GetNumberOfValues() &&
      other->GetNumberOfComponents() == array->GetNumberOfComponents();
    const int components = array->GetNumberOfComponents();
    for (vtkIdType k = 0; equal && k < array->GetNumberOfValues(); ++k)
    {
      equal = other->GetComponent(k / components, k % components) ==
        array->GetComponent(k / components, k % components);
    }
    return equal;
  };
  return std::any_of(blocks.data(), &block, [&](const SceneAdapter::Block& earlier) {
    return earlier.Gathered && earlier.Leaf == block.Leaf &&
      same(vtkDataArray::SafeDownCast(
        earlier.Data->GetFieldData()->GetAbstractArray(names::GlobalAmbient)));
  });
}

/// Brings the triangles that were gathered from several processes into the order of their cells.
void SortByCell(radiometry::Scene& scene, std::vector<std::int32_t>& cellOfOccluder)
{
  std::vector<std::size_t> order(scene.Triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  const auto middle = static_cast<std::ptrdiff_t>(scene.ReceiverTriangles);
  std::stable_sort(order.begin(), order.begin() + middle, [&](std::size_t a, std::size_t b) {
    return scene.TriangleCell[a] < scene.TriangleCell[b];
  });
  std::stable_sort(order.begin() + middle, order.end(), [&](std::size_t a, std::size_t b) {
    return cellOfOccluder[a - scene.ReceiverTriangles] < cellOfOccluder[b - scene.ReceiverTriangles];
  });
  const auto triangles = scene.Triangles;
  const auto cells = scene.TriangleCell;
  const auto occluders = cellOfOccluder;
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    scene.Triangles[k] = triangles[order[k]];
    scene.TriangleCell[k] = cells[order[k]];
    if (k >= scene.ReceiverTriangles)
    {
      cellOfOccluder[k - scene.ReceiverTriangles] = occluders[order[k] - scene.ReceiverTriangles];
    }
  }
}

/// The field array ObjectTransform of an object, if it has one.
bool ReadTransform(vtkDataObject* data, const std::string& name, radiometry::Affine& matrix)
{
  auto* array = vtkDataArray::SafeDownCast(
    data->GetFieldData()->GetAbstractArray(names::ObjectTransform));
  if (!array)
  {
    return false;
  }
  if (array->GetNumberOfValues() != 16)
  {
    throw InputError(name, -1, std::to_string(array->GetNumberOfValues()) + " numbers",
      "16: a 4 x 4 matrix, row by row");
  }
  const int components = array->GetNumberOfComponents();
  for (int k = 0; k < 16; ++k)
  {
    matrix[k] = array->GetComponent(k / components, k % components);
  }
  radiometry::ValidateAffine(name.c_str(), matrix);
  return true;
}

/// How far rounding to single precision may have moved points; 0 where they are in double.
double SinglePrecision(vtkPolyData* data)
{
  if (data->GetNumberOfPoints() == 0 || data->GetPoints()->GetDataType() != VTK_FLOAT)
  {
    return 0.0;
  }
  double bounds[6];
  data->GetBounds(bounds);
  double largest = 0.0;
  for (const double b : bounds)
  {
    largest = std::max(largest, std::fabs(b));
  }
  return 0.5 * std::numeric_limits<float>::epsilon() * largest;
}

} // namespace

void SceneAdapter::SetFrames(const radiometry::Affine& object, const radiometry::ViewFrame& view)
{
  radiometry::ValidateAffine(names::ObjectTransform, object);
  this->ObjectTransform = object;
  this->View = view;
}

void SceneAdapter::AddSurface(vtkDataObject* data)
{
  const std::size_t first = this->Surface.size();
  Collect(data, "", 0, this->Surface);
  const auto read = [&](vtkDataObject* carrier, const std::string& name) {
    radiometry::Affine matrix;
    if (ReadTransform(carrier, name + names::ObjectTransform, matrix))
    {
      if (this->OwnTransform && matrix != this->ObjectTransform)
      {
        throw InputError(name + names::ObjectTransform, -1, "differs from another block's",
          "one transform for the whole surface");
      }
      this->OwnTransform = true;
      this->ObjectTransform = matrix;
    }
  };
  read(data, "");
  for (std::size_t k = first; k < this->Surface.size(); ++k)
  {
    read(this->Surface[k].Data, this->Surface[k].Name);
  }
}

void SceneAdapter::AddOccluder(vtkDataObject* data)
{
  Collect(data, "occluder ", this->OccluderInputs++ << InputShift, this->Occluders);
}

void SceneAdapter::AddLights(vtkDataObject* data)
{
  const std::int64_t leaf = this->LightInputs++ << InputShift;
  if (vtkCompositeDataSet::SafeDownCast(data))
  {
    // Its own field data, as of a block without lights.
    Block whole;
    whole.Data = vtkSmartPointer<vtkPolyData>::New();
    whole.Data->GetFieldData()->ShallowCopy(data->GetFieldData());
    whole.Name = "lights, ";
    whole.Leaf = leaf;
    this->Lights.push_back(whole);
  }
  Collect(data, "lights, ", leaf, this->Lights);
}

void SceneAdapter::FindAmbient()
{
  this->AmbientArrays.clear();
  for (const Block& block : this->Lights)
  {
    auto* array = vtkDataArray::SafeDownCast(
      block.Data->GetFieldData()->GetAbstractArray(names::GlobalAmbient));
    if (array && !IsRepeated(this->Lights, block, array))
    {
      this->AmbientArrays.emplace_back(block.Name + names::GlobalAmbient, array);
    }
  }
}

radiometry::Scene SceneAdapter::Build()
{
  this->FindAmbient();
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
  std::size_t occluderCells = 0;
  for (Block& block : this->Occluders)
  {
    block.FirstCell = occluderCells;
    occluderCells += static_cast<std::size_t>(block.Cells);
    const Triangulation t = Triangulate(block);
    builder.AddMesh(SceneBuilder::Role::Occluder, t.Points, t.Triangles, t.Cell,
      this->MetersPerUnit, block.Name + "Points");
  }
  std::vector<std::int32_t> cellOfOccluder;
  radiometry::Scene scene =
    builder.Finish(this->Gathered ? this->GatheredCells : cells, &cellOfOccluder);
  if (this->Gathered)
  {
    cells = this->GatheredCells;
    SortByCell(scene, cellOfOccluder);
  }
  covered.assign(cells, 0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    covered[scene.TriangleCell[t]] = 1;
  }
  this->Empty = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 0));

  scene.Optics.Bands = bands;
  this->ReadMaterials(scene);
  this->ReadTransmittance(cellOfOccluder, scene);
  this->ReadAmbient(scene);
  LightsOnce once;
  this->Keys.clear();
  for (const Block& block : this->Lights)
  {
    for (const radiometry::LightRecord& record :
      once.New(block, ReadLights(block.Data, bands, block.Name)))
    {
      scene.Lights.push_back(
        radiometry::ToLight(radiometry::PlaceLight(record, this->ObjectTransform, this->View),
          this->MetersPerUnit, scene.Origin, scene.Lights.size()));
      const radiometry::Vec3& p =
        record.Polygon.empty() ? record.Position : record.Polygon.front();
      const radiometry::Vec3 d =
        record.Polygon.empty() ? record.Direction : radiometry::Vec3{};
      this->Keys.push_back(
        { static_cast<double>(record.Type), p.x, p.y, p.z, d.x, d.y, d.z });
    }
  }
  double rounding = 0.0;
  for (const std::vector<Block>* blocks : { &this->Surface, &this->Occluders })
  {
    for (const Block& block : *blocks)
    {
      rounding = std::max(rounding, SinglePrecision(block.Data) * this->MetersPerUnit);
    }
  }
  radiometry::BringLightsForward(scene, rounding);
  return scene;
}
