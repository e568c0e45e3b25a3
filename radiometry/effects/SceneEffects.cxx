// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/SceneEffects.h"

#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiometry
{
namespace
{

double Greatest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}
double Greatest(const std::array<std::vector<double>, 2>& sides)
{
  return std::max(Greatest(sides[0]), Greatest(sides[1]));
}
double GreatestTransmittance(const Scene& scene)
{
  return std::max(Greatest(scene.Optics.Transmittance), Greatest(scene.TriangleTransmittance));
}
bool AnyOn(const std::vector<std::uint8_t>& flags)
{
  return std::any_of(flags.begin(), flags.end(), [](std::uint8_t f) { return f != 0; });
}

/// True when every light is finite and lies before the plane of every triangle, area lights perhaps on
/// it.
bool LightsInside(const Scene& scene)
{
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  for (const Light& light : scene.Lights)
  {
    if (!light.Enabled)
    {
      continue;
    }
    if (light.Type == LightType::Directional || light.Type == LightType::Environment)
    {
      return false;
    }
    const std::vector<Vec3> places =
      light.Type == LightType::Area ? light.Polygon : std::vector<Vec3>{ light.Position };
    for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
    {
      const Triangle3 v = scene.TriangleAt(t);
      const Vec3 n = Normalized(AreaNormal2(v));
      // A panel that lies on a surface is not hidden by it.
      const double least = light.Type == LightType::Area ? -1e-12 * extent : 0.0;
      if (std::any_of(places.begin(), places.end(), [&](const Vec3& p) {
            const double height = Dot(n, p - v[0]);
            return least < 0.0 ? height < least : height <= 0.0;
          }))
      {
        return false;
      }
    }
  }
  return true;
}

/// Specular reflectance of a triangle's cell, the greatest of sides and bands.
double SpecularOf(const Materials& optics, std::int32_t cell)
{
  double greatest = 0.0;
  for (const std::vector<double>& values : optics.SpecularReflectance)
  {
    for (int b = 0; b < optics.Bands && !values.empty(); ++b)
    {
      greatest = std::max(greatest, values[static_cast<std::size_t>(cell * optics.Bands + b)]);
    }
  }
  return greatest;
}

/// What all mirrors send on of point-like and directional lights and of skies (of which no plane gets
/// more than `sky`, W/m^2), were nothing in the way and every
/// mirror two-sided [W, brightest band], and the smallest cell's area it may fall on.
double SpecularFlux(const Scene& scene, double sky, double& smallest)
{
  constexpr double Sphere = 4.0 * 3.14159265358979323846;
  constexpr std::size_t MostPairs = 20000000;
  std::vector<double> areas(scene.Cells, 0.0);
  std::vector<std::size_t> mirrors;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    areas[static_cast<std::size_t>(scene.TriangleCell[t])] += Area(scene.TriangleAt(t));
    if (SpecularOf(scene.Optics, scene.TriangleCell[t]) > 0.0)
    {
      mirrors.push_back(t);
    }
  }
  smallest = std::numeric_limits<double>::infinity();
  for (const double a : areas)
  {
    smallest = a > 0.0 ? std::min(smallest, a) : smallest;
  }
  const bool few = mirrors.size() * scene.Lights.size() <= MostPairs;
  const double most = Greatest(scene.Optics.SpecularReflectance);
  double flux = 0.0;
  for (const std::size_t t : mirrors)
  {
    flux += 2.0 * sky * SpecularOf(scene.Optics, scene.TriangleCell[t]) * Area(scene.TriangleAt(t));
  }
  for (const Light& light : scene.Lights)
  {
    if (!light.Enabled || light.Type == LightType::Area || light.Type == LightType::Environment)
    {
      continue;
    }
    const double intensity = Greatest(light.Intensity);
    const bool beam = light.Type == LightType::Directional;
    if (!few && !beam)
    {
      flux += most * intensity * Sphere;
      continue;
    }
    for (const std::size_t t : mirrors)
    {
      const Triangle3 v = scene.TriangleAt(t);
      const double reflected = SpecularOf(scene.Optics, scene.TriangleCell[t]) * intensity;
      flux += reflected *
        (beam ? std::fabs(0.5 * Dot(AreaNormal2(v), light.Direction))
              : std::fabs(SolidAngle(v[0] - light.Position, v[1] - light.Position,
                  v[2] - light.Position)));
    }
  }
  return flux;
}

