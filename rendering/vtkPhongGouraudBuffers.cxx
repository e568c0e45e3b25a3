// SPDX-License-Identifier: BSD-3-Clause
// The buffers of vtkPhongGouraudHelper: the field at points, the field and the frames of cells.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Vec3.h"

#include <array>
#include <cmath>

using vtkradiometry::BandColors;
using vtkradiometry::DataOf;
using vtkradiometry::DrawnBlock;

namespace
{

using radiometry::Vec3;

Vec3 PointAt(vtkPolyData* block, vtkIdType id)
{
  double p[3];
  block->GetPoint(id, p);
  return { p[0], p[1], p[2] };
}

struct CellFrame
{
  Vec3 Normal; // unit; zero for a cell without area
  Vec3 Center; // mean of the points
};

/// Normal (right-hand rule, mean over the polygon by Newell's sum) and centre of a polygon.
CellFrame FrameOf(vtkPolyData* block, vtkIdType count, const vtkIdType* ids)
{
  CellFrame frame;
  const Vec3 origin = PointAt(block, ids[0]);
  Vec3 previous = PointAt(block, ids[count - 1]) - origin;
  Vec3 sum;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Vec3 next = PointAt(block, ids[i]) - origin;
    frame.Normal += Cross(previous, next);
    sum += next;
    previous = next;
  }
  frame.Normal = Normalized(frame.Normal);
  frame.Center = origin + sum / static_cast<double>(count);
  return frame;
}

/// Calls f(frame) for each triangle of polygons and strips in the order in which they are drawn.
/// `cellOfPolygonTriangle` names the cell of each triangle of the polygons.
template <typename F>
void ForEachTriangleFrame(vtkPolyData* block, const std::vector<vtkIdType>& cellOfPolygonTriangle,
  vtkIdType firstPolygon, const F& f)
{
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  std::size_t triangle = 0;
  vtkIdType cell = firstPolygon;
  auto polygons = vtk::TakeSmartPointer(block->GetPolys()->NewIterator());
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell())
  {
    polygons->GetCurrentCell(count, ids);
    CellFrame frame;
    bool made = false;
    for (; triangle < cellOfPolygonTriangle.size() && cellOfPolygonTriangle[triangle] == cell;
         ++triangle)
    {
      if (!made)
      {
        frame = FrameOf(block, count, ids);
        made = true;
      }
      f(frame);
    }
    ++cell;
  }
  auto strips = vtk::TakeSmartPointer(block->GetStrips()->NewIterator());
  for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell())
  {
    strips->GetCurrentCell(count, ids);
    for (vtkIdType i = 2; i < count; ++i)
    {
      const vtkIdType corners[3] = { ids[i - 2], i % 2 ? ids[i] : ids[i - 1],
        i % 2 ? ids[i - 1] : ids[i] };
      f(FrameOf(block, 3, corners));
    }
  }
}

/// Does every cell have one normal at all its points?
bool HasOneNormalPerCell(vtkPolyData* block)
{
  vtkDataArray* normals = block->GetPointData()->GetNormals();
  if (!normals)
  {
    return false;
  }
  for (vtkCellArray* cells : { block->GetPolys(), block->GetStrips() })
  {
    auto it = vtk::TakeSmartPointer(cells->NewIterator());
    for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      it->GetCurrentCell(count, ids);
      for (vtkIdType i = 1; i < count; ++i)
      {
        for (int c = 0; c < 3; ++c)
        {
          if (normals->GetComponent(ids[i], c) != normals->GetComponent(ids[0], c))
          {
            return false;
          }
        }
      }
    }
  }
  return true;
}

void SetTexel(std::vector<float>& texels, std::size_t i, double x, double y, double z)
{
  texels[4 * i] = static_cast<float>(x);
  texels[4 * i + 1] = static_cast<float>(y);
  texels[4 * i + 2] = static_cast<float>(z);
}

} // namespace

vtkPhongGouraudHelper::BlockField vtkPhongGouraudHelper::FindField(vtkPolyData* block)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  BlockField field;
  if (mapper->FieldMode != vtkPhongGouraudMapper::FIELD_ON &&
    mapper->FieldMode != vtkPhongGouraudMapper::FIELD_REFLECTANCE)
  {
    return field;
  }
  const auto find = [](vtkDataSetAttributes* data, const std::string& name, vtkIdType tuples) {
    vtkDataArray* array = data->GetArray(name.c_str());
    return array && array->GetNumberOfTuples() == tuples ? array : nullptr;
  };
  const std::string& name = mapper->FieldArrayName;
  vtkDataSetAttributes* data = block->GetPointData();
  vtkIdType tuples = block->GetNumberOfPoints();
  if (mapper->FieldAssociation != 1)
  {
    field.Front = find(data, name, tuples);
  }
  if (!field.Front && mapper->FieldAssociation != 0)
  {
    data = block->GetCellData();
    tuples = block->GetNumberOfCells();
    field.Front = find(data, name, tuples);
    field.OfCells = field.Front != nullptr;
  }
  if (field.Front)
  {
    field.Back = find(data, name + radiometry::names::BackSuffix, tuples);
  }
  return field;
}

