// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/SourceView.h"
#include "radiometry/scene/Patch.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// What one receiver gets from all area sources. Vectors hold a value for each band, W/m^2.
struct AreaLight
{
  std::vector<double> Value;
  std::vector<double> Error;
  std::vector<double> Unshadowed; // bound of Value, were nothing in the way
  std::int64_t Rays = 0;
  double Dropped = 0.0; // of the error: the bound on sources left out, of any band
  bool Open = false;    // the tolerance is not met; more work would help
  bool Improvable = false; // a finer tolerance would make the error smaller
};

/// How well a receiver's light has to be known.
struct AreaEffort
{
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0; // W/m^2
  int Work = 64;                  // parts that receivers (for points: sources) may be cut into
  double Dropped = 0.0; // W/m^2: what was left out before; all together a quarter of the tolerance
  bool Drop = true;     // sources may be left out
};

/// What there is no time to look at: half of the bound of all sources together, give or take half.
AreaLight BoundArea(const AreaSources& sources, const Patch& patch);
AreaLight BoundArea(const AreaSources& sources, const SurfacePoint& point);

/// Sums the area sources that matter to one receiver: the source or group of the greatest bound
/// first, until the bounds of all others together are small beside the tolerance.
class AreaReceiver
{
public:
  /// `scale`: the greatest coordinate that the scene was computed with, m.
  AreaReceiver(const SourceView& view, double scale);

  /// Averages over a patch.
  ///   Exact   from sources in whose shaft nothing stands, or which are proven hidden
  ///   Else    the patch is cut in quarters where it pays most; in each part a linear model and the
  ///           unshadowed irradiance, whose averages are known, are fitted to 16 points, from
  ///           each of which the visible part of the source is exact
  ///   Error   2.5 standard deviations of what the fit leaves
  /// `before`: what the patch gets otherwise, per band (its scale counts for the tolerance).
  AreaLight AtPatch(const Patch& patch, std::uint64_t key, const double* before,
    const AreaEffort& effort) const;

  /// At a point: one place, or several just beside a vertex, whose visible shares are averaged.
  AreaLight AtPoint(const SurfacePoint& point, const std::vector<ViewPoint>& places,
    std::uint64_t key, const double* before, const AreaEffort& effort) const;

private:
  struct Part;
  void Evaluate(const Patch& patch, std::uint64_t key, Part& part, std::int64_t& rays) const;

  const SourceView& View;
  double Scale;
};

} // namespace radiometry
