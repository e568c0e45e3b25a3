// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceArrays.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace names = radiometry::names;
using radiometry::InputError;
using Blocks = std::vector<SceneAdapter::Block>;

namespace
{

vtkDataSetAttributes* Attributes(vtkPolyData* data, bool points)
{
  return points ? static_cast<vtkDataSetAttributes*>(data->GetPointData()) : data->GetCellData();
}

bool Surface(const SceneAdapter::Block& block)
{
  return !block.Sensors && block.Cells > 0;
}

/// An array of N or one component with as many tuples as there are cells or points; null: none.
vtkDataArray* Find(vtkPolyData* data, bool points, const std::string& block,
  const std::string& name, int bands)
{
  vtkDataArray* array = Attributes(data, points)->GetArray(name.c_str());
  if (array && array->GetNumberOfComponents() != bands && array->GetNumberOfComponents() != 1)
  {
    throw InputError(block + name, -1,
      std::to_string(array->GetNumberOfComponents()) + " components",
      "1 or " + std::to_string(bands) + ", the bands of the scene");
  }
  return array;
}

double Value(vtkDataArray* array, vtkIdType tuple, int band, const std::string& label)
{
  const double value = array->GetComponent(tuple, array->GetNumberOfComponents() == 1 ? 0 : band);
  if (!(value >= 0.0) || !std::isfinite(value))
  {
    throw InputError(label, tuple, value, "W/m^2, a finite number of at least 0");
  }
  return value;
}

/// The mean of a cell's corners.
class CornerMean
{
public:
  CornerMean(vtkPolyData* data, vtkDataArray* array, const std::string& label)
    : Data(data)
    , Array(array)
    , Label(label)
  {
  }
  double operator()(vtkIdType cell, int band)
  {
    this->Data->GetCellPoints(cell, this->Ids);
    double sum = 0.0;
    for (vtkIdType k = 0; k < this->Ids->GetNumberOfIds(); ++k)
    {
      sum += Value(this->Array, this->Ids->GetId(k), band, this->Label);
    }
    return this->Ids->GetNumberOfIds() > 0
      ? sum / static_cast<double>(this->Ids->GetNumberOfIds())
      : 0.0;
  }

private:
  vtkPolyData* Data;
  vtkDataArray* Array;
  std::string Label;
  vtkNew<vtkIdList> Ids;
};

/// Reads an array of all blocks by cell; false where no block has it.
bool ReadCells(const Blocks& blocks, bool points, const std::string& name, bool needed, int bands,
  std::size_t cells, std::vector<double>& values)
{
  bool any = false;
  for (const SceneAdapter::Block& block : blocks)
  {
    any = any || (Surface(block) && Find(block.Data, points, block.Name, name, bands));
  }
  if (!any)
  {
    return false;
  }
  values.assign(cells * static_cast<std::size_t>(bands), 0.0);
  for (const SceneAdapter::Block& block : blocks)
  {
    vtkDataArray* array = Surface(block) ? Find(block.Data, points, block.Name, name, bands) : nullptr;
    if (!array)
    {
      if (needed && Surface(block))
      {
        throw InputError(block.Name + name, -1, "missing", "as other blocks have it");
      }
      continue;
    }
    CornerMean mean(block.Data, array, block.Name + name);
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      const std::int32_t number = block.Number(c);
      for (int b = 0; b < bands && number >= 0; ++b)
      {
        values[static_cast<std::size_t>(number) * static_cast<std::size_t>(bands) +
          static_cast<std::size_t>(b)] =
          points ? mean(c, b) : Value(array, c, b, block.Name + name);
      }
    }
  }
  return true;
}

/// Calls visit(carrier's polydata, point of it, its place among Job::Points).
template <typename Visit>
void EachPoint(const vtkRadiometricFilter::Job& job, const Visit& visit)
{
  for (const SurfacePoints::Block& block : job.Carriers->Blocks())
  {
    for (vtkIdType i = 0; block.Data && i < block.Data->GetNumberOfPoints(); ++i)
    {
      const std::ptrdiff_t at = block.Numbers.empty()
        ? static_cast<std::ptrdiff_t>(block.First) + i
        : block.Numbers[static_cast<std::size_t>(i)];
      if (at >= 0)
      {
        visit(block.Data.Get(), i, static_cast<std::size_t>(at));
      }
    }
  }
}

void ReadPoints(
  const vtkRadiometricFilter::Job& job, const std::string& name, std::vector<double>& values)
{
  const int bands = job.Scene.Optics.Bands;
  EachPoint(job, [&](vtkPolyData* data, vtkIdType i, std::size_t at) {
    vtkDataArray* array = Find(data, true, "", name, bands);
    for (int b = 0; b < bands && array; ++b)
    {
      values.resize(job.Points.size() * static_cast<std::size_t>(bands), 0.0);
      values[at * static_cast<std::size_t>(bands) + static_cast<std::size_t>(b)] =
        Value(array, i, b, name);
    }
  });
}

