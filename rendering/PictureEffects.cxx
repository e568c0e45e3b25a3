// SPDX-License-Identifier: BSD-3-Clause
#include "PictureEffects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkradiometry
{
namespace
{

using radiometry::DisplayLight;
using radiometry::Effect;
using radiometry::EffectDecision;
using radiometry::EffectPlan;
using radiometry::EffectSwitch;
using radiometry::LightTerms;
using radiometry::Rgb;
using radiometry::Vec3;

/// In this order effects are left out: what others depend on first.
constexpr Effect Order[] = { Effect::AreaLights, Effect::Environment, Effect::DirectionalLights,
  Effect::PointLights, Effect::SpotLights, Effect::Occlusion, Effect::CandelaWebs,
  Effect::SpotShape, Effect::Attenuation, Effect::Specular, Effect::LocalViewer,
  Effect::GlobalAmbient, Effect::Emission, Effect::TwoSided, Effect::Translucency };

bool IsBlack(const Rgb& c)
{
  return c == Rgb();
}

/// The row that a light's being drawn at all stands in.
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

bool IsLegacy(const DisplayLight& light)
{
  return light.Attenuation[0] != 0.0 || light.Attenuation[1] != 0.0 || light.Attenuation[2] != 1.0;
}

double Greatest(const Rgb& c)
{
  return std::max({ std::abs(c.r), std::abs(c.g), std::abs(c.b) });
}

} // namespace

//------------------------------------------------------------------------------
// Facts
//------------------------------------------------------------------------------
bool FrameFacts::operator==(const FrameFacts& o) const
{
  const auto all = [](const FrameFacts& f) {
    return std::array<std::uint8_t, 22>{ { f.Shows, f.AnyLight, f.Lights, f.Directional, f.Point, f.Spot,
      f.Luminaire, f.Area, f.Sky, f.Highlights, f.Legacy, f.SpecularMaterial, f.AmbientMaterial,
      f.AmbientLight, f.Emission, f.BacksSeen, f.SidesDiffer, f.Parallel, f.Translucent, f.Shares,
      f.SharesKnown, f.Spectral } };
  };
  return all(*this) == all(o) && this->Wishes == o.Wishes;
}

void NoteLights(const CollectedLights& lights, double scale, FrameFacts& facts)
{
  facts.Spectral = facts.Spectral || lights.Spectral;
  for (const DisplayLight& light : lights.Lights)
  {
    if (!GivesLight(light, scale))
    {
      continue;
    }
    facts.AnyLight = 1;
    const LightKind kind = KindOf(light);
    std::uint8_t* const kinds[] = { &facts.Directional, &facts.Point, &facts.Spot,
      &facts.Luminaire, &facts.Area, &facts.Sky };
    *kinds[static_cast<int>(kind)] = 1;
    if (facts.Wishes[static_cast<std::size_t>(RowOf(kind))] ==
      static_cast<std::uint8_t>(EffectSwitch::Off))
    {
      continue;
    }
    facts.Lights = 1;
    if (kind == LightKind::Area || kind == LightKind::Sky)
    {
      continue;
    }
    facts.Highlights = facts.Highlights || !IsBlack(light.Specular);
    facts.AmbientLight = facts.AmbientLight || !IsBlack(light.Ambient);
    facts.Legacy = facts.Legacy || (HasFallOff(kind) && IsLegacy(light));
  }
}

//------------------------------------------------------------------------------
// Decisions
//------------------------------------------------------------------------------
PictureEffects::PictureEffects()
  : Decided(std::make_shared<EffectPlan>())
  , Undropped(this->Decided)
{
}

void PictureEffects::Decide(const FrameFacts& facts)
{
  if (this->Known && facts == this->Facts)
  {
    return;
  }
  this->Facts = facts;
  this->Known = true;
  this->BoundKey.clear();
  std::vector<EffectSwitch> wishes;
  for (const std::uint8_t wish : facts.Wishes)
  {
    wishes.push_back(static_cast<EffectSwitch>(wish));
  }
  // Bands become colours where arrays are read: there is nothing to leave out of a frame.
  wishes[static_cast<std::size_t>(Effect::SpectralBands)] = EffectSwitch::Auto;
  auto plan = std::make_shared<EffectPlan>(wishes, "linear colour");
  const bool lit = facts.Shows == FrameFacts::LitSurface;
  const bool receives = facts.AnyLight && facts.Shows != FrameFacts::NothingLit;
  const bool shining = facts.Lights && receives;
  const char* const unlit = facts.Shows == FrameFacts::NothingLit
    ? "the surface shows colours of its own, not light on it"
    : "no light gives light";
  const auto light = [&](Effect effect, bool present, const char* absent, const char* why) {
    plan->Decide(effect, present && receives, shining, receives ? absent : unlit, why);
  };
  light(Effect::DirectionalLights, facts.Directional, "there is no directional light",
    "there are directional lights");
  light(Effect::PointLights, facts.Point || facts.Luminaire, "there is no point light",
    "there are point lights");
  light(Effect::SpotLights, facts.Spot, "there is no spot light", "there are spot lights");
  light(Effect::AreaLights, facts.Area && lit,
    lit ? "there is no area light" : "area lights have no highlights", "there are area lights");
  light(Effect::Environment, facts.Sky && lit,
    lit ? "there is no environment light" : "environments have no highlights",
    "there is an environment light");
  light(Effect::SpotShape, facts.Spot && plan->Simulates(Effect::SpotLights),
    "no spot light is drawn", "spot lights have a cone");
  light(Effect::CandelaWebs, facts.Luminaire && plan->Simulates(Effect::PointLights),
    "no light has a candela web", "luminaires have a candela web");
  light(Effect::Attenuation, facts.Legacy, "all lights obey the inverse square law",
    "lights have a fall-off a + b r + c r^2 other than r^2");
  plan->Decide(Effect::Occlusion, facts.Shares && shining, facts.SharesKnown && shining,
    !shining ? unlit
             : (facts.SharesKnown ? "LightVisibility says that all light arrives"
                                  : "the surface does not know which light arrives (LightVisibility)"),
    "the surface knows which share of its lights arrives (LightVisibility)");

  const bool glossy = shining && facts.Highlights && facts.SpecularMaterial;
  plan->Decide(Effect::Specular, glossy, shining,
    !shining ? unlit
             : (facts.SpecularMaterial ? "no light has highlights" : "the material has no highlights"),
    "the material has highlights");
  const bool highlights = plan->Simulates(Effect::Specular);
  plan->Decide(Effect::LocalViewer, highlights && !facts.Parallel, highlights && !facts.Parallel,
    highlights ? "in a parallel projection all directions to the viewer agree"
               : "without highlights it does not matter where the eye is",
    "highlights depend on the place of the eye");
  plan->Decide(Effect::GlobalAmbient, lit && facts.AmbientMaterial && facts.AmbientLight, lit,
    !lit ? unlit
         : (facts.AmbientMaterial ? "there is no ambient light" : "the material takes no ambient light"),
    "the material takes ambient light");
  plan->Decide(Effect::Emission, lit && facts.Emission, lit,
    lit ? "the surface gives no light of its own" : unlit, "the surface gives light of its own");
  const bool byLight = shining && (lit || highlights);
  plan->Decide(Effect::TwoSided, facts.BacksSeen && (byLight || facts.SidesDiffer), true,
    facts.BacksSeen ? "both sides look the same" : "back faces are culled",
    "backs may be seen, which are lit about the reversed normal");
  plan->Decide(Effect::Translucency, facts.Translucent, true, "everything is opaque",
    "some of the surface has an opacity below 1");
  plan->Decide(Effect::SpectralBands, facts.Spectral, true,
    "all arrays are RGB or grey", "bands become colours by the CIE observer when arrays are read");
  for (const Effect effect : Order)
  {
    if (plan->LeavesOut(effect))
    {
      (*plan)[effect].Bound = std::numeric_limits<double>::infinity(); // until Bound() knows
    }
  }
  this->Decided = plan;
  this->Undropped = plan;
}

bool PictureEffects::IsOn(Effect effect) const
{
  const EffectDecision& d = this->Plan()[effect];
  return d.Simulated && d.Wish == EffectSwitch::On;
}

bool PictureEffects::NeedsBounds(double tolerance) const
{
  return this->Undropped->LeavesOut() || tolerance > 0.0 ||
    this->Decided != this->Undropped; // the tolerance became 0
}

//------------------------------------------------------------------------------
// Leaving out
//------------------------------------------------------------------------------
namespace
{

/// Whether a light is drawn at all, and as what: `plan` leaves out what `without` says.
template <typename F>
bool Keep(DisplayLight& light, const F& without)
{
  const LightKind kind = KindOf(light);
  if (without(RowOf(kind)))
  {
    return false;
  }
  if (kind == LightKind::Spot && without(Effect::SpotShape))
  {
    light.CosCutoff = -1.0;
    light.SpotExponent = 0.0;
    light.SmoothEdge = false;
  }
  if (kind == LightKind::Luminaire && without(Effect::CandelaWebs))
  {
    light.Web = nullptr;
  }
  return true;
}

/// A picture from which one effect after the other is taken.
class Reduction
{
public:
  explicit Reduction(BoundedPicture&& picture)
    : Picture(std::move(picture))
  {
  }

  double BoundOf(Effect effect, const EffectPlan& plan) const
  {
    const BoundedPicture& p = this->Picture;
    const MaterialPeaksOf peaks{ p };
    const auto lights = [&](const auto& ofLight) {
      double sum = 0.0;
      for (std::size_t k = 0; k < p.Scene.Lights.size(); ++k)
      {
        sum += ofLight(p.Scene.Lights[k], k);
      }
      return sum;
    };
    const auto added = [&](const DisplayLight& light, const LightTerms& terms) {
      return radiometry::LightBound(p.Scene.Model, light, p.Surface, terms);
    };
    const auto all = [&](const LightTerms& terms) {
      return lights([&](const DisplayLight& light, std::size_t) { return added(light, terms); });
    };
    switch (effect)
    {
      case Effect::SpotShape:
        return lights([&](const DisplayLight& light, std::size_t) {
          return KindOf(light) == LightKind::Spot
            ? radiometry::SpotShapeBound(p.Scene.Model, light, p.Surface)
            : 0.0;
        });
      case Effect::CandelaWebs:
        return lights([&](const DisplayLight& light, std::size_t) {
          return KindOf(light) == LightKind::Luminaire ? added(light, {}) : 0.0;
        });
      case Effect::Attenuation:
        return lights([&](const DisplayLight& light, std::size_t) {
          return this->Falls(light)
            ? radiometry::AttenuationBound(p.Scene.Model, light, p.Surface, p.Square)
            : 0.0;
        });
      case Effect::Occlusion:
        return lights([&](const DisplayLight& light, std::size_t k) {
          return p.Loss[k] > 0.0 ? p.Loss[k] * added(light, { 0.0, 1.0, 1.0 }) : 0.0;
        });
      case Effect::Specular:
        return all({ 0.0, 0.0, 1.0 });
      case Effect::LocalViewer:
        return !plan.Simulates(Effect::Specular)
          ? 0.0
          : lights([&](const DisplayLight& light, std::size_t) {
              return radiometry::ViewerBound(
                p.Scene.Model, light, p.Surface, p.Scene.Eye, p.Scene.Viewer);
            });
      case Effect::GlobalAmbient:
        return all({ 1.0, 0.0, 0.0 }) + peaks.Ambient();
      case Effect::Emission:
        return Greatest(p.Emission);
      case Effect::TwoSided:
        // A light of the front is none of the back: of each, one picture has nothing. Area lights and
        // skies may reach both; the difference of two values of one sign is within the greater.
        return all({ p.AmbientOfSides, 1.0, 1.0 }) + p.AmbientOfSides * peaks.Ambient() +
          p.EmissionOfSides + p.FieldOfSides;
      case Effect::Translucency:
        return std::numeric_limits<double>::infinity(); // what is behind is not known here
      default:
        return lights([&](const DisplayLight& light, std::size_t) {
          return RowOf(KindOf(light)) == effect ? added(light, {}) : 0.0;
        });
    }
  }

  void TakeOut(Effect effect)
  {
    BoundedPicture& p = this->Picture;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < p.Scene.Lights.size(); ++k)
    {
      if (Keep(p.Scene.Lights[k], [effect](Effect e) { return e == effect; }))
      {
        if (effect == Effect::Attenuation && this->Falls(p.Scene.Lights[k]))
        {
          p.Scene.Lights[k].Attenuation = { { 0.0, 0.0, p.Square } };
        }
        if (kept != k)
        {
          p.Scene.Lights[kept] = std::move(p.Scene.Lights[k]);
          p.Loss[kept] = p.Loss[k];
        }
        ++kept;
      }
    }
    p.Scene.Lights.resize(kept);
    p.Loss.resize(kept);
    if (effect == Effect::Specular)
    {
      p.Surface.Peaks.Specular = Rgb();
    }
    if (effect == Effect::GlobalAmbient)
    {
      p.Surface.Peaks.Ambient = Rgb();
    }
    if (effect == Effect::Emission)
    {
      p.EmissionOfSides = 0.0;
    }
  }

private:
  struct MaterialPeaksOf
  {
    const BoundedPicture& Picture;
    double Ambient() const
    {
      return Greatest(this->Picture.Surface.Peaks.Ambient * this->Picture.Scene.Model.GlobalAmbient);
    }
  };
  bool Falls(const DisplayLight& light) const
  {
    const auto& a = light.Attenuation;
    return HasFallOff(KindOf(light)) &&
      (a[0] != 0.0 || a[1] != 0.0 || a[2] != this->Picture.Square);
  }

  BoundedPicture Picture;
};

} // namespace

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

