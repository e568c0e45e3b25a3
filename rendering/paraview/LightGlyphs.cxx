// SPDX-License-Identifier: BSD-3-Clause
#include "LightGlyphs.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Light.h"
#include "radiometry/scene/Vec3.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vtkradiometry
{
namespace
{

namespace names = radiometry::names;
using radiometry::LightType;
using radiometry::Vec3;

constexpr int CircleSegments = 24;

/// Lines, and for each which light (cell and point of the lights) it belongs to.
class Lines
{
public:
  Lines() { this->Colors->SetNumberOfComponents(3); }
  void Begin(vtkIdType lightCell, vtkIdType lightPoint, const std::array<unsigned char, 3>& color)
  {
    this->LightCell = lightCell;
    this->LightPoint = lightPoint;
    this->Color = color;
  }
  vtkIdType Point(const Vec3& p)
  {
    this->PointsOf->InsertNextId(this->LightPoint);
    return this->Points->InsertNextPoint(p.x, p.y, p.z);
  }
  void Segment(const Vec3& a, const Vec3& b)
  {
    const vtkIdType ids[2] = { this->Point(a), this->Point(b) };
    this->Line();
    this->Cells->InsertNextCell(2, ids);
  }
  void Circle(const Vec3& center, const Vec3& u, const Vec3& v)
  {
    this->Line();
    this->Cells->InsertNextCell(CircleSegments + 1);
    vtkIdType first = 0;
    for (int i = 0; i < CircleSegments; ++i)
    {
      const double a = 2.0 * vtkMath::Pi() * i / CircleSegments;
      const vtkIdType id = this->Point(center + std::cos(a) * u + std::sin(a) * v);
      first = i == 0 ? id : first;
      this->Cells->InsertCellPoint(id);
    }
    this->Cells->InsertCellPoint(first);
  }
  /// Half of a circle, from u through v to -u.
  void Arc(const Vec3& center, const Vec3& u, const Vec3& v)
  {
    this->Line();
    this->Cells->InsertNextCell(CircleSegments / 2 + 1);
    for (int i = 0; i <= CircleSegments / 2; ++i)
    {
      const double a = 2.0 * vtkMath::Pi() * i / CircleSegments;
      this->Cells->InsertCellPoint(this->Point(center + std::cos(a) * u + std::sin(a) * v));
    }
  }
  /// The lines as polydata, with the ids of `lights` that selection reads.
  vtkSmartPointer<vtkPolyData> Finish(vtkPolyData* lights) const
  {
    auto glyphs = vtkSmartPointer<vtkPolyData>::New();
    glyphs->SetPoints(this->Points);
    glyphs->SetLines(this->Cells);
    this->Colors->SetName(LightGlyphColors);
    glyphs->GetCellData()->AddArray(this->Colors);
    const auto copy = [](vtkDataSetAttributes* from, vtkIdList* ids, vtkDataSetAttributes* to) {
      for (const char* name : { "vtkOriginalCellIds", "vtkOriginalPointIds", "vtkCompositeIndex",
             "vtkProcessId" })
      {
        if (vtkAbstractArray* array = from->GetAbstractArray(name))
        {
          vtkSmartPointer<vtkAbstractArray> picked;
          picked.TakeReference(array->NewInstance());
          picked->SetName(name);
          picked->SetNumberOfComponents(array->GetNumberOfComponents());
          picked->SetNumberOfTuples(ids->GetNumberOfIds());
          array->GetTuples(ids, picked);
          to->AddArray(picked);
        }
      }
    };
    copy(lights->GetCellData(), this->CellsOf, glyphs->GetCellData());
    copy(lights->GetPointData(), this->PointsOf, glyphs->GetPointData());
    return glyphs;
  }

private:
  void Line()
  {
    this->CellsOf->InsertNextId(this->LightCell);
    this->Colors->InsertNextTypedTuple(this->Color.data());
  }
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
  vtkNew<vtkIdList> CellsOf;
  vtkNew<vtkIdList> PointsOf;
  vtkNew<vtkUnsignedCharArray> Colors;
  vtkIdType LightCell = 0;
  vtkIdType LightPoint = 0;
  std::array<unsigned char, 3> Color{ { 255, 255, 255 } };
};

/// Two unit vectors that make a right-handed frame with the unit vector w.
void Frame(const Vec3& w, Vec3& u, Vec3& v)
{
  const Vec3 other = std::abs(w.x) < 0.9 ? Vec3{ 1.0, 0.0, 0.0 } : Vec3{ 0.0, 1.0, 0.0 };
  u = radiometry::Normalized(Cross(other, w));
  v = Cross(w, u);
}

void DrawPoint(Lines& lines, const Vec3& p, double size)
{
  const Vec3 x{ 0.3 * size, 0.0, 0.0 };
  const Vec3 y{ 0.0, 0.3 * size, 0.0 };
  const Vec3 z{ 0.0, 0.0, 0.3 * size };
  lines.Circle(p, x, y);
  lines.Circle(p, y, z);
  lines.Circle(p, z, x);
  for (const Vec3& axis : { x, y, z })
  {
    lines.Segment(p + 1.3 * axis, p + 1.7 * axis);
    lines.Segment(p - 1.3 * axis, p - 1.7 * axis);
  }
}

void DrawSpot(
  Lines& lines, const Vec3& p, const Vec3& axis, double cutoff, double inner, double size)
{
  Vec3 u;
  Vec3 v;
  Frame(axis, u, v);
  const double angle = vtkMath::RadiansFromDegrees(cutoff);
  const Vec3 base = p + std::cos(angle) * size * axis;
  const double radius = std::sin(angle) * size;
  lines.Circle(base, radius * u, radius * v);
  for (const Vec3& side : { u, v, -u, -v })
  {
    lines.Segment(p, base + radius * side);
  }
  lines.Segment(p, p + 1.2 * size * axis);
  if (inner > 0.0 && inner < cutoff) // where the smooth edge begins
  {
    const double in = vtkMath::RadiansFromDegrees(inner);
    lines.Circle(p + std::cos(in) * size * axis, std::sin(in) * size * u, std::sin(in) * size * v);
  }
}

void DrawDirectional(Lines& lines, const Vec3& p, const Vec3& axis, double size)
{
  Vec3 u;
  Vec3 v;
  Frame(axis, u, v);
  const double radius = 0.35 * size;
  lines.Circle(p, radius * u, radius * v);
  for (int ray = 0; ray < 8; ++ray) // of the sun
  {
    const double a = vtkMath::Pi() * (ray + 0.5) / 4.0;
    const Vec3 out = std::cos(a) * u + std::sin(a) * v;
    lines.Segment(p + 1.2 * radius * out, p + 1.5 * radius * out);
  }
  for (const Vec3& side : { Vec3{}, u, v, -u, -v })
  {
    const Vec3 from = p + radius * side;
    const Vec3 tip = from + size * axis;
    lines.Segment(from, tip);
    for (const Vec3& wing : { u, v, -u, -v })
    {
      lines.Segment(tip, tip - 0.15 * size * axis + 0.06 * size * wing);
    }
  }
}

/// The rim of an area light, and from its middle an arrow to each side on which it shines.
void DrawPolygon(Lines& lines, const std::vector<Vec3>& corners, bool twoSided, double size)
{
  Vec3 middle;
  Vec3 normal;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec3& next = corners[(k + 1) % corners.size()];
    lines.Segment(corners[k], next);
    middle += corners[k] / static_cast<double>(corners.size());
    normal += Cross(corners[k] - corners[0], next - corners[0]);
  }
  const Vec3 axis = radiometry::Normalized(normal);
  Vec3 u;
  Vec3 v;
  Frame(axis, u, v);
  for (int side = 0; side < (twoSided ? 2 : 1); ++side)
  {
    const Vec3 along = side == 0 ? axis : -axis;
    const Vec3 tip = middle + 0.5 * size * along;
    lines.Segment(middle, tip);
    for (const Vec3& wing : { u, v, -u, -v })
    {
      lines.Segment(tip, tip - 0.15 * size * along + 0.06 * size * wing);
    }
  }
}

void DrawEnvironment(Lines& lines, const Vec3& p, const Vec3& down, double size)
{
  Vec3 u;
  Vec3 v;
  Frame(-down, u, v);
  const double radius = 0.5 * size;
  lines.Circle(p, radius * u, radius * v);
  lines.Arc(p, radius * u, -radius * down);
  lines.Arc(p, radius * v, -radius * down);
}

/// The arrays of lights, with what stands for one that is absent.
class LightValues
{
public:
  explicit LightValues(vtkPolyData* lights)
    : Data(lights->GetPointData())
    , CellOfPoint(static_cast<std::size_t>(lights->GetNumberOfPoints()), 0)
  {
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < lights->GetNumberOfCells(); ++c)
    {
      lights->GetCellPoints(c, ids);
      for (const vtkIdType p : *ids)
      {
        this->CellOfPoint[p] = c;
      }
    }
  }
  double At(const char* name, vtkIdType i, int component, double absent) const
  {
    vtkDataArray* array = this->Data->GetArray(name);
    return array && component < array->GetNumberOfComponents() ? array->GetComponent(i, component)
                                                               : absent;
  }
  LightType Type(vtkIdType i) const
  {
    return static_cast<LightType>(static_cast<int>(this->At(names::LightType, i, 0, 0.0)));
  }
  vtkIdType Cell(vtkIdType i) const { return this->CellOfPoint[i]; }
  bool OfCamera(vtkIdType i) const { return this->At(names::AttachedTo, i, 0, 0.0) == 2.0; }
  std::array<unsigned char, 3> Color(vtkIdType i) const
  {
    if (this->At(names::LightEnabled, i, 0, 1.0) == 0.0)
    {
      return { { 96, 96, 96 } };
    }
    vtkDataArray* intensity = this->Data->GetArray(names::Intensity);
    std::array<unsigned char, 3> color{ { 255, 255, 255 } };
    if (intensity && intensity->GetNumberOfComponents() == 3)
    {
      double rgb[3];
      intensity->GetTuple(i, rgb);
      const double most = *std::max_element(rgb, rgb + 3);
      for (int c = 0; most > 0.0 && std::isfinite(most) && c < 3; ++c)
      {
        color[c] = static_cast<unsigned char>(255.0 * std::clamp(rgb[c] / most, 0.0, 1.0) + 0.5);
      }
    }
    return color;
  }

private:
  vtkPointData* Data;
  std::vector<vtkIdType> CellOfPoint;
};

