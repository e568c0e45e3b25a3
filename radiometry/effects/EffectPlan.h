// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

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

/// The effects that a simulation may carry or leave out.
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
  Attenuation
};
inline constexpr int EffectCount = 9;
const char* EffectName(Effect effect);

/// One row of the EffectPlan table.
struct EffectDecision
{
  bool Simulated = false;
  bool Present = false;  // the scene calls for it
  std::string Why;
  double Bound = 0.0;    // greatest change of any irradiance value that leaving it out can make,
                         // W/m^2, in any band; infinite where none can be given; 0 when simulated
                         // (Transmission: what is left out of it, where that is the indirect light)
  double Seconds = 0.0;  // spent on it
};

/// What the filter at hand can do at all.
struct EffectAbilities
{
  bool Interreflection = false; // false for direct light alone
  bool Emission = false;
  bool Transmission = false; // of direct light
  bool Environment = false;
  /// Rays that go on over mirrors and through panes: specular transport, and panes for what surfaces
  /// send.
  bool Paths = false;
  std::string NoPaths;  // why not, in words
  double Tolerance = 0.0; // relative: what specular reflection cannot change by that is left out
};

/// Decides, effect by effect, what the scene calls for, before anything is simulated.
///   Occlusion      not needed when no triangle can hide a light from another: a convex body seen
///                  from outside, a convex room with its lights inside
///   Interreflection not needed when no front faces another, or nothing reflects
///   SpotShape      not needed when there is no spot; Attenuation: when all lights obey 1/r^2
///   BackFaces, Emission, SpecularTransport, Transmission: when no material asks for them
class EffectPlan
{
public:
  /// `freePoints`: values are wanted off the surface too, where even a convex body hides lights.
  EffectPlan(const Scene& scene, const std::vector<EffectSwitch>& switches,
    const EffectAbilities& abilities, bool freePoints = false);

  const EffectDecision& operator[](Effect effect) const
  {
    return this->Decisions[static_cast<int>(effect)];
  }
  EffectDecision& operator[](Effect effect) { return this->Decisions[static_cast<int>(effect)]; }
  bool Simulates(Effect effect) const { return (*this)[effect].Simulated; }

  /// True when light has to be followed over mirrors or through panes on its way from surface to
  /// surface: the MonteCarlo method alone does that.
  bool CallsForPaths() const;
  /// True when light passes panes that stand between something.
  bool PassesPanes() const { return this->Panes && this->Simulates(Effect::Transmission); }

  /// True when something has to be bounded.
  bool LeavesOut() const;

  /// Gives each effect that the scene has and the run left out its bound.
  /// `peak`: the greatest irradiance by direct light that any cell could get, nothing in the way
  /// (W/m^2, strongest band); `peakBack` the same of back faces; `spot` and `attenuation` the
  /// greatest change of a cell's unshadowed irradiance by those effects.
  /// `sky`: the greatest irradiance that environment lights can give.
  ///   Specular  of any cell's average: what mirrors may send on of the radiance of surfaces, panels
  ///             and skies, all around; and all that they get from point-like and directional lights
  ///             brought to one cell, for a hollow mirror may do that
  void Bound(const Scene& scene, double peak, double peakBack, double spot, double attenuation,
    double sky = 0.0);

private:
  std::vector<EffectDecision> Decisions;
  bool Indirect; // the run follows light from surface to surface
  bool Paths;    // ... over mirrors and through panes
  bool Panes = false; // that stand between something
};

} // namespace radiometry
