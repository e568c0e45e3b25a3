// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace radiometry
{

/// Makes the geometry of a Scene from meshes as they come from files: recentres in double, joins
/// points of equal coordinates, drops triangles without area, and refuses what is not finite.
///
/// Use: AddMesh for the receivers, AddMesh for each occluder, then Finish.
/// Fails: InputError{"Points", index, value} for a coordinate that is not finite or too large.
class SceneBuilder
{
public:
  enum class Role
  {
    Receiver,
    Occluder
  };

  /// `points` in the caller's unit (coordinates x metersPerUnit are metres); triangles index them.
  /// `cell` gives the caller's cell of each triangle. `name` is used in messages.
  /// Receivers must be added before occluders.
  void AddMesh(Role role, const std::vector<Vec3>& points,
    const std::vector<std::array<std::int32_t, 3>>& triangles,
    const std::vector<std::int32_t>& cell, double metersPerUnit, const std::string& name = "Points");

  /// The scene without optics and lights. `cells` is the caller's number of receiving cells.
  /// `occluderCells` gets the caller's cell of each triangle that only occludes.
  Scene Finish(std::size_t cells, std::vector<std::int32_t>* occluderCells = nullptr);

  /// Triangles dropped because they have no area.
  std::size_t Degenerate() const { return this->DroppedTriangles; }

private:
  std::vector<Vec3> Points; // metres, absolute
  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<std::int32_t> TriangleCell;
  std::vector<std::int32_t> OccluderCell;
  std::size_t ReceiverTriangles = 0;
  std::size_t DroppedTriangles = 0;
};

} // namespace radiometry
