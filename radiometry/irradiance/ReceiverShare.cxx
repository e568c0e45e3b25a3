// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/ReceiverShare.h"

#include <algorithm>
#include <numeric>

namespace radiometry
{

ReceiverShare::ReceiverShare(const Communicator& ranks, const std::vector<std::uint32_t>& order,
  const std::vector<std::uint32_t>& first)
  : Ranks(ranks)
  , Own(static_cast<std::size_t>(ranks.Rank()))
{
  const auto size = static_cast<std::size_t>(ranks.Size());
  this->Dealt.reserve(order.size());
  for (std::size_t r = 0; r < size; ++r)
  {
    this->Starts.push_back(this->Dealt.size());
    for (std::size_t g = r; g + 1 < first.size(); g += size)
    {
      this->Dealt.insert(this->Dealt.end(), order.begin() + first[g], order.begin() + first[g + 1]);
    }
  }
  this->Starts.push_back(this->Dealt.size());
}

std::vector<double> ReceiverShare::Gather(const std::vector<double>& own, std::size_t width) const
{
  std::vector<std::size_t> begin;
  for (const std::size_t start : this->Starts)
  {
    begin.push_back(width * start);
  }
  std::vector<double> dealt(width * this->Dealt.size());
  std::copy(own.begin(), own.end(), dealt.begin() + static_cast<std::ptrdiff_t>(begin[this->Own]));
  this->Ranks.Gather(dealt.data(), begin);
  std::vector<double> all(dealt.size());
  for (std::size_t k = 0; k < this->Dealt.size(); ++k)
  {
    std::copy_n(&dealt[width * k], width, &all[width * this->Dealt[k]]);
  }
  return all;
}

void PlainGroups(
  std::size_t n, std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& first)
{
  constexpr std::size_t most = 64;
  order.resize(n);
  std::iota(order.begin(), order.end(), 0u);
  first.clear();
  for (std::size_t k = 0; k < n; k += most)
  {
    first.push_back(static_cast<std::uint32_t>(k));
  }
  first.push_back(static_cast<std::uint32_t>(n));
}

} // namespace radiometry
