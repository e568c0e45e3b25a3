// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
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
  void Add(double value)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    this->Add(word);
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

inline void ContentKey::AddBytes(const void* data, std::size_t bytes)
{
  const auto* from = static_cast<const unsigned char*>(data);
  std::uint64_t word = 0;
  for (; bytes >= sizeof(word); bytes -= sizeof(word), from += sizeof(word))
  {
    std::memcpy(&word, from, sizeof(word));
    this->Add(word);
  }
  if (bytes > 0)
  {
    word = 0;
    std::memcpy(&word, from, bytes);
    this->Add(word);
  }
}

} // namespace radiometry
