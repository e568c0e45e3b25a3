// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/EffectPlan.h"
#include "radiometry/effects/LightBounds.h"
#include "radiometry/effects/OpticalLimits.h"
#include "radiometry/effects/SpecularReach.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace radiometry
{

/// What leaving an effect out can change of any value: irradiance of either side of a cell or point,
/// and what leaves there [W/m^2, brightest band].
///
/// Every bound is one on the light that has to do with the effect (all light is positive):
///   V       its first light at values that are wanted, P at any place, Phi its flux (LightBounds.h)
///   A, M    global ambient light; exitance of emitters
///   d, s, t greatest of diffuse reflection and transmission, of specular reflection and panes
///           together (what stays radiance), of panes alone; R of all (OpticalLimits.h)
///   X       light over mirrors and lobes (SpecularReach.h)
/// Surfaces that send at most the radiance L/pi give no place more than L, were they all around it;
/// what they get they pass on R-fold at most, so that light that met k surfaces is at most R^k of what
/// it was, and all that follows on it 1/(1 - R). Hence
///   Y(P) = d P/(1 - R)   all that surfaces make by diffuse reflection of first light P at any place;
///          of averages over cells also d Phi/((1 - R) A_min): flux only gets less
///          where a lamp is near a surface P is great on a small spot only: all lights together also
///          make no more than E1 + C + Y(E1 + C), E1 = d times BoundFirstReflection straight on, C what
///          mirrors and lobes make of it: s d P/(1 - s), or the series of rho (n + 2)/2 times E1
///   E    = M/(1 - s)     of emitters, with what stays radiance of it
///   B    = E + Y(P + A + X + E)     all light that left a surface
/// and of each effect
///   a kind of light, Environment        V + X + Y(P + X) of these lights
///   SpotShape, Attenuation, CandelaWebs the same of what they change, X of those lights
///   GlobalAmbient                       A + Y(A)
///   Emission                            E + Y(E)
///   Interreflection                     Y(P + A + X + E); after n reflections R^n times that
///   SpecularTransport                   X + G + d (X + G)/(1 - d), G = rho_s (A + B): what arrives
///     that a mirror or lobe sent on, and what diffuse reflection makes of that where surfaces send no
///     more by mirrors: the difference of both solutions. With panes G/(1 - t), d/(1 - t). Mirrors: of
///     mirrors
///   Transmission                        t (V + X) + Y(t (P + X)) + (t B + tau_d (P + A + X + B))/(1 - R)
///   BackFaces                           what backs get: V + A + X + B
///   Occlusion                           what was computed without it: it is less with it
///   SpectralBands                       the differences of all these from their means, passed on
///   Discretisation                      Interreflection's: with any elements it is between 0 and that
/// Where the run follows no light from surface to surface, Y, X and B are no part of an effect's bound:
/// they are in those of Interreflection and SpecularTransport, which it leaves out.
/// Cost: LightBounds's and, where surfaces reflect specularly, SpecularReach's; each once.
class EffectBounds
{
public:
  /// `scene` and `points` must outlive this. `plan` says what is simulated.
  EffectBounds(const Scene& scene, const std::vector<SurfacePoint>& points, bool cells);

  /// Of an effect, as the plan stands. `computed`: the greatest value with its error that the run
  /// without Occlusion came to; below 0: not known.
  double Of(Effect effect, const EffectPlan& plan, bool indirect, double computed = -1.0);

  /// What of Transmission a run leaves out that simulates it: of diffuse transmission where it follows
  /// no light from surface to surface, of panes where only rays could (`paths`: it has them).
  double OfTransmissionBeside(const EffectPlan& plan, bool indirect, bool paths);

  /// Light that was reflected diffusely more than `bounces` times, on top of all other.
  double Interreflection(const EffectPlan& plan, int bounces = 0);
  /// After so many diffuse reflections the rest is at most `allowed`; 0: light that was never
  /// reflected is enough. Below 0: more than `most`.
  int BouncesFor(double allowed, const EffectPlan& plan, int most = 1000);

  const OpticalLimits& Surfaces() const { return this->Optics; }
  /// What all values are at least, weakest band: global ambient light, and where there is no Occlusion
  /// the lights of Auto's plan that shine on all (LeastLight).
  double LeastValue(const EffectPlan& plan) const;

private:
  const LightBounds& First(const EffectPlan& plan);
  SpecularReach Specular(
    const EffectPlan& plan, const std::array<bool, 5>& kinds, const FirstReflection* straight = nullptr);
  const SpecularReach& AllSpecular(const EffectPlan& plan);
  /// Y of light that gives `peak` at any place and `flux` in all.
  double Spread(double peak, double flux) const;
  double Emitted() const;
  double AllSent(const EffectPlan& plan); // B
  double OfLights(const EffectPlan& plan, const LightReach& reach, const std::array<bool, 5>& kinds,
    bool indirect);
  double OfBands(const EffectPlan& plan, bool indirect);

  const Scene& Whole;
  const std::vector<SurfacePoint>& Points;
  bool Cells;
  OpticalLimits Optics;
  double Ambient = 0.0;
  /// Of the lights' first light: all that surfaces make of it by diffuse reflection more than `bounces`
  /// times.
  double SpreadLights(const EffectPlan& plan, int bounces);

  /// Of all lights.
  const FirstReflection& ReflectedOnce(const EffectPlan& plan);

  std::unique_ptr<FirstReflection> Once;
  std::unique_ptr<LightBounds> Light;
  std::unique_ptr<SpecularReach> Mirrored;
};

/// What the lights that `takes` names add at most to the radiance that any surface sends [W/(m^2 sr)],
/// by lobes, and by diffuse reflection where `diffuse`: of the irradiance E at any place ((n + 2)/2
/// rho_s + d) E/pi, and what stays radiance of that; panels are also seen themselves. Infinite where
/// mirrors may show a lamp.
double BoundRadianceOf(const Scene& scene, const std::vector<SurfacePoint>& points,
  const std::function<bool(const Light&)>& takes, bool diffuse);

} // namespace radiometry
