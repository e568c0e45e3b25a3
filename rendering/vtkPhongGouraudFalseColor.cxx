// SPDX-License-Identifier: BSD-3-Clause
// False colour, for vtkPhongGouraudHelper: scalars through their colour map, without light.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkFloatArray.h"
#include "vtkLookupTable.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

using vtkradiometry::ColorSteps;
using vtkradiometry::DataOf;
using vtkradiometry::DrawnBlock;

namespace
{

/// The values that a map's colours belong to: a component or the length of each tuple.
std::vector<double> MappedValues(vtkScalarsToColors* map, vtkDataArray* array, int component)
{
  const int components = array->GetNumberOfComponents();
  int first = std::clamp(component, 0, components - 1);
  int last = first;
  if (component < 0 && components > 1)
  {
    // as vtkScalarsToColors::MapVectorsThroughTable reads a vector
    first = std::clamp(map->GetVectorComponent(), 0, components - 1);
    last = first;
    if (map->GetVectorMode() == vtkScalarsToColors::MAGNITUDE)
    {
      const int size = map->GetVectorSize();
      first = size > 0 ? first : 0;
      last = size > 0 ? std::min(first + size, components) - 1 : components - 1;
    }
  }
  const bool length = component < 0 && components > 1 &&
    map->GetVectorMode() == vtkScalarsToColors::MAGNITUDE;
  std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto tuple = static_cast<vtkIdType>(i);
    if (!length)
    {
      values[i] = array->GetComponent(tuple, first);
      continue;
    }
    double sum = 0.0;
    for (int c = first; c <= last; ++c)
    {
      sum += array->GetComponent(tuple, c) * array->GetComponent(tuple, c);
    }
    values[i] = std::sqrt(sum);
  }
  return values;
}

std::vector<ColorSteps::Color> ColorsOf(
  vtkScalarsToColors* map, vtkAbstractArray* array, int mode, int component)
{
  auto mapped = vtk::TakeSmartPointer(map->MapScalars(array, mode, component));
  std::vector<ColorSteps::Color> colors(static_cast<std::size_t>(mapped->GetNumberOfTuples()));
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    mapped->GetTypedTuple(static_cast<vtkIdType>(i), colors[i].data());
  }
  return colors;
}

} // namespace

vtkPhongGouraudHelper::BlockScalars vtkPhongGouraudHelper::FindScalars(vtkPolyData* block)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  BlockScalars scalars;
  if (mapper->FieldMode != vtkPhongGouraudMapper::FIELD_FALSE_COLOR ||
    !mapper->GetScalarVisibility())
  {
    return scalars;
  }
  int where = 0;
  vtkAbstractArray* array = vtkAbstractMapper::GetAbstractScalars(block, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), where);
  const vtkIdType needed = where == 0 ? block->GetNumberOfPoints() : block->GetNumberOfCells();
  if (!array || where > 1 || array->GetNumberOfTuples() != needed)
  {
    return scalars;
  }
  scalars.Array = array;
  scalars.OfCells = where == 1;
  auto* values = vtkDataArray::SafeDownCast(array);
  scalars.Map = mapper->GetLookupTable();
  if (values && values->GetLookupTable())
  {
    scalars.Map = values->GetLookupTable();
  }
  // Numbers that are colours already, and categories, have nothing between them to be mapped.
  const bool vectorOfColors = mapper->GetArrayComponent() < 0 &&
    array->GetNumberOfComponents() > 1 &&
    scalars.Map->GetVectorMode() == vtkScalarsToColors::RGBCOLORS;
  scalars.AreColors = !values || scalars.Map->GetIndexedLookup() || vectorOfColors ||
    mapper->GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS ||
    (mapper->GetColorMode() == VTK_COLOR_MODE_DEFAULT &&
      vtkUnsignedCharArray::SafeDownCast(array));
  return scalars;
}

void vtkPhongGouraudHelper::PrepareFalseColor()
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  this->ScalarsOfCells = false;
  this->ScalarsOfPoints = false;
  this->ScalarsMissing = false;
  this->PointColors = false;
  vtkScalarsToColors* map = nullptr;
  for (const DrawnBlock* drawn : this->Blocks())
  {
    const BlockScalars scalars = this->FindScalars(DataOf(*drawn));
    if (!scalars.Array)
    {
      this->ScalarsMissing = true;
      continue;
    }
    if (!mapper->GetUseLookupTableScalarRange())
    {
      scalars.Map->SetRange(mapper->GetScalarRange());
    }
    scalars.Map->Build();
    (scalars.OfCells ? this->ScalarsOfCells : this->ScalarsOfPoints) = true;
    if (!scalars.OfCells)
    {
      this->PointColors = this->PointColors || scalars.AreColors || (map && map != scalars.Map);
      map = scalars.Map;
    }
  }
  if (!map || this->PointColors)
  {
    this->Steps.Clear();
    this->StepsMap = nullptr;
  }
  else if (this->StepsMap != map || this->StepsTime < map->GetMTime())
  {
    this->Steps.Build(map);
    this->StepsMap = map;
    this->StepsTime.Modified();
  }
}