BandColors vtkPhongGouraudHelper::ColorsOfField(vtkPolyData* block)
{
  using radiometry::imaging::BandValues;
  const bool reflects =
    this->Mapper()->FieldMode == vtkPhongGouraudMapper::FIELD_REFLECTANCE;
  const BandColors colors(
    block->GetFieldData(), reflects ? BandValues::Reflectance : BandValues::Power);
  if (!colors.GetProblem().empty())
  {
    vtkErrorWithObjectMacro(this->Mapper(), << colors.GetProblem());
  }
  return colors;
}

bool vtkPhongGouraudHelper::GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* act)
{
  return this->Superclass::GetNeedToRebuildBufferObjects(ren, act) ||
    this->VBOBuildTime < this->Mapper()->BufferTime;
}

void vtkPhongGouraudHelper::BuildBufferObjects(vtkRenderer* ren, vtkActor* act)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  this->FieldOfCells = false;
  this->FieldOfPoints = false;
  this->FieldOfBack = false;
  this->SpectralField = false;
  this->FieldMost = 0.0;
  this->BoxesMade = false;
  this->ConstantInCells = mapper->Shading == vtkPhongGouraudMapper::AUTO;
  bool empty = true;
  for (const DrawnBlock* drawn : this->Blocks())
  {
    vtkPolyData* block = DataOf(*drawn);
    empty = empty && block->GetNumberOfCells() == 0;
    const BlockField field = this->FindField(block);
    if (field.Front)
    {
      (field.OfCells ? this->FieldOfCells : this->FieldOfPoints) = true;
      this->FieldOfBack = this->FieldOfBack || field.Back;
    }
    this->ConstantInCells = this->ConstantInCells && HasOneNormalPerCell(block);
  }
  const bool wanted = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_ON ||
    mapper->FieldMode == vtkPhongGouraudMapper::FIELD_REFLECTANCE;
  if (wanted && !empty && !this->FieldOfCells && !this->FieldOfPoints)
  {
    vtkWarningWithObjectMacro(mapper, << "no point or cell array \"" << mapper->FieldArrayName
                                      << "\": these blocks are drawn black");
  }
  this->PrepareFalseColor();
  this->PrepareVisibility();
  this->Superclass::BuildBufferObjects(ren, act);
  this->BuildMaterials(ren, act);
  this->BuildCellBuffers(ren, act);
  this->BuildChoice(act);
  this->BuildFalseColor(ren, act);
  this->BuildVisibility(ren, act);
}

void vtkPhongGouraudHelper::AppendOneBufferObject(vtkRenderer* ren, vtkActor* act,
  DrawnBlock* drawn, vtkIdType& flatIndex, std::vector<unsigned char>& colors,
  std::vector<float>& norms)
{
  vtkPolyData* block = DataOf(*drawn);
  vtkDataArray* points = block->GetPoints()->GetData();
  vtkIdType offset = 0;
  vtkIdType before = 0;
  vtkIdType after = 0;
  this->VBOs->ArrayExists("vertexMC", points, offset, before);
  this->Superclass::AppendOneBufferObject(ren, act, drawn, flatIndex, colors, norms);
  this->VBOs->ArrayExists("vertexMC", points, offset, after);
  if (this->FieldOfPoints)
  {
    this->AppendField(block, after > before);
  }
  if (this->ScalarsOfPoints)
  {
    this->AppendScalars(block, after > before);
  }
  if (this->VisibilityGroupsOfPoints > 0)
  {
    this->AppendVisibility(block, after > before);
  }
  vtkCellArray* prims[4] = { block->GetVerts(), block->GetLines(), block->GetPolys(),
    block->GetStrips() };
  drawn->CellCellMap->Update(prims, act->GetProperty()->GetRepresentation(), block->GetPoints());
}

void vtkPhongGouraudHelper::AppendField(vtkPolyData* block, bool newPoints)
{
  const BlockField found = this->FindField(block);
  vtkDataArray* front = found.OfCells ? nullptr : found.Front;
  vtkDataArray* back = found.OfCells || !found.Back ? front : found.Back;
  vtkDataArray* points = block->GetPoints()->GetData();
  if (!newPoints)
  {
    // VTK draws blocks that share their points from one copy of them; so must their field be.
    if (this->FieldOfShared[points] != front)
    {
      vtkErrorWithObjectMacro(
        this->Mapper(), << "two blocks share one array of points but not the field \""
                        << this->Mapper()->FieldArrayName << "\": give each its own points");
    }
    return;
  }
  this->FieldOfShared[points] = front;
  const vtkIdType count = block->GetNumberOfPoints();
  const BandColors colors = this->ColorsOfField(block);
  this->AppendPointField("radiometryFieldMC", front, count, colors);
  if (this->FieldOfBack)
  {
    this->AppendPointField("radiometryFieldBackMC", back, count, colors);
  }
}