/// The greatest pi L of panels, W/m^2, brightest band.
double GreatestExtended(const Scene& scene)
{
  double greatest = 0.0;
  for (const Light& light : scene.Lights)
  {
    if (light.Enabled && light.Type == LightType::Area)
    {
      greatest = std::max(greatest, Greatest(light.Intensity));
    }
  }
  return greatest;
}

} // namespace

SceneEffects::SceneEffects(const Scene& scene, const std::vector<EffectSwitch>& switches,
  const EffectAbilities& abilities, const std::vector<SurfacePoint>& points, bool cells)
  : Whole(scene)
  , Groups(SingleBands(scene.Optics.Bands))
  , Decided(switches)
  , Indirect(abilities.Interreflection)
  , Paths(abilities.Paths)
{
  const bool freePoints =
    std::any_of(points.begin(), points.end(), [](const SurfacePoint& p) { return p.Triangle < 0; });
  EffectPlan& plan = this->Decided;
  const Materials& optics = scene.Optics;
  const Convexity convexity = FindConvexity(scene);
  const bool twoSided = AnyOn(optics.TwoSided);

  bool spots = false;
  bool legacy = false;
  bool environment = false;
  bool any = false;
  for (const Light& light : scene.Lights)
  {
    if (light.Enabled)
    {
      any = true;
      spots = spots || light.Type == LightType::Spot;
      legacy = legacy ||
        (light.Type != LightType::Directional && light.Type != LightType::Environment &&
          !light.InverseSquare());
      environment = environment || light.Type == LightType::Environment;
    }
  }
  const double emitted = Greatest(optics.EmittedExitance);
  const double reflectance = Greatest(optics.DiffuseReflectance);
  const double specular = Greatest(optics.SpecularReflectance);
  const double transmitted = GreatestTransmittance(scene);
  const double diffused = Greatest(optics.DiffuseTransmittance);
  const bool lit = any || emitted > 0.0 || Greatest(scene.GlobalAmbient) > 0.0;

  const bool backs = twoSided || diffused > 0.0; // receive light
  const bool shadowless = !backs && !(freePoints && !scene.Triangles.empty()) &&
    (convexity == Convexity::Body || (convexity == Convexity::Room && LightsInside(scene)));
  plan.Decide(Effect::Occlusion, (any || emitted > 0.0) && !shadowless && !scene.Triangles.empty(), true,
    scene.Triangles.empty() || (!any && emitted <= 0.0)
      ? (scene.Triangles.empty() ? "there is no surface" : "no light is on")
      : (convexity == Convexity::Body ? "the surface is a convex body: no face hides a light from another"
                                      : "a convex room with its lights inside: nothing stands between"),
    "surfaces may stand between a light and a cell");
  plan.Decide(Effect::Interreflection,
    (reflectance > 0.0 || diffused > 0.0) && (convexity != Convexity::Body || backs) && lit,
    abilities.Interreflection,
    reflectance <= 0.0 && diffused <= 0.0 ? "no surface reflects diffusely"
                       : (lit ? "no front faces another" : "no light is on"),
    "surfaces face each other and reflect up to " + std::to_string(reflectance) +
      (diffused > 0.0 ? ", let through diffusely up to " + std::to_string(diffused) : ""));
  const bool facing = convexity != Convexity::Body || backs || freePoints;
  const std::string noPaths = abilities.NoPaths.empty() ? "" : " (" + abilities.NoPaths + ")";
  plan.Decide(Effect::SpecularTransport, specular > 0.0 && facing && lit, abilities.Paths,
    specular <= 0.0 ? "no surface reflects specularly"
                    : (lit ? "nothing faces the surfaces that reflect specularly" : "no light is on"),
    "surfaces reflect specularly up to " + std::to_string(specular) +
      (abilities.Paths ? ": light is followed over them" : noPaths));
  EffectDecision& mirrors = plan[Effect::SpecularTransport];
  const double lost = 1.0 - reflectance - specular - transmitted - diffused;
  if (mirrors.Simulated && specular <= 0.1 * abilities.RelativeTolerance * lost &&
    mirrors.Wish == EffectSwitch::Auto)
  {
    mirrors.Simulated = false;
    mirrors.Dropped = true;
    mirrors.Why = "surfaces reflect specularly up to " + std::to_string(specular) +
      " only: less than a tenth of the tolerance";
  }
  this->Panes = transmitted > 0.0 && plan[Effect::Occlusion].Present;
  const std::string through = diffused > 0.0
    ? "cells let up to " + std::to_string(diffused) + " of the light through diffusely" +
      (this->Indirect ? "" : " (direct light alone does not follow it: bound given)")
    : "";
  const std::string follows = !this->Indirect
    ? " of the direct light through"
    : (abilities.Paths ? " of the direct light and of what surfaces send or reflect through"
                       : " of the direct light through; what surfaces send or reflect does not pass "
                         "them (bound given)" + noPaths);
  const std::string straight =
    this->Panes ? "panes let up to " + std::to_string(transmitted) + follows : "";
  plan.Decide(Effect::Transmission, this->Panes || diffused > 0.0, abilities.Transmission,
    transmitted > 0.0 ? "nothing stands between a light and a cell" : "every surface is opaque",
    straight + (this->Panes && diffused > 0.0 ? "; " : "") + through);
  plan.Decide(Effect::BackFaces, twoSided, true, "no surface is two-sided",
    "two-sided surfaces receive on their backs");
  plan.Decide(Effect::Emission, emitted > 0.0, abilities.Emission, "no surface emits",
    "surfaces emit light of their own");
  plan.Decide(Effect::Environment, environment, abilities.Environment, "there is no environment light",
    "there is an environment light");
  plan.Decide(Effect::SpotShape, spots, true, "there is no spot light",
    "spot lights have a cone or an exponent");
  plan.Decide(Effect::Attenuation, legacy, true, "all lights obey the inverse square law",
    "lights carry a legacy attenuation a + b r + c r^2 other than r^2");
  this->DecideLights();
  bool perfect = false;
  for (std::size_t cell = 0; cell < scene.Cells && specular > 0.0 && !perfect; ++cell)
  {
    perfect = IsMirror(optics, 0, cell) || IsMirror(optics, 1, cell);
  }
  const bool transport = plan.Simulates(Effect::SpecularTransport);
  plan.Decide(Effect::Mirrors, perfect, transport || !plan[Effect::SpecularTransport].Present,
    "every surface that reflects specularly has a lobe",
    transport ? "surfaces reflect specularly without a lobe" : "left out with SpecularTransport");
  plan[Effect::Mirrors].Present = perfect && plan[Effect::SpecularTransport].Present;
  this->DecideBands();
  this->DecideSampling(abilities, points, cells);
  this->Reduce();
}

