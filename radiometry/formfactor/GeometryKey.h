// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace radiometry
{

/// 128 bits of some content: equal for equal content, and for different content only by a chance
/// that can be left out of account.
class ContentKey
{
public:
  void Add(std::uint64_t word)
  {
    this->Low = (this->Low ^ word) * 0x9e3779b97f4a7c15ull;
    this->Low ^= this->Low >> 29;
    this->High = (this->High + word) * 0xd6e8feb86659fd93ull;
    this->High ^= this->High >> 32;
  }
  void AddBytes(const void* data, std::size_t bytes);
  template <class T>
  void Add(const std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Add(static_cast<std::uint64_t>(values.size()));
    this->AddBytes(values.data(), values.size() * sizeof(T));
  }
  bool operator==(const ContentKey& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
  bool operator!=(const ContentKey& other) const { return !(*this == other); }

  std::uint64_t Low = 0x243f6a8885a308d3ull;
  std::uint64_t High = 0x13198a2e03707344ull;
};

/// What operators depend on whatever they follow: points, triangles, the cells that these belong
/// to, the sides that receive, and which triangles let how much light through.
ContentKey KeyOfGeometry(const Scene& scene);

/// What operators that follow light over mirrors and panes depend on beside: specular reflectance
/// and shininess.
ContentKey KeyOfMirrors(const Scene& scene);

} // namespace radiometry
