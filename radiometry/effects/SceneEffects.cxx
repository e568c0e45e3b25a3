// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/SceneEffects.h"

#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace radiometry
{
namespace
{

double Greatest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
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

/// How the surfaces that receive stand to each other: what only blocks light sends none.
Convexity AmongReceivers(const Scene& scene, Convexity all)
{
  if (scene.Triangles.size() == scene.ReceiverTriangles || scene.ReceiverTriangles == 0)
  {
    return all;
  }
  Scene part;
  std::vector<std::int32_t> number(scene.Points.size(), -1);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    std::array<std::int32_t, 3> corners = scene.Triangles[t];
    for (std::int32_t& c : corners)
    {
      std::int32_t& n = number[static_cast<std::size_t>(c)];
      if (n < 0)
      {
        n = static_cast<std::int32_t>(part.Points.size());
        part.Points.push_back(scene.Points[static_cast<std::size_t>(c)]);
      }
      c = n;
    }
    part.Triangles.push_back(corners);
  }
  return FindConvexity(part);
}

} // namespace

SceneEffects::SceneEffects(const Scene& scene, const std::vector<EffectSwitch>& switches,
  const EffectAbilities& abilities, const std::vector<SurfacePoint>& points, bool cells)
  : Whole(scene)
  , Groups(SingleBands(scene.Optics.Bands))
  , Decided(switches)
  , Limits(scene, points, cells)
  , RelativeTolerance(abilities.RelativeTolerance)
  , AbsoluteTolerance(abilities.AbsoluteTolerance)
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
  const OpticalLimits& surfaces = this->Limits.Surfaces();
  const double emitted = surfaces.Emitted;
  const double reflectance = surfaces.Reflected;
  const double specular = surfaces.Specular;
  const double transmitted = surfaces.Pane;
  const double diffused = surfaces.Diffused;
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
    (reflectance > 0.0 || diffused > 0.0) &&
      (AmongReceivers(scene, convexity) != Convexity::Body || backs || freePoints) && lit,
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
    specular > 0.0 ? "every surface that reflects specularly has a lobe"
                   : "no surface reflects specularly",
    transport ? "surfaces reflect specularly without a lobe" : "left out with SpecularTransport");
  plan[Effect::Mirrors].Present = perfect && plan[Effect::SpecularTransport].Present;
  this->DecideBands();
  this->DecideSampling(abilities, points, cells);
  if (abilities.Drops)
  {
    this->DropSmall(abilities);
  }
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

const std::vector<SurfacePoint>& SceneEffects::NoPoints()
{
  static const std::vector<SurfacePoint> none;
  return none;
}

bool SceneEffects::FollowsLight() const
{
  return this->Indirect &&
    (this->Decided.Simulates(Effect::Interreflection) || this->CallsForPaths());
}

double SceneEffects::Allowed(double least) const
{
  return 0.25 * std::max(this->AbsoluteTolerance, this->RelativeTolerance * least);
}

bool SceneEffects::Drop(Effect effect, double allowed)
{
  EffectPlan& plan = this->Decided;
  const EffectDecision& d = plan[effect];
  if (!d.Simulated || !d.Present || d.Wish != EffectSwitch::Auto || !(allowed > 0.0) ||
    !plan.Drop(effect, this->Limits.Of(effect, plan, this->FollowsLight()), allowed))
  {
    return false;
  }
  EffectDecision& mirrors = plan[Effect::Mirrors];
  if (effect == Effect::SpecularTransport && mirrors.Simulated)
  {
    mirrors.Simulated = false;
    mirrors.Dropped = true; // the bound is that of SpecularTransport
    mirrors.Why += "; dropped with SpecularTransport, whose bound holds for both";
  }
  return true;
}

/// True for the one kind of light that there is: beside nothing it is not small.
bool SceneEffects::IsAllLight(Effect effect) const
{
  if (this->AbsoluteTolerance > 0.0 || !this->Whole.GlobalAmbient.empty())
  {
    return false;
  }
  int sources = 0;
  bool source = false;
  for (const Effect kind : { Effect::Environment, Effect::AreaLights, Effect::Emission,
         Effect::PointLights, Effect::SpotLights, Effect::DirectionalLights })
  {
    sources += this->Decided[kind].Present && this->Decided[kind].Simulated ? 1 : 0;
    source = source || kind == effect;
  }
  return source && sources <= 1;
}

