// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/EffectPlan.h"

#include "radiometry/effects/CompiledEffects.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace radiometry
{

const char* EffectName(Effect effect)
{
  static const char* const names[EffectCount] = { "Occlusion", "Interreflection",
    "SpecularTransport", "Transmission", "BackFaces", "Emission", "Environment", "SpotShape",
    "Attenuation", "PointLights", "SpotLights", "DirectionalLights", "AreaLights", "CandelaWebs",
    "GlobalAmbient", "Mirrors", "SpectralBands", "PointSampling", "Discretisation", "Specular",
    "TwoSided", "LocalViewer", "Translucency" };
  return names[static_cast<int>(effect)];
}

bool HasSwitch(Effect effect)
{
  return effect != Effect::GlobalAmbient && effect != Effect::PointSampling &&
    effect != Effect::Discretisation;
}

const char* SwitchName(EffectSwitch value)
{
  static const char* const names[] = { "Auto", "On", "Off" };
  return names[static_cast<int>(value)];
}

const char* DecisionName(const EffectDecision& decision)
{
  if (decision.Simulated)
  {
    return "simulated";
  }
  return decision.Dropped ? "dropped" : (decision.Present ? "left out" : "not needed");
}

std::string Explain(Effect effect, const EffectDecision& d, const std::string& unit)
{
  return Explain(std::string(EffectName(effect)), d, unit);
}

std::string Explain(const std::string& name, const EffectDecision& d, const std::string& unit)
{
  std::ostringstream text;
  text << name << " is " << DecisionName(d) << ": " << d.Why;
  if (d.Present && (!d.Simulated || d.Bound > 0.0))
  {
    if (!std::isfinite(d.Bound))
    {
      text << "; what that changes cannot be bounded";
    }
    else
    {
      text << (d.Simulated ? "; what is left out of it changes no value by more than "
                           : "; that changes no value by more than ")
           << d.Bound << ' ' << unit;
    }
  }
  text << '.';
  return text.str();
}

EffectPlan::EffectPlan(const std::vector<EffectSwitch>& switches, std::string unit)
  : Rows(EffectCount)
  , Unit(std::move(unit))
{
  for (std::size_t k = 0; k < std::min(switches.size(), this->Rows.size()); ++k)
  {
    this->Rows[k].Wish = switches[k];
  }
}

void EffectPlan::Decide(Effect effect, bool present, bool able, const std::string& whyAbsent,
  const std::string& whyPresent)
{
  EffectDecision& d = (*this)[effect];
  d.Known = true;
  d.Present = present;
  d.Able = able && Compiled(effect);
  d.Simulated = d.Able && d.Wish != EffectSwitch::Off && (present || d.Wish == EffectSwitch::On);
  if (!present)
  {
    d.Why = d.Simulated ? "switched on; " + whyAbsent : whyAbsent;
  }
  else if (!d.Able)
  {
    d.Why = whyPresent +
      (able ? "; this build leaves it out" : "; not simulated by this filter");
  }
  else
  {
    d.Why = d.Wish == EffectSwitch::Off ? "switched off; " + whyPresent : whyPresent;
  }
}

bool EffectPlan::Drop(Effect effect, double bound, double allowed)
{
  EffectDecision& d = (*this)[effect];
  if (!d.Simulated || !d.Present || d.Wish != EffectSwitch::Auto ||
    !(this->DroppedBound() + bound <= allowed))
  {
    return false;
  }
  d.Simulated = false;
  d.Dropped = true;
  d.Bound = bound;
  d.Why += "; it cannot matter beside the tolerance";
  return true;
}

double EffectPlan::DroppedBound() const
{
  double sum = 0.0;
  for (const EffectDecision& d : this->Rows)
  {
    sum += d.Dropped ? d.Bound : 0.0;
  }
  return sum;
}

bool EffectPlan::LeavesOut() const
{
  return std::any_of(this->Rows.begin(), this->Rows.end(),
    [](const EffectDecision& d) { return d.Present && !d.Simulated; });
}

std::string EffectPlan::Explain(Effect effect) const
{
  return radiometry::Explain(effect, (*this)[effect], this->Unit);
}

std::string EffectPlan::Explain() const
{
  std::string text;
  for (int k = 0; k < EffectCount; ++k)
  {
    if (this->Rows[static_cast<std::size_t>(k)].Known)
    {
      text += this->Explain(static_cast<Effect>(k)) + '\n';
    }
  }
  return text;
}

} // namespace radiometry