void SceneEffects::DecideLights()
{
  static constexpr std::pair<Effect, LightType> kinds[] = {
    { Effect::PointLights, LightType::Point }, { Effect::SpotLights, LightType::Spot },
    { Effect::DirectionalLights, LightType::Directional }, { Effect::AreaLights, LightType::Area }
  };
  const auto count = [&](auto test) {
    return std::count_if(this->Whole.Lights.begin(), this->Whole.Lights.end(),
      [&](const Light& light) { return light.Enabled && test(light); });
  };
  EffectPlan& plan = this->Decided;
  static const char* const words[] = { "point light", "spot light", "directional light",
    "area light" };
  for (std::size_t k = 0; k < std::size(kinds); ++k)
  {
    const auto lights = count([&](const Light& l) { return l.Type == kinds[k].second; });
    const std::string word = words[k];
    plan.Decide(kinds[k].first, lights > 0, true, "no " + word + " is on",
      std::to_string(lights) + ' ' + word + (lights > 1 ? "s are on" : " is on"));
  }
  const auto webs =
    count([](const Light& l) { return l.Type == LightType::Point && l.Web != nullptr; });
  plan.Decide(Effect::CandelaWebs, webs > 0, true, "no light has a candela web",
    std::to_string(webs) + (webs > 1 ? " lights have candela webs" : " light has a candela web"));
  const bool ambient = Greatest(this->Whole.GlobalAmbient) > 0.0;
  plan.Decide(Effect::GlobalAmbient, ambient, true, "there is no global ambient light",
    "every point gets ambient light that nothing hides");
}

