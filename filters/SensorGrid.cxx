// SPDX-License-Identifier: BSD-3-Clause
#include "SensorGrid.h"

#include "PointMerger.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::Vec3;

void WriteSensors(const std::vector<radiometry::Sensor>& sensors,
  const std::array<std::int64_t, 2>& counts, const std::string& rule, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(sensors.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName(names::Normals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  vtkNew<vtkDoubleArray> corners;
  corners->SetName(names::SensorCell);
  corners->SetNumberOfComponents(12);
  corners->SetNumberOfTuples(count);
  vtkNew<vtkCellArray> verts;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const radiometry::Sensor& sensor = sensors[static_cast<std::size_t>(i)];
    points->SetPoint(i, sensor.Point.x, sensor.Point.y, sensor.Point.z);
    for (int k = 0; k < 3; ++k)
    {
      normals->SetTypedComponent(i, k, sensor.Normal[k]);
      for (int c = 0; c < 4; ++c)
      {
        corners->SetTypedComponent(i, 3 * c + k, sensor.Corners[c][k]);
      }
    }
    verts->InsertNextCell(1, &i);
  }
  output->SetPoints(points);
  output->SetVerts(verts);
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(corners);
  if (counts[0] > 0 && counts[1] > 0)
  {
    vtkNew<vtkIntArray> dimensions;
    dimensions->SetName(names::SensorGridDimensions);
    dimensions->InsertNextValue(static_cast<int>(counts[0]));
    dimensions->InsertNextValue(static_cast<int>(counts[1]));
    output->GetFieldData()->AddArray(dimensions);
  }
  vtkNew<vtkStringArray> words;
  words->SetName(names::SensorGridRule);
  words->InsertNextValue(rule);
  output->GetFieldData()->AddArray(words);
}

bool IsSensorGrid(vtkPolyData* data)
{
  return data->GetNumberOfPoints() > 0 && data->GetNumberOfPolys() == 0 &&
    data->GetNumberOfStrips() == 0 && data->GetPointData()->GetArray(names::Normals) != nullptr;
}

vtkSmartPointer<vtkPolyData> SensorCells(vtkPolyData* sensors)
{
  const vtkIdType count = sensors->GetNumberOfPoints();
  auto output = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> cells;
  vtkDataArray* corners = sensors->GetPointData()->GetArray(names::SensorCell);
  if (!corners)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      cells->InsertNextCell(1, &i);
    }
    output->SetPoints(sensors->GetPoints());
    output->SetVerts(cells);
  }
  else
  {
    if (corners->GetNumberOfComponents() != 12 || corners->GetNumberOfTuples() != count)
    {
      throw InputError(names::SensorCell, -1,
        std::to_string(corners->GetNumberOfTuples()) + " tuples of " +
          std::to_string(corners->GetNumberOfComponents()) + " components",
        std::to_string(count) + " tuples of 12, one a sensor");
    }
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    PointMerger merger(points);
    for (vtkIdType i = 0; i < count; ++i)
    {
      double c[12];
      corners->GetTuple(i, c);
      vtkIdType ids[4];
      for (int k = 0; k < 4; ++k)
      {
        const Vec3 corner{ c[3 * k], c[3 * k + 1], c[3 * k + 2] };
        if (!IsFinite(corner))
        {
          throw InputError(
            names::SensorCell, i, corner.x + corner.y + corner.z, "finite coordinates");
        }
        ids[k] = merger.Add(corner);
      }
      if (ids[2] == ids[3] || ids[0] == ids[1])
      {
        ids[1] = ids[0] == ids[1] ? ids[2] : ids[1]; // turned over: the first one twice
        ids[2] = ids[3];
        cells->InsertNextCell(3, ids);
      }
      else
      {
        cells->InsertNextCell(4, ids);
      }
    }
    output->SetPoints(points);
    output->SetPolys(cells);
  }
  output->GetCellData()->ShallowCopy(sensors->GetPointData());
  output->GetCellData()->RemoveArray(names::SensorCell);
  output->GetFieldData()->ShallowCopy(sensors->GetFieldData());
  return output;
}

vtkSmartPointer<vtkPolyData> SensorLattice(vtkPolyData* sensors)
{
  auto* dimensions = vtkDataArray::SafeDownCast(
    sensors->GetFieldData()->GetAbstractArray(names::SensorGridDimensions));
  if (!dimensions || dimensions->GetNumberOfValues() != 2)
  {
    return nullptr;
  }
  const double n1 = dimensions->GetTuple1(0);
  const double n2 =
    dimensions->GetNumberOfComponents() == 2 ? dimensions->GetComponent(0, 1) : dimensions->GetTuple1(1);
  if (!(n1 >= 2.0 && n2 >= 2.0) ||
    n1 * n2 != static_cast<double>(sensors->GetNumberOfPoints()))
  {
    return nullptr;
  }
  const auto columns = static_cast<vtkIdType>(n1);
  const auto rows = static_cast<vtkIdType>(n2);
  vtkNew<vtkCellArray> quads;
  for (vtkIdType j = 0; j + 1 < rows; ++j)
  {
    for (vtkIdType i = 0; i + 1 < columns; ++i)
    {
      const vtkIdType k = j * columns + i;
      const vtkIdType ids[4] = { k, k + 1, k + columns + 1, k + columns };
      quads->InsertNextCell(4, ids);
    }
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->SetPoints(sensors->GetPoints());
  output->SetPolys(quads);
  output->GetPointData()->ShallowCopy(sensors->GetPointData());
  output->GetPointData()->RemoveArray(names::SensorCell);
  output->GetFieldData()->ShallowCopy(sensors->GetFieldData());
  return output;
}
