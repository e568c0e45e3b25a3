// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace radiometry
{

/// What a user asks of an effect: the values of the filters' switches.
enum class EffectSwitch
{
  Auto = 0,
  On = 1,
  Off = 2
};

/// The effects that a simulation or a picture may carry or leave out.
enum class Effect
{
  Occlusion,
  Interreflection,
  SpecularTransport,
  Transmission,
  BackFaces,
  Emission,
  Environment,
  SpotShape,
  Attenuation,
  PointLights,
  SpotLights,
  DirectionalLights,
  AreaLights,
  CandelaWebs,
  GlobalAmbient,
  Mirrors,        // surfaces that reflect specularly without a lobe
  SpectralBands,  // bands that are computed one by one
  PointSampling,  // values at points instead of averages over cells
  Discretisation, // elements finer than the cells
  Specular,       // highlights of a picture
  TwoSided,       // lighting of both sides in a picture
  LocalViewer,
  Translucency
};
inline constexpr int EffectCount = 23;
/// The word of an effect in tables: that of its switch.
const char* EffectName(Effect effect);
/// Whether filters have a switch of that name. GlobalAmbient is a number that is given,
/// PointSampling follows SampleLocation and Discretisation follows Refinement.
bool HasSwitch(Effect effect);
/// Auto, On or Off.
const char* SwitchName(EffectSwitch value);

/// One row of the EffectPlan table.
struct EffectDecision
{
  bool Known = false;     // the computation at hand has the effect at all: a row of its table
  bool Present = false;   // the scene calls for it
  bool Able = false;      // the computation can simulate it
  bool Simulated = false;
  bool Dropped = false;   // Auto left it out though it is present: its bound is small enough
  EffectSwitch Wish = EffectSwitch::Auto;
  std::string Why;
  double Bound = 0.0;   // greatest change of any value that leaving it out can make, in any band, in
                        // the plan's unit; infinite where none can be given; 0 when simulated
                        // (Transmission: what is left out of it, where that is the indirect light)
  double Seconds = 0.0; // spent on it
};

/// simulated, dropped (by Auto), left out (by the user, or as it cannot be simulated), not needed.
const char* DecisionName(const EffectDecision& decision);
/// In a sentence, why the effect was kept or left out, and what that may change.
std::string Explain(Effect effect, const EffectDecision& decision, const std::string& unit);
std::string Explain(
  const std::string& name, const EffectDecision& decision, const std::string& unit);

/// What a computation carries and what it leaves out, effect by effect, decided before it begins:
/// of both simulating filters (SceneEffects.h) and of the picture.
class EffectPlan
{
public:
  /// `switches` by Effect; those that are missing are Auto.
  explicit EffectPlan(const std::vector<EffectSwitch>& switches = {}, std::string unit = "W/m^2");

  const EffectDecision& operator[](Effect effect) const
  {
    return this->Rows[static_cast<std::size_t>(effect)];
  }
  EffectDecision& operator[](Effect effect) { return this->Rows[static_cast<std::size_t>(effect)]; }
  bool Simulates(Effect effect) const { return (*this)[effect].Simulated; }

  /// Simulated where it is wanted: present and not Off, or On; and where it can be.
  void Decide(Effect effect, bool present, bool able, const std::string& whyAbsent,
    const std::string& whyPresent);

  /// Auto: leaves a present effect out where its bound and those of the effects dropped before it
  /// stay within `allowed` together. True where it did.
  bool Drop(Effect effect, double bound, double allowed);
  /// What all effects that were dropped may change of any value, together.
  double DroppedBound() const;

  /// True when an effect is present and not simulated: something has to be bounded.
  bool LeavesOut(Effect effect) const
  {
    return (*this)[effect].Present && !(*this)[effect].Simulated;
  }
  bool LeavesOut() const;

  /// In a sentence, why the effect was kept or left out, and what that may change.
  std::string Explain(Effect effect) const;
  /// A sentence for each effect that is known, line by line.
  std::string Explain() const;

  const std::vector<EffectDecision>& Decisions() const { return this->Rows; }
  const std::string& BoundUnit() const { return this->Unit; }

private:
  std::vector<EffectDecision> Rows;
  std::string Unit;
};

} // namespace radiometry