void SceneEffects::DecideBands()
{
  EffectPlan& plan = this->Decided;
  const int bands = this->Whole.Optics.Bands;
  const EffectSwitch wish = plan[Effect::SpectralBands].Wish;
  if (bands > 1 && wish != EffectSwitch::On)
  {
    this->Groups = FindBandGroups(this->Whole);
  }
  const auto groups = static_cast<int>(this->Groups.Size());
  const bool differ = bands > 1 && (groups > 1 || wish == EffectSwitch::On);
  plan.Decide(Effect::SpectralBands, differ, true,
    bands > 1 ? "the " + std::to_string(bands) + " bands are equal: one is computed and copied"
              : "there is one band",
    wish == EffectSwitch::On || groups == bands
      ? std::to_string(bands) + " bands are computed one by one"
      : std::to_string(groups) + " of " + std::to_string(bands) +
        " bands differ; the others are copies of these");
}

void SceneEffects::DecideSampling(
  const EffectAbilities& abilities, const std::vector<SurfacePoint>& points, bool cells)
{
  EffectPlan& plan = this->Decided;
  plan[Effect::PointSampling].Wish = EffectSwitch::Auto;
  plan.Decide(Effect::PointSampling, !points.empty(), true,
    "averages over cells are wanted: they are integrals, not samples",
    std::to_string(points.size()) + " values are wanted at points" +
      (cells ? ", beside averages over cells" : ""));
  plan[Effect::Discretisation].Wish = abilities.Refinement;
  plan.Decide(Effect::Discretisation, plan.Simulates(Effect::Interreflection),
    abilities.Interreflection,
    this->Indirect ? "no light goes from surface to surface: there are no elements"
                   : "direct light is integrated over each cell: there are no elements",
    "what each surface reflects varies over it: the solve may take finer elements than the cells");
}

void SceneEffects::Reduce()
{
  const EffectPlan& plan = this->Decided;
  static constexpr Effect kinds[] = { Effect::PointLights, Effect::SpotLights,
    Effect::DirectionalLights, Effect::AreaLights, Effect::Environment };
  SceneParts parts;
  bool less = false;
  for (std::size_t k = 0; k < std::size(kinds); ++k)
  {
    parts.WithoutLights[k] = plan.LeavesOut(kinds[k]);
    less = less || parts.WithoutLights[k];
  }
  parts.WithoutWebs = plan.LeavesOut(Effect::CandelaWebs);
  parts.WithoutMirrors =
    plan.LeavesOut(Effect::Mirrors) && plan.Simulates(Effect::SpecularTransport);
  parts.Grey = plan.LeavesOut(Effect::SpectralBands);
  if (parts.Grey)
  {
    this->Groups.Group.assign(this->Groups.Group.size(), 0);
    this->Groups.Firsts.assign(1, 0);
  }
  if (less || parts.WithoutWebs || parts.WithoutMirrors || !this->Groups.AllApart())
  {
    this->Reduced = std::make_unique<Scene>(ReduceScene(this->Whole, parts, this->Groups));
  }
}

bool SceneEffects::CallsForPaths() const
{
  return this->Paths &&
    (this->Decided.Simulates(Effect::SpecularTransport) || this->PassesPanes());
}

