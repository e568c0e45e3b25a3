// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
/// Elements of one triangle are consecutive. Children are numbered as their corner of the parent,
/// the middle one last.
class ElementSet
{
public:
  /// One element for each receiving side of each receiving triangle. `backFaces` false leaves the
  /// backs of two-sided cells out.
  ElementSet(const Scene& scene, bool backFaces);

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
