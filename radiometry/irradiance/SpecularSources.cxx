// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SpecularSources.h"

#include "radiometry/geometry/PolygonTriangulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

void AddPanel(const Triangle3& corners, const double* exitance, int bands, std::int32_t triangle,
  std::vector<SpecularSource>& sources)
{
  SpecularSource panel;
  panel.Is = SpecularSource::Kind::Panel;
  panel.Intensity.assign(exitance, exitance + bands);
  panel.Strength = *std::max_element(panel.Intensity.begin(), panel.Intensity.end());
  panel.Corners = corners;
  panel.Normal = Normalized(AreaNormal2(corners));
  panel.PanelArea = Area(corners);
  panel.Triangle = triangle;
  if (panel.Strength > 0.0 && panel.PanelArea > 0.0)
  {
    sources.push_back(std::move(panel));
  }
}

} // namespace

double SpecularSource::FromPanel(const Vec3& on, const Vec3& point, const Vec3& normal) const
{
  const Vec3 way = on - point;
  const double r2 = LengthSquared(way);
  const double arrives = Dot(normal, way);
  const double leaves = -Dot(this->Normal, way);
  return arrives > 0.0 && leaves > 0.0 && r2 > 0.0
    ? this->PanelArea * arrives * leaves / (Pi * r2 * r2)
    : 0.0;
}

double SpecularSource::Roughly(const Vec3& point, const Vec3& normal) const
{
  if (this->Is == Kind::Beam)
  {
    return this->Beam->AtPoint(point, normal);
  }
  double sum = 0.0;
  for (const Vec3& corner : this->Corners)
  {
    const Vec3 way = corner - point;
    const double r2 = LengthSquared(way) + this->PanelArea;
    const double cosines = std::max(0.0, Dot(normal, way)) * std::max(0.0, -Dot(this->Normal, way));
    sum += this->PanelArea * cosines / (3.0 * Pi * r2 * r2);
  }
  return sum;
}

std::vector<SpecularSource> FindSpecularSources(
  const Scene& scene, const EmitterSet& emitters, const SpecularLightOptions& options)
{
  std::vector<SpecularSource> sources;
  const int bands = scene.Optics.Bands;
  for (const Light& light : scene.Lights)
  {
    const double strength = light.Intensity.empty()
      ? 0.0
      : *std::max_element(light.Intensity.begin(), light.Intensity.end());
    if (!light.Enabled || !(strength > 0.0))
    {
      continue;
    }
    if (light.Type == LightType::Area)
    {
      for (Triangle3 t : TriangulatePolygon(light.Polygon, "Polygons", light.Index))
      {
        AddPanel(t, light.Intensity.data(), bands, -1, sources);
        if (light.TwoSided)
        {
          std::swap(t[1], t[2]);
          AddPanel(t, light.Intensity.data(), bands, -1, sources);
        }
      }
      continue;
    }
    if (light.Type != LightType::Environment)
    {
      SpecularSource source;
      source.Intensity = light.Intensity;
      source.Strength = strength;
      source.Beam = std::make_unique<SourceFlux>(light, options.SpotShape, options.Attenuation);
      sources.push_back(std::move(source));
    }
  }
  for (std::size_t k = 0; k < emitters.Patches.size(); ++k)
  {
    AddPanel(emitters.Patches[k].Corners,
      emitters.Exitance.data() + k * static_cast<std::size_t>(emitters.Bands), bands,
      emitters.Patches[k].Triangle, sources);
  }
  return sources;
}

} // namespace radiometry
