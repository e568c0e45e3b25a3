// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace radiometry
{

/// Sets of the numbers 0 to n - 1 that grow together as links between them are met (union-find).
/// The least number of a set stands for it, so the answer does not depend on the links' order.
class LinkedSets
{
public:
  explicit LinkedSets(std::size_t n)
    : Leader(n)
  {
    std::iota(this->Leader.begin(), this->Leader.end(), 0);
  }

  /// The number that stands for k's set.
  std::int32_t Root(std::int32_t k)
  {
    while (this->Leader[static_cast<std::size_t>(k)] != k)
    {
      auto& up = this->Leader[static_cast<std::size_t>(k)];
      up = this->Leader[static_cast<std::size_t>(up)];
      k = up;
    }
    return k;
  }

  void Join(std::int32_t a, std::int32_t b)
  {
    a = this->Root(a);
    b = this->Root(b);
    this->Leader[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<std::int32_t> Leader;
};

} // namespace radiometry
