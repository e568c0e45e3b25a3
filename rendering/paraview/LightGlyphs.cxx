// SPDX-License-Identifier: BSD-3-Clause
#include "LightGlyphs.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Light.h"
#include "radiometry/scene/Vec3.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkradiometry
{
namespace
{

using radiometry::LightType;
using radiometry::Vec3;

constexpr int CircleSegments = 24;

class Lines
{
public:
  vtkIdType Point(const Vec3& p) { return this->Points->InsertNextPoint(p.x, p.y, p.z); }
  void Segment(const Vec3& a, const Vec3& b)
  {
    const vtkIdType ids[2] = { this->Point(a), this->Point(b) };
    this->Cells->InsertNextCell(2, ids);
  }
  void Circle(const Vec3& center, const Vec3& u, const Vec3& v)
  {
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
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
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

void DrawSpot(Lines& lines, const Vec3& p, const Vec3& axis, double cutoff, double size)
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
}

void DrawDirectional(Lines& lines, const Vec3& p, const Vec3& axis, double size)
{
  Vec3 u;
  Vec3 v;
  Frame(axis, u, v);
  const double radius = 0.35 * size;
  lines.Circle(p, radius * u, radius * v);
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

/// The polygons of a data set whose points are corners of area lights.
void DrawAreas(vtkPolyData* data, double size, Lines& lines)
{
  namespace names = radiometry::names;
  vtkDataArray* type = data->GetPointData()->GetArray(names::LightType);
  vtkDataArray* enabled = data->GetPointData()->GetArray(names::LightEnabled);
  vtkDataArray* twoSided = data->GetPointData()->GetArray(names::LightTwoSided);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; type && c < data->GetNumberOfPolys(); ++c)
  {
    data->GetPolys()->GetCellAtId(c, ids);
    std::vector<Vec3> corners;
    bool drawn = ids->GetNumberOfIds() > 2;
    for (const vtkIdType p : *ids)
    {
      double x[3];
      data->GetPoint(p, x);
      corners.push_back({ x[0], x[1], x[2] });
      drawn = drawn && type->GetComponent(p, 0) == static_cast<double>(LightType::Area) &&
        IsFinite(corners.back());
    }
    if (drawn && (!enabled || enabled->GetComponent(ids->GetId(0), 0) != 0.0))
    {
      DrawPolygon(lines, corners, twoSided && twoSided->GetComponent(ids->GetId(0), 0) != 0.0, size);
    }
  }
}

void DrawAll(vtkPolyData* data, double size, Lines& lines)
{
  namespace names = radiometry::names;
  DrawAreas(data, size, lines);
  const auto value = [data](const char* name, vtkIdType i, int component, double absent) {
    vtkDataArray* array = data->GetPointData()->GetArray(name);
    return array && component < array->GetNumberOfComponents() ? array->GetComponent(i, component)
                                                               : absent;
  };
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    const Vec3 p{ x[0], x[1], x[2] };
    const Vec3 axis = radiometry::Normalized({ value(names::Direction, i, 0, 0.0),
      value(names::Direction, i, 1, 0.0), value(names::Direction, i, 2, -1.0) });
    if (value(names::LightEnabled, i, 0, 1.0) == 0.0 || !IsFinite(p) || !IsFinite(axis))
    {
      continue;
    }
    const auto type = static_cast<LightType>(static_cast<int>(value(names::LightType, i, 0, 0.0)));
    const double cutoff = value(names::SpotCutoff, i, 0, 180.0);
    if (type == LightType::Directional)
    {
      DrawDirectional(lines, p, axis, size);
    }
    else if (type == LightType::Spot && cutoff > 0.0 && cutoff <= 90.0)
    {
      DrawSpot(lines, p, axis, cutoff, size);
    }
    else if (type == LightType::Point || type == LightType::Spot)
    {
      DrawPoint(lines, p, size);
    }
  }
}

} // namespace

void MakeLightGlyphs(vtkDataObject* lights, double size, vtkPolyData* glyphs)
{
  Lines lines;
  if (size > 0.0)
  {
    if (auto* data = vtkPolyData::SafeDownCast(lights))
    {
      DrawAll(data, size, lines);
    }
    else if (auto* tree = vtkCompositeDataSet::SafeDownCast(lights))
    {
      auto it = vtk::TakeSmartPointer(tree->NewIterator());
      for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
      {
        if (auto* block = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
        {
          DrawAll(block, size, lines);
        }
      }
    }
  }
  glyphs->Initialize();
  glyphs->SetPoints(lines.Points);
  glyphs->SetLines(lines.Cells);
}

} // namespace vtkradiometry
