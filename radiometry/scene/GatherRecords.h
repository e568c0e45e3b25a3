// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace radiometry
{

/// Every rank's records, rank by rank, on all of them. `begin` gets where each rank's begin, one
/// more than there are ranks. Without ranks they stay as they are. Collective.
template <class T>
void GatherRecords(
  const Communicator* ranks, std::vector<T>& records, std::vector<std::size_t>* begin = nullptr)
{
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::int32_t) == 0);
  if (!ranks)
  {
    if (begin)
    {
      *begin = { 0, records.size() };
    }
    return;
  }
  const auto size = static_cast<std::size_t>(ranks->Size());
  const auto own = static_cast<std::size_t>(ranks->Rank());
  std::vector<std::int64_t> counts(size, 0);
  counts[own] = static_cast<std::int64_t>(records.size());
  ranks->Sum(counts.data(), size);
  constexpr std::size_t width = sizeof(T) / sizeof(std::int32_t);
  std::vector<std::size_t> first(size + 1, 0), words(size + 1, 0);
  for (std::size_t r = 0; r < size; ++r)
  {
    first[r + 1] = first[r] + static_cast<std::size_t>(counts[r]);
    words[r + 1] = first[r + 1] * width;
  }
  std::vector<std::int32_t> buffer(words[size]);
  if (!records.empty())
  {
    std::memcpy(buffer.data() + words[own], records.data(), records.size() * sizeof(T));
  }
  ranks->Gather(buffer.data(), words);
  records.resize(first[size]);
  if (!records.empty())
  {
    std::memcpy(static_cast<void*>(records.data()), buffer.data(), records.size() * sizeof(T));
  }
  if (begin)
  {
    *begin = first;
  }
}

} // namespace radiometry
