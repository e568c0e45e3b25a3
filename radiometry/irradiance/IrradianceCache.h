// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/LightVisibility.h"
#include "radiometry/irradiance/ShadowPieces.h"
#include "radiometry/scene/ContentKey.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace radiometry
{

/// The values of a run, for one that goes on from them.
struct IrradianceKept
{
  ShadowPieces Pieces;      // into which shadows' edges cut the cells
  bool HasPieces = false;
  DirectState Cells;        // both sides
  std::array<DirectState, 2> Points;
  /// Shares of lights, as exact as this tolerance asked for (below 0: there are none).
  double SharesRelative = -1.0, SharesAbsolute = -1.0;
  std::array<LightShares, 2> CellShares;
  std::array<LightShares, 2> PointShares;

  std::size_t MemoryBytes() const;
};

/// What a run of direct light leaves for the next.
///   Visibility  of the same points and triangles: lights may move, dim, come and go
///   Values      of the same scene, receivers and effects: with a finer tolerance those that do not
///               meet it are computed again, those from rays with the next larger number of rays, as
///               one run at that tolerance would; with a coarser one nothing is
/// Kept by content. Of several ranks each keeps its own share. A sequence of runs gives the same
/// bytes each time, for any number of threads.
///
/// Not thread-safe: one run at a time.
class IrradianceCache
{
public:
  IrradianceCache();
  ~IrradianceCache();
  IrradianceCache(const IrradianceCache&) = delete;
  IrradianceCache& operator=(const IrradianceCache&) = delete;

  /// The scene's visibility, kept from the last call where the geometry is the same.
  const OcclusionScene& Occluders(const Scene& scene);
  /// The key of points and triangles of the scene of the last call.
  const ContentKey& GeometryKey() const { return this->Geometry; }
  /// Takes out the values that a run of that key may go on from; null: none.
  std::unique_ptr<IrradianceKept> Take(const ContentKey& key);
  void Keep(const ContentKey& key, std::unique_ptr<IrradianceKept> values);
  /// Frees all.
  void Release();
  std::size_t MemoryBytes() const;

private:
  ContentKey Geometry;
  std::unique_ptr<OcclusionScene> Visibility;
  ContentKey Content;
  std::unique_ptr<IrradianceKept> Values;
};

/// All that the values of direct light depend on beside tolerances: the scene, points at which they
/// are wanted and what of the options is simulated.
/// (`geometry`: the key of points and triangles).
ContentKey KeyOfDirectLight(const ContentKey& geometry, const Scene& scene,
  const std::vector<SurfacePoint>& points, const DirectOptions& options);

} // namespace radiometry
