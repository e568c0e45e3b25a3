// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// The elements on which light is exchanged: each side of each receiving triangle that can receive,
/// divided into four as often as asked. Both sides of a triangle are divided alike.
///
/// Elements of one triangle are consecutive, in the order of a walk down its divisions, front before
/// back: the same scene divided alike has the same numbers, in any run. Children are numbered as
/// their corner of the parent, the middle one last.
///   Cost    some 250 bytes an element; O(n) to make, to divide and to group
class ElementSet
{
public:
  /// One element for each receiving side of each receiving triangle. `backFaces` false leaves the
  /// backs of two-sided cells out. Cells that transmit diffusely receive on both sides always.
  ElementSet(const Scene& scene, bool backFaces);

  /// Triangles, sides and divisions; the order of the elements follows from them.
  void Save(ArchiveWriter& archive) const;
  /// Throws std::runtime_error for what is no element set.
  static ElementSet Load(ArchiveReader& archive);

  /// Divides until no element is larger than `area` (m^2), each triangle for itself.
  ElementSet DividedToArea(double area) const;
  /// Divides once the elements marked (on either side).
  ElementSet Divided(const std::vector<std::uint8_t>& marked) const;
  /// The number of elements that DividedToArea would make.
  std::size_t CountAtArea(double area) const;

  std::size_t Size() const { return this->Patches.size(); }
  const std::vector<Patch>& GetPatches() const { return this->Patches; }
  const std::vector<double>& GetAreas() const { return this->Areas; }
  std::size_t Cells() const { return this->CellCount; }
  /// How often the element's triangle was divided to make it.
  int Depth(std::size_t element) const { return this->Depths[element]; }

  /// The element of the same piece that looks the other way; -1 where that side does not receive.
  std::int32_t Opposite(std::size_t element) const
  {
    return this->Nodes[static_cast<std::size_t>(this->Leaves[element])]
      .Element[this->Patches[element].Side == 0 ? 1 : 0];
  }

  /// The element at barycentric coordinates (u, v) of a triangle's side; -1 where none receives.
  std::int32_t Find(std::int32_t triangle, bool front, double u, double v) const;

  /// Groups of about 4^levels neighbouring elements: those of one ancestor so many divisions up;
  /// where triangles were divided less often, these join neighbours of nearly the same plane and
  /// the same optics. `count` gets the number of groups.
  std::vector<std::int32_t> Groups(const Scene& scene, int levels, std::size_t& count) const;
  /// Each element's cell and side as a group: 2 cell + side, numbered without gaps.
  std::vector<std::int32_t> CellGroups(std::size_t& count) const;

private:
  struct Node
  {
    std::int32_t Child = -1; // first of four, or -1
    std::int32_t Parent = -1;
    std::array<std::int32_t, 2> Element{ -1, -1 }; // of a leaf, front and back
  };
  ElementSet() = default;
  void Emit(std::int32_t node, const Triangle3& corners, std::int32_t triangle, std::int32_t cell,
    int depth);
  std::vector<std::int32_t> RootClusters(
    const Scene& scene, std::size_t side, std::size_t size) const;
  void EmitAll();
  void DivideNode(std::int32_t node);

  std::vector<Node> Nodes; // the roots first, one for each receiving triangle
  std::vector<Triangle3> Roots;
  std::vector<std::int32_t> RootCell;
  std::vector<std::array<bool, 2>> Receives;
  std::size_t CellCount = 0;

  std::vector<Patch> Patches;
  std::vector<double> Areas;
  std::vector<std::uint8_t> Depths;
  std::vector<std::int32_t> Leaves; // node of each element
};

} // namespace radiometry
