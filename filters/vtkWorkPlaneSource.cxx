// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWorkPlaneSource.h"

#include "SceneAdapter.h"
#include "SensorGrid.h"
#include "radiometry/geometry/MeasuringGrid.h"
#include "radiometry/scene/InputError.h"

#include "vtkBoundingBox.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <sstream>

vtkStandardNewMacro(vtkWorkPlaneSource);

using radiometry::InputError;
using radiometry::Vec3;

struct vtkWorkPlaneSource::Grid
{
  std::vector<radiometry::Sensor> Sensors;
  std::array<std::int64_t, 2> Counts{}; // of a rectangle; 0: none
  std::string Rule;
};

namespace
{

Vec3 Vector(const double v[3])
{
  return { v[0], v[1], v[2] };
}

void CheckFinite(const char* name, const double v[3])
{
  for (int k = 0; k < 3; ++k)
  {
    if (!std::isfinite(v[k]))
    {
      throw InputError(name, k, v[k], "a finite number");
    }
  }
}

void CheckChoice(const char* name, int value, int most, const char* expected)
{
  if (value < 0 || value > most)
  {
    throw InputError(name, -1, value, expected);
  }
}

/// The polydata of the input, whatever it is.
std::vector<SceneAdapter::Block> Surfaces(vtkDataObject* input)
{
  SceneAdapter adapter(1.0, false, 0.5);
  adapter.AddSurface(input);
  return adapter.Blocks();
}

Vec3 PointOf(vtkPolyData* data, vtkIdType i)
{
  double p[3];
  data->GetPoint(i, p);
  if (!std::isfinite(p[0] + p[1] + p[2]))
  {
    throw InputError("Points", i, p[0] + p[1] + p[2], "finite coordinates");
  }
  return Vector(p);
}

/// The polygons all of whose corners are on the floor.
void AddFloor(vtkPolyData* data, radiometry::RoomExtent& extent)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    data->GetCellPoints(i, ids);
    bool floor = ids->GetNumberOfIds() > 2;
    for (vtkIdType k = 0; floor && k < ids->GetNumberOfIds(); ++k)
    {
      floor = extent.OnFloor(PointOf(data, ids->GetId(k)));
    }
    for (vtkIdType k = 0; floor && k < ids->GetNumberOfIds(); ++k)
    {
      extent.AddFloor(PointOf(data, ids->GetId(k)));
    }
  }
}

radiometry::GridParallelogram RoomPlane(
  vtkDataObject* input, const Vec3& up, double height, double margin)
{
  radiometry::RoomExtent extent(up);
  const auto blocks = Surfaces(input);
  for (const SceneAdapter::Block& block : blocks)
  {
    for (vtkIdType i = 0; i < block.Data->GetNumberOfPoints(); ++i)
    {
      extent.Add(PointOf(block.Data, i));
    }
  }
  if (extent.Empty())
  {
    throw InputError("Input", -1, "empty", "a room with points");
  }
  for (const SceneAdapter::Block& block : blocks)
  {
    AddFloor(block.Data, extent);
  }
  return extent.Plane(height, margin);
}

/// Sensors on one cell: whole quadrilaterals where they are flat, else triangles.
void AddCell(
  vtkPolyData* data, vtkGenericCell* cell, double spacing, std::vector<radiometry::Sensor>& sensors)
{
  if (cell->GetNumberOfPoints() == 4 &&
    (cell->GetCellType() == VTK_QUAD || cell->GetCellType() == VTK_POLYGON))
  {
    std::array<Vec3, 4> quad;
    for (int k = 0; k < 4; ++k)
    {
      quad[k] = PointOf(data, cell->GetPointId(k));
    }
    if (radiometry::AddSensors(quad, spacing, sensors))
    {
      return;
    }
  }
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
  {
    PointOf(data, cell->GetPointId(k)); // finite
  }
  cell->Triangulate(0, ids, points);
  for (vtkIdType t = 0; t + 2 < ids->GetNumberOfIds(); t += 3)
  {
    radiometry::AddSensors(radiometry::Triangle3{ PointOf(data, ids->GetId(t)),
                             PointOf(data, ids->GetId(t + 1)), PointOf(data, ids->GetId(t + 2)) },
      spacing, sensors);
  }
}

} // namespace

