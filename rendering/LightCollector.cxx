// SPDX-License-Identifier: BSD-3-Clause
#include "LightCollector.h"

#include "BandColors.h"
#include "ExtendedLightReader.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Light.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace vtkradiometry
{
namespace
{

using radiometry::DisplayLight;
using radiometry::Rgb;
using radiometry::Vec3;

/// One array of the lights, with the value that stands where it is absent.
class LightArray
{
public:
  LightArray(vtkPolyData* data, const char* name, const BandColors* colors = nullptr)
    : Name(name)
    , Colors(colors)
    , Array(data->GetPointData()->GetArray(name))
  {
  }
  explicit operator bool() const { return this->Array != nullptr; }
  double Value(vtkIdType i, double absent, int component = 0) const
  {
    return this->Array && component < this->Array->GetNumberOfComponents()
      ? this->Array->GetComponent(i, component)
      : absent;
  }
  Vec3 Vector(vtkIdType i, const Vec3& absent) const
  {
    return { this->Value(i, absent.x, 0), this->Value(i, absent.y, 1),
      this->Value(i, absent.z, 2) };
  }
  Rgb Color(vtkIdType i, const Rgb& absent) const
  {
    if (!this->Array)
    {
      return absent;
    }
    const std::array<double, 3> rgb = this->Colors->Of(this->Array, i);
    return { rgb[0], rgb[1], rgb[2] };
  }
  bool IsSpectral() const { return this->Array && this->Colors->IsSpectral(this->Array); }
  const char* Name;

private:
  const BandColors* Colors; // of arrays of bands
  vtkDataArray* Array;
};

bool IsFinite(const Rgb& c)
{
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

/// Empty when the light can be drawn, else "array: what was expected".
std::string WhatIsWrong(const DisplayLight& light, double cutoff)
{
  namespace names = radiometry::names;
  const auto& p = light.Position;
  if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
  {
    return "Points: expected finite coordinates";
  }
  if (!IsFinite(light.Diffuse))
  {
    return std::string(names::Intensity) + ": expected finite values";
  }
  if (!IsFinite(light.Ambient))
  {
    return std::string(names::AmbientColor) + ": expected finite values";
  }
  if (!IsFinite(light.Specular))
  {
    return std::string(names::SpecularColor) + ": expected finite values";
  }
  if (!radiometry::IsFinite(light.SpotDirection) || light.SpotDirection == Vec3{})
  {
    return std::string(names::Direction) + ": expected a finite direction with a length";
  }
  if (!(cutoff > 0.0 && cutoff <= 90.0) && cutoff != 180.0)
  {
    return std::string(names::SpotCutoff) + ": expected (0, 90] or 180 degrees";
  }
  if (!(light.SpotExponent >= 0.0) || !std::isfinite(light.SpotExponent))
  {
    return std::string(names::SpotExponent) + ": expected a finite value of at least 0";
  }
  double sum = 0.0;
  for (const double a : light.Attenuation)
  {
    if (!(a >= 0.0) || !std::isfinite(a))
    {
      return std::string(names::Attenuation) + ": expected finite values of at least 0";
    }
    sum += a;
  }
  return sum > 0.0 ? std::string()
                   : std::string(names::Attenuation) + ": expected one value above 0";
}

void CollectFromPolyData(vtkPolyData* data, CollectedLights& result)
{
  namespace names = radiometry::names;
  const LightArray type(data, names::LightType);
  const BandColors colors(data->GetFieldData(), radiometry::imaging::BandValues::Power);
  const LightArray intensity(data, names::Intensity, &colors);
  const LightArray direction(data, names::Direction);
  const LightArray cutoffs(data, names::SpotCutoff);
  const LightArray inner(data, names::SpotInnerCutoff);
  const LightArray exponent(data, names::SpotExponent);
  const LightArray attenuation(data, names::Attenuation);
  const LightArray enabled(data, names::LightEnabled);
  const LightArray ambient(data, names::AmbientColor, &colors);
  const LightArray specular(data, names::SpecularColor, &colors);
  const LightArray attached(data, names::AttachedTo);
  const LightArray reference(data, names::ReferenceDirection);
  ExtendedLightReader extended(data);
  std::vector<AreaLight> areas = extended.Areas();
  std::set<vtkIdType> corners;
  for (const AreaLight& area : areas)
  {
    corners.insert(area.Points.begin(), area.Points.end());
  }
  const auto complain = [&result](vtkIdType i, const std::string& what) {
    if (result.Problem.empty())
    {
      std::ostringstream text;
      text << "light " << i << " is left out of the picture: " << what;
      result.Problem = text.str();
    }
  };
  for (const LightArray* array : { &intensity, &ambient, &specular })
  {
    result.Spectral = result.Spectral || array->IsSpectral();
  }
  if (!colors.GetProblem().empty() && result.Problem.empty())
  {
    result.Problem = "lights: " + colors.GetProblem();
  }
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    if (enabled.Value(i, 1.0) == 0.0)
    {
      continue;
    }
    const double kind = type.Value(i, 0.0);
    if (kind == 3.0)
    {
      result.NotDrawn += corners.count(i) == 0 ? 1 : 0; // else its polygon comes below
      continue;
    }
    if (kind != 0.0 && kind != 1.0 && kind != 2.0 && kind != 4.0)
    {
      complain(i, std::string(names::LightType) + ": expected 0 to 4");
      continue;
    }
    DisplayLight light;
    light.SpotDirection = direction.Vector(i, { 0.0, 0.0, -1.0 });
    double p[3];
    data->GetPoint(i, p);
    const Vec3 from = -light.SpotDirection;
    light.Position = kind == 2.0 ? std::array<double, 4>{ { from.x, from.y, from.z, 0.0 } }
                                 : std::array<double, 4>{ { p[0], p[1], p[2], 1.0 } };
    light.Diffuse = intensity.Color(i, { 1.0, 1.0, 1.0 });
    light.Specular = specular.Color(i, light.Diffuse);
    light.Ambient = ambient.Color(i, Rgb());
    const Vec3 abc = attenuation.Vector(i, { 0.0, 0.0, 1.0 });
    light.Attenuation = { { abc.x, abc.y, abc.z } };
    double cutoff = 180.0;
    if (kind == 1.0)
    {
      cutoff = cutoffs.Value(i, 180.0);
      light.SpotExponent = exponent.Value(i, 0.0);
      if (cutoff < 180.0)
      {
        light.CosCutoff = cutoff == 90.0 ? 0.0 : std::cos(vtkMath::RadiansFromDegrees(cutoff));
        const double innerCutoff = inner.Value(i, -1.0);
        light.SmoothEdge = innerCutoff >= 0.0 && innerCutoff < cutoff;
        light.CosInnerCutoff = std::cos(vtkMath::RadiansFromDegrees(innerCutoff));
      }
    }
    try
    {
      light.Reference = reference.Vector(i, { 1.0, 0.0, 0.0 });
      light.Web = kind == 0.0 ? extended.Web(i) : nullptr;
      light.Sky = kind == 4.0 ? extended.Sky(i, light.SpotDirection, light.Reference) : nullptr;
    }
    catch (const radiometry::InputError& error)
    {
      complain(i, error.what());
      continue;
    }
    const std::string wrong = WhatIsWrong(light, cutoff);
    if (!wrong.empty())
    {
      complain(i, wrong);
      continue;
    }
    const int frame = static_cast<int>(attached.Value(i, 0.0));
    result.Lights.push_back(light);
    result.Frames.push_back(static_cast<LightFrame>(std::clamp(frame, 0, 2)));
    const Vec3& d = light.SpotDirection;
    result.Keys.push_back({ kind, p[0], p[1], p[2], d.x, d.y, d.z });
  }
  for (AreaLight& area : areas)
  {
    const vtkIdType i = area.Points.front();
    if (type.Value(i, 0.0) != 3.0 || enabled.Value(i, 1.0) == 0.0)
    {
      continue;
    }
    DisplayLight light;
    light.Diffuse = intensity.Color(i, { 1.0, 1.0, 1.0 });
    light.Specular = light.Ambient = Rgb();
    light.PolygonTwoSided = area.TwoSided;
    light.Polygon = std::move(area.Corners);
    const bool finite =
      std::all_of(light.Polygon.begin(), light.Polygon.end(), [](const Vec3& c) { return radiometry::IsFinite(c); });
    if (!finite || !IsFinite(light.Diffuse))
    {
      complain(i, finite ? std::string(names::Intensity) + ": expected finite values"
                         : "Points: expected finite coordinates");
      continue;
    }
    const Vec3 corner = light.Polygon.front();
    const int frame = static_cast<int>(attached.Value(i, 0.0));
    result.Lights.push_back(std::move(light));
    result.Frames.push_back(static_cast<LightFrame>(std::clamp(frame, 0, 2)));
    result.Keys.push_back({ 3.0, corner.x, corner.y, corner.z, 0.0, 0.0, 0.0 });
  }
}

} // namespace

CollectedLights CollectFromData(vtkDataObject* data)
{
  CollectedLights result;
  if (auto* lights = vtkPolyData::SafeDownCast(data))
  {
    CollectFromPolyData(lights, result);
  }
  else if (auto* tree = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto it = vtk::TakeSmartPointer(tree->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      if (auto* block = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
      {
        CollectFromPolyData(block, result);
      }
    }
  }
  return result;
}

CollectedLights CollectFromRenderer(vtkRenderer* renderer, bool physical)
{
  CollectedLights result;
  const double unit = physical ? vtkMath::Pi() : 1.0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator it;
  lights->InitTraversal(it);
  while (vtkLight* source = lights->GetNextLight(it))
  {
    if (!source->GetSwitch())
    {
      continue;
    }
    double position[3];
    double focus[3];
    source->GetTransformedPosition(position);
    source->GetTransformedFocalPoint(focus);
    const auto color = [&](const double* c) {
      return (unit * source->GetIntensity()) * Rgb{ c[0], c[1], c[2] };
    };
    DisplayLight light;
    light.SpotDirection = { focus[0] - position[0], focus[1] - position[1],
      focus[2] - position[2] };
    light.Diffuse = color(source->GetDiffuseColor());
    light.Specular = color(source->GetSpecularColor());
    light.Ambient = source->GetIntensity() *
      Rgb{ source->GetAmbientColor()[0], source->GetAmbientColor()[1],
        source->GetAmbientColor()[2] };
    if (source->GetPositional())
    {
      light.Position = { { position[0], position[1], position[2], 1.0 } };
      const double* a = source->GetAttenuationValues();
      light.Attenuation = { { a[0], a[1], a[2] } };
      if (source->GetConeAngle() < 90.0)
      {
        light.CosCutoff = std::cos(vtkMath::RadiansFromDegrees(source->GetConeAngle()));
        light.SpotExponent = source->GetExponent();
      }
    }
    else
    {
      const Vec3 from = -light.SpotDirection;
      light.Position = { { from.x, from.y, from.z, 0.0 } };
    }
    const std::string wrong = WhatIsWrong(light, 180.0);
    if (wrong.empty())
    {
      result.Lights.push_back(light);
      result.Frames.push_back(LightFrame::Scene);
      result.Keys.push_back({ -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 });
    }
    else if (result.Problem.empty())
    {
      result.Problem = "a vtkLight is left out of the picture: " + wrong;
    }
  }
  return result;
}

} // namespace vtkradiometry
