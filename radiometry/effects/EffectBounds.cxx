// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/EffectBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace radiometry
{
namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();
constexpr std::array<bool, 5> AllKinds{ true, true, true, true, true };

double Greatest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}
/// 0 where nothing is passed on, however much of it there were.
double Times(double factor, double value)
{
  return factor > 0.0 && value > 0.0 ? factor * value : 0.0;
}
double Rest(double share)
{
  return share < 1.0 ? 1.0 / (1.0 - share) : Infinite;
}
std::array<bool, 5> Only(LightType kind)
{
  std::array<bool, 5> kinds{};
  kinds[static_cast<std::size_t>(kind)] = true;
  return kinds;
}
std::size_t IndexOf(LightType kind)
{
  return static_cast<std::size_t>(kind);
}

} // namespace

EffectBounds::EffectBounds(
  const Scene& scene, const std::vector<SurfacePoint>& points, bool cells)
  : Whole(scene)
  , Points(points)
  , Cells(cells)
  , Optics(FindOpticalLimits(scene))
  , Ambient(Greatest(scene.GlobalAmbient))
{
}

double EffectBounds::LeastValue(const EffectPlan& plan) const
{
  const double ambient = this->Whole.GlobalAmbient.empty()
    ? 0.0
    : *std::min_element(this->Whole.GlobalAmbient.begin(), this->Whole.GlobalAmbient.end());
  const bool open = !plan[Effect::Occlusion].Present && !this->Optics.TwoSided &&
    plan[Effect::BackFaces].Wish != EffectSwitch::On;
  const bool all = plan[Effect::PointLights].Wish != EffectSwitch::Off &&
    plan[Effect::SpotLights].Wish != EffectSwitch::Off &&
    plan[Effect::DirectionalLights].Wish != EffectSwitch::Off;
  return ambient +
    (open && all && this->Whole.ReceiverTriangles > 0
        ? LeastLight(this->Whole, this->Points, this->Cells)
        : 0.0);
}

namespace
{

LightVariants VariantsOf(const EffectPlan& plan)
{
  // An effect that is left out, or may yet be: both variants are bounded.
  LightVariants v;
  v.SpotShape = plan.LeavesOut(Effect::SpotShape);
  v.Attenuation = plan.LeavesOut(Effect::Attenuation);
  v.CandelaWebs = plan.LeavesOut(Effect::CandelaWebs);
  return v;
}

} // namespace

const LightBounds& EffectBounds::First(const EffectPlan& plan)
{
  if (!this->Light)
  {
    const bool backs = this->Optics.TwoSided || this->Optics.Diffused > 0.0 ||
      plan.Simulates(Effect::BackFaces); // or only asked for, of points
    this->Light = std::make_unique<LightBounds>(
      BoundLights(this->Whole, this->Points, this->Cells, backs, VariantsOf(plan)));
  }
  return *this->Light;
}

const FirstReflection& EffectBounds::ReflectedOnce(const EffectPlan& plan)
{
  if (!this->Once)
  {
    this->Once = std::make_unique<FirstReflection>(BoundFirstReflection(
      this->Whole, this->Points, this->Cells, this->First(plan), this->Optics.Diffused > 0.0));
  }
  return *this->Once;
}

SpecularReach EffectBounds::Specular(const EffectPlan& plan, const std::array<bool, 5>& kinds,
  const FirstReflection* straight)
{
  if (!plan[Effect::SpecularTransport].Present)
  {
    return {};
  }
  const bool cellsOnly = this->Cells && this->Points.empty();
  const LightVariants variants = VariantsOf(plan);
  return straight
    ? BoundSpecular(this->Whole, this->Optics, cellsOnly, kinds, variants, *straight)
    : BoundSpecular(this->Whole, this->Optics, cellsOnly, kinds, variants);
}

const SpecularReach& EffectBounds::AllSpecular(const EffectPlan& plan)
{
  if (!this->Mirrored)
  {
    const bool specular = plan[Effect::SpecularTransport].Present;
    this->Mirrored = std::make_unique<SpecularReach>(
      this->Specular(plan, AllKinds, specular ? &this->ReflectedOnce(plan) : nullptr));
  }
  return *this->Mirrored;
}

double EffectBounds::Spread(double peak, double flux) const
{
  const double area = this->Optics.SmallestCell;
  const double most = this->Cells && this->Points.empty() && area > 0.0
    ? std::min(peak, flux / area)
    : peak;
  return Times(Rest(this->Optics.Total), Times(this->Optics.Scattered, most));
}

double EffectBounds::Emitted() const
{
  const OpticalLimits& o = this->Optics;
  const double all = Times(o.Emitted, Rest(o.Carried));
  return this->Cells && this->Points.empty() && o.SmallestCell > 0.0
    ? std::min(all, Times(o.EmittedFlux, Rest(o.Carried) / o.SmallestCell))
    : all;
}

