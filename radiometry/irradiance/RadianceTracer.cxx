// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/RadianceTracer.h"

#include "radiometry/geometry/PolygonTriangulation.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/BeamLights.h"
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// The values of a side; the back has the front's where it has none of its own.
const std::vector<double>& Of(const std::array<std::vector<double>, 2>& sides, bool front)
{
  return front || sides[1].empty() ? sides[0] : sides[1];
}

} // namespace

RadianceTracer::RadianceTracer(const Scene& scene, const OcclusionScene& occluders,
  const DiffuseLight& diffuse, const RadianceEffects& effects)
  : Geometry(scene)
  , Occluders(occluders)
  , Diffuse(diffuse)
  , Effects(effects)
  , Bands(static_cast<std::size_t>(scene.Optics.Bands))
  , Surfaces(scene, effects.Specular, effects.Transmission, effects.BackFaces)
  , Extent(radiometry::Extent(scene))
{
  const int panes = effects.Transmission && occluders.HasPanes() ? scene.Optics.Bands : 0;
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    const Light& light = scene.Lights[k];
    if (!light.Enabled || !(Magnitude(light) > 0.0))
    {
      continue;
    }
    if (light.Type == LightType::Environment)
    {
      if (effects.Environment)
      {
        this->Skies.push_back({ &light, SkyFrame(light.Direction, light.Reference) });
      }
      continue;
    }
    if (light.Type != LightType::Area)
    {
      Beam beam;
      beam.Flux = std::make_unique<SourceFlux>(light, effects.SpotShape, effects.Attenuation);
      beam.Shadow = std::make_unique<ShadowCutter>(*beam.Flux, nullptr, occluders, panes);
      beam.Index = k;
      this->Beams.push_back(std::move(beam));
    }
  }
  this->AddPanels();
  for (const std::vector<double>& side : diffuse.Exitance)
  {
    for (const double b : side)
    {
      this->Greatest = std::max(this->Greatest, b / Pi);
    }
  }
  for (const SkyLight& sky : this->Skies)
  {
    const auto& radiance = sky.Source->Environment;
    double most = 1.0;
    if (radiance)
    {
      const std::vector<double>& map = radiance->Values();
      most = map.empty() ? 0.0 : *std::max_element(map.begin(), map.end());
      for (int e = -89; map.empty() && e < 90; e += 2) // analytic skies are smooth
      {
        for (int a = 0; a < 360; a += 5)
        {
          const double h = e * Pi / 180.0, w = a * Pi / 180.0;
          most = std::max(most,
            radiance->At({ std::cos(h) * std::cos(w), std::cos(h) * std::sin(w), std::sin(h) }));
        }
      }
      most *= map.empty() ? 1.2 : 1.0;
    }
    this->Greatest += most * Magnitude(*sky.Source);
  }
}

void RadianceTracer::AddPanel(
  const Triangle3& corners, const double* exitance, std::int32_t triangle, bool front)
{
  Panel panel;
  panel.Corners = corners;
  panel.Normal = Normalized(AreaNormal2(corners));
  panel.Area = radiometry::Area(corners);
  panel.Triangle = triangle;
  panel.Front = front;
  double most = 0.0;
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    panel.Radiance.push_back(exitance[b] / Pi);
    most = std::max(most, panel.Radiance.back());
  }
  panel.Chance = most * panel.Area;
  if (panel.Chance > 0.0)
  {
    this->Greatest = std::max(this->Greatest, most);
    this->Panels.push_back(std::move(panel));
  }
}

