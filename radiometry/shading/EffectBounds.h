// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/shading/LightingModel.h"

#include <vector>

/// What leaving an effect out of a picture can change of any of its colours, at most. What is proved
/// here of single lights is summed up by rendering/PictureBounds.
///
///   Model   LightingModel.h. A light adds to the colour
///             f s w v (k_a A + k_d D max(N.L, 0) + k_s S h)       (Physical: D and S over pi)
///           f its fall-off, s the shape of its cone, w its candela web, v the share of it that
///           arrives, all at least 0 and s, w <= 1 (web values are relative to the greatest);
///           h = max(cos a, 0)^n <= 1 the lobe, Physical: (n + 2)/2 max(N.L, 0) max(cos a, 0)^n.
///           Nothing is assumed of normals: N.L and lobes take any value that they can.
///   Places  the surface lies in boxes. f falls with distance (a, b, c >= 0) and s grows with the
///           cosine, so in a box both lie between their values at the ends of what the box spans; a
///           bound is the greatest of the boxes'. It holds for interpolated light, too (Gouraud): a
///           mean of values that the bound holds for.
///   Exact   the rounding of float32 (some 1e-6 of the colour) comes on top
namespace radiometry
{

/// A part of the surface: a box with edges along the axes.
struct SurfaceBox
{
  Vec3 Low;
  Vec3 High;
};

/// The greatest absolute values, over the surface and both its sides, of what multiplies light.
struct MaterialPeaks
{
  Rgb Ambient;
  Rgb Diffuse;
  Rgb Specular;
  double LeastShininess = 0.0;
  double GreatestShininess = 0.0;
};

struct BoundedSurface
{
  std::vector<SurfaceBox> Boxes;
  MaterialPeaks Peaks;
};

/// By what a light's terms are multiplied before they are added up.
struct LightTerms
{
  double Ambient = 1.0;
  double Diffuse = 1.0;
  double Specular = 1.0;
};

/// Greatest change of max(cos a, 0)^n where the angle a changes by at most `turn`.
///   n = 0          0 (0^0 is 1)
///   0 < n < 1      |x^n - y^n| <= |x - y|^n, and a cosine changes by no more than the angle: turn^n
///   n >= 1         the slope n cos^(n-1) a sin a is greatest at sin^2 a = 1/n:
///                  sqrt(n) ((n - 1)/n)^((n - 1)/2) turn
/// and never more than 1, the range of the lobe.
double LobeChange(double n, double turn);

/// What a light adds at most, in the greatest band: all that leaving it out changes. `terms` picks
/// parts of it: {0, 0, 1} are its highlights.
///   Area lights  D min(1, A/(pi d^2)): their form factor, of a polygon of area A at the distance d
///   Skies        |constant| + |linear| + max|xx, yy, zz| + (|xy| + |xz| + |yz|)/2
///   Infinite     where the surface may come as near as one likes to a light that falls off
double LightBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, const LightTerms& terms = {});

/// What drawing a spot as a point changes: s becomes 1, so the light changes by 1 - s.
double SpotShapeBound(
  const LightingModel& model, const DisplayLight& light, const BoundedSurface& surface);

/// What the inverse square in the place of the light's own fall-off changes: two values of at least 0,
/// so no more than the greater one. `square`: the factor c of 1/(c r^2).
double AttenuationBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, double square);

/// What a viewer infinitely far along `viewer` in the place of the eye changes of a light's highlight.
/// The direction to the viewer turns by at most the angle t between the two, the mirrored one with it;
/// H, halfway between L and V, by t/2 in their plane and t/(2 cos(g/2)) out of it, g the greatest angle
/// between L and V on the way.
double ViewerBound(const LightingModel& model, const DisplayLight& light,
  const BoundedSurface& surface, const Vec3& eye, const Vec3& viewer);

} // namespace radiometry
