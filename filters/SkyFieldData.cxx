// SPDX-License-Identifier: BSD-3-Clause
#include "SkyFieldData.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SkyRadiance.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::SkyModel;
using radiometry::SkyRadiance;

namespace
{

template <class Array>
vtkNew<Array> Add(
  vtkFieldData* data, const std::string& name, int components, vtkIdType tuples, double value)
{
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(value);
  data->AddArray(array);
  return array;
}

std::string MapName(int k)
{
  return names::EnvironmentMap + std::to_string(k);
}

void WriteMap(const SkyRadiance& map, int k, vtkFieldData* field)
{
  const auto values = Add<vtkDoubleArray>(field, MapName(k), map.Bands(),
    static_cast<vtkIdType>(map.Width()) * map.Height(), 0.0);
  std::copy(map.Values().begin(), map.Values().end(), values->GetPointer(0));
  const auto size = Add<vtkIntArray>(field, MapName(k) + "Size", 2, 1, 0.0);
  size->SetValue(0, map.Width());
  size->SetValue(1, map.Height());
}

} // namespace

void WriteSkies(const std::vector<radiometry::LightRecord>& lights,
  const std::vector<vtkIdType>& points, vtkPolyData* output)
{
  const auto isSky = [](const radiometry::LightRecord& light) {
    return light.Type == radiometry::LightType::Environment;
  };
  if (!std::any_of(lights.begin(), lights.end(), isSky))
  {
    return;
  }
  const vtkIdType n = output->GetNumberOfPoints();
  vtkPointData* data = output->GetPointData();
  const auto model = Add<vtkIntArray>(data, names::SkyModel, 1, n, 0.0);
  const auto coefficients = Add<vtkDoubleArray>(data, names::SkyCoefficients, 5, n, 0.0);
  const auto sun = Add<vtkDoubleArray>(data, names::SunDirection, 3, n, 0.0);
  const auto map = Add<vtkIntArray>(data, names::EnvironmentMap, 1, n, -1.0);
  const auto ground = Add<vtkDoubleArray>(data, names::GroundRadiance, 1, n, 0.0);
  std::vector<const SkyRadiance*> maps; // each once, however many lights have it
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    const SkyRadiance* sky = lights[k].Environment.get();
    if (!isSky(lights[k]) || !sky)
    {
      continue;
    }
    const vtkIdType i = points[k];
    model->SetValue(i, static_cast<int>(sky->Model()));
    coefficients->SetTuple(i, sky->Coefficients().data());
    const radiometry::SkyFrame frame(lights[k].Direction, lights[k].Reference);
    const radiometry::Vec3 toSun = frame.ToWorld(sky->ToSun());
    sun->SetTuple3(i, toSun.x, toSun.y, toSun.z);
    ground->SetValue(i, sky->GroundRadiance());
    if (sky->Model() == SkyModel::Map)
    {
      const auto found = std::find(maps.begin(), maps.end(), sky);
      map->SetValue(i, static_cast<int>(found - maps.begin()));
      if (found == maps.end())
      {
        WriteMap(*sky, static_cast<int>(maps.size()), output->GetFieldData());
        maps.push_back(sky);
      }
    }
  }
}

SkyReader::SkyReader(vtkPolyData* input, int bands, const std::string& prefix)
  : Input(input)
  , Bands(bands)
  , Prefix(prefix)
{
}

vtkDataArray* SkyReader::Find(const char* name, int components) const
{
  vtkDataArray* array = this->Input->GetPointData()->GetArray(name);
  if (array &&
    (array->GetNumberOfComponents() != components ||
      array->GetNumberOfTuples() != this->Input->GetNumberOfPoints()))
  {
    throw InputError(this->Prefix + name, -1,
      std::to_string(array->GetNumberOfTuples()) + " tuples of " +
        std::to_string(array->GetNumberOfComponents()) + " components",
      std::to_string(this->Input->GetNumberOfPoints()) + " tuples of " +
        std::to_string(components));
  }
  return array;
}