void vtkPhongGouraudHelper::AppendScalars(vtkPolyData* block, bool newPoints)
{
  const BlockScalars found = this->FindScalars(block);
  vtkAbstractArray* array = found.OfCells ? nullptr : found.Array;
  vtkDataArray* points = block->GetPoints()->GetData();
  if (!newPoints)
  {
    if (this->ScalarsOfShared[points] != array)
    {
      vtkErrorWithObjectMacro(this->Mapper(),
        << "two blocks share one array of points but not the scalars of the colour map: give each "
           "its own points");
    }
    return;
  }
  this->ScalarsOfShared[points] = array;
  const vtkIdType count = block->GetNumberOfPoints();
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(this->PointColors ? 4 : 2);
  values->SetNumberOfTuples(count);
  values->Fill(0.0);
  if (array)
  {
    const int component = this->Mapper()->GetArrayComponent();
    const std::vector<ColorSteps::Color> colors =
      ColorsOf(found.Map, array, this->Mapper()->GetColorMode(), component);
    const std::vector<double> scalars = this->PointColors
      ? std::vector<double>()
      : MappedValues(found.Map, vtkDataArray::SafeDownCast(array), component);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const ColorSteps::Color& color = colors[static_cast<std::size_t>(i)];
      if (this->PointColors)
      {
        for (int c = 0; c < 4; ++c)
        {
          values->SetTypedComponent(i, c, static_cast<float>(color[c]) / 255.0f);
        }
        continue;
      }
      const double scalar = scalars[static_cast<std::size_t>(i)];
      const bool nan = std::isnan(scalar);
      values->SetTypedComponent(i, 0, nan ? 0.0f : this->Steps.Coordinate(scalar, color));
      values->SetTypedComponent(i, 1, nan ? 1.0f : 0.0f);
    }
  }
  this->VBOs->AppendDataArray(
    this->PointColors ? "radiometryColorMC" : "radiometryScalarMC", values, VTK_FLOAT);
}

void vtkPhongGouraudHelper::BuildFalseColor(vtkRenderer* ren, vtkActor* act)
{
  this->ScalarsOfShared.clear();
  const bool surface = act->GetProperty()->GetRepresentation() == VTK_SURFACE;
  const std::vector<DrawnBlock*> blocks = this->Blocks();
  if (!this->Steps.IsEmpty())
  {
    this->StepBuffer.Upload(ren, this->Steps.Texels());
  }
  else
  {
    this->StepBuffer.Free();
  }
  const bool everywhere = this->ScalarsOfPoints && !this->ScalarsOfCells && !this->ScalarsMissing;
  if (blocks.empty() || !surface || everywhere ||
    (!this->ScalarsOfCells && !this->ScalarsOfPoints))
  {
    this->CellColorBuffer.Free();
    return;
  }
  // For each triangle: the colour of its cell; opacity -1: see its points, -2: the property's.
  std::vector<float> texels(
    4 * static_cast<std::size_t>(blocks.back()->CellCellMap->GetFinalOffset()), 0.0f);
  for (DrawnBlock* drawn : blocks)
  {
    const BlockScalars scalars = this->FindScalars(DataOf(*drawn));
    vtkOpenGLCellToVTKCellMap* map = drawn->CellCellMap;
    const std::size_t begin = static_cast<std::size_t>(map->GetPrimitiveOffsets()[0]);
    std::vector<ColorSteps::Color> colors;
    if (scalars.OfCells)
    {
      colors = ColorsOf(scalars.Map, scalars.Array, this->Mapper()->GetColorMode(),
        this->Mapper()->GetArrayComponent());
    }
    for (std::size_t i = 0; i < map->GetSize(); ++i)
    {
      float* texel = &texels[4 * (begin + i)];
      texel[3] = scalars.Array ? -1.0f : -2.0f;
      for (int c = 0; scalars.OfCells && c < 4; ++c)
      {
        texel[c] =
          static_cast<float>(colors[static_cast<std::size_t>(map->GetValue(i))][c]) / 255.0f;
      }
    }
  }
  this->CellColorBuffer.Upload(ren, std::move(texels));
}
