// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace radiometry
{

/// A non-negative number in 8 bits, to 5 %: its logarithm, from 2^-28 to 16.
inline std::uint8_t CodedError(double value)
{
  return value > 0.0
    ? static_cast<std::uint8_t>(std::clamp(std::lround(std::log2(value) * 8.0) + 224l, 1l, 255l))
    : std::uint8_t(0);
}

struct ErrorDecoder
{
  double Value[256];
  ErrorDecoder()
  {
    this->Value[0] = 0.0;
    for (int k = 1; k < 256; ++k)
    {
      this->Value[k] = std::exp2((k - 224) / 8.0);
    }
  }
};
inline double Decoded(std::uint8_t code)
{
  static const ErrorDecoder decoder;
  return decoder.Value[code];
}

} // namespace radiometry
