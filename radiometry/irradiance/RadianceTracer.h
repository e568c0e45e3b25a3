// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/ShadowCutter.h"
#include "radiometry/irradiance/SourceFlux.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/irradiance/SurfaceExitance.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// What RadianceTracer follows.
struct RadianceEffects
{
  bool Occlusion = true;     // false: highlights are not shadowed
  bool Specular = true;      // false: lobes and mirrors reflect nothing
  bool Transmission = true;  // false: nothing is seen through panes, and they block
  bool Environment = true;
  bool SpotShape = true;
  bool Attenuation = true;
  bool BackFaces = true;     // false: backs of two-sided cells send and reflect nothing
};

/// Numbers in (0, 1) that one sample is made of, in four dimensions each.
struct RadianceNumbers
{
  std::array<double, 4> Lobe;
  std::array<double, 4> Panel;
  std::uint64_t State = 0; // of what comes after the first reflection
};

/// Radiance along a ray, and what a lobe or pane sends on of it.
///   Model   L = B/pi where the ray ends + what is reflected by the lobe of scene/Reflectance.h
///           and transmitted straight there, over any number of mirrors and panes
///   Lights  of point, spot and directional lights f E with one shadow ray; area lights and
///           emitting surfaces by the balance heuristic of a point on them and the lobe's direction;
///           skies where rays meet nothing. A perfect mirror shows no light without an area
///   Noise   unbiased, but for paths that are cut after 1000 reflections
///   Source  Veach and Guibas 1995 (balance heuristic)
class RadianceTracer
{
public:
  RadianceTracer(const Scene& scene, const OcclusionScene& occluders, const DiffuseLight& diffuse,
    const RadianceEffects& effects);

  /// A place that reflects or transmits, with the side that is looked at.
  struct Place
  {
    RayEnd End;
    Vec3 Normal; // unit, to that side
    std::int32_t Cell = -1;
    bool Front = true;
    Vec3 Toward; // unit, to who looks
    const double* Known = nullptr; // share of each light's that arrives, by light; null: not known
  };

  /// True where a side of a cell reflects specularly or lets light through.
  bool Calls(std::int32_t cell, bool front) const;

  /// Adds one sample of what the place sends on, but for highlights of lights (Highlights.h), to `radiance` [W/(m^2 sr), bands], and to `doubt`
  /// the part of it that errors of the diffuse light make. Returns the rays traced.
  std::int64_t AddSample(
    const Place& place, const RadianceNumbers& numbers, double* radiance, double* doubt) const;

  /// rho_s of a side of a cell, and tau; 0 where the effect is left out.
  double Reflectance(std::int32_t cell, bool front, std::size_t band) const;
  double Transmittance(std::int32_t cell, std::size_t band) const;

  /// Whether a side of a cell sends diffuse light.
  bool Sends(std::int32_t cell, bool front) const;
  /// The greatest radiance of surfaces, area lights and skies, any band.
  double GreatestRadiance() const { return this->Greatest; }
  /// A light that reaches a place from one direction.
  struct Beam
  {
    std::unique_ptr<SourceFlux> Flux;
    std::unique_ptr<ShadowCutter> Shadow;
    std::size_t Index; // among the scene's lights
  };
  const std::vector<Beam>& AllBeams() const { return this->Beams; }
  const RadianceEffects& Follows() const { return this->Effects; }
  double Exponent(std::int32_t cell, bool front) const;
  /// Greatest irradiance of point, spot and directional lights, no cosine, anywhere within `radius` of
  /// a place, any band; infinite where one may be there.
  double GreatestBeams(const Vec3& center, double radius) const;

private:
  struct Panel
  {
    Triangle3 Corners;
    Vec3 Normal;
    double Area;
    double Chance; // of being chosen
    std::vector<double> Radiance;
    std::int32_t Triangle; // of the scene that it lies on; -1: a light of its own
    bool Front = true;
  };
  struct Walk;

  void AddPanels();
  void AddPanel(const Triangle3& corners, const double* exitance, std::int32_t triangle, bool front);
  double Lobe(const Place& place, double exponent, const Vec3& in) const;
  double LobeDensity(const Place& place, const Vec3& in) const;
  double Bounce(const Place& at, const std::array<double, 4>& u, Vec3& direction,
    double& density) const;
  double PanelDensity(const Panel& panel, const Vec3& way) const;
  void AddBeams(Walk& walk) const;
  void AddPanelSample(Walk& walk, const std::array<double, 4>& u) const;
  bool Follow(Walk& walk) const;
  void AddSky(Walk& walk) const;

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const DiffuseLight& Diffuse;
  RadianceEffects Effects;
  std::size_t Bands;
  SpecularSurfaces Surfaces;
  std::vector<Beam> Beams;
  std::vector<Panel> Panels;
  std::vector<double> Cumulative; // of the panels' chances
  std::vector<std::size_t> Lights; // panels that are no part of the scene
  std::vector<std::array<std::int32_t, 2>> PanelOf; // by triangle and side; -1: none; empty: no emitters
  struct SkyLight
  {
    const Light* Source;
    SkyFrame Axes;
  };
  std::vector<SkyLight> Skies;
  double Extent = 0.0;
  double Greatest = 0.0;
};

} // namespace radiometry
