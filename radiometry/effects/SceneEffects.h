// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/EffectPlan.h"
#include "radiometry/scene/Scene.h"

#include <string>
#include <vector>

namespace radiometry
{

/// What the filter at hand can do at all, and how exact it has to be.
struct EffectAbilities
{
  bool Interreflection = false; // false for direct light alone
  bool Emission = false;
  bool Transmission = false; // of direct light
  bool Environment = false;
  /// Rays that go on over mirrors and through panes: specular transport, and panes for what surfaces
  /// send.
  bool Paths = false;
  std::string NoPaths;            // why not, in words
  double RelativeTolerance = 0.0; // what cannot change a value by that is left out
  double AbsoluteTolerance = 0.0; // W/m^2; whichever of the two is the greater
};

/// Decides, effect by effect, what a scene calls for, before anything is simulated.
///   Occlusion      not needed when no triangle can hide a light from another: a convex body seen
///                  from outside, a convex room with its lights inside
///   Interreflection not needed when no front faces another, or nothing reflects
///   SpotShape      not needed when there is no spot; Attenuation: when all lights obey 1/r^2
///   BackFaces, Emission, SpecularTransport, Transmission: when no material asks for them
class SceneEffects
{
public:
  /// `freePoints`: values are wanted off the surface too, where even a convex body hides lights.
  /// `scene` must outlive this.
  SceneEffects(const Scene& scene, const std::vector<EffectSwitch>& switches,
    const EffectAbilities& abilities, bool freePoints = false);

  const EffectPlan& Plan() const { return this->Decided; }
  EffectPlan& Plan() { return this->Decided; }

  /// What is to be simulated: the scene without what the plan leaves out of its lights and bands.
  const Scene& Simulated() const { return this->Whole; }
  /// Values or errors of the bands of Simulated(), items x bands, as those of the scene.
  std::vector<double> AllBands(std::vector<double> values) const { return values; }

  /// True when light has to be followed over mirrors or through panes on its way from surface to
  /// surface: the MonteCarlo method alone does that.
  bool CallsForPaths() const;
  /// True when light passes panes that stand between something.
  bool PassesPanes() const
  {
    return this->Panes && this->Decided.Simulates(Effect::Transmission);
  }

  /// Gives each effect that the scene has and the run left out its bound.
  /// `peak`: the greatest irradiance by direct light that any cell could get, nothing in the way
  /// (W/m^2, strongest band); `peakBack` the same of back faces; `spot` and `attenuation` the
  /// greatest change of a cell's unshadowed irradiance by those effects.
  /// `sky`: the greatest irradiance that environment lights can give.
  ///   Specular  of any cell's average: what mirrors may send on of the radiance of surfaces, panels
  ///             and skies, all around; and all that they get from point-like and directional lights
  ///             brought to one cell, for a hollow mirror may do that
  void Bound(double peak, double peakBack, double spot, double attenuation, double sky = 0.0);

private:
  const Scene& Whole;
  EffectPlan Decided;
  bool Indirect; // the run follows light from surface to surface
  bool Paths;    // ... over mirrors and through panes
  bool Panes = false; // that stand between something
};

} // namespace radiometry
