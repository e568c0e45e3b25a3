// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/SpecularSources.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <functional>
#include <vector>

namespace radiometry
{

/// Light that lights send by way of flat perfect mirrors: that of their images behind the mirrors,
/// seen through these.
///   Model    E = sum over images of rho_s^k E_image V: E_image as of the light itself (unfolded),
///            V whether the way over the k mirrors is free, with what panes leave of it
///   Images   of lights that shine from one direction, of area lights and emitters; in at most 16
///            planes of mirrors, of the first order, and of higher ones while there are no more than
///            16; none where mirrors have more planes (curved ones): light paths carry the rest
///   Values   averages over patches: the image's exact flux times the visible share, which is
///            sampled (a ratio: what is wholly visible has no noise); or at points
///   Error    2.7 standard deviations of eight batches, and what so few points may have missed
///   Cost     64 to 1024 paths of k + 1 rays for each image that a patch can see in its mirror
class SpecularImages
{
public:
  SpecularImages(const Scene& scene, const OcclusionScene& occluders,
    const SpecularSurfaces& surfaces, const std::vector<SpecularSource>& sources,
    std::size_t receivers, const SpecularLightOptions& options);

  bool Empty() const { return this->Sequences.empty(); }
  /// The longest sequence of mirrors.
  std::size_t Order() const { return this->Longest; }
  /// True when there is no longer sequence of these mirrors.
  bool AllOrders() const { return this->Planes.size() <= 1; }
  /// Which plane of mirrors a side of a triangle lies in; -1: none.
  std::int32_t PlaneOf(std::int32_t triangle, bool front) const
  {
    return this->Empty()
      ? -1
      : this->PlaneIndex[2 * static_cast<std::size_t>(triangle) + (front ? 0 : 1)];
  }

  /// Adds to values and errors (receivers x bands, W/m^2, half-widths of 95 %).
  void Add(const std::vector<Patch>& patches, const StageProgress& stage,
    std::vector<double>& values, std::vector<double>& errors) const;
  void Add(const std::vector<SurfacePoint>& points, const StageProgress& stage,
    std::vector<double>& values, std::vector<double>& errors) const;

private:
  struct Plane
  {
    Vec3 Normal; // unit, to the side that reflects
    double Offset = 0.0;
    Vec3 Center; // of a sphere about its mirrors
    double Radius = 0.0;
    Vec3 Reflect(const Vec3& p) const
    {
      return p - 2.0 * (Dot(this->Normal, p) - this->Offset) * this->Normal;
    }
    Vec3 Turn(const Vec3& d) const { return d - 2.0 * Dot(this->Normal, d) * this->Normal; }
    double Height(const Vec3& p) const { return Dot(this->Normal, p) - this->Offset; }
  };
  using Sequence = std::vector<std::int32_t>; // of planes, from the light

  void Each(std::size_t receivers, const StageProgress& stage, std::vector<double>& values,
    std::vector<double>& errors, double seconds,
    const std::function<void(std::size_t)>& body) const;
  void FindPlanes(const Scene& scene);
  void FindSequences(std::size_t receivers);
  bool MaySee(const Sequence& sequence, const SpecularSource& source, const Vec3& center,
    double radius) const;
  /// What gets over the mirrors from a point of the source (or its direction), a share a band.
  bool Way(const Sequence& sequence, const SpecularSource& source, const Vec3& on,
    const RayEnd& from, double* bands) const;
  void AddPatch(const Patch& patch, std::uint64_t key, const Sequence& sequence,
    const SpecularSource& source, double* values, double* squares) const;

  const OcclusionScene& Occluders;
  const SpecularSurfaces& Surfaces;
  const std::vector<SpecularSource>& Sources;
  SpecularLightOptions Options;
  std::size_t Bands;
  std::vector<Plane> Planes;
  std::vector<std::int32_t> PlaneIndex; // triangles x sides
  std::vector<Sequence> Sequences;
  std::size_t Longest = 0;
};

} // namespace radiometry
