// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

class SpecularSurfaces;

/// What the operators need to know of the wanted result.
struct ExchangeOptions
{
  double RelativeTolerance = 0.01; // wanted of a row's irradiance
  /// Of each element, a factor of at most 1 on RelativeTolerance for its row; null: 1. What is not
  /// wanted so fine may be coarser. Hierarchical alone looks at it.
  const std::vector<float>* RowTolerance = nullptr;
  bool Occlusion = true;
  std::size_t MemoryLimit = 0; // bytes; 0: none
  int Threads = 0;             // 0: all
  std::uint64_t Seed = 0;      // results of different seeds are independent
  /// Where light goes on over mirrors and through panes (Monte Carlo alone); null: it ends at what it
  /// meets.
  std::shared_ptr<const SpecularSurfaces> Paths;
  double SecondsLeft = 0.0; // for building; past them what remains is estimated coarsely. 0: no limit
  const Communicator* Ranks = nullptr; // that share rows; null: this process alone
};

} // namespace radiometry
