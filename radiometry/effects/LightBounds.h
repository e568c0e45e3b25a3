// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <cstddef>
#include <vector>

namespace radiometry
{

/// What some light gives at most, brightest band, nothing in the way.
struct LightReach
{
  double Value = 0.0; // any value that is wanted: an average over a cell, or a point; W/m^2
  double Peak = 0.0;  // any place on a surface, or such a point; W/m^2
  double Flux = 0.0;  // all surfaces together; W
};

/// Which variant of the lights a bound is for: those effects may be left out in the run, so that the
/// greater of both holds.
struct LightVariants
{
  bool SpotShape = false;
  bool Attenuation = false;
  bool CandelaWebs = false;
};

/// A triangle that gets more than most, beside skies.
struct BrightSpot
{
  Triangle3 Corners; // counter-clockwise seen from the lit side
  double Peak = 0.0; // any place of it gets, W/m^2
  double Flux = 0.0; // W
};
/// Bounds on what the enabled lights of a scene give before anything is reflected.
///   Model, of a light of intensity I on a triangle or a point at the least distance d and the most
///   far away f, h before its plane:
///     point-like  any place gets at most I s (h/d) k(d): the falloff k and the cosine h/r both fall
///                 with the distance r. s bounds the shape of the cone: that at the least angle
///                 between axis and triangle (a sphere about it). The average over it is at most
///                 I s Omega/A times the greatest k r^2 (1, or that at f, with which it grows)
///     directional I cos
///     area        exitance times the form factor to the panel of area A_p, which is at most 1,
///                 A_p/(pi d^2) with d between spheres about both, and A_p/A for an average
///     skies       pi times the greatest radiance, and the flux from everywhere
///   SpotShape, Attenuation, CandelaWebs: what changes where they are left out: as point-like with
///     1 - s at the greatest angle, |k(r) r^2 - 1| at d or f (k r^2 grows with r), 1 - web >= 0
///   Many pairs  64 receivers together as a sphere, for lights farther than four radii
///   Cost        some 50 ns a receiver and light, on all threads; above 3e5 pairs some 1 ns
struct LightBounds
{
  std::array<LightReach, 5> Kinds; // by LightType
  LightReach All;                  // of the sums
  LightReach Backs;                // of All what backs get
  LightReach SpotShape;
  LightReach Attenuation;
  LightReach CandelaWebs;
  std::vector<BrightSpot> Spots; // at most 64
  double PeakBeyond = 0.0;  // as All.Peak, anywhere but on the spots
  double SkyRadiance = 0.0; // pi times the greatest of all skies together, W/m^2
};

/// `points` are wanted, and averages over `cells`. `backs`: both sides of points receive.
LightBounds BoundLights(const Scene& scene, const std::vector<SurfacePoint>& points, bool cells,
  bool backs, const LightVariants& variants = {});

/// What arrives at values that are wanted, and anywhere, when the first light of `bounds` was reflected
/// diffusely once, all of it: beside what the rest of the surfaces sends, the spots, of which a place
/// at the distance D gets no more than Flux/(pi D^2), nor than Peak, and an average over the area A no
/// more than Flux/A; and none behind a spot, unless light is `diffused` through.
struct FirstReflection
{
  double Value = 0.0;
  double Peak = 0.0;
};
FirstReflection BoundFirstReflection(const Scene& scene, const std::vector<SurfacePoint>& points,
  bool cells, const LightBounds& bounds, bool diffused);

/// What the point, spot and directional lights of a scene give every wanted value at least, weakest
/// band, where nothing stands between them and any receiver (fronts alone receive). Of point-like ones
/// I s Omega/A with the least shape s and the least k r^2; 0 for more than 3e5 pairs.
double LeastLight(const Scene& scene, const std::vector<SurfacePoint>& points, bool cells);

/// What a light gives a triangle: of a point-like or directional one, in front of it (Height > 0) or
/// behind.
struct PairBound
{
  double Height = 0.0; // of the light before the plane; directional: -cos
  double Average = 0.0;
  double Peak = 0.0;
  double Strength = 0.0; // Peak without the cosine: I s k(d)
};
PairBound BoundPair(const Light& light, const Triangle3& triangle, const LightVariants& variants);

/// Greatest of a light's bands.
double Brightest(const Light& light);
/// Greatest radiance of a sky's brightest band, and the greatest irradiance it gives a plane.
struct SkyBound
{
  double Radiance = 0.0;
  double Irradiance = 0.0;
};
SkyBound BoundSky(const Light& light);

} // namespace radiometry
