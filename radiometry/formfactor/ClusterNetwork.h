// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ClusterLinks.h"
#include "radiometry/formfactor/ElementTree.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// A tree of elements and the links between its nodes: products with the exchange that they stand
/// for, before what is done to its rows.
///   Model   S_ij = A_i A_j K_ab (1 + first order in places and normals) for i of a, j of b
///           (ExchangeSlope)
///   Ranks   each keeps the links of its own tasks; products and errors end in a sum
///   Memory  56 bytes a link, some 300 an element, and 64 bands an element during a product
class ClusterNetwork
{
public:
  /// A link as one of its nodes sees it.
  struct Entry
  {
    std::int32_t Other;
    float Kernel;
    float Slope[3];          // per metre of this node's place (and the negative of the other's)
    std::uint8_t Turn;       // t of ExchangeSlope in 255ths; 0: the same for all pairs
    std::uint8_t Factor;     // the row's form factor, unoccluded; coded, as all that follows
    std::uint8_t Form, Far;  // what it misses, relative to that: over this node, over the other
    std::uint8_t Sight, Dim; // by visibility, the same
    std::uint8_t Unused[2];
  };
  static constexpr std::size_t BytesOfElement =
    1300; // tree, shapes, what stands between, a product of three bands
  static constexpr std::size_t BytesOfLink = 2 * sizeof(Entry) + sizeof(ClusterLink);

  ClusterNetwork() = default;
  ClusterNetwork(ElementTree tree, int threads, const Communicator* ranks);

  /// Makes the links; false when some rank would have more than `most`. Past `seconds` (0: no limit)
  /// what remains is made by `hasty`. Collective.
  bool Link(const ClusterRefiner& refiner, const ClusterRefiner& hasty, double seconds,
    std::size_t most, const StageProgress& stage);

  /// The most links of a rank that a refiner would make; keeps none. Collective.
  std::size_t Count(const ClusterRefiner& refiner, const StageProgress& stage) const;

  /// out = d F d x. Collective.
  void Multiply(const std::vector<double>& scale, const double* x, double* out, int bands) const;
  /// Sums of the squares of what links miss of d F d B, for elements: by the form of the kernel, by
  /// visibility. Where `closed`, a constant B is received exactly, and what a link misses goes with
  /// the difference of B from `received`. Collective.
  void SquareErrors(const double* B, const double* received,
    const std::vector<std::uint8_t>& closed, double* form, double* sight, int bands) const;
  /// Elements linked directly or over others share a label, from 0. Collective.
  std::vector<std::int32_t> Components() const;

  const ElementTree& GetTree() const { return this->Tree; }
  std::int64_t Links() const { return this->LinkCount; } // of all ranks, as what follows
  std::int64_t Pairs() const { return this->PairCount; }
  std::int64_t Rays() const { return this->RayCount; }
  bool Hasty() const { return this->Hurried; }
  std::size_t MemoryBytes() const;

  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where the archive is damaged or of another number of ranks.
  void Load(ArchiveReader& in, int threads, const Communicator* ranks);

private:
  /// Parallel where it is worth it.
  template <class Body>
  void Each(std::size_t count, const Body& body, double cost) const
  {
    if (this->Entries.size() < 20000)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        body(k);
      }
      return;
    }
    ParallelFor(count, this->Threads, {}, body, cost);
  }
  /// Runs body(node) over all nodes of each subtree, subtrees in parallel, and of the part above.
  template <class Body>
  void Up(const Body& body) const
  {
    const auto& roots = this->Tree.Subtrees();
    this->Each(
      roots.size(),
      [&](std::size_t k) {
        const std::int32_t root = roots[k];
        for (std::int32_t at = root + 2 * this->Tree[root].Count - 2; at >= root; --at)
        {
          body(at);
        }
      },
      1e-5);
    const auto& upper = this->Tree.Upper();
    for (auto at = upper.rbegin(); at != upper.rend(); ++at)
    {
      body(*at);
    }
  }
  /// gather(node) for every node, then pass(node, parent) from the top down.
  template <class Gather, class Pass>
  void Down(const Gather& gather, const Pass& pass) const
  {
    const auto& upper = this->Tree.Upper();
    this->Each(
      upper.size(), [&](std::size_t k) { gather(upper[k]); }, 1e-6);
    for (const std::int32_t at : upper)
    {
      if (at > 0)
      {
        pass(at, this->Tree[at].Parent);
      }
    }
    const auto& roots = this->Tree.Subtrees();
    this->Each(
      roots.size(),
      [&](std::size_t k) {
        const std::int32_t root = roots[k];
        for (std::int32_t at = root; at < root + 2 * this->Tree[root].Count - 1; ++at)
        {
          gather(at);
          if (at > 0)
          {
            pass(at, this->Tree[at].Parent);
          }
        }
      },
      1e-4);
  }

  std::size_t Item(const ElementTree::Node& leaf) const
  {
    return static_cast<std::size_t>(this->Tree.Order()[static_cast<std::size_t>(leaf.First)]);
  }
  template <int Fixed>
  void Product(const std::vector<double>& scale, const double* x, double* out, int bands) const;
  void NumberCurved();
  std::size_t TaskCount() const
  {
    return std::clamp<std::size_t>(this->Tree.Order().size() / 8, 64, 32768);
  }
  void Keep(std::vector<std::vector<ClusterLink>>& parts);
  void Total(double* values, std::size_t count) const
  {
    if (this->Ranks)
    {
      this->Ranks->Sum(values, count);
    }
  }

  ElementTree Tree;
  std::vector<std::size_t> Begin; // of each node's entries
  std::vector<Entry> Entries;
  std::vector<std::int32_t> Curved; // number of each node whose normals differ; -1: they do not
  std::size_t CurvedCount = 0;
  std::int64_t LinkCount = 0, PairCount = 0, RayCount = 0;
  bool Hurried = false;
  int Threads = 0;
  const Communicator* Ranks = nullptr;
};

} // namespace radiometry