vtkWorkPlaneSource::vtkWorkPlaneSource()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

int vtkWorkPlaneSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkWorkPlaneSource::CheckProperties(bool hasInput) const
{
  CheckChoice("Mode", this->Mode, ON_SURFACE, "0 Auto, 1 Rectangle, 2 Room or 3 OnSurface");
  CheckChoice("SpacingRule", this->SpacingRule, FIXED_RESOLUTION,
    "0 EN 12464-1, 1 Spacing or 2 Resolution");
  CheckChoice("Rounding", this->Rounding, ODD, "0 Up, 1 Nearest or 2 Odd");
  CheckFinite("Origin", this->Origin);
  CheckFinite("Point1", this->Point1);
  CheckFinite("Point2", this->Point2);
  if (!std::isfinite(this->Height))
  {
    throw InputError("Height", -1, this->Height, "a finite number");
  }
  if (!(this->WallZone >= 0.0) || !std::isfinite(this->WallZone))
  {
    throw InputError("WallZone", -1, this->WallZone, "a finite number, at least 0");
  }
  if (!(this->MetersPerUnit > 0.0) || !std::isfinite(this->MetersPerUnit))
  {
    throw InputError("MetersPerUnit", -1, this->MetersPerUnit, "a finite number above 0");
  }
  if (!(this->Spacing > 0.0) || !std::isfinite(this->Spacing))
  {
    throw InputError("Spacing", -1, this->Spacing, "a finite number above 0");
  }
  for (int k = 0; k < 2; ++k)
  {
    if (this->Resolution[k] < 1)
    {
      throw InputError("Resolution", k, this->Resolution[k], "at least 1");
    }
  }
  if (this->Mode >= ROOM && !hasInput)
  {
    throw InputError("Input", -1, "missing", "the room or the surface that this Mode is about");
  }
  if (this->Mode == ON_SURFACE && this->SpacingRule == FIXED_RESOLUTION)
  {
    throw InputError("SpacingRule", -1, this->SpacingRule, "0 EN 12464-1 or 1 Spacing on a surface");
  }
}

void vtkWorkPlaneSource::MakePlane(vtkDataObject* input, Grid& grid) const
{
  const double unit = this->MetersPerUnit;
  const bool room = this->Mode == ROOM || (this->Mode == AUTO && input);
  const Vec3 origin = Vector(this->Origin);
  const radiometry::GridParallelogram plane = room
    ? RoomPlane(input, Vector(this->UpDirection), this->Height / unit, this->WallZone / unit)
    : radiometry::GridParallelogram{ origin, Vector(this->Point1) - origin,
        Vector(this->Point2) - origin };
  const double side1 = unit * Length(plane.Side1);
  const double side2 = unit * Length(plane.Side2);
  const double sine = Length(Cross(Normalized(plane.Side1), Normalized(plane.Side2)));
  if (!(sine > 1e-9) || !std::isfinite(side1 * side2))
  {
    throw InputError("Point1, Point2", -1,
      std::to_string(side1) + " m and " + std::to_string(side2) + " m",
      "sides of a plane with area, not parallel to each other");
  }
  std::ostringstream rule;
  if (this->SpacingRule == FIXED_RESOLUTION)
  {
    grid.Counts = { this->Resolution[0], this->Resolution[1] };
    rule << "Resolution";
  }
  else
  {
    const bool standard = this->SpacingRule == EN_12464;
    const double spacing =
      standard ? radiometry::MeasuringGridSpacing(side1, side2) : this->Spacing;
    grid.Counts = radiometry::MeasuringGridCounts(
      side1, side2, spacing, static_cast<radiometry::GridRounding>(this->Rounding));
    rule << (standard ? "EN 12464-1, p = " : "Spacing, p = ") << spacing << " m";
  }
  rule << "; " << grid.Counts[0] << " x " << grid.Counts[1] << " points on " << side1 << " m x "
       << side2 << " m";
  if (room)
  {
    rule << ", " << this->Height << " m above the floor, wall zone " << this->WallZone << " m";
  }
  grid.Rule = rule.str();
  radiometry::AddSensors(plane, grid.Counts, grid.Sensors);
}