void SceneEffects::Bound(
  double peak, double peakBack, double spot, double attenuation, double sky)
{
  const Scene& scene = this->Whole;
  EffectPlan& plan = this->Decided;
  const double infinite = std::numeric_limits<double>::infinity();
  const Materials& optics = scene.Optics;
  const double emitted = Greatest(optics.EmittedExitance);
  const double specular = Greatest(optics.SpecularReflectance);
  const double transmitted = GreatestTransmittance(scene);
  const double ambient = Greatest(scene.GlobalAmbient);
  const double diffuse = Greatest(optics.DiffuseReflectance);
  const double diffused = Greatest(optics.DiffuseTransmittance);
  const double reflectance = diffuse + specular + transmitted + diffused;
  // No point gets more than all that any surface sends, were it all around it: E0/(1 - rho).
  const double direct = std::max(peak, peakBack);
  const double sent = (direct + ambient) * reflectance + emitted;
  const double indirect = reflectance < 1.0 ? sent / (1.0 - reflectance) : infinite;
  const auto orNothing = [](double factor, double value) { return factor > 0.0 ? value : 0.0; };

  // Through panes: what comes straight; then all that any surface sends, and what that adds by
  // reflection.
  const double passing = this->Indirect && !this->Paths
    ? orNothing(transmitted,
        reflectance < 1.0 ? transmitted * indirect / (1.0 - diffuse - diffused) : infinite)
    : 0.0;
  // What cells that diffuse send on, and what that adds by reflection.
  const double spread = orNothing(diffused,
    reflectance < 1.0 ? diffused * (direct + ambient + indirect) / (1.0 - reflectance) : infinite);

  // Over mirrors the radiance of extended sources stays what it is; that of points may be gathered.
  double specularBound = 0.0;
  const EffectDecision& mirrors = plan[Effect::SpecularTransport];
  if (mirrors.Present && !mirrors.Simulated)
  {
    double smallest = 0.0;
    const double flux = SpecularFlux(scene, sky, smallest);
    const double extended =
      specular * (GreatestExtended(scene) + ambient + indirect + emitted);
    specularBound = reflectance < 1.0
      ? (extended + orNothing(flux, flux / smallest)) / (1.0 - reflectance)
      : orNothing(extended + flux, infinite);
  }

  const double reflected = reflectance < 1.0
    ? (peak + ambient + emitted) * reflectance / (1.0 - reflectance)
    : orNothing(peak + ambient + emitted, infinite);
  const auto withReflection = [&](double value) {
    return orNothing(value, reflectance < 1.0 ? value / (1.0 - reflectance) : infinite);
  };
  const std::pair<Effect, double> bounds[] = {
    { Effect::Occlusion, peak + emitted },
    { Effect::Interreflection, reflected },
    { Effect::SpecularTransport, specularBound },
    { Effect::Transmission,
      orNothing(transmitted, transmitted * (direct + emitted) + passing) + spread },
    { Effect::BackFaces, peakBack },
    { Effect::Emission, withReflection(emitted) },
    { Effect::Environment, withReflection(sky) },
    { Effect::SpotShape, spot },
    { Effect::Attenuation, attenuation },
    { Effect::PointLights, withReflection(direct) },
    { Effect::SpotLights, withReflection(direct) },
    { Effect::DirectionalLights, withReflection(direct) },
    { Effect::AreaLights, withReflection(direct) },
    { Effect::CandelaWebs, infinite },
    { Effect::Mirrors, specularBound },
    { Effect::SpectralBands, infinite },
    { Effect::Discretisation, withReflection(direct) },
  };
  for (const auto& [effect, bound] : bounds)
  {
    plan[effect].Bound = plan.LeavesOut(effect) ? bound : 0.0;
  }
  EffectDecision& panes = plan[Effect::Transmission];
  if (panes.Present && panes.Simulated)
  {
    panes.Bound = passing + (this->Indirect ? 0.0 : spread);
  }
}

} // namespace radiometry
