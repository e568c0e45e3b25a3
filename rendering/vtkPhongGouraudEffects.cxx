// SPDX-License-Identifier: BSD-3-Clause
// The switches and the effect plan of vtkPhongGouraudMapper.
#include "vtkPhongGouraudMapper.h"

#include "radiometry/effects/EffectPlan.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <iterator>
#include <cstring>

using radiometry::Effect;
using radiometry::EffectDecision;
using radiometry::EffectPlan;

namespace
{

/// Those that a picture has, in the order of the table; bands become colours when arrays are read.
constexpr Effect Switchable[] = { Effect::Occlusion, Effect::Emission, Effect::Environment,
  Effect::SpotShape, Effect::Attenuation, Effect::PointLights, Effect::SpotLights,
  Effect::DirectionalLights, Effect::AreaLights, Effect::CandelaWebs, Effect::GlobalAmbient,
  Effect::Specular, Effect::TwoSided, Effect::LocalViewer, Effect::Translucency };

bool IsSwitchable(int effect)
{
  return std::any_of(std::begin(Switchable), std::end(Switchable),
    [effect](Effect e) { return static_cast<int>(e) == effect; });
}

int NumberOf(const char* name)
{
  for (const Effect effect : Switchable)
  {
    if (name && std::strcmp(name, radiometry::EffectName(effect)) == 0)
    {
      return static_cast<int>(effect);
    }
  }
  return -1;
}

/// How much of a row there is in a picture of several groups of blocks.
int Weight(const EffectDecision& d)
{
  return d.Simulated ? 3 : (d.Present ? 2 : (d.Known ? 1 : 0));
}

template <typename Array>
Array* AddColumn(vtkTable* table, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  table->AddColumn(column);
  return column; // kept alive by the table
}

} // namespace

void vtkPhongGouraudMapper::SetEffectSwitch(int effect, int value)
{
  if (!IsSwitchable(effect))
  {
    vtkErrorMacro(<< "SetEffectSwitch: no effect of a picture has the number " << effect);
    return;
  }
  value = std::clamp<int>(value, EFFECT_AUTO, EFFECT_OFF);
  int& old = this->EffectSwitches[static_cast<std::size_t>(effect)];
  if (old != value)
  {
    old = value;
    if (effect == static_cast<int>(Effect::Occlusion) ||
      effect == static_cast<int>(Effect::Specular))
    {
      this->BufferTime.Modified(); // of shares, of materials
    }
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetEffectSwitch(const char* effect, int value)
{
  const int number = NumberOf(effect);
  if (number < 0)
  {
    vtkErrorMacro(<< "SetEffectSwitch: a picture has no effect \"" << (effect ? effect : "") << '"');
    return;
  }
  this->SetEffectSwitch(number, value);
}

int vtkPhongGouraudMapper::GetEffectSwitch(int effect)
{
  return IsSwitchable(effect) ? this->EffectSwitches[static_cast<std::size_t>(effect)]
                              : EFFECT_AUTO;
}

int vtkPhongGouraudMapper::GetEffectSwitch(const char* effect)
{
  return this->GetEffectSwitch(NumberOf(effect));
}

int vtkPhongGouraudMapper::WishOf(int effect, bool backProperty) const
{
  const int chosen = this->EffectSwitches[static_cast<std::size_t>(effect)];
  if (chosen != EFFECT_AUTO)
  {
    return chosen;
  }
  switch (static_cast<Effect>(effect))
  {
    case Effect::TwoSided:
      if (!this->TwoSided && !backProperty)
      {
        return EFFECT_OFF;
      }
      break;
    case Effect::LocalViewer:
      if (!this->LocalViewer)
      {
        return EFFECT_OFF;
      }
      break;
    case Effect::Specular:
      if (this->FieldMode == FIELD_ON && !this->Highlights)
      {
        return EFFECT_OFF;
      }
      break;
    case Effect::Occlusion:
      if (!this->UseLightVisibility)
      {
        return EFFECT_OFF;
      }
      break;
    default:
      break;
  }
  return this->EveryEffect ? EFFECT_ON : EFFECT_AUTO;
}

bool vtkPhongGouraudMapper::WantsHighlights() const
{
  return this->WishOf(static_cast<int>(Effect::Specular), false) != EFFECT_OFF;
}

bool vtkPhongGouraudMapper::WantsLightVisibility() const
{
  return this->WishOf(static_cast<int>(Effect::Occlusion), false) != EFFECT_OFF;
}

EffectPlan vtkPhongGouraudMapper::MergedPlan() const
{
  if (this->FramePlans.empty())
  {
    return EffectPlan({}, "linear colour");
  }
  EffectPlan plan = *this->FramePlans.front();
  for (const auto& other : this->FramePlans)
  {
    for (int k = 0; k < radiometry::EffectCount; ++k)
    {
      EffectDecision& d = plan[static_cast<Effect>(k)];
      const EffectDecision& o = (*other)[static_cast<Effect>(k)];
      const double bound = std::max(d.Bound, o.Bound);
      if (Weight(o) > Weight(d))
      {
        d = o;
      }
      d.Bound = bound;
    }
  }
  return plan;
}

const char* vtkPhongGouraudMapper::Explain()
{
  this->Explanation =
    this->FramePlans.empty() ? "Nothing has been drawn yet." : this->MergedPlan().Explain();
  return this->Explanation.c_str();
}

vtkTable* vtkPhongGouraudMapper::GetEffectPlan()
{
  vtkNew<vtkTable> table;
  auto* effect = AddColumn<vtkStringArray>(table, "Effect");
  auto* wish = AddColumn<vtkStringArray>(table, "Switch");
  auto* decision = AddColumn<vtkStringArray>(table, "Decision");
  auto* bound = AddColumn<vtkDoubleArray>(table, "Bound");
  auto* unit = AddColumn<vtkStringArray>(table, "Unit");
  auto* seconds = AddColumn<vtkDoubleArray>(table, "Seconds");
  auto* why = AddColumn<vtkStringArray>(table, "Why");
  const EffectPlan plan = this->MergedPlan();
  for (int k = 0; k < radiometry::EffectCount; ++k)
  {
    const EffectDecision& d = plan[static_cast<Effect>(k)];
    if (d.Known)
    {
      effect->InsertNextValue(radiometry::EffectName(static_cast<Effect>(k)));
      wish->InsertNextValue(radiometry::SwitchName(d.Wish));
      decision->InsertNextValue(radiometry::DecisionName(d));
      bound->InsertNextValue(d.Bound);
      unit->InsertNextValue(plan.BoundUnit());
      seconds->InsertNextValue(d.Seconds);
      why->InsertNextValue(d.Why);
    }
  }
  this->EffectPlanTable = table.Get();
  return this->EffectPlanTable;
}