void vtkWorkPlaneSource::MakeOnSurface(vtkDataObject* input, Grid& grid) const
{
  const auto blocks = Surfaces(input);
  double spacing = this->Spacing;
  std::ostringstream rule;
  if (this->SpacingRule == EN_12464)
  {
    vtkBoundingBox bounds;
    for (const SceneAdapter::Block& block : blocks)
    {
      if (block.Data->GetNumberOfPoints() > 0)
      {
        bounds.AddBounds(block.Data->GetBounds());
      }
    }
    double sides[3] = { 0.0, 0.0, 0.0 };
    if (bounds.IsValid())
    {
      bounds.GetLengths(sides);
    }
    std::sort(sides, sides + 3);
    spacing = radiometry::MeasuringGridSpacing(
      this->MetersPerUnit * sides[2], this->MetersPerUnit * sides[1]);
    rule << "EN 12464-1, p = ";
  }
  else
  {
    rule << "Spacing, p = ";
  }
  vtkNew<vtkGenericCell> cell;
  for (const SceneAdapter::Block& block : blocks)
  {
    for (vtkIdType i = 0; i < block.Data->GetNumberOfCells(); ++i)
    {
      block.Data->GetCell(i, cell);
      if (cell->GetCellDimension() == 2)
      {
        AddCell(block.Data, cell, spacing / this->MetersPerUnit, grid.Sensors);
      }
    }
  }
  if (grid.Sensors.empty())
  {
    throw InputError("Input", -1, "no polygon with area", "a surface to put sensors on");
  }
  rule << spacing << " m at most; " << grid.Sensors.size() << " points on the surface";
  grid.Rule = rule.str();
}

int vtkWorkPlaneSource::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  vtkDataObject* input =
    in[0]->GetNumberOfInformationObjects() > 0 ? vtkDataObject::GetData(in[0]) : nullptr;
  vtkPolyData* sensors = vtkPolyData::GetData(out, 0);
  vtkPolyData* mesh = vtkPolyData::GetData(out, 1);
  sensors->Initialize();
  mesh->Initialize();
  try
  {
    this->CheckProperties(input != nullptr);
    Grid grid;
    if (this->Mode == ON_SURFACE)
    {
      this->MakeOnSurface(input, grid);
    }
    else
    {
      this->MakePlane(input, grid);
    }
    if (this->FlipNormals)
    {
      for (radiometry::Sensor& sensor : grid.Sensors)
      {
        sensor.Normal = -sensor.Normal;
        std::reverse(sensor.Corners.begin(), sensor.Corners.end());
      }
    }
    WriteSensors(grid.Sensors, grid.Counts, grid.Rule, sensors);
    mesh->ShallowCopy(SensorCells(sensors));
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    sensors->Initialize();
    mesh->Initialize();
    return 0;
  }
  return 1;
}

void vtkWorkPlaneSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double v[3]) {
    os << indent << name << ": " << v[0] << " " << v[1] << " " << v[2] << "\n";
  };
  os << indent << "Mode: " << this->Mode << "\n";
  vector("Origin", this->Origin);
  vector("Point1", this->Point1);
  vector("Point2", this->Point2);
  vector("UpDirection", this->UpDirection);
  os << indent << "Height: " << this->Height << " m\n"
     << indent << "WallZone: " << this->WallZone << " m\n"
     << indent << "FlipNormals: " << this->FlipNormals << "\n"
     << indent << "SpacingRule: " << this->SpacingRule << "\n"
     << indent << "Spacing: " << this->Spacing << " m\n"
     << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << "\n"
     << indent << "Rounding: " << this->Rounding << "\n"
     << indent << "MetersPerUnit: " << this->MetersPerUnit << "\n";
}
