// SPDX-License-Identifier: BSD-3-Clause
//
// PatchBlock: how the patches of a cluster hang together.
#include "radiometry/irradiance/PatchBlock.h"

#include <algorithm>
#include <cstring>

namespace radiometry
{

/// Corners of equal coordinates are one: points of a scene are.
void PatchBlock::FindPoints()
{
  constexpr std::size_t slots = 512;
  std::array<std::uint8_t, slots> place;
  place.fill(0xff);
  this->Points.clear();
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& p = this->Patches[this->Ids[i]].Corners[k];
      std::uint64_t bits[3];
      std::memcpy(bits, &p, sizeof bits);
      const std::uint64_t mixed =
        (bits[0] * 0x9e3779b97f4a7c15ull) ^ (bits[1] * 0xbf58476d1ce4e5b9ull) ^
        (bits[2] * 0x94d049bb133111ebull);
      std::size_t slot = (mixed ^ (mixed >> 32)) * 0x9e3779b97f4a7c15ull >> 55;
      while (place[slot] != 0xff && !(this->Points[place[slot]] == p))
      {
        slot = (slot + 1) % slots;
      }
      if (place[slot] == 0xff)
      {
        place[slot] = static_cast<std::uint8_t>(this->Points.size());
        this->Points.push_back(p);
      }
      this->Corner[i][k] = place[slot];
    }
  }
}

/// Patches of one triangle touch; others touch where they have two corners in common: then the line
/// between these is on an edge of both their triangles (or else one cuts through the other).
void PatchBlock::FindLinks()
{
  constexpr std::size_t slots = 512;
  std::array<std::uint16_t, slots> edge;
  std::array<std::uint8_t, slots> owner;
  edge.fill(0xffff);
  this->Linked = true;
  this->WholePieces = false;
  this->Links.clear();
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    const auto mine = static_cast<std::uint8_t>(i);
    if (i > 0 &&
      this->Patches[this->Ids[i]].Triangle == this->Patches[this->Ids[i - 1]].Triangle)
    {
      this->Links.push_back({ static_cast<std::uint8_t>(i - 1), mine });
    }
    for (int k = 0; k < 3; ++k)
    {
      const unsigned a = this->Corner[i][k];
      const unsigned b = this->Corner[i][(k + 1) % 3];
      const auto key = static_cast<std::uint16_t>((std::min(a, b) << 8) | std::max(a, b));
      std::size_t slot = (key * 40503u >> 4) % slots;
      while (edge[slot] != 0xffff && edge[slot] != key)
      {
        slot = (slot + 1) % slots;
      }
      if (edge[slot] == key)
      {
        this->Links.push_back({ owner[slot], mine });
      }
      edge[slot] = key;
      owner[slot] = mine;
    }
  }
}

/// Parts Facing[begin, end) into connected pieces: Piece holds the number of each; returns how many.
std::size_t PatchBlock::FindPieces(std::size_t begin, std::size_t end)
{
  if (!this->Linked)
  {
    this->FindLinks();
  }
  const bool whole = end - begin == this->Count;
  if (whole && this->WholePieces)
  {
    return this->PieceCount;
  }
  this->WholePieces = whole;
  constexpr std::uint8_t absent = 0xff;
  std::array<std::uint8_t, Most> root;
  root.fill(absent);
  for (std::size_t k = begin; k < end; ++k)
  {
    root[this->Facing[k]] = this->Facing[k];
  }
  const auto find = [&](std::uint8_t i) {
    while (root[i] != i)
    {
      i = root[i] = root[root[i]];
    }
    return i;
  };
  for (const auto& link : this->Links)
  {
    if (root[link[0]] != absent && root[link[1]] != absent)
    {
      const std::uint8_t a = find(link[0]);
      const std::uint8_t b = find(link[1]);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::array<std::uint8_t, Most> number;
  std::uint8_t pieces = 0;
  for (std::size_t k = begin; k < end; ++k)
  {
    const std::uint8_t i = this->Facing[k]; // ascending, and a root is the least of its piece
    const std::uint8_t r = find(i);
    if (r == i)
    {
      number[i] = pieces++;
    }
    this->Piece[i] = number[r];
  }
  this->PieceCount = pieces;
  return pieces;
}

} // namespace radiometry
