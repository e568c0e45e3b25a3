// SPDX-License-Identifier: BSD-3-Clause
#include "LightPolyData.h"

#include "WebFieldData.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <map>

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

/// The place of a web in the list, appended where it is new.
int IndexOf(const radiometry::CandelaWeb* web, std::vector<const radiometry::CandelaWeb*>& webs)
{
  const auto found = std::find(webs.begin(), webs.end(), web);
  const auto index = found - webs.begin();
  if (found == webs.end())
  {
    webs.push_back(web);
  }
  return static_cast<int>(index);
}

/// The webs that lights refer to, each read once.
class WebReader
{
public:
  WebReader(vtkPolyData* input, const std::string& prefix)
    : Field(input->GetFieldData())
    , Prefix(prefix)
  {
  }
  /// The web of light i; null for an index below 0.
  std::shared_ptr<const radiometry::CandelaWeb> At(double index, vtkIdType i)
  {
    if (index < 0.0)
    {
      return nullptr;
    }
    const int k = index < 1e9 ? static_cast<int>(index) : -1;
    auto& web = this->Webs[k];
    if (!web && k == index)
    {
      web = ReadWeb(this->Field, k, this->Prefix);
    }
    if (!web)
    {
      throw radiometry::InputError(this->Prefix + names::PhotometricWeb, i, index,
        "the number of a web in the field data, or -1 for none");
    }
    return web;
  }

private:
  vtkFieldData* Field;
  std::string Prefix;
  std::map<int, std::shared_ptr<const radiometry::CandelaWeb>> Webs;
};

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
  const auto reference = Add<vtkDoubleArray>(data, names::ReferenceDirection, 3, n);
  const auto cutoff = Add<vtkDoubleArray>(data, names::SpotCutoff, 1, n);
  const auto inner = Add<vtkDoubleArray>(data, names::SpotInnerCutoff, 1, n);
  const auto exponent = Add<vtkDoubleArray>(data, names::SpotExponent, 1, n);
  const auto attenuation = Add<vtkDoubleArray>(data, names::Attenuation, 3, n);
  const auto enabled = Add<vtkIntArray>(data, names::LightEnabled, 1, n);
  const auto ambient = Add<vtkDoubleArray>(data, names::AmbientColor, bands, n);
  const auto specular = Add<vtkDoubleArray>(data, names::SpecularColor, bands, n);
  const auto web = Add<vtkIntArray>(data, names::PhotometricWeb, 1, n);
  const auto attached = Add<vtkIntArray>(data, names::AttachedTo, 1, n);
  std::vector<const radiometry::CandelaWeb*> webs; // each once, however many lights have it
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
    Set(reference, i, light.Reference);
    cutoff->SetValue(i, light.SpotCutoff);
    inner->SetValue(i, light.SpotInnerCutoff);
    exponent->SetValue(i, light.SpotExponent);
    Set(attenuation, i, light.Attenuation);
    enabled->SetValue(i, light.Enabled ? 1 : 0);
    web->SetValue(i, light.Web ? IndexOf(light.Web.get(), webs) : -1);
    attached->SetValue(i, light.AttachedTo);
  }
  output->SetPoints(points);
  output->SetVerts(verts);

  vtkFieldData* field = output->GetFieldData();
  for (std::size_t k = 0; k < webs.size(); ++k)
  {
    WriteWeb(*webs[k], static_cast<int>(k), field);
  }
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

