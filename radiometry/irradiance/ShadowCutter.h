// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/Silhouettes.h"
#include "radiometry/irradiance/SourceFlux.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// Flux that reaches a patch.
struct LitFlux
{
  double Value = 0.0;
  double Error = 0.0;       // of what could not be decided, and of quadrature
  std::int64_t Rays = 0;
  bool Exact = true;        // nothing was left undecided
  /// Past panes: what arrives in each band; Value is the greatest of them. Empty: Value in each.
  std::vector<double> Bands;
};

/// What of one light's flux reaches a patch past the occluders.
///
/// The patch is cut along the planes through the light and each silhouette segment in its shaft:
/// within a piece nothing can begin or end to hide the light, so one ray decides all of it, and the
/// flux of each piece has a closed form. Where more segments stand in the shaft than are worth
/// cutting along, the patch is quartered first, the largest undecided part next, until the estimate
/// of the error meets `allowed` or `work` parts have been made; what is then left is sampled.
/// Past panes a piece gets its share in each band: their edges, folds and changes of transmittance
/// are among the segments.
class ShadowCutter
{
public:
  /// `bands`: of the scene, where panes let light through; 0: everything is opaque.
  ShadowCutter(const SourceFlux& source, const Silhouettes* silhouettes,
    const OcclusionScene& occluders, int bands = 0);

  /// `crossings` are the lines at which other triangles cut through the patch's triangle.
  /// `allowed` and the result are in the unit of SourceFlux::OnPolygon. `candidates`: silhouette
  /// segments, all in the shaft of the patch among them; null: they are searched for.
  LitFlux Flux(const Patch& patch, const Vec3& normal, double unoccluded,
    const std::vector<Segment3>& crossings, double allowed, int work,
    const std::vector<Segment3>* candidates = nullptr) const;

  /// True when the light is hidden from a point on triangle `triangle` (-1: free).
  bool Hidden(const RayEnd& from) const;
  /// The same for many neighbours: hidden[k] is 1 or 0.
  void Hidden(const std::vector<RayEnd>& from, std::vector<std::uint8_t>& hidden) const;
  /// What panes leave of the light at a point, a share a band; all 0 where it is hidden.
  void Passing(const RayEnd& from, double* shares) const;
  bool Transmits() const { return this->Bands > 0; }

private:
  using Polygon = std::vector<Vec3>;
  void Cut(const Patch& patch, const Triangle3& part, const std::vector<Segment3>& lines,
    const Vec3& normal, LitFlux& result) const;
  void AddPiece(const RayEnd& from, double flux, double quadrature, LitFlux& result) const;
  double AddSamples(const Triangle3& corners, std::int32_t triangle, double flux,
    LitFlux& result) const;

  const SourceFlux& Source;
  const Silhouettes* Outline; // null: nothing hides anything
  const OcclusionScene& Occluders;
  bool Close;
  std::size_t Bands; // 0: everything is opaque
};

} // namespace radiometry
