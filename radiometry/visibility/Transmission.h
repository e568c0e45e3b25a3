// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/ExactHit.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// The panes of a scene: the triangles that let some light through, and what they leave of it.
///   Model  straight (regular) transmission: what passes is the product, band by band, of the
///          transmittances of all sheets crossed, whatever the angle
///   Sheets a ray through an edge or a corner that triangles share crosses their sheet once. Faces
///          that coincide (the same plane within 1e-13 of the scene's size) count as one sheet, that
///          lets through the least of what they let through, band by band.
///   Exact  decided in double throughout
///   Cost   O(log(panes) + crossings) for each ray
class Transmission
{
public:
  /// `boxes` of all triangles of the scene, in the coordinates of the rays.
  Transmission(const Scene& scene, const std::vector<Box3>& boxes);

  /// True when a triangle of the scene lets light through.
  static bool Present(const Scene& scene);

  /// For each triangle of the scene: 1 where it is a pane.
  const std::vector<std::uint8_t>& Panes() const { return this->IsPane; }

  /// Multiplies `bands` by what the panes between the ends of a ray let through; false when nothing
  /// is left in any band. The ray starts near the scene's box.
  bool Pass(const RayQuery& ray, double* bands) const;

private:
  int Bands;
  std::vector<std::uint8_t> IsPane;
  std::vector<std::int32_t> Triangles; // of the tree's items
  std::vector<double> Share;           // panes x bands
  BoxTree Tree;
};

} // namespace radiometry
