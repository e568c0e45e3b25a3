// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/GeometryKey.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiometry
{

struct RadiosityLevel;
struct RadiosityOptions;

/// What a radiosity run leaves for the next on the same geometry: the scene to ask for visibility
/// with its shadow lines, the finest elements, their operator, the bound of the inverse and the
/// solution to begin from. Lights, emission and reflectance may differ from run to run.
///
/// Kept by content: whatever changes points, triangles, cells, the sides that receive or what lets
/// light through drops all; a change of mirrors, where paths over them are followed, or of the
/// options that shape an operator drops the operator. A run that begins from kept elements gives
/// other numbers than one from nothing, both within their errors.
///
/// Not thread-safe: one run at a time.
class RadiosityCache
{
public:
  RadiosityCache();
  ~RadiosityCache();
  RadiosityCache(const RadiosityCache&) = delete;
  RadiosityCache& operator=(const RadiosityCache&) = delete;

  /// The scene's visibility: kept from the last call where geometry is the same.
  const OcclusionScene& Occluders(const Scene& scene);
  /// Whether nothing can hide anything else in the scene of the last call of Occluders.
  bool Convex() const { return this->IsConvex; }

  /// Takes the level out that a run with these options may begin from; null: none.
  std::unique_ptr<RadiosityLevel> Take(const Scene& scene, const RadiosityOptions& options);
  /// Puts one in for the next run.
  void Keep(
    const Scene& scene, const RadiosityOptions& options, std::unique_ptr<RadiosityLevel> level);
  const RadiosityLevel* Level() const { return this->Kept.get(); }

  /// Writes what is kept to a file (OperatorFile.h). Fails: InputError{"OperatorFile"} where nothing
  /// is kept, or it cannot be written.
  void Save(const std::string& name, const Communicator* ranks) const;
  /// Keeps what a file holds, for the scene of the last call of Occluders; nothing is read where that
  /// is kept already. Fails: InputError{"OperatorFile"} where the file is not of this scene and these
  /// options, or is damaged.
  void Load(const std::string& name, const Scene& scene, const RadiosityOptions& options);

  /// Frees all.
  void Release();
  /// Of the kept operator and elements.
  std::size_t MemoryBytes() const;

private:
  ContentKey Geometry;
  std::vector<std::pair<std::string, std::string>> Shape; // options: names and values
  std::string LoadedFrom;
  bool IsConvex = false;
  std::unique_ptr<OcclusionScene> Visibility;
  std::unique_ptr<RadiosityLevel> Kept; // dies before what it sees through
};

} // namespace radiometry
