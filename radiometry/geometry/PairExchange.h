// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// How an exchange was computed.
enum class ExchangeMethod
{
  Zero,    // one lies behind the other
  Rule,    // a rule on both: far apart
  Closed,  // a rule on the smaller, the closed form towards the larger
  Contour, // the double contour integral: near, touching
  Divided  // one was divided because the contour integral lost too many digits
};

struct PairExchangeResult
{
  double Value = 0.0; // A_i F_ij = A_j F_ji, m^2
  double Error = 0.0; // bound or estimate of |Value - exact|, m^2
  double Rounding = 0.0; // of that, what rounding of coordinates and lost digits may make, m^2
  ExchangeMethod Method = ExchangeMethod::Zero;
};

/// What an exchange needs to know of one triangle, computed once.
struct ExchangePatch
{
  explicit ExchangePatch(const Triangle3& corners);

  Triangle3 Corners;
  Vec3 Normal;   // unit; zero when the triangle has no area
  Vec3 Center;   // centroid
  double Radius; // greatest distance of a corner from the centroid
  double Area;
  double Rounding; // m, of coordinates: each was rounded once when the scene was recentred
  double Turn;     // what that may turn the normal by, rad
  double Swelling; // ... and make of the area, relative
};

/// Unoccluded exchange of diffuse light between the fronts of two triangles, each clipped by the
/// plane of the other.
///   Model   A_i F_ij = int int max(0, cos_i) max(0, cos_j)/(pi r^2) dA_j dA_i
///                    = (1/2pi) contour int contour int ln r dr_i.dr_j
///   Method  from an a-priori bound of the rule's truncation: see ExchangeMethod. The inner contour
///           integral is analytic; the outer is split at the feet of the other edge's corners and
///           integrated by the double-exponential rule, so that coinciding, touching and nearly
///           touching edges are integrated and not sampled
///   Limits  scale-free: sizes, gaps and distances enter as ratios only. Error includes rounding, that
///           of coordinates too: of slivers, of small triangles far from the origin and of wedges
///           flatter than some 1e-4 rad fewer digits than asked for may be left
///   Cost    0.15 us (far, 1 %), 5 us (near, 1 %), 25 us (touching, 1e-6); never more than some 50
///           contour integrals (20 ms), after which Error says what is left
///   Source  Sparrow (1963), a new and simpler formulation for radiative angle factors, eq. 9
/// `absolute` (m^2): an error that is small enough whatever the value; 0: the relative one alone.
PairExchangeResult PairExchange(const ExchangePatch& i, const ExchangePatch& j,
  double relativeTolerance = 1e-6, double absolute = 0.0);
inline PairExchangeResult PairExchange(const Triangle3& i, const Triangle3& j,
  double relativeTolerance = 1e-6, double absolute = 0.0)
{
  return PairExchange(ExchangePatch(i), ExchangePatch(j), relativeTolerance, absolute);
}

/// The same between two flat or bent polygons given as triangles: the sum over their pairs.
PairExchangeResult PairExchange(const std::vector<Triangle3>& i, const std::vector<Triangle3>& j,
  double relativeTolerance = 1e-6);

} // namespace radiometry