std::vector<radiometry::LightRecord> ReadLights(
  vtkPolyData* input, int bands, const std::string& prefix)
{
  using radiometry::InputError;
  const vtkIdType n = input->GetNumberOfPoints();
  const auto sized = [&](const char* name) {
    vtkDataArray* array = input->GetPointData()->GetArray(name);
    if (array && array->GetNumberOfTuples() != n)
    {
      throw InputError(prefix + name, -1, std::to_string(array->GetNumberOfTuples()) + " tuples",
        std::to_string(n) + ", one a light");
    }
    return array;
  };
  const auto find = [&](const char* name, int components) {
    vtkDataArray* array = sized(name);
    if (array && array->GetNumberOfComponents() != components)
    {
      throw InputError(prefix + name, -1,
        std::to_string(array->GetNumberOfComponents()) + " components",
        std::to_string(components) + (components == 1 ? " component" : " components"));
    }
    return array;
  };
  vtkDataArray* type = find(names::LightType, 1);
  vtkDataArray* direction = find(names::Direction, 3);
  vtkDataArray* reference = find(names::ReferenceDirection, 3);
  vtkDataArray* web = find(names::PhotometricWeb, 1);
  vtkDataArray* cutoff = find(names::SpotCutoff, 1);
  vtkDataArray* inner = find(names::SpotInnerCutoff, 1);
  vtkDataArray* exponent = find(names::SpotExponent, 1);
  vtkDataArray* attenuation = find(names::Attenuation, 3);
  vtkDataArray* enabled = find(names::LightEnabled, 1);
  vtkDataArray* attached = find(names::AttachedTo, 1);
  vtkDataArray* intensity = sized(names::Intensity);
  if (n > 0 && !intensity)
  {
    throw InputError(prefix + names::Intensity, -1, "missing",
      "a point array of lights (W/sr; directional: W/m^2)");
  }
  if (intensity && intensity->GetNumberOfComponents() != 1 &&
    intensity->GetNumberOfComponents() != bands)
  {
    throw InputError(prefix + names::Intensity, -1,
      std::to_string(intensity->GetNumberOfComponents()) + " components",
      "1 or " + std::to_string(bands) + " components");
  }

  const auto vector = [](vtkDataArray* array, vtkIdType i) {
    return radiometry::Vec3{ array->GetComponent(i, 0), array->GetComponent(i, 1),
      array->GetComponent(i, 2) };
  };
  WebReader webs(input, prefix);
  std::vector<radiometry::LightRecord> lights(static_cast<std::size_t>(n));
  for (vtkIdType i = 0; i < n; ++i)
  {
    radiometry::LightRecord& light = lights[i];
    const double kind = type ? type->GetComponent(i, 0) : 0.0;
    if (kind == 3.0 || kind == 4.0)
    {
      throw InputError(prefix + names::LightType, i, kind,
        "0 point, 1 spot or 2 directional (area and environment lights are not available in this "
        "version; an emitting surface is, by EmittedExitance)");
    }
    if (kind != 0.0 && kind != 1.0 && kind != 2.0)
    {
      throw InputError(prefix + names::LightType, i, kind,
        "0 point, 1 spot, 2 directional, 3 area or 4 environment");
    }
    light.Type = static_cast<radiometry::LightType>(static_cast<int>(kind));
    double p[3];
    input->GetPoint(i, p);
    light.Position = { p[0], p[1], p[2] };
    light.Direction = direction ? vector(direction, i) : light.Direction;
    light.Reference = reference ? vector(reference, i) : light.Reference;
    light.Web = web ? webs.At(web->GetComponent(i, 0), i) : nullptr;
    light.Intensity.resize(static_cast<std::size_t>(bands));
    for (int b = 0; b < bands; ++b)
    {
      light.Intensity[b] =
        intensity->GetComponent(i, intensity->GetNumberOfComponents() == 1 ? 0 : b);
    }
    light.SpotCutoff = cutoff ? cutoff->GetComponent(i, 0) : light.SpotCutoff;
    light.SpotInnerCutoff = inner ? inner->GetComponent(i, 0) : light.SpotInnerCutoff;
    light.SpotExponent = exponent ? exponent->GetComponent(i, 0) : light.SpotExponent;
    light.Attenuation = attenuation ? vector(attenuation, i) : light.Attenuation;
    light.Enabled = !enabled || enabled->GetComponent(i, 0) != 0.0;
    light.AttachedTo = attached ? static_cast<int>(attached->GetComponent(i, 0)) : 0;
    try
    {
      radiometry::Validate(light, i);
    }
    catch (const InputError& error)
    {
      throw InputError(prefix + error.Array, error.Index, error.Value, error.Expected);
    }
  }
  return lights;
}
