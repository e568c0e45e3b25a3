// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/irradiance/SourceFlux.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// Where a block of receivers lies and which way they face.
struct ReceiverBounds
{
  Box3 Box;
  Vec3 Normal;             // unit; the middle of their normals
  double CosSpread = -1.0; // of the greatest angle from it; -1: any
  /// No irradiance by a light of physical attenuation exceeds this, per unit of intensity (1/m^2):
  /// for averages over patches, 2 pi over the least area; infinite at points.
  double Greatest = 0.0;
};

/// Lights clustered in space with bounds on what any of them can give: so that many can be left out
/// at once.
///   Model  of a light of intensity I under a node, on any receiver of a block:
///          E <= I g,  g = shape(least angle off the axes) cos(least angle off the normals) / r^2
///          with r the least distance, or the legacy attenuation there
///   Cost   O(n log n) to build; a bound costs some tens of nanoseconds
class LightTree
{
public:
  LightTree() = default;
  /// `sources` must outlive the tree.
  LightTree(const std::vector<std::unique_ptr<SourceFlux>>& sources, int bands);

  /// Entries: nodes in [0, Nodes()), then each light; light k is entry Nodes() + k.
  std::int32_t Nodes() const { return static_cast<std::int32_t>(this->Inner.size()); }
  /// Where a search starts: the root, and each directional light.
  const std::vector<std::int32_t>& Roots() const { return this->Starts; }
  bool IsLight(std::int32_t entry) const { return entry >= this->Nodes(); }
  std::size_t LightOf(std::int32_t entry) const
  {
    return static_cast<std::size_t>(entry - this->Nodes());
  }
  /// The entries right below a node.
  const std::int32_t* Children(std::int32_t node) const { return this->Inner[node].Child; }

  /// The bound g of an entry, 1/m^2 (directional lights: a cosine); 0 where no light of it can
  /// reach any of the receivers, infinite where there is no bound.
  double Gain(std::int32_t entry, const ReceiverBounds& receivers) const;
  /// The sum of the intensities below an entry, in one band, and that of their strongest bands.
  double Intensity(std::int32_t entry, int band) const
  {
    return this->Sums[static_cast<std::size_t>(entry) * this->Bands + band];
  }
  double Strength(std::int32_t entry) const { return this->Strengths[entry]; }
  /// How many lights there are below an entry.
  std::int32_t Count(std::int32_t entry) const { return this->Counts[entry]; }

  /// Distance from a point to the nearest light that has a place; infinite: none has.
  double Nearest(const Vec3& point) const;

private:
  /// Bounds on the lights below an entry.
  struct Reach
  {
    Box3 Box;
    Vec3 Axis;
    double CosSpread = 1.0;  // of the axes; -1: any
    double CosCutoff = 1.0;  // of the widest cone; -1: all directions
    double Exponent = 0.0;   // the least
    double Attenuation[3] = { 0.0, 0.0, 1.0 }; // the least of each
    bool Directional = false;
  };
  struct Node
  {
    std::int32_t Child[2];
  };
  static Reach ReachOf(const SourceFlux& source);
  static Reach Join(const Reach& a, const Reach& b);
  std::int32_t Build(std::vector<std::int32_t>& items, std::size_t begin, std::size_t end);

  std::size_t Bands = 1;
  std::vector<Node> Inner;
  std::vector<Reach> Reaches; // of all entries
  std::vector<double> Sums;   // entries x bands
  std::vector<double> Strengths;
  std::vector<std::int32_t> Counts;
  std::vector<std::int32_t> Starts;
};

} // namespace radiometry
