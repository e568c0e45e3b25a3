// SPDX-License-Identifier: BSD-3-Clause
#include "LightPolyData.h"

#include "SkyFieldData.h"
#include "WebFieldData.h"

#include "radiometry/geometry/ConvexPolygon.h"
#include "radiometry/geometry/PolygonTriangulation.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <map>
#include <utility>

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

bool IsArea(const radiometry::LightRecord& light)
{
  return light.Type == radiometry::LightType::Area;
}

radiometry::Vec3 PointOf(vtkPolyData* data, vtkIdType i)
{
  double p[3];
  data->GetPoint(i, p);
  return { p[0], p[1], p[2] };
}

/// A polygon whose points are corners of an area light.
struct AreaCell
{
  vtkIdType Index = 0; // among the polygons
  std::vector<vtkIdType> Points;
};

/// The polygons of points of LightType 3. Every such point must be a corner of one of them, and of
/// polygons with such points alone.
std::vector<AreaCell> FindAreaCells(
  vtkPolyData* input, vtkDataArray* type, const std::string& prefix)
{
  std::vector<AreaCell> cells;
  if (!type)
  {
    return cells;
  }
  const vtkIdType n = input->GetNumberOfPoints();
  const auto isCorner = [&](vtkIdType p) { return type->GetComponent(p, 0) == 3.0; };
  std::vector<char> used(static_cast<std::size_t>(n), 0);
  vtkCellArray* polygons = input->GetPolys();
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; polygons && c < polygons->GetNumberOfCells(); ++c)
  {
    polygons->GetCellAtId(c, ids);
    AreaCell cell;
    cell.Index = c;
    cell.Points.assign(ids->begin(), ids->end());
    const auto corners = std::count_if(cell.Points.begin(), cell.Points.end(), isCorner);
    if (corners == 0)
    {
      continue;
    }
    const auto other = std::find_if_not(cell.Points.begin(), cell.Points.end(), isCorner);
    if (other != cell.Points.end())
    {
      throw radiometry::InputError(prefix + names::LightType, *other, type->GetComponent(*other, 0),
        "3 at every corner of polygon " + std::to_string(c) + ", as at others of its corners");
    }
    for (const vtkIdType p : cell.Points)
    {
      used[p] = 1;
    }
    cells.push_back(std::move(cell));
  }
  for (vtkIdType p = 0; p < n; ++p)
  {
    if (isCorner(p) && !used[p])
    {
      throw radiometry::InputError(prefix + names::LightType, p, 3.0,
        "a point of an area light (3) to be a corner of a polygon (vertices, lines and triangle "
        "strips make no area light)");
    }
  }
  return cells;
}

} // namespace

