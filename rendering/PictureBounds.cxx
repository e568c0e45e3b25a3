// SPDX-License-Identifier: BSD-3-Clause
#include "PictureBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkradiometry
{

using radiometry::DisplayLight;
using radiometry::Effect;
using radiometry::LightTerms;
using radiometry::Rgb;
using radiometry::Vec3;

namespace
{

double Greatest(const Rgb& c)
{
  return std::max({ std::abs(c.r), std::abs(c.g), std::abs(c.b) });
}

bool Has(const EffectSet& set, Effect effect)
{
  return set[static_cast<std::size_t>(effect)];
}

} // namespace

Effect RowOf(LightKind kind)
{
  switch (kind)
  {
    case LightKind::Directional:
      return Effect::DirectionalLights;
    case LightKind::Spot:
      return Effect::SpotLights;
    case LightKind::Area:
      return Effect::AreaLights;
    case LightKind::Sky:
      return Effect::Environment;
    default:
      return Effect::PointLights; // a luminaire is a point with a web
  }
}

bool HasFallOff(LightKind kind)
{
  return kind == LightKind::Point || kind == LightKind::Spot || kind == LightKind::Luminaire;
}

bool KeepLight(DisplayLight& light, const EffectSet& without)
{
  const LightKind kind = KindOf(light);
  if (Has(without, RowOf(kind)))
  {
    return false;
  }
  if (kind == LightKind::Spot && Has(without, Effect::SpotShape))
  {
    light.CosCutoff = -1.0;
    light.SpotExponent = 0.0;
    light.SmoothEdge = false;
  }
  if (kind == LightKind::Luminaire && Has(without, Effect::CandelaWebs))
  {
    light.Web = nullptr;
  }
  return true;
}

bool BoundedPicture::FallsOtherwise(const DisplayLight& light) const
{
  const auto& a = light.Attenuation;
  return HasFallOff(KindOf(light)) && (a[0] != 0.0 || a[1] != 0.0 || a[2] != this->Square);
}

double BoundedPicture::BoundOf(Effect effect, bool highlights) const
{
  const auto lights = [&](const auto& ofLight) {
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Scene.Lights.size(); ++k)
    {
      sum += ofLight(this->Scene.Lights[k], k);
    }
    return sum;
  };
  const auto added = [&](const DisplayLight& light, const LightTerms& terms) {
    return radiometry::LightBound(this->Scene.Model, light, this->Surface, terms);
  };
  const auto all = [&](const LightTerms& terms) {
    return lights([&](const DisplayLight& light, std::size_t) { return added(light, terms); });
  };
  const double ambient = Greatest(this->Surface.Peaks.Ambient * this->Scene.Model.GlobalAmbient);
  switch (effect)
  {
    case Effect::SpotShape:
      return lights([&](const DisplayLight& light, std::size_t) {
        return KindOf(light) == LightKind::Spot
          ? radiometry::SpotShapeBound(this->Scene.Model, light, this->Surface)
          : 0.0;
      });
    case Effect::CandelaWebs:
      return lights([&](const DisplayLight& light, std::size_t) {
        return KindOf(light) == LightKind::Luminaire ? added(light, {}) : 0.0;
      });
    case Effect::Attenuation:
      return lights([&](const DisplayLight& light, std::size_t) {
        return this->FallsOtherwise(light)
          ? radiometry::AttenuationBound(this->Scene.Model, light, this->Surface, this->Square)
          : 0.0;
      });
    case Effect::Occlusion:
      return lights([&](const DisplayLight& light, std::size_t k) {
        return this->Loss[k] > 0.0 ? this->Loss[k] * added(light, { 0.0, 1.0, 1.0 }) : 0.0;
      });
    case Effect::Specular:
      return all({ 0.0, 0.0, 1.0 });
    case Effect::LocalViewer:
      return !highlights ? 0.0 : lights([&](const DisplayLight& light, std::size_t) {
        return radiometry::ViewerBound(
          this->Scene.Model, light, this->Surface, this->Scene.Eye, this->Scene.Viewer);
      });
    case Effect::GlobalAmbient:
      return all({ 1.0, 0.0, 0.0 }) + ambient;
    case Effect::Emission:
      return Greatest(this->Emission);
    case Effect::TwoSided:
      // A light of the front is none of the back: of each, one picture has nothing. Area lights and
      // skies may reach both; the difference of two values of one sign is within the greater.
      return all({ this->AmbientOfSides, 1.0, 1.0 }) + this->AmbientOfSides * ambient +
        this->EmissionOfSides + this->FieldOfSides;
    case Effect::Translucency:
      return std::numeric_limits<double>::infinity(); // what is behind is not known here
    default:
      return lights([&](const DisplayLight& light, std::size_t) {
        return RowOf(KindOf(light)) == effect ? added(light, {}) : 0.0;
      });
  }
}

