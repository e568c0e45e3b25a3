// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Archive.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace radiometry
{

/// A dense symmetric matrix in square tiles of which only the upper triangle is kept, so that
/// S_ij = S_ji to the last bit and rows can be worked on independently of each other. Tiles of
/// zeros are not kept at all.
template <class T>
class SymmetricTiles
{
public:
  static constexpr std::size_t Edge = 64;
  static constexpr std::size_t Area = Edge * Edge;

  static std::size_t Blocks(std::size_t n) { return (n + Edge - 1) / Edge; }
  /// Bytes of a matrix without a tile of zeros.
  static std::size_t Bytes(std::size_t n)
  {
    return Blocks(n) * (Blocks(n) + 1) / 2 * (Area * sizeof(T) + sizeof(void*));
  }

  void Resize(std::size_t n)
  {
    this->Count = Blocks(n);
    this->Tiles.clear();
    this->Tiles.resize(this->Count * (this->Count + 1) / 2);
  }
  /// Row-major Edge x Edge values of block row i <= block column j; null: zeros.
  const T* Tile(std::size_t i, std::size_t j) const { return this->Tiles[this->Index(i, j)].get(); }
  /// Room for a tile, not yet set.
  T* Make(std::size_t i, std::size_t j)
  {
    auto& tile = this->Tiles[this->Index(i, j)];
    tile.reset(new T[Area]);
    return tile.get();
  }
  std::size_t MemoryBytes() const
  {
    std::size_t kept = 0;
    for (const auto& tile : this->Tiles)
    {
      kept += tile ? 1 : 0;
    }
    return kept * Area * sizeof(T) + this->Tiles.size() * sizeof(void*);
  }

  /// sums[w Edge + r] += row r of block `block` times right-hand side w of W, which begins at
  /// x + w stride and is padded to whole blocks.
  template <int W>
  void MultiplyBlock(std::size_t block, const double* x, std::size_t stride, double* sums) const
  {
    for (std::size_t other = 0; other < this->Count; ++other)
    {
      const T* tile = other < block ? this->Tile(other, block) : this->Tile(block, other);
      if (!tile)
      {
        continue;
      }
      const double* v = x + other * Edge;
      other < block ? Columns<W>(tile, v, stride, sums) : Rows<W>(tile, v, stride, sums);
    }
  }

  void Save(ArchiveWriter& out) const
  {
    out.Put(static_cast<std::uint64_t>(this->Count));
    std::vector<std::uint8_t> kept;
    for (const auto& tile : this->Tiles)
    {
      kept.push_back(tile ? 1 : 0);
    }
    out.Put(kept);
    for (const auto& tile : this->Tiles)
    {
      if (tile)
      {
        out.Put(std::vector<T>(tile.get(), tile.get() + Area));
      }
    }
  }
  /// Throws std::runtime_error where it is not a matrix of n rows.
  void Load(ArchiveReader& in, std::size_t n)
  {
    this->Resize(n);
    std::vector<std::uint8_t> kept;
    if (in.Get<std::uint64_t>() != this->Count)
    {
      throw std::runtime_error("is damaged: a matrix of another size");
    }
    in.Get(kept);
    if (kept.size() != this->Tiles.size())
    {
      throw std::runtime_error("is damaged: a matrix of another size");
    }
    std::vector<T> values;
    for (std::size_t k = 0; k < kept.size(); ++k)
    {
      if (kept[k])
      {
        in.Get(values);
        if (values.size() != Area)
        {
          throw std::runtime_error("is damaged: a tile of another size");
        }
        this->Tiles[k].reset(new T[Area]);
        std::copy(values.begin(), values.end(), this->Tiles[k].get());
      }
    }
  }

private:
  std::size_t Index(std::size_t i, std::size_t j) const
  {
    return i * this->Count - i * (i + 1) / 2 + j;
  }
  /// The tile's columns are the wanted rows.
  template <int W>
  static void Columns(const T* tile, const double* v, std::size_t stride, double* sums)
  {
    for (std::size_t k = 0; k < Edge; ++k)
    {
      const T* row = tile + k * Edge;
      for (int w = 0; w < W; ++w)
      {
        const double factor = v[static_cast<std::size_t>(w) * stride + k];
        for (std::size_t r = 0; r < Edge; ++r)
        {
          sums[static_cast<std::size_t>(w) * Edge + r] += static_cast<double>(row[r]) * factor;
        }
      }
    }
  }
  template <int W>
  static void Rows(const T* tile, const double* v, std::size_t stride, double* sums)
  {
    for (std::size_t r = 0; r < Edge; ++r)
    {
      const T* row = tile + r * Edge;
      for (int w = 0; w < W; ++w)
      {
        const double* u = v + static_cast<std::size_t>(w) * stride;
        double lanes[8] = {};
        for (std::size_t k = 0; k < Edge; k += 8)
        {
          for (std::size_t l = 0; l < 8; ++l)
          {
            lanes[l] += static_cast<double>(row[k + l]) * u[k + l];
          }
        }
        sums[static_cast<std::size_t>(w) * Edge + r] += ((lanes[0] + lanes[4]) +
          (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
      }
    }
  }

  std::size_t Count = 0;
  std::vector<std::unique_ptr<T[]>> Tiles;
};

} // namespace radiometry