/// The polygons of a data set whose points are corners of area lights.
void DrawAreas(vtkPolyData* data, const LightValues& values, double size, Lines& lines)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfPolys(); ++c)
  {
    data->GetPolys()->GetCellAtId(c, ids);
    std::vector<Vec3> corners;
    bool drawn = ids->GetNumberOfIds() > 2 && !values.OfCamera(ids->GetId(0));
    for (const vtkIdType p : *ids)
    {
      double x[3];
      data->GetPoint(p, x);
      corners.push_back({ x[0], x[1], x[2] });
      drawn = drawn && values.Type(p) == LightType::Area && IsFinite(corners.back());
    }
    if (drawn)
    {
      const vtkIdType first = ids->GetId(0);
      lines.Begin(values.Cell(first), first, values.Color(first));
      DrawPolygon(lines, corners, values.At(names::LightTwoSided, first, 0, 0.0) != 0.0, size);
    }
  }
}

vtkSmartPointer<vtkPolyData> DrawAll(vtkPolyData* data, double size)
{
  Lines lines;
  if (size > 0.0)
  {
    const LightValues values(data);
    DrawAreas(data, values, size, lines);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      double x[3];
      data->GetPoint(i, x);
      const Vec3 p{ x[0], x[1], x[2] };
      const Vec3 axis = radiometry::Normalized({ values.At(names::Direction, i, 0, 0.0),
        values.At(names::Direction, i, 1, 0.0), values.At(names::Direction, i, 2, -1.0) });
      if (!IsFinite(p) || !IsFinite(axis) || values.OfCamera(i))
      {
        continue;
      }
      lines.Begin(values.Cell(i), i, values.Color(i));
      const LightType type = values.Type(i);
      const double cutoff = values.At(names::SpotCutoff, i, 0, 180.0);
      if (type == LightType::Directional)
      {
        DrawDirectional(lines, p, axis, size);
      }
      else if (type == LightType::Environment)
      {
        DrawEnvironment(lines, p, axis, size);
      }
      else if (type == LightType::Spot && cutoff > 0.0 && cutoff <= 90.0)
      {
        DrawSpot(lines, p, axis, cutoff, values.At(names::SpotInnerCutoff, i, 0, -1.0), size);
      }
      else if (type == LightType::Point || type == LightType::Spot)
      {
        DrawPoint(lines, p, size);
      }
    }
  }
  return lines.Finish(data);
}

} // namespace

const char* const LightGlyphColors = "LightGlyphColors";

vtkSmartPointer<vtkDataObject> MakeLightGlyphs(vtkDataObject* lights, double size)
{
  if (auto* data = vtkPolyData::SafeDownCast(lights))
  {
    return DrawAll(data, size);
  }
  vtkSmartPointer<vtkDataObject> glyphs;
  if (auto* tree = vtkCompositeDataSet::SafeDownCast(lights))
  {
    auto made = vtk::TakeSmartPointer(tree->NewInstance());
    made->CopyStructure(tree);
    made->GetFieldData()->ShallowCopy(tree->GetFieldData());
    auto it = vtk::TakeSmartPointer(tree->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      if (auto* block = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
      {
        made->SetDataSet(it, DrawAll(block, size));
      }
    }
    glyphs = made;
  }
  return glyphs;
}

} // namespace vtkradiometry