double EffectBounds::SpreadLights(const EffectPlan& plan, int bounces)
{
  const OpticalLimits& o = this->Optics;
  const LightBounds& first = this->First(plan);
  const double plain = Times(
    bounces > 0 ? std::pow(o.Total, bounces) : 1.0, this->Spread(first.All.Peak, first.All.Flux));
  if (!(plain > 0.0) || first.Spots.empty())
  {
    return plain;
  }
  const FirstReflection& once = this->ReflectedOnce(plan);
  const double d = o.Scattered;
  double carried = Times(Times(o.Carried, Rest(o.Carried)), d * first.All.Peak);
  if (!(o.Pane > 0.0))
  {
    carried = std::min(carried, Times(Times(o.Lobe, Rest(o.Lobe)), d * once.Peak));
  }
  const double further = this->Spread(d * once.Peak + carried, Infinite);
  return std::min(plain,
    bounces > 0 ? Times(std::pow(o.Total, bounces - 1), further)
                : d * once.Value + carried + further);
}

double EffectBounds::Interreflection(const EffectPlan& plan, int bounces)
{
  const double emitted = Times(this->Optics.Emitted, Rest(this->Optics.Carried));
  const double steady = this->Ambient + this->AllSpecular(plan).Peak + emitted;
  return this->SpreadLights(plan, bounces) +
    Times(bounces > 0 ? std::pow(this->Optics.Total, bounces) : 1.0, this->Spread(steady, Infinite));
}

int EffectBounds::BouncesFor(double allowed, const EffectPlan& plan, int most)
{
  const double all = this->Interreflection(plan);
  if (all <= allowed)
  {
    return 0;
  }
  const double share = this->Optics.Total;
  if (!(allowed > 0.0) || !std::isfinite(all) || !(share < 1.0))
  {
    return -1;
  }
  int count = 1;
  while (count <= most && this->Interreflection(plan, count) > allowed)
  {
    ++count;
  }
  return count <= most ? count : -1;
}

double EffectBounds::AllSent(const EffectPlan& plan)
{
  return this->Emitted() + this->Interreflection(plan);
}

double EffectBounds::OfLights(const EffectPlan& plan, const LightReach& reach,
  const std::array<bool, 5>& kinds, bool indirect)
{
  if (!indirect)
  {
    return reach.Value;
  }
  const SpecularReach over = this->Specular(plan, kinds);
  return reach.Value + over.Value + this->Spread(reach.Peak, reach.Flux) +
    this->Spread(over.Peak, Infinite);
}

double EffectBounds::OfBands(const EffectPlan& plan, bool indirect)
{
  const LightBounds& first = this->First(plan);
  const OpticalLimits& o = this->Optics;
  const double most =
    first.All.Value + this->Ambient + (indirect ? this->AllSent(plan) : this->Emitted());
  if (o.Spread.Carried > 0.0)
  {
    return most + (indirect ? this->AllSpecular(plan).Value : 0.0);
  }
  // How far each light's bands are from their mean, relative to the brightest.
  double relative = 0.0;
  for (const radiometry::Light& light : this->Whole.Lights)
  {
    const double brightest = Brightest(light);
    if (!light.Enabled || !(brightest > 0.0))
    {
      continue;
    }
    const double mean = std::accumulate(light.Intensity.begin(), light.Intensity.end(), 0.0) /
      static_cast<double>(light.Intensity.size());
    for (const double i : light.Intensity)
    {
      relative = std::max(relative, std::fabs(i - mean) / brightest);
    }
    if (light.Type == LightType::Environment)
    {
      relative = 1.0; // its map may have any colours
    }
  }
  double ambient = 0.0;
  const std::vector<double>& given = this->Whole.GlobalAmbient;
  const double mean = given.empty()
    ? 0.0
    : std::accumulate(given.begin(), given.end(), 0.0) / static_cast<double>(given.size());
  for (const double a : given)
  {
    ambient = std::max(ambient, std::fabs(a - mean));
  }
  const double emitted = Times(o.Spread.Emitted, Rest(o.Carried));
  const double direct = relative * first.All.Value + ambient + emitted;
  if (!indirect)
  {
    return std::min(direct, most);
  }
  // What is sent differs by d times what arrives, and by the difference of d times all that arrives.
  const SpecularReach& over = this->AllSpecular(plan);
  const double specular = relative * over.Value;
  const double arrives = first.All.Peak + this->Ambient + over.Peak + this->AllSent(plan);
  const double changed = o.Spread.Emitted +
    o.Scattered * (relative * (first.All.Peak + over.Peak) + ambient) +
    Times(o.Spread.Scattered, arrives);
  return std::min(
    direct + specular + Times(changed, Rest(o.Total)), most + over.Value);
}

double EffectBounds::OfTransmissionBeside(const EffectPlan& plan, bool indirect, bool paths)
{
  const OpticalLimits& o = this->Optics;
  const double rest = Rest(o.Total);
  if (indirect)
  {
    return paths ? 0.0 : Times(rest, Times(o.Pane, this->AllSent(plan)));
  }
  if (!(o.Diffused > 0.0))
  {
    return 0.0;
  }
  const double arrives = this->First(plan).All.Peak + this->Ambient +
    this->AllSpecular(plan).Peak + this->AllSent(plan);
  return Times(rest, Times(o.Diffused, arrives));
}

