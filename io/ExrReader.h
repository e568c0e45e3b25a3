// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ExrImage.h"

#include <cstdint>

namespace radiometry::io
{

struct ExrReadOptions
{
  /// NaN and infinities are kept. Else the first one is an error that names channel, pixel and
  /// value.
  bool KeepNonFinite = true;
  /// A picture kept as luminance and sub-sampled chroma (Y, RY, BY) becomes R, G, B; channels
  /// that are sub-sampled in another picture stay as they are.
  bool DecodeLuminanceChroma = true;
  /// The most bytes that the pixels of all parts may take; more is an error before any is read.
  std::uint64_t MemoryLimit = std::uint64_t(4) << 30;
  /// Threads that unpack pixels (0: all). What is read does not depend on it.
  int Threads = 0;
};

/// Reads the headers only: channels without data.
ExrImage ReadExrHeaders(const std::string& fileName, const ExrReadOptions& options = {});

/// Reads every part of an OpenEXR file. Half and float channels arrive as float, uint as uint.
///
///   Cost    memory as told by MemoryLimit, plus some lines; time one pass
///   Fails   FileError: not an OpenEXR file, damaged or cut short, pixels missing, larger than
///           the memory limit, deep data (several samples a pixel, which this does not read)
ExrImage ReadExr(const std::string& fileName, const ExrReadOptions& options = {});

} // namespace radiometry::io
