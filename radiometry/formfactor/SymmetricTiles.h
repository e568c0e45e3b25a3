// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace radiometry
{

/// A dense symmetric matrix in square tiles of which only the upper triangle is kept, so that
/// S_ij = S_ji to the last bit and rows can be worked on independently of each other.
template <class T>
class SymmetricTiles
{
public:
  static constexpr std::size_t Edge = 64;

  static std::size_t Blocks(std::size_t n) { return (n + Edge - 1) / Edge; }
  static std::size_t Bytes(std::size_t n)
  {
    return Blocks(n) * (Blocks(n) + 1) / 2 * Edge * Edge * sizeof(T);
  }

  void Resize(std::size_t n)
  {
    this->Count = Blocks(n);
    this->Values.assign(this->Count * (this->Count + 1) / 2 * Edge * Edge, T(0));
  }
  std::size_t TileCount() const { return this->Count * (this->Count + 1) / 2; }
  /// Row-major Edge x Edge values of block row i <= block column j.
  T* Tile(std::size_t i, std::size_t j) { return this->Values.data() + this->Offset(i, j); }
  const T* Tile(std::size_t i, std::size_t j) const
  {
    return this->Values.data() + this->Offset(i, j);
  }

  /// sums[r] += row r of block `block` times x (padded to whole blocks).
  void MultiplyBlock(std::size_t block, const double* x, double* sums) const
  {
    for (std::size_t other = 0; other < this->Count; ++other)
    {
      const double* v = x + other * Edge;
      if (other < block)
      {
        const T* tile = this->Tile(other, block);
        for (std::size_t k = 0; k < Edge; ++k)
        {
          const double factor = v[k];
          for (std::size_t r = 0; r < Edge; ++r)
          {
            sums[r] += static_cast<double>(tile[k * Edge + r]) * factor;
          }
        }
      }
      else
      {
        const T* tile = this->Tile(block, other);
        for (std::size_t r = 0; r < Edge; ++r)
        {
          double lanes[8] = {};
          for (std::size_t k = 0; k < Edge; k += 8)
          {
            for (std::size_t l = 0; l < 8; ++l)
            {
              lanes[l] += static_cast<double>(tile[r * Edge + k + l]) * v[k + l];
            }
          }
          sums[r] += ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) +
            ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
        }
      }
    }
  }

private:
  std::size_t Offset(std::size_t i, std::size_t j) const
  {
    return (i * this->Count - i * (i + 1) / 2 + j) * Edge * Edge;
  }

  std::size_t Count = 0;
  std::vector<T> Values;
};

} // namespace radiometry