double EffectBounds::Of(Effect effect, const EffectPlan& plan, bool indirect, double computed)
{
  const OpticalLimits& o = this->Optics;
  const auto sky = IndexOf(LightType::Environment);
  const double rest = Rest(o.Total);
  const auto kind = [&](LightType type) {
    return this->OfLights(
      plan, this->First(plan).Kinds[IndexOf(type)], Only(type), indirect);
  };
  const auto specular = [&](double value, double peak, double reflectance) {
    const double through = Rest(o.Pane);
    const double carried =
      Times(through, Times(reflectance, this->Ambient + this->AllSent(plan)));
    const double again = Times(o.Scattered, through);
    return value + carried + Times(Times(again, Rest(again)), peak + carried);
  };
  switch (effect)
  {
    case Effect::PointLights:
      return kind(LightType::Point);
    case Effect::SpotLights:
      return kind(LightType::Spot);
    case Effect::DirectionalLights:
      return kind(LightType::Directional);
    case Effect::AreaLights:
      return kind(LightType::Area);
    case Effect::Environment:
      return this->OfLights(
        plan, this->First(plan).Kinds[sky], Only(LightType::Environment), indirect);
    case Effect::SpotShape:
      return this->OfLights(plan, this->First(plan).SpotShape, Only(LightType::Spot), indirect);
    case Effect::CandelaWebs:
      return this->OfLights(plan, this->First(plan).CandelaWebs, Only(LightType::Point), indirect);
    case Effect::Attenuation:
      return this->OfLights(plan, this->First(plan).Attenuation,
        { true, true, false, true, false }, indirect);
    case Effect::GlobalAmbient:
      return this->Ambient + (indirect ? this->Spread(this->Ambient, Infinite) : 0.0);
    case Effect::Emission:
      return this->Emitted() + (indirect ? this->Spread(this->Emitted(), Infinite) : 0.0);
    case Effect::Interreflection:
    case Effect::Discretisation:
      return this->Interreflection(plan);
    case Effect::SpecularTransport:
      return specular(
        this->AllSpecular(plan).Value, this->AllSpecular(plan).Peak, o.Specular);
    case Effect::Mirrors:
      return specular(
        this->AllSpecular(plan).MirrorValue, this->AllSpecular(plan).MirrorPeak, o.Mirror);
    case Effect::Transmission:
    {
      const LightReach& all = this->First(plan).All;
      const double direct = Times(o.Pane, all.Value + (indirect ? 0.0 : this->Emitted()));
      if (!indirect)
      {
        return direct + this->OfTransmissionBeside(plan, false, false);
      }
      const SpecularReach& over = this->AllSpecular(plan);
      const double sent = this->AllSent(plan);
      return direct + Times(o.Pane, over.Value) +
        this->Spread(Times(o.Pane, all.Peak), Times(o.Pane, all.Flux)) +
        this->Spread(Times(o.Pane, over.Peak), Infinite) +
        Times(rest,
          Times(o.Pane, sent) + Times(o.Diffused, all.Peak + this->Ambient + over.Peak + sent));
    }
    case Effect::BackFaces:
      return this->First(plan).Backs.Value + this->Ambient +
        (indirect ? this->AllSpecular(plan).Value + this->AllSent(plan) : this->Emitted());
    case Effect::Occlusion:
    {
      // All light is positive and only gets less by what stands in its way.
      const double open = indirect || o.Emitted > 0.0 ? Infinite : this->First(plan).All.Value;
      const double most =
        computed >= 0.0 ? std::min(open, computed) : open;
      // Without it no rays meet mirrors either: the change goes the one way or the other.
      return indirect && plan.LeavesOut(Effect::SpecularTransport)
        ? std::max(most, this->Of(Effect::SpecularTransport, plan, indirect))
        : most;
    }
    case Effect::SpectralBands:
      return this->OfBands(plan, indirect);
    default:
      return 0.0;
  }
}

double BoundRadianceOf(const Scene& scene, const std::vector<SurfacePoint>& points,
  const std::function<bool(const Light&)>& takes, bool diffuse)
{
  constexpr double pi = 3.14159265358979323846;
  Scene some = scene;
  double panels = 0.0;
  for (Light& light : some.Lights)
  {
    light.Enabled = light.Enabled && takes(light);
    panels += light.Enabled && light.Type == LightType::Area ? Brightest(light) : 0.0;
  }
  const OpticalLimits o = FindOpticalLimits(scene);
  const double peak = BoundLights(some, points, true, true, { true, true, true }).All.Peak;
  const bool lamps = std::any_of(some.Lights.begin(), some.Lights.end(), [](const Light& light) {
    return light.Enabled && light.Type != LightType::Area;
  });
  const double lobes = lamps ? Times(o.Lobe, peak) : Times(o.Specular, panels);
  const double sent = Times(diffuse ? o.Scattered : 0.0, peak) + lobes + Times(o.Carried, panels);
  return Times(Rest(o.Carried), sent) / pi;
}

} // namespace radiometry