void vtkPhongGouraudHelper::AppendPointField(
  const char* attribute, vtkDataArray* field, vtkIdType points, const BandColors& colors)
{
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(points);
  values->Fill(0.0);
  this->SpectralField = this->SpectralField || (field && colors.IsSpectral(field));
  for (vtkIdType i = 0; field && i < points; ++i)
  {
    const std::array<double, 3> rgb = colors.Of(field, i);
    this->NoteField(rgb);
    values->SetTuple(i, rgb.data());
  }
  this->VBOs->AppendDataArray(attribute, values, VTK_FLOAT);
}

void vtkPhongGouraudHelper::BuildCellBuffers(vtkRenderer* ren, vtkActor* act)
{
  this->FieldOfShared.clear();
  vtkPhongGouraudMapper* mapper = this->Mapper();
  const bool surface = act->GetProperty()->GetRepresentation() == VTK_SURFACE;
  const bool frames = surface &&
    (mapper->FieldMode != vtkPhongGouraudMapper::FIELD_ON ||
      (mapper->WantsHighlights() && this->Shines(act))) &&
    (mapper->Shading == vtkPhongGouraudMapper::FLAT || !this->HasPointNormals());
  const bool fields = surface && this->FieldOfCells;
  if (!frames)
  {
    this->FrameBuffer.Free();
  }
  if (!fields)
  {
    this->FieldBuffer.Free();
  }
  const std::vector<DrawnBlock*> blocks = this->Blocks();
  if (blocks.empty() || (!frames && !fields))
  {
    return;
  }

  // Centres are stored as the vertices are: VTK may shift and scale these.
  Vec3 shift;
  Vec3 scale{ 1.0, 1.0, 1.0 };
  vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC");
  if (positions && positions->GetCoordShiftAndScaleEnabled())
  {
    const std::vector<double>& s = positions->GetShift();
    const std::vector<double>& f = positions->GetScale();
    shift = { s[0], s[1], s[2] };
    scale = { f[0], f[1], f[2] };
  }

  const auto total = static_cast<std::size_t>(blocks.back()->CellCellMap->GetFinalOffset());
  std::vector<float> frameTexels(frames ? 8 * total : 0, 0.0f);
  const std::size_t sides = this->FieldOfBack ? 2 : 1;
  std::vector<float> fieldTexels(fields ? 4 * sides * total : 0, 0.0f);
  for (DrawnBlock* drawn : blocks)
  {
    vtkPolyData* block = DataOf(*drawn);
    vtkOpenGLCellToVTKCellMap* map = drawn->CellCellMap;
    const vtkIdType* offsets = map->GetPrimitiveOffsets();
    const BlockField field = this->FindField(block);
    if (fields && field.OfCells)
    {
      const BandColors colors = this->ColorsOfField(block);
      for (std::size_t side = 0; side < sides; ++side)
      {
        vtkDataArray* array = side == 1 && field.Back ? field.Back : field.Front;
        this->SpectralField = this->SpectralField || colors.IsSpectral(array);
        for (std::size_t i = 0; i < map->GetSize(); ++i)
        {
          const std::array<double, 3> rgb = colors.Of(array, map->GetValue(i));
          this->NoteField(rgb);
          const std::size_t texel = (static_cast<std::size_t>(offsets[0]) + i) * sides + side;
          SetTexel(fieldTexels, texel, rgb[0], rgb[1], rgb[2]);
        }
      }
    }
    if (frames)
    {
      std::vector<vtkIdType> cellOfTriangle;
      for (vtkIdType i = offsets[2] - offsets[0]; i < offsets[3] - offsets[0]; ++i)
      {
        cellOfTriangle.push_back(map->GetValue(static_cast<std::size_t>(i)));
      }
      std::size_t texel = static_cast<std::size_t>(offsets[2]);
      const vtkIdType firstPolygon =
        block->GetVerts()->GetNumberOfCells() + block->GetLines()->GetNumberOfCells();
      ForEachTriangleFrame(block, cellOfTriangle, firstPolygon, [&](const CellFrame& frame) {
        const Vec3 c = frame.Center - shift;
        SetTexel(frameTexels, 2 * texel, frame.Normal.x, frame.Normal.y, frame.Normal.z);
        SetTexel(frameTexels, 2 * texel + 1, c.x * scale.x, c.y * scale.y, c.z * scale.z);
        ++texel;
      });
    }
  }
  this->FrameBuffer.Upload(ren, std::move(frameTexels));
  this->FieldBuffer.Upload(ren, std::move(fieldTexels));
}
