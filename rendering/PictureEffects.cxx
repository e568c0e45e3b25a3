// SPDX-License-Identifier: BSD-3-Clause
#include "PictureEffects.h"

#include <algorithm>
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
using radiometry::Rgb;

/// In this order effects are left out: what others depend on first.
constexpr Effect Order[] = { Effect::AreaLights, Effect::Environment, Effect::DirectionalLights,
  Effect::PointLights, Effect::SpotLights, Effect::Occlusion, Effect::CandelaWebs,
  Effect::SpotShape, Effect::Attenuation, Effect::Specular, Effect::LocalViewer,
  Effect::GlobalAmbient, Effect::Emission, Effect::TwoSided, Effect::Translucency };

bool IsBlack(const Rgb& c)
{
  return c == Rgb();
}

bool IsLegacy(const DisplayLight& light)
{
  return light.Attenuation[0] != 0.0 || light.Attenuation[1] != 0.0 || light.Attenuation[2] != 1.0;
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
// Bounds, and leaving out
//------------------------------------------------------------------------------
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
  BoundedPicture left = std::move(picture);
  for (const Effect effect : Order)
  {
    if (plan->LeavesOut(effect))
    {
      (*plan)[effect].Bound = left.BoundOf(effect, plan->Simulates(Effect::Specular));
      left.TakeOut(effect);
    }
  }
  for (const Effect effect : Order)
  {
    const EffectDecision& d = (*plan)[effect];
    if (tolerance > 0.0 && d.Present && d.Simulated && d.Wish == EffectSwitch::Auto)
    {
      if (plan->Drop(effect, left.BoundOf(effect, plan->Simulates(Effect::Specular)), tolerance))
      {
        left.TakeOut(effect);
      }
    }
  }
  this->Decided = plan;
}

bool PictureEffects::LeaveOut(CollectedLights& lights) const
{
  EffectSet without;
  for (const Effect effect : { Effect::DirectionalLights, Effect::PointLights, Effect::SpotLights,
         Effect::AreaLights, Effect::Environment, Effect::SpotShape, Effect::CandelaWebs,
         Effect::Attenuation })
  {
    without.set(static_cast<std::size_t>(effect), this->LeavesOut(effect));
  }
  if (without.none())
  {
    return false;
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lights.Lights.size(); ++k)
  {
    if (!KeepLight(lights.Lights[k], without))
    {
      continue;
    }
    if (this->LeavesOut(Effect::Attenuation) && HasFallOff(KindOf(lights.Lights[k])))
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
