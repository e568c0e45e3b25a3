// SPDX-License-Identifier: BSD-3-Clause
// What the simulation knows of shadows (LightVisibility), for vtkPhongGouraudHelper.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>
#include <limits>

using vtkradiometry::DataOf;
using vtkradiometry::DrawnBlock;
using vtkradiometry::LightKey;

namespace
{

namespace names = radiometry::names;

/// Of floats, so 256 MiB on the graphics card.
constexpr std::size_t MostShares = std::size_t{ 1 } << 26;
/// Groups of four lights that are handed from points to pixels; with backs half of that a side.
constexpr int MostGroupsOfPoints = 4;

std::vector<LightKey> KeysOf(vtkPolyData* block)
{
  std::vector<LightKey> keys;
  vtkDataArray* array = block->GetFieldData()->GetArray(names::LightVisibilityLights);
  for (vtkIdType i = 0; array && array->GetNumberOfComponents() == 7 &&
       i < array->GetNumberOfTuples(); ++i)
  {
    LightKey key;
    array->GetTuple(i, key.data());
    keys.push_back(key);
  }
  return keys;
}

/// How far two lights are from being the same; infinite where they cannot be, rounding of
/// coordinates to single precision allowed.
double DifferenceOf(const LightKey& a, const LightKey& b)
{
  double size = 0.0;
  double difference = 0.0;
  for (std::size_t c = 1; c < a.size(); ++c)
  {
    size = std::max({ size, std::abs(a[c]), std::abs(b[c]) });
    difference = std::max(difference, std::abs(a[c] - b[c]));
  }
  return a[0] == b[0] && difference <= 1e-6 * size ? difference
                                                   : std::numeric_limits<double>::infinity();
}

/// The place of a light among others; -1: it is none of them.
int PlaceOf(const LightKey& key, const std::vector<LightKey>& keys)
{
  int place = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    const double difference = DifferenceOf(key, keys[k]);
    if (difference < least)
    {
      least = difference;
      place = static_cast<int>(k);
    }
  }
  return place;
}

} // namespace

vtkPhongGouraudHelper::BlockVisibility vtkPhongGouraudHelper::FindVisibility(vtkPolyData* block)
{
  BlockVisibility found;
  const std::vector<LightKey> keys = KeysOf(block);
  const auto find = [&](vtkDataSetAttributes* data, const char* suffix, vtkIdType tuples) {
    vtkDataArray* array =
      data->GetArray((std::string(names::LightVisibility) + suffix).c_str());
    const bool fits = array && !keys.empty() && array->GetNumberOfTuples() == tuples &&
      array->GetNumberOfComponents() == static_cast<int>(keys.size());
    return fits ? array : nullptr;
  };
  vtkDataSetAttributes* data = block->GetPointData();
  vtkIdType tuples = block->GetNumberOfPoints();
  found.Front = find(data, "", tuples);
  if (!found.Front)
  {
    data = block->GetCellData();
    tuples = block->GetNumberOfCells();
    found.Front = find(data, "", tuples);
    found.OfCells = found.Front != nullptr;
  }
  found.Back = found.Front ? find(data, names::BackSuffix, tuples) : nullptr;
  // The columns are those of the first block that has any.
  for (const LightKey& key : this->VisibilityKeys)
  {
    found.Components.push_back(PlaceOf(key, keys));
  }
  return found;
}

void vtkPhongGouraudHelper::PrepareVisibility()
{
  this->VisibilityKeys.clear();
  this->VisibilityOfCells = false;
  this->VisibilityOfBack = false;
  this->VisibilityGroupsOfPoints = 0;
  bool ofPoints = false;
  for (const DrawnBlock* drawn : this->Blocks())
  {
    vtkPolyData* block = DataOf(*drawn);
    const BlockVisibility found = this->FindVisibility(block);
    if (found.Front && this->VisibilityKeys.empty())
    {
      this->VisibilityKeys = KeysOf(block);
    }
    this->VisibilityOfCells = this->VisibilityOfCells || (found.Front && found.OfCells);
    this->VisibilityOfBack = this->VisibilityOfBack || found.Back;
    ofPoints = ofPoints || (found.Front && !found.OfCells);
  }
  this->NoteVisibilityLoss();
  if (!this->Mapper()->WantsLightVisibility())
  {
    this->VisibilityOfCells = false; // known, for what leaving it out changes, but not uploaded
    return;
  }
  std::size_t room = this->VisibilityKeys.size();
  if (ofPoints)
  {
    const int most = this->VisibilityOfBack ? MostGroupsOfPoints / 2 : MostGroupsOfPoints;
    room = std::min(room, static_cast<std::size_t>(4 * most));
    this->VisibilityGroupsOfPoints = static_cast<int>((room + 3) / 4);
  }
  if (this->VisibilityOfCells)
  {
    std::size_t cells = 1;
    for (const DrawnBlock* drawn : this->Blocks())
    {
      // Triangles are not counted yet: at most as many as corners.
      vtkPolyData* block = DataOf(*drawn);
      cells += static_cast<std::size_t>(block->GetPolys()->GetNumberOfConnectivityIds() +
        block->GetStrips()->GetNumberOfConnectivityIds());
    }
    const std::size_t sides = this->VisibilityOfBack ? 2 : 1;
    room = std::min(room, 4 * (MostShares / (4 * sides * cells)));
    this->VisibilityOfCells = room > 0;
  }
  if (room < this->VisibilityKeys.size())
  {
    vtkWarningWithObjectMacro(this->Mapper(),
      << "LightVisibility: there is room for the shadows of " << room << " of "
      << this->VisibilityKeys.size() << " lights; the others are drawn without");
    this->VisibilityKeys.resize(room);
  }
}