void RadianceTracer::AddPanels()
{
  for (const Light& light : this->Geometry.Lights)
  {
    if (!light.Enabled || light.Type != LightType::Area || !(Magnitude(light) > 0.0))
    {
      continue;
    }
    for (Triangle3 t : TriangulatePolygon(light.Polygon, "Polygons", light.Index))
    {
      this->AddPanel(t, light.Intensity.data(), -1, true);
      if (light.TwoSided)
      {
        std::swap(t[1], t[2]);
        this->AddPanel(t, light.Intensity.data(), -1, true);
      }
    }
  }
  for (std::size_t k = 0; k < this->Panels.size(); ++k)
  {
    this->Lights.push_back(k);
  }
  const auto& emitted = this->Geometry.Optics.EmittedExitance;
  for (std::size_t t = 0; t < this->Geometry.ReceiverTriangles; ++t)
  {
    const std::int32_t cell = this->Geometry.TriangleCell[t];
    for (int side = 0; side < 2; ++side)
    {
      const std::vector<double>& values = Of(emitted, side == 0);
      if (values.empty() || !this->Sends(cell, side == 0))
      {
        continue;
      }
      const double* exitance = values.data() + static_cast<std::size_t>(cell) * this->Bands;
      const bool two = !this->Geometry.Optics.TwoSided.empty() &&
        this->Geometry.Optics.TwoSided[static_cast<std::size_t>(cell)] != 0;
      Triangle3 corners = this->Geometry.TriangleAt(t);
      if (side == 1)
      {
        std::swap(corners[1], corners[2]);
      }
      const std::size_t before = this->Panels.size();
      if (side == 0 || two)
      {
        this->AddPanel(corners, exitance, static_cast<std::int32_t>(t), side == 0);
      }
      if (this->Panels.size() > before)
      {
        this->PanelOf.resize(this->Geometry.ReceiverTriangles, { -1, -1 });
        this->PanelOf[t][static_cast<std::size_t>(side)] = static_cast<std::int32_t>(before);
      }
    }
  }
  double sum = 0.0;
  for (const Panel& panel : this->Panels)
  {
    sum += panel.Chance;
    this->Cumulative.push_back(sum);
  }
  for (Panel& panel : this->Panels)
  {
    panel.Chance /= sum;
  }
}

bool RadianceTracer::Sends(std::int32_t cell, bool front) const
{
  if (this->Diffuse.Exitance[front ? 0 : 1].empty())
  {
    return false;
  }
  if (front)
  {
    return true;
  }
  const auto c = static_cast<std::size_t>(cell);
  const Materials& optics = this->Geometry.Optics;
  if (this->Effects.BackFaces && !optics.TwoSided.empty() && optics.TwoSided[c] != 0)
  {
    return true;
  }
  bool through = false;
  for (std::size_t b = 0; b < this->Bands && !optics.DiffuseTransmittance.empty(); ++b)
  {
    through = through || optics.DiffuseTransmittance[c * this->Bands + b] > 0.0;
  }
  return through;
}

double RadianceTracer::Reflectance(std::int32_t cell, bool front, std::size_t band) const
{
  const Materials& optics = this->Geometry.Optics;
  const std::vector<double>& values = Of(optics.SpecularReflectance, front);
  const auto c = static_cast<std::size_t>(cell);
  const bool there = this->Effects.Specular && !values.empty() &&
    (front || (this->Effects.BackFaces && !optics.TwoSided.empty() && optics.TwoSided[c] != 0));
  return there ? values[c * this->Bands + band] : 0.0;
}

double RadianceTracer::Transmittance(std::int32_t cell, std::size_t band) const
{
  const std::vector<double>& values = this->Geometry.Optics.Transmittance;
  return this->Effects.Transmission && !values.empty()
    ? values[static_cast<std::size_t>(cell) * this->Bands + band]
    : 0.0;
}

double RadianceTracer::Exponent(std::int32_t cell, bool front) const
{
  const std::vector<double>& values = Of(this->Geometry.Optics.Shininess, front);
  return values.empty() ? DefaultShininess : values[static_cast<std::size_t>(cell)];
}

bool RadianceTracer::Calls(std::int32_t cell, bool front) const
{
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    if (this->Reflectance(cell, front, b) > 0.0 || this->Transmittance(cell, b) > 0.0)
    {
      return true;
    }
  }
  return false;
}

double RadianceTracer::GreatestBeams(const Vec3& center, double radius) const
{
  double sum = 0.0;
  for (const Beam& beam : this->Beams)
  {
    const Light& light = beam.Flux->GetLight();
    const double most = Magnitude(light);
    if (beam.Flux->Directional())
    {
      sum += most;
      continue;
    }
    const double r = Length(light.Position - center) - radius;
    const double* a = light.Attenuation;
    const double divisor = a[0] + a[1] * r + a[2] * r * r;
    const double least =
      this->Effects.Attenuation ? divisor : std::min(r * r, divisor > 0.0 ? divisor : r * r);
    sum += r > 0.0 && least > 0.0 ? most / least : std::numeric_limits<double>::infinity();
  }
  return sum;
}

} // namespace radiometry
