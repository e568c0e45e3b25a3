// SPDX-License-Identifier: BSD-3-Clause
#include "ExtendedLightReader.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace names = radiometry::names;
using radiometry::CandelaWeb;
using radiometry::InputError;
using radiometry::SkyFrame;
using radiometry::SkyModel;
using radiometry::SkyQuadric;
using radiometry::SkyRadiance;
using radiometry::Vec3;

namespace vtkradiometry
{
namespace
{

/// What was made of some numbers, for as long as others ask for the same.
template <typename Made>
class Kept
{
public:
  template <typename Make>
  std::shared_ptr<const Made> Get(const std::vector<double>& key, const Make& make)
  {
    for (const auto& [known, made] : this->Entries)
    {
      if (known == key)
      {
        return made;
      }
    }
    std::shared_ptr<const Made> made = make();
    if (this->Entries.size() >= 64)
    {
      this->Entries.erase(this->Entries.begin());
    }
    this->Entries.emplace_back(key, made);
    return made;
  }

private:
  std::vector<std::pair<std::vector<double>, std::shared_ptr<const Made>>> Entries;
};

std::vector<double> Values(vtkDataArray* array)
{
  std::vector<double> all;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      all.push_back(array->GetComponent(i, c));
    }
  }
  return all;
}

} // namespace

ExtendedLightReader::ExtendedLightReader(vtkPolyData* lights)
  : Data(lights)
{
}

double ExtendedLightReader::Value(
  const char* name, vtkIdType light, int component, double absent) const
{
  vtkDataArray* array = this->Data->GetPointData()->GetArray(name);
  return array && component < array->GetNumberOfComponents() &&
      light < array->GetNumberOfTuples()
    ? array->GetComponent(light, component)
    : absent;
}

vtkDataArray* ExtendedLightReader::Field(const std::string& name) const
{
  return this->Data->GetFieldData()->GetArray(name.c_str());
}

std::shared_ptr<const CandelaWeb> ExtendedLightReader::Web(vtkIdType light)
{
  const double index = this->Value(names::PhotometricWeb, light, 0, -1.0);
  if (index < 0.0)
  {
    return nullptr;
  }
  const std::string name =
    names::PhotometricWeb + std::to_string(static_cast<int>(std::min(index, 1e9)));
  std::vector<double> parts[3];
  static const char* const suffixes[3] = { "Horizontal", "Vertical", "" };
  std::vector<double> key;
  for (int k = 0; k < 3; ++k)
  {
    vtkDataArray* array = this->Field(name + suffixes[k]);
    if (!array)
    {
      throw InputError(name + suffixes[k], -1, "missing", "a field array");
    }
    parts[k] = Values(array);
    key.push_back(static_cast<double>(parts[k].size()));
    key.insert(key.end(), parts[k].begin(), parts[k].end());
  }
  vtkDataArray* type = this->Field(name + "Type");
  const double kind = type && type->GetNumberOfTuples() > 0 ? type->GetComponent(0, 0) : 1.0;
  if (kind != 1.0 && kind != 2.0 && kind != 3.0)
  {
    throw InputError(name + "Type", -1, kind, "1 C, 2 B or 3 A");
  }
  key.push_back(kind);
  static thread_local Kept<CandelaWeb> webs;
  return webs.Get(key, [&] {
    return std::make_shared<const CandelaWeb>(
      static_cast<radiometry::WebType>(static_cast<int>(kind)), parts[0], parts[1], parts[2], name);
  });
}