void PictureEffects::Bound(BoundedPicture&& picture, double tolerance)
{
  std::vector<double> key = picture.Key();
  key.push_back(tolerance);
  if (key == this->BoundKey)
  {
    return;
  }
  this->BoundKey = std::move(key);
  auto plan = std::make_shared<EffectPlan>(*this->Undropped);
  Reduction left(std::move(picture));
  for (const Effect effect : Order)
  {
    if (plan->LeavesOut(effect))
    {
      (*plan)[effect].Bound = left.BoundOf(effect, *plan);
      left.TakeOut(effect);
    }
  }
  for (const Effect effect : Order)
  {
    const EffectDecision& d = (*plan)[effect];
    if (tolerance > 0.0 && d.Present && d.Simulated && d.Wish == EffectSwitch::Auto)
    {
      if (plan->Drop(effect, left.BoundOf(effect, *plan), tolerance))
      {
        left.TakeOut(effect);
      }
    }
  }
  this->Decided = plan;
}

bool PictureEffects::LeaveOut(CollectedLights& lights) const
{
  constexpr Effect ofLights[] = { Effect::DirectionalLights, Effect::PointLights,
    Effect::SpotLights, Effect::AreaLights, Effect::Environment, Effect::SpotShape,
    Effect::CandelaWebs, Effect::Attenuation };
  const auto without = [this](Effect effect) { return this->LeavesOut(effect); };
  if (std::none_of(std::begin(ofLights), std::end(ofLights), without))
  {
    return false;
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lights.Lights.size(); ++k)
  {
    if (!Keep(lights.Lights[k], without))
    {
      continue;
    }
    if (without(Effect::Attenuation) && HasFallOff(KindOf(lights.Lights[k])))
    {
      lights.Lights[k].Attenuation = { { 0.0, 0.0, 1.0 } };
    }
    if (kept != k)
    {
      lights.Lights[kept] = std::move(lights.Lights[k]);
      lights.Frames[kept] = lights.Frames[k];
      lights.Keys[kept] = lights.Keys[k];
      lights.Columns[kept] = lights.Columns[k];
    }
    ++kept;
  }
  lights.Lights.resize(kept);
  lights.Frames.resize(kept);
  lights.Keys.resize(kept);
  lights.Columns.resize(kept);
  return true;
}

} // namespace vtkradiometry