void vtkPhongGouraudHelper::NoteVisibilityLoss()
{
  this->VisibilityLoss.assign(this->VisibilityKeys.size(), 0.0);
  for (const DrawnBlock* drawn : this->Blocks())
  {
    const BlockVisibility found = this->FindVisibility(DataOf(*drawn));
    for (vtkDataArray* array : { found.Front, found.Back })
    {
      for (std::size_t column = 0; array && column < found.Components.size(); ++column)
      {
        double range[2] = { 1.0, 1.0 };
        if (found.Components[column] >= 0)
        {
          array->GetRange(range, found.Components[column]);
        }
        this->VisibilityLoss[column] = std::max(
          { this->VisibilityLoss[column], std::abs(1.0 - range[0]), std::abs(1.0 - range[1]) });
      }
    }
  }
}

void vtkPhongGouraudHelper::AppendVisibility(vtkPolyData* block, bool newPoints)
{
  if (!newPoints)
  {
    return; // as the first block that has these points
  }
  const BlockVisibility found = this->FindVisibility(block);
  const vtkIdType count = block->GetNumberOfPoints();
  for (int side = 0; side < (this->VisibilityOfBack ? 2 : 1); ++side)
  {
    vtkDataArray* array = found.OfCells ? nullptr : (side == 0 ? found.Front : found.Back);
    for (int group = 0; group < this->VisibilityGroupsOfPoints; ++group)
    {
      vtkNew<vtkFloatArray> values;
      values->SetNumberOfComponents(4);
      values->SetNumberOfTuples(count);
      values->Fill(1.0);
      for (int c = 0; array && c < 4; ++c)
      {
        const auto column = static_cast<std::size_t>(4 * group + c);
        const int component = column < found.Components.size() ? found.Components[column] : -1;
        for (vtkIdType i = 0; component >= 0 && i < count; ++i)
        {
          values->SetTypedComponent(i, c, static_cast<float>(array->GetComponent(i, component)));
        }
      }
      const std::string name =
        std::string(side == 0 ? "radiometryVisibility" : "radiometryVisibilityBack") +
        std::to_string(group) + "MC";
      this->VBOs->AppendDataArray(name.c_str(), values, VTK_FLOAT);
    }
  }
}

void vtkPhongGouraudHelper::BuildVisibility(vtkRenderer* ren, vtkActor* act)
{
  const std::vector<DrawnBlock*> blocks = this->Blocks();
  if (!this->VisibilityOfCells || blocks.empty() ||
    act->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    this->VisibilityBuffer.Free();
    return;
  }
  // For each triangle: front, then back (where any block has it): groups of four lights.
  const std::size_t sides = this->VisibilityOfBack ? 2 : 1;
  const std::size_t groups = (this->VisibilityKeys.size() + 3) / 4;
  const auto total = static_cast<std::size_t>(blocks.back()->CellCellMap->GetFinalOffset());
  std::vector<float> texels(4 * groups * sides * total, 1.0f);
  for (DrawnBlock* drawn : blocks)
  {
    const BlockVisibility found = this->FindVisibility(DataOf(*drawn));
    if (!found.Front || !found.OfCells)
    {
      continue;
    }
    vtkOpenGLCellToVTKCellMap* map = drawn->CellCellMap;
    const std::size_t begin = static_cast<std::size_t>(map->GetPrimitiveOffsets()[0]);
    for (std::size_t i = 0; i < map->GetSize(); ++i)
    {
      for (std::size_t side = 0; side < sides; ++side)
      {
        vtkDataArray* array = side == 0 ? found.Front : found.Back;
        float* shares = &texels[4 * groups * ((begin + i) * sides + side)];
        for (std::size_t column = 0; array && column < found.Components.size(); ++column)
        {
          const int component = found.Components[column];
          shares[column] = component < 0
            ? 1.0f
            : static_cast<float>(array->GetComponent(map->GetValue(i), component));
        }
      }
    }
  }
  this->VisibilityBuffer.Upload(ren, std::move(texels));
}

void vtkPhongGouraudHelper::AssignVisibility(vtkradiometry::CollectedLights& collected)
{
  collected.Columns.assign(collected.Lights.size(), -1);
  for (std::size_t k = 0; k < collected.Keys.size() && !this->VisibilityKeys.empty(); ++k)
  {
    collected.Columns[k] = PlaceOf(collected.Keys[k], this->VisibilityKeys);
  }
}

void vtkPhongGouraudHelper::NeedVisibility(vtkradiometry::ShaderFeatures& needs) const
{
  needs.insert("Visibility");
  if (this->VisibilityOfCells)
  {
    needs.insert("VisibilityOfCells");
  }
  if (needs.count("TwoSided"))
  {
    needs.insert(this->VisibilityOfBack ? "VisibilityOfBack" : "VisibilityOfFront");
  }
  const char* groups[] = { "VisibilityOfPoints", "VisibilityOfPoints2", "VisibilityOfPoints3",
    "VisibilityOfPoints4" };
  for (int k = 0; k < this->VisibilityGroupsOfPoints; ++k)
  {
    needs.insert(groups[k]);
  }
}