std::shared_ptr<const SkyRadiance> SkyReader::Map(vtkIdType i)
{
  vtkDataArray* index = this->Find(names::EnvironmentMap, 1);
  const double wanted = index ? index->GetComponent(i, 0) : -1.0;
  const int k = wanted >= 0.0 && wanted < 1e9 ? static_cast<int>(wanted) : -1;
  auto* values = vtkDataArray::SafeDownCast(
    this->Input->GetFieldData()->GetAbstractArray(MapName(std::max(k, 0)).c_str()));
  if (k < 0 || k != wanted || !values)
  {
    throw InputError(this->Prefix + names::EnvironmentMap, i, wanted,
      "the number of a map in the field data (EnvironmentMap0, ...)");
  }
  auto& known = this->Maps[k];
  if (known)
  {
    return known;
  }
  const std::string name = this->Prefix + MapName(k);
  const int components = values->GetNumberOfComponents();
  if (components != 1 && components != this->Bands)
  {
    throw InputError(name, -1, std::to_string(components) + " bands",
      "1 or " + std::to_string(this->Bands) + " bands, as the lights' Intensity");
  }
  auto* size = vtkDataArray::SafeDownCast(
    this->Input->GetFieldData()->GetAbstractArray((MapName(k) + "Size").c_str()));
  if (!size || size->GetNumberOfTuples() * size->GetNumberOfComponents() != 2)
  {
    throw InputError(name + "Size", -1, size ? "not two numbers" : "missing", "width and height");
  }
  const double width = size->GetComponent(0, 0);
  const double height =
    size->GetNumberOfComponents() == 2 ? size->GetComponent(0, 1) : size->GetComponent(1, 0);
  if (!(width >= 1.0) || !(height >= 1.0) || width > 1e6 || height > 1e6 ||
    width * height != static_cast<double>(values->GetNumberOfTuples()))
  {
    throw InputError(name, -1, std::to_string(values->GetNumberOfTuples()) + " pixels",
      "width times height of " + MapName(k) + "Size");
  }
  std::vector<double> pixels(
    static_cast<std::size_t>(values->GetNumberOfTuples()) * components);
  for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = values->GetComponent(p, c);
      if (!(value >= 0.0) || value > 1e300)
      {
        throw InputError(name, p, value, "a finite radiance, not negative");
      }
      pixels[static_cast<std::size_t>(p) * components + c] = value;
    }
  }
  known = SkyRadiance::Map(
    static_cast<int>(width), static_cast<int>(height), components, std::move(pixels));
  return known;
}

std::shared_ptr<const SkyRadiance> SkyReader::At(
  vtkIdType i, const radiometry::LightRecord& light)
{
  vtkDataArray* model = this->Find(names::SkyModel, 1);
  vtkDataArray* ground = this->Find(names::GroundRadiance, 1);
  const double kind = model ? model->GetComponent(i, 0) : 0.0;
  const double below = ground ? ground->GetComponent(i, 0) : 0.0;
  try
  {
    if (kind == 0.0)
    {
      return SkyRadiance::Uniform();
    }
    if (kind == 3.0)
    {
      return SkyRadiance::Overcast(below);
    }
    if (kind == 2.0)
    {
      vtkDataArray* coefficients = this->Find(names::SkyCoefficients, 5);
      vtkDataArray* sun = this->Find(names::SunDirection, 3);
      if (!coefficients || !sun)
      {
        throw InputError(coefficients ? names::SunDirection : names::SkyCoefficients, -1, "missing",
          "a point array of CIE general skies");
      }
      std::array<double, 5> abcde;
      coefficients->GetTuple(i, abcde.data());
      const radiometry::SkyFrame frame(light.Direction, light.Reference);
      const radiometry::Vec3 toSun{ sun->GetComponent(i, 0), sun->GetComponent(i, 1),
        sun->GetComponent(i, 2) };
      return SkyRadiance::General(abcde,
        frame.ToSky(radiometry::UnitDirection(names::SunDirection, toSun, i)), below);
    }
  }
  catch (const InputError& error)
  {
    throw InputError(this->Prefix + error.Array, i, error.Value, error.Expected);
  }
  if (kind == 1.0)
  {
    return this->Map(i);
  }
  throw InputError(this->Prefix + names::SkyModel, i, kind,
    "0 uniform, 1 map, 2 CIE general sky or 3 traditional overcast");
}
