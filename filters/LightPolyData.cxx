// SPDX-License-Identifier: BSD-3-Clause
#include "LightPolyData.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

namespace names = radiometry::names;

namespace
{

template <class Array>
vtkNew<Array> Add(vtkFieldData* data, const char* name, int components, vtkIdType tuples)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  data->AddArray(array);
  return array;
}

void Set(vtkDoubleArray* array, vtkIdType i, const radiometry::Vec3& v)
{
  array->SetTuple3(i, v.x, v.y, v.z);
}

} // namespace

void WriteLights(const std::vector<radiometry::LightRecord>& lights, int bands, bool photometric,
  double luminousEfficacy, vtkPolyData* output)
{
  const auto n = static_cast<vtkIdType>(lights.size());
  output->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  vtkNew<vtkCellArray> verts;
  vtkPointData* data = output->GetPointData();
  const auto type = Add<vtkIntArray>(data, names::LightType, 1, n);
  const auto intensity = Add<vtkDoubleArray>(data, names::Intensity, bands, n);
  const auto direction = Add<vtkDoubleArray>(data, names::Direction, 3, n);
  const auto cutoff = Add<vtkDoubleArray>(data, names::SpotCutoff, 1, n);
  const auto inner = Add<vtkDoubleArray>(data, names::SpotInnerCutoff, 1, n);
  const auto exponent = Add<vtkDoubleArray>(data, names::SpotExponent, 1, n);
  const auto attenuation = Add<vtkDoubleArray>(data, names::Attenuation, 3, n);
  const auto enabled = Add<vtkIntArray>(data, names::LightEnabled, 1, n);
  const auto ambient = Add<vtkDoubleArray>(data, names::AmbientColor, bands, n);
  const auto specular = Add<vtkDoubleArray>(data, names::SpecularColor, bands, n);
  const auto web = Add<vtkIntArray>(data, names::PhotometricWeb, 1, n);
  const auto attached = Add<vtkIntArray>(data, names::AttachedTo, 1, n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    const radiometry::LightRecord& light = lights[i];
    points->SetPoint(i, light.Position.x, light.Position.y, light.Position.z);
    verts->InsertNextCell(1, &i);
    type->SetValue(i, static_cast<int>(light.Type));
    for (int b = 0; b < bands; ++b)
    {
      intensity->SetComponent(i, b, light.Intensity[b]);
      ambient->SetComponent(i, b, 0.0);
      specular->SetComponent(i, b, light.Intensity[b]);
    }
    Set(direction, i, light.Direction);
    cutoff->SetValue(i, light.SpotCutoff);
    inner->SetValue(i, light.SpotInnerCutoff);
    exponent->SetValue(i, light.SpotExponent);
    Set(attenuation, i, light.Attenuation);
    enabled->SetValue(i, light.Enabled ? 1 : 0);
    web->SetValue(i, -1);
    attached->SetValue(i, light.AttachedTo);
  }
  output->SetPoints(points);
  output->SetVerts(verts);

  vtkFieldData* field = output->GetFieldData();
  Add<vtkStringArray>(field, "IntensityUnit", 1, 1)
    ->SetValue(0, "point, spot: W/sr; directional: W/m^2");
  Add<vtkIntArray>(field, "Photometric", 1, 1)->SetValue(0, photometric ? 1 : 0);
  Add<vtkDoubleArray>(field, "LuminousEfficacy", 1, 1)->SetValue(0, luminousEfficacy);
  const auto lightNames = Add<vtkStringArray>(field, "LightNames", 1, n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    lightNames->SetValue(i, lights[i].Name);
  }
}
