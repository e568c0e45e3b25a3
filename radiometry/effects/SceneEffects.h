// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/EffectBounds.h"
#include "radiometry/effects/EffectPlan.h"
#include "radiometry/effects/SimulatedScene.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <memory>
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
  bool Drops = true;              // Auto may leave out what cannot matter
  EffectSwitch Refinement = EffectSwitch::Off; // elements finer than the cells
};

/// Decides, effect by effect, what a scene calls for, before anything is simulated; Auto also drops
/// what cannot matter: present effects whose bounds stay, together, within a quarter of the tolerance
/// of every value. That is AbsoluteTolerance, or RelativeTolerance of what every value is known to
/// get (global ambient light, and lights that nothing can hide), if that is more. Cost: a pass over the optical arrays; the bounds are only looked
/// at where something may be dropped or was left out.
///   PointLights, SpotLights, DirectionalLights, AreaLights, Environment
///                  lights of that kind are on; left out: they are off
///   SpotShape, Attenuation, CandelaWebs
///                  some spot has a cone or an exponent, some light another attenuation than 1/r^2,
///                  some a web; left out: spots and webs shine alike in all directions, as on the
///                  axis or as at most, and all lights by the inverse square law
///   GlobalAmbient  there is such light; it has no switch and costs nothing
///   Occlusion      something can stand between a light and a receiver: not in a convex body seen
///                  from outside, nor in a convex room with its lights inside
///   Transmission, BackFaces, Emission, SpecularTransport, Mirrors
///                  some material asks for it; left out, it is as if no material did
///   Interreflection  surfaces face each other and reflect
///   SpectralBands  bands differ; bands that are equal to the last bit are computed once (On: each by
///                  itself). Left out: all have the values of their mean
///   PointSampling  values are wanted at points; no switch
///   Discretisation the solve may take finer elements than the cells; follows Refinement
class SceneEffects
{
public:
  /// Values are wanted as averages over `cells`, at `points`, or both: free ones are off the surface,
  /// where even a convex body hides lights. `scene` and `points` must outlive this.
  SceneEffects(const Scene& scene, const std::vector<EffectSwitch>& switches,
    const EffectAbilities& abilities, const std::vector<SurfacePoint>& points = NoPoints(),
    bool cells = true);
  static const std::vector<SurfacePoint>& NoPoints();

  const EffectPlan& Plan() const { return this->Decided; }
  EffectPlan& Plan() { return this->Decided; }

  /// What is to be simulated: the scene without what the plan leaves out of its lights and bands.
  const Scene& Simulated() const { return this->Reduced ? *this->Reduced : this->Whole; }
  /// Values or errors of the bands of Simulated(), items x bands, as those of the scene.
  std::vector<double> AllBands(std::vector<double> values) const
  {
    return SpreadBands(std::move(values), this->Groups);
  }

  /// True when light has to be followed over mirrors or through panes on its way from surface to
  /// surface: the MonteCarlo method alone does that.
  bool CallsForPaths() const;
  /// True when light passes panes that stand between something.
  bool PassesPanes() const
  {
    return this->Panes && this->Decided.Simulates(Effect::Transmission);
  }

  /// Gives each effect that the scene has and the run left out its bound (EffectBounds.h).
  /// `computed`: the greatest irradiance with its error that the run came to, W/m^2.
  void Bound(double computed);

  /// Seconds that beams (point, spot and directional lights), areas (panels and emitters) and skies
  /// took, shadows included, go to their effects: among those of a kind by their number. `others`:
  /// the rest of direct light, which goes to Occlusion.
  void Spent(const std::array<double, 3>& kinds, double others);

  /// Auto leaves a present effect out where its bound, with those dropped before, is within `allowed`
  /// [W/m^2]: for what is only known when the run has begun. The flags of the run are the caller's.
  bool Drop(Effect effect, double allowed);
  /// What may be dropped in all of a value of at least `least` W/m^2: a quarter of its tolerance.
  double Allowed(double least) const;
  EffectBounds& Bounds() { return this->Limits; }

private:
  void DecideLights();
  void DecideBands();
  void DecideSampling(const EffectAbilities& abilities, const std::vector<SurfacePoint>& points,
    bool cells);
  /// Auto drops what cannot matter beside the tolerance of any value.
  bool IsAllLight(Effect effect) const;
  void DropSmall(const EffectAbilities& abilities);
  /// Whether light is followed from surface to surface.
  bool FollowsLight() const;
  /// Makes the scene that is simulated, where it is not the whole.
  void Reduce();

  const Scene& Whole;
  std::unique_ptr<Scene> Reduced;
  BandGroups Groups;
  EffectPlan Decided;
  EffectBounds Limits;
  double RelativeTolerance;
  double AbsoluteTolerance;
  bool Indirect; // the run follows light from surface to surface
  bool Paths;    // ... over mirrors and through panes
  bool Panes = false; // that stand between something
};

} // namespace radiometry