void WriteLights(const std::vector<radiometry::LightRecord>& lights, int bands, bool photometric,
  double luminousEfficacy, vtkPolyData* output)
{
  // An area light has a point a corner, each with all of its arrays; any other light has one.
  vtkIdType n = 0;
  for (const radiometry::LightRecord& light : lights)
  {
    n += IsArea(light) ? static_cast<vtkIdType>(light.Polygon.size()) : 1;
  }
  output->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  vtkNew<vtkCellArray> verts;
  vtkNew<vtkCellArray> polygons;
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
  const auto twoSided = Add<vtkIntArray>(data, names::LightTwoSided, 1, n);
  std::vector<const radiometry::CandelaWeb*> webs; // each once, however many lights have it
  const auto set = [&](vtkIdType i, const radiometry::LightRecord& light,
                     const radiometry::Vec3& position) {
    points->SetPoint(i, position.x, position.y, position.z);
    type->SetValue(i, static_cast<int>(light.Type));
    for (int b = 0; b < bands; ++b)
    {
      intensity->SetComponent(i, b, light.Intensity[b]);
      ambient->SetComponent(i, b, 0.0);
      specular->SetComponent(i, b, light.Intensity[b]);
    }
    Set(direction, i, IsArea(light) ? radiometry::Normalized(radiometry::AreaNormal2(
                                        light.Polygon.data(), light.Polygon.size()))
                                    : light.Direction);
    Set(reference, i, light.Reference);
    cutoff->SetValue(i, light.SpotCutoff);
    inner->SetValue(i, light.SpotInnerCutoff);
    exponent->SetValue(i, light.SpotExponent);
    Set(attenuation, i, light.Attenuation);
    enabled->SetValue(i, light.Enabled ? 1 : 0);
    web->SetValue(i, light.Web ? IndexOf(light.Web.get(), webs) : -1);
    attached->SetValue(i, light.AttachedTo);
    twoSided->SetValue(i, light.TwoSided ? 1 : 0);
  };
  vtkIdType at = 0;
  std::vector<vtkIdType> firstPoint; // of each light
  for (const radiometry::LightRecord& light : lights)
  {
    firstPoint.push_back(at);
    if (!IsArea(light))
    {
      verts->InsertNextCell(1, &at);
      set(at++, light, light.Position);
      continue;
    }
    polygons->InsertNextCell(static_cast<int>(light.Polygon.size()));
    for (const radiometry::Vec3& corner : light.Polygon)
    {
      polygons->InsertCellPoint(at);
      set(at++, light, corner);
    }
  }
  output->SetPoints(points);
  output->SetVerts(verts);
  output->SetPolys(polygons);
  WriteSkies(lights, firstPoint, output);

  vtkFieldData* field = output->GetFieldData();
  for (std::size_t k = 0; k < webs.size(); ++k)
  {
    WriteWeb(*webs[k], static_cast<int>(k), field);
  }
  Add<vtkStringArray>(field, "IntensityUnit", 1, 1)
    ->SetValue(0, "point, spot: W/sr; directional: W/m^2; area: W/m^2 of exitance; "
                "environment: W/(m^2 sr)");
  Add<vtkIntArray>(field, "Photometric", 1, 1)->SetValue(0, photometric ? 1 : 0);
  Add<vtkDoubleArray>(field, "LuminousEfficacy", 1, 1)->SetValue(0, luminousEfficacy);
  const auto lightNames = Add<vtkStringArray>(field, "LightNames", 1,
    static_cast<vtkIdType>(lights.size()));
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    lightNames->SetValue(static_cast<vtkIdType>(i), lights[i].Name);
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
  vtkDataArray* twoSided = find(names::LightTwoSided, 1);
  vtkDataArray* intensity = sized(names::Intensity);
  if (n > 0 && !intensity)
  {
    throw InputError(prefix + names::Intensity, -1, "missing",
      "a point array of lights (W/sr; directional, area: W/m^2)");
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
  SkyReader skies(input, bands, prefix);
  const auto validate = [&](const radiometry::LightRecord& light, vtkIdType i) {
    try
    {
      radiometry::Validate(light, i);
    }
    catch (const InputError& error)
    {
      throw InputError(prefix + error.Array, error.Index, error.Value, error.Expected);
    }
  };
  // What every kind of light has.
  const auto begin = [&](vtkIdType i, radiometry::LightType kind) {
    radiometry::LightRecord light;
    light.Type = kind;
    light.Position = PointOf(input, i);
    light.Attenuation = attenuation ? vector(attenuation, i) : light.Attenuation;
    light.Intensity.resize(static_cast<std::size_t>(bands));
    for (int b = 0; b < bands; ++b)
    {
      light.Intensity[b] =
        intensity->GetComponent(i, intensity->GetNumberOfComponents() == 1 ? 0 : b);
    }
    light.Enabled = !enabled || enabled->GetComponent(i, 0) != 0.0;
    light.AttachedTo = attached ? static_cast<int>(attached->GetComponent(i, 0)) : 0;
    return light;
  };
  std::vector<radiometry::LightRecord> lights;
  for (vtkIdType i = 0; i < n; ++i)
  {
    const double kind = type ? type->GetComponent(i, 0) : 0.0;
    if (kind == 3.0)
    {
      continue;
    }
    if (kind != 0.0 && kind != 1.0 && kind != 2.0 && kind != 4.0)
    {
      throw InputError(prefix + names::LightType, i, kind,
        "0 point, 1 spot, 2 directional, 3 area or 4 environment");
    }
    radiometry::LightRecord light =
      begin(i, static_cast<radiometry::LightType>(static_cast<int>(kind)));
    light.Direction = direction ? vector(direction, i) : light.Direction;
    light.Reference = reference ? vector(reference, i) : light.Reference;
    light.Web = web ? webs.At(web->GetComponent(i, 0), i) : nullptr;
    light.SpotCutoff = cutoff ? cutoff->GetComponent(i, 0) : light.SpotCutoff;
    light.SpotInnerCutoff = inner ? inner->GetComponent(i, 0) : light.SpotInnerCutoff;
    light.SpotExponent = exponent ? exponent->GetComponent(i, 0) : light.SpotExponent;
    validate(light, i);
    if (light.Type == radiometry::LightType::Environment)
    {
      light.Environment = skies.At(i, light);
    }
    lights.push_back(std::move(light));
  }
  for (const AreaCell& cell : FindAreaCells(input, type, prefix))
  {
    radiometry::LightRecord light = begin(cell.Points.front(), radiometry::LightType::Area);
    for (const vtkIdType p : cell.Points)
    {
      light.Polygon.push_back(PointOf(input, p));
      if (!radiometry::IsFinite(light.Polygon.back()))
      {
        throw InputError(prefix + "Points", p, "not finite", "finite coordinates");
      }
    }
    light.TwoSided = twoSided && twoSided->GetComponent(cell.Points.front(), 0) != 0.0;
    validate(light, cell.Points.front());
    radiometry::TriangulatePolygon(
      light.Polygon, (prefix + "Polygons").c_str(), static_cast<long long>(cell.Index));
    lights.push_back(std::move(light));
  }
  return lights;
}