bool Carries(const Blocks& blocks, bool points, const char* name)
{
  return std::any_of(blocks.begin(), blocks.end(), [&](const SceneAdapter::Block& block) {
    return Surface(block) && Attributes(block.Data, points)->HasArray(name);
  });
}

} // namespace

bool CarryLight(const Blocks& blocks, bool points)
{
  return Carries(blocks, points, names::Radiosity) || Carries(blocks, points, names::Irradiance);
}

SurfaceLight ReadSurfaceLight(const vtkRadiometricFilter::Job& job)
{
  const Blocks& blocks = job.Adapter->Blocks();
  SurfaceLight light;
  const bool points = !CarryLight(blocks, false);
  if (points && !CarryLight(blocks, true))
  {
    // Values at points are not handed from process to process.
    if (job.Adapter->IsGathered() && CarryLight(job.Adapter->OwnBlocks(), true))
    {
      throw InputError(std::string(names::Irradiance) + " or " + names::Radiosity, -1,
        "values at points", "values of cells, where processes share a surface or it has ghost cells");
    }
    return light;
  }
  light.Any = true;
  light.Radiosity = Carries(blocks, points, names::Radiosity);
  const std::string quantity = light.Radiosity ? names::Radiosity : names::Irradiance;
  for (std::size_t side = 0; side < 2; ++side)
  {
    const std::string name = quantity + (side == 1 ? names::BackSuffix : "");
    radiometry::FieldValues& cells = light.Cells[side];
    if (ReadCells(blocks, points, name, side == 0, job.Scene.Optics.Bands, job.Scene.Cells,
          cells.Values))
    {
      ReadCells(blocks, points, name + names::ErrorSuffix, false, job.Scene.Optics.Bands,
        job.Scene.Cells, cells.Errors);
    }
    if (!job.WantCells)
    {
      ReadPoints(job, name, light.Points[side].Values);
      if (!light.Points[side].Values.empty())
      {
        ReadPoints(job, name + names::ErrorSuffix, light.Points[side].Errors);
      }
    }
  }
  return light;
}

std::vector<float> ReadLightVisibility(const vtkRadiometricFilter::Job& job)
{
  const std::size_t lights = job.Scene.Lights.size();
  std::vector<float> known;
  if (lights == 0)
  {
    return known;
  }
  const auto copy = [&](vtkDataArray* array, vtkIdType tuple, std::size_t at) {
    for (std::size_t k = 0; k < lights; ++k)
    {
      // Shares that are neither 0 nor 1 are asked for again.
      known[at * lights + k] =
        array ? static_cast<float>(array->GetComponent(tuple, static_cast<int>(k))) : 0.5f;
    }
  };
  // Only of the very lights that are here.
  const auto& keys = job.Adapter->LightKeys();
  const auto find = [&](vtkPolyData* data, bool points) -> vtkDataArray* {
    vtkDataArray* array = Attributes(data, points)->GetArray(names::LightVisibility);
    auto* of = vtkDataArray::SafeDownCast(
      data->GetFieldData()->GetAbstractArray(names::LightVisibilityLights));
    bool same = array && array->GetNumberOfComponents() == static_cast<int>(lights) && of &&
      of->GetNumberOfComponents() == 7 && of->GetNumberOfTuples() == static_cast<vtkIdType>(lights) &&
      keys.size() == lights;
    for (std::size_t k = 0; k < lights && same; ++k)
    {
      for (int c = 0; c < 7; ++c)
      {
        same = same &&
          of->GetComponent(static_cast<vtkIdType>(k), c) == keys[k][static_cast<std::size_t>(c)];
      }
    }
    return same ? array : nullptr;
  };
  if (!job.WantCells)
  {
    bool any = false;
    for (const SurfacePoints::Block& block : job.Carriers->Blocks())
    {
      any = any || (block.Data && find(block.Data, true));
    }
    known.assign(any ? job.Points.size() * lights : 0, 0.5f);
    if (any)
    {
      EachPoint(job, [&](vtkPolyData* data, vtkIdType i, std::size_t at) {
        copy(find(data, true), i, at);
      });
    }
    return known;
  }
  const Blocks& blocks = job.Adapter->OwnBlocks();
  if (std::none_of(blocks.begin(), blocks.end(), [&](const SceneAdapter::Block& block) {
        return Surface(block) && find(block.Data, false);
      }))
  {
    return known;
  }
  known.assign(job.Scene.Cells * lights, 0.5f);
  for (const SceneAdapter::Block& block : blocks)
  {
    for (vtkIdType c = 0; Surface(block) && c < block.Cells; ++c)
    {
      if (block.Number(c) >= 0)
      {
        copy(find(block.Data, false), c, static_cast<std::size_t>(block.Number(c)));
      }
    }
  }
  return known;
}
