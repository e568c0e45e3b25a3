// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/BeamLights.h"
#include "radiometry/irradiance/LightSum.h"
#include "radiometry/irradiance/PatchClusters.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// A cluster of patches under one light after the other.
///   Method  Where no silhouette edge touches the shaft between the cluster and the light, and
///           nothing cuts through the patches, visibility is the same all over each connected piece
///           of the cluster: one ray (two for many patches) tells for all of them. Elsewhere the
///           cluster is halved; patches that no line touches take one ray each, in packets, the
///           others are cut (ShadowCutter).
///   Cost    for a light: a solid angle a patch and one search of a shaft
class PatchBlock : public ReceiverBlock
{
public:
  PatchBlock(const Scene& scene, const BeamLights& lights, const std::vector<Patch>& patches,
    const DirectOptions& options, double extent);

  /// Takes up a cluster; patches without area are not receivers.
  void Load(const std::uint32_t* begin, const std::uint32_t* end);
  std::size_t Size() const { return this->Count; }
  const ReceiverBounds& Bounds() const { return this->Around; }
  double PatchArea(std::size_t i) const { return this->Areas[i]; }

  /// No time is left to ask what is hidden: half of the light is taken, with an error of half.
  bool Blind = false;
  /// Parts that each patch and light may be divided into, and by how much each patch's doubts must
  /// be smaller than usual.
  int Work = 1;
  std::array<double, PatchClusters::MostPatches> Factor;

  std::int64_t Ask(std::size_t light, const std::uint8_t* active, const double* basis,
    LightShare* shares) override;
  const double* Tints() const override { return this->Tint.empty() ? nullptr : this->Tint.data(); }

private:
  static constexpr std::size_t Most = PatchClusters::MostPatches;
  struct Pending; // one light's question

  void FindPoints();
  bool Knows(const SourceFlux& source, std::size_t i) const;
  void FindLinks();
  std::size_t FindPieces(std::size_t begin, std::size_t end);
  void Decide(Pending& now, std::size_t begin, std::size_t end,
    const std::vector<Segment3>* candidates, std::size_t depth);
  bool DecideTogether(Pending& now, std::size_t begin, std::size_t end);
  void DecideOne(Pending& now, std::size_t k, const std::vector<Segment3>* candidates);
  bool MakeShaft(const Pending& now, std::size_t begin, std::size_t end, LightShaft& shaft);
  void Trace(Pending& now);
  void SetShares(std::size_t i, const double* shares, double of);

  const Scene& Geometry;
  const BeamLights& Lights;
  const std::vector<Patch>& Patches;
  const DirectOptions& Options;
  double Coordinates; // the largest

  std::size_t Count = 0;
  const std::uint32_t* Ids = nullptr;
  ReceiverBounds Around;
  std::array<Vec3, Most> Normals;
  std::array<double, Most> Areas;
  std::array<double, Most> Roundings;
  std::array<double, Most> Heights; // the least of the triangle's
  std::array<double, Most> Rims;    // the length of the triangle's rim
  std::array<std::uint8_t, Most> Crossed;
  // Corners without repetition, and which of them each patch has.
  std::vector<Vec3> Points;
  std::array<std::array<std::uint8_t, 3>, Most> Corner;
  // Pairs of patches that touch along an edge of the surface; found when first needed.
  bool Linked = false;
  std::vector<std::array<std::uint8_t, 2>> Links;

  // Room for one question.
  std::array<double, Most> Open;
  std::array<double, Most> Lit;
  std::array<double, Most> Doubt;
  std::array<double, Most> Quadrature;
  std::array<std::uint8_t, Most> Facing; // patches that the light may reach
  std::array<std::uint8_t, Most> Piece;  // of each patch: the connected piece it belongs to
  bool WholePieces = false;              // those are of all patches of the cluster
  std::size_t PieceCount = 0;
  std::array<std::vector<Segment3>, 8> Candidates;
  std::vector<Segment3> Lines;
  std::vector<Vec3> Cluster;
  std::vector<RayEnd> Starts;
  std::vector<std::uint8_t> StartOf;
  std::vector<std::uint8_t> Hidden;
  std::size_t Bands;         // where panes let light through; 0: everything is opaque
  std::vector<double> Tint;  // patches x bands, see Tints; empty: everything is opaque
  std::vector<double> Shares; // of a band
};

} // namespace radiometry