void BoundedPicture::TakeOut(Effect effect)
{
  EffectSet without;
  without.set(static_cast<std::size_t>(effect));
  std::vector<DisplayLight>& lights = this->Scene.Lights;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    if (!KeepLight(lights[k], without))
    {
      continue;
    }
    if (effect == Effect::Attenuation && this->FallsOtherwise(lights[k]))
    {
      lights[k].Attenuation = { { 0.0, 0.0, this->Square } };
    }
    if (kept != k)
    {
      lights[kept] = std::move(lights[k]);
      this->Loss[kept] = this->Loss[k];
    }
    ++kept;
  }
  lights.resize(kept);
  this->Loss.resize(kept);
  if (effect == Effect::Specular)
  {
    this->Surface.Peaks.Specular = Rgb();
  }
  if (effect == Effect::GlobalAmbient)
  {
    this->Surface.Peaks.Ambient = Rgb();
  }
  if (effect == Effect::Emission)
  {
    this->EmissionOfSides = 0.0;
  }
}

std::vector<double> BoundedPicture::Key() const
{
  std::vector<double> key;
  const auto add = [&key](std::initializer_list<double> values) {
    key.insert(key.end(), values.begin(), values.end());
  };
  const auto vector = [&add](const Vec3& v) { add({ v.x, v.y, v.z }); };
  const auto color = [&add](const Rgb& c) { add({ c.r, c.g, c.b }); };
  add({ static_cast<double>(this->Scene.Model.Reflection), this->Square, this->EmissionOfSides,
    this->FieldOfSides, this->AmbientOfSides });
  color(this->Scene.Model.GlobalAmbient);
  color(this->Emission);
  vector(this->Scene.Eye);
  vector(this->Scene.Viewer);
  const radiometry::MaterialPeaks& peaks = this->Surface.Peaks;
  color(peaks.Ambient);
  color(peaks.Diffuse);
  color(peaks.Specular);
  add({ peaks.LeastShininess, peaks.GreatestShininess });
  for (const radiometry::SurfaceBox& box : this->Surface.Boxes)
  {
    vector(box.Low);
    vector(box.High);
  }
  for (std::size_t k = 0; k < this->Scene.Lights.size(); ++k)
  {
    const DisplayLight& light = this->Scene.Lights[k];
    key.insert(key.end(), light.Position.begin(), light.Position.end());
    key.insert(key.end(), light.Attenuation.begin(), light.Attenuation.end());
    vector(light.SpotDirection);
    color(light.Ambient);
    color(light.Diffuse);
    color(light.Specular);
    add({ light.CosCutoff, light.SpotExponent, light.CosInnerCutoff, double(light.SmoothEdge),
      double(light.Web != nullptr), double(light.PolygonTwoSided), this->Loss[k] });
    for (const Vec3& corner : light.Polygon)
    {
      vector(corner);
    }
    if (light.Sky)
    {
      color(light.Sky->Constant);
      std::for_each(light.Sky->Linear.begin(), light.Sky->Linear.end(), color);
      std::for_each(light.Sky->Quadratic.begin(), light.Sky->Quadratic.end(), color);
    }
  }
  return key;
}

} // namespace vtkradiometry