std::shared_ptr<const SkyRadiance> ExtendedLightReader::Radiance(
  vtkIdType light, const SkyFrame& frame) const
{
  const double kind = this->Value(names::SkyModel, light, 0, 0.0);
  const double ground = this->Value(names::GroundRadiance, light, 0, 0.0);
  if (kind == 0.0)
  {
    return SkyRadiance::Uniform();
  }
  if (kind == 3.0)
  {
    return SkyRadiance::Overcast(ground);
  }
  if (kind == 2.0)
  {
    std::array<double, 5> abcde;
    for (int c = 0; c < 5; ++c)
    {
      abcde[c] = this->Value(names::SkyCoefficients, light, c, std::nan(""));
    }
    const Vec3 sun{ this->Value(names::SunDirection, light, 0, 0.0),
      this->Value(names::SunDirection, light, 1, 0.0),
      this->Value(names::SunDirection, light, 2, 0.0) };
    return SkyRadiance::General(abcde, frame.ToSky(sun), ground);
  }
  const double map = this->Value(names::EnvironmentMap, light, 0, -1.0);
  const std::string name =
    names::EnvironmentMap + std::to_string(static_cast<int>(std::clamp(map, 0.0, 1e9)));
  vtkDataArray* values = this->Field(name);
  vtkDataArray* size = this->Field(name + "Size");
  if (kind != 1.0 || map < 0.0 || !values || !size || size->GetNumberOfValues() != 2)
  {
    throw InputError(kind == 1.0 ? name : names::SkyModel, light, kind == 1.0 ? map : kind,
      kind == 1.0 ? "a map in the field data, with its size" : "0 to 3");
  }
  const std::vector<double> extent = Values(size);
  const int bands = values->GetNumberOfComponents();
  if (!(extent[0] * extent[1] == static_cast<double>(values->GetNumberOfTuples())))
  {
    throw InputError(name, -1, static_cast<double>(values->GetNumberOfTuples()),
      "width times height pixels");
  }
  return SkyRadiance::Map(
    static_cast<int>(extent[0]), static_cast<int>(extent[1]), bands, Values(values));
}

std::shared_ptr<const SkyQuadric> ExtendedLightReader::Sky(
  vtkIdType light, const Vec3& direction, const Vec3& reference)
{
  const SkyFrame frame(direction, reference);
  std::vector<double> key{ direction.x, direction.y, direction.z, reference.x, reference.y,
    reference.z, this->Value(names::SkyModel, light, 0, 0.0),
    this->Value(names::GroundRadiance, light, 0, 0.0) };
  for (int c = 0; c < 5; ++c)
  {
    key.push_back(this->Value(names::SkyCoefficients, light, c, 0.0));
    key.push_back(this->Value(names::SunDirection, light, c, 0.0));
  }
  const double map = this->Value(names::EnvironmentMap, light, 0, -1.0);
  if (key[6] == 1.0 && map >= 0.0)
  {
    vtkDataArray* values =
      this->Field(names::EnvironmentMap + std::to_string(static_cast<int>(std::min(map, 1e9))));
    key.push_back(values ? static_cast<double>(reinterpret_cast<std::uintptr_t>(values)) : 0.0);
    key.push_back(values ? static_cast<double>(values->GetMTime()) : 0.0);
  }
  static thread_local Kept<SkyQuadric> skies;
  return skies.Get(key, [&] {
    return std::make_shared<const SkyQuadric>(
      radiometry::ProjectSky(*this->Radiance(light, frame), frame, { 1.0, 1.0, 1.0 }));
  });
}

std::vector<AreaLight> ExtendedLightReader::Areas()
{
  std::vector<AreaLight> areas;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < this->Data->GetNumberOfPolys(); ++c)
  {
    this->Data->GetPolys()->GetCellAtId(c, ids);
    if (ids->GetNumberOfIds() < 3)
    {
      continue;
    }
    AreaLight area;
    area.Points.assign(ids->begin(), ids->end());
    area.TwoSided = this->Value(names::LightTwoSided, area.Points[0], 0, 0.0) != 0.0;
    for (const vtkIdType p : *ids)
    {
      double corner[3];
      this->Data->GetPoint(p, corner);
      area.Corners.push_back({ corner[0], corner[1], corner[2] });
    }
    areas.push_back(std::move(area));
  }
  return areas;
}

} // namespace vtkradiometry