void SceneEffects::DropSmall(const EffectAbilities& abilities)
{
  // What takes longest comes first. Backs stay: their values are asked for. Without a light there is
  // nothing that could be hidden.
  std::vector<Effect> candidates;
  for (const Effect effect : { Effect::SpecularTransport, Effect::Interreflection,
         Effect::Transmission, Effect::Environment, Effect::AreaLights, Effect::Emission,
         Effect::CandelaWebs, Effect::Attenuation, Effect::SpotShape, Effect::PointLights,
         Effect::SpotLights, Effect::DirectionalLights, Effect::Mirrors, Effect::SpectralBands })
  {
    const EffectDecision& d = this->Decided[effect];
    if (d.Present && d.Simulated && d.Wish == EffectSwitch::Auto && !this->IsAllLight(effect))
    {
      candidates.push_back(effect);
    }
  }
  // Bounds are found only where they may serve: they cost about what direct light in the open does.
  const bool occlusion = !abilities.Interreflection && this->Decided[Effect::Occlusion].Present;
  if (candidates.empty() && !occlusion)
  {
    return;
  }
  const double allowed = this->Allowed(
    this->RelativeTolerance > 0.0 ? this->Limits.LeastValue(this->Decided) : 0.0);
  if (!(allowed > 0.0))
  {
    return;
  }
  for (const Effect effect : candidates)
  {
    this->Drop(effect, allowed);
  }
  if (!abilities.Interreflection)
  {
    this->Drop(Effect::Occlusion, allowed);
  }
}

void SceneEffects::Spent(const std::array<double, 3>& kinds, double others)
{
  EffectPlan& plan = this->Decided;
  const Scene& scene = this->Simulated();
  std::array<double, 5> lights{};
  for (const Light& light : scene.Lights)
  {
    lights[static_cast<std::size_t>(light.Type)] += light.Enabled ? 1.0 : 0.0;
  }
  double emitters = 0.0;
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (const std::vector<double>& emitted : scene.Optics.EmittedExitance)
  {
    for (std::size_t k = 0; k < emitted.size() && plan.Simulates(Effect::Emission); k += bands)
    {
      emitters += emitted[k] > 0.0 ? 1.0 : 0.0;
    }
  }
  const auto share = [&](double seconds, std::initializer_list<std::pair<Effect, double>> among) {
    double all = 0.0;
    for (const auto& [effect, count] : among)
    {
      all += count;
    }
    for (const auto& [effect, count] : among)
    {
      plan[effect].Seconds += count > 0.0 ? seconds * count / all : 0.0;
    }
  };
  share(kinds[0], { { Effect::PointLights, lights[0] }, { Effect::SpotLights, lights[1] },
    { Effect::DirectionalLights, lights[2] } });
  share(kinds[1], { { Effect::AreaLights, lights[3] }, { Effect::Emission, emitters } });
  share(kinds[2], { { Effect::Environment, lights[4] } });
  plan[Effect::Occlusion].Seconds += plan.Simulates(Effect::Occlusion) ? std::max(0.0, others) : 0.0;
}

void SceneEffects::Bound(double computed)
{
  EffectPlan& plan = this->Decided;
  for (int k = 0; k < EffectCount; ++k)
  {
    const auto effect = static_cast<Effect>(k);
    EffectDecision& d = plan[effect];
    if (d.Known && !d.Dropped)
    {
      d.Bound = plan.LeavesOut(effect)
        ? this->Limits.Of(effect, plan, this->FollowsLight(), computed)
        : 0.0;
    }
  }
  EffectDecision& panes = plan[Effect::Transmission];
  if (panes.Present && panes.Simulated)
  {
    panes.Bound = this->Limits.OfTransmissionBeside(plan, this->Indirect, this->Paths);
  }
}

} // namespace radiometry
