// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FileError.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace radiometry::io
{

/// How a channel lies in the file.
enum class ExrPixelType
{
  Half,
  Float,
  UInt
};

/// How the pixels of a part are packed. All but the last five lose nothing.
enum class ExrCompression
{
  None,
  RLE,
  ZIPS,
  ZIP,
  PIZ,
  PXR24, ///< rounds float to 24 bits
  B44,
  B44A,
  DWAA,
  DWAB
};

/// The name of a compression as people write it ("ZIP"), and back.
std::string ToString(ExrCompression compression);
/// Fails with std::invalid_argument for a name that is none.
ExrCompression CompressionFromString(const std::string& name);

/// A rectangle of pixels, both ends included; y counts downward. Empty when max < min.
struct ExrBox
{
  int XMin = 0;
  int YMin = 0;
  int XMax = -1;
  int YMax = -1;

  static ExrBox OfSize(int width, int height) { return { 0, 0, width - 1, height - 1 }; }
  long long Width() const { return static_cast<long long>(XMax) - XMin + 1; }
  long long Height() const { return static_cast<long long>(YMax) - YMin + 1; }
  bool operator==(const ExrBox& o) const
  {
    return XMin == o.XMin && YMin == o.YMin && XMax == o.XMax && YMax == o.YMax;
  }
};

/// The xy chromaticities of red, green, blue and white, in this order.
using ExrChromaticities = std::array<float, 8>;
/// Rec. ITU-R BT.709 with a D65 white.
ExrChromaticities Rec709Chromaticities();

/// What a header can say beside its pixels. A file may have other types: reading names them in
/// ExrPart::SkippedAttributes. "envmap" is the text "latlong" or "cube".
using ExrAttribute =
  std::variant<int, float, double, std::string, std::array<float, 2>, std::array<float, 3>,
    std::array<double, 3>, std::vector<float>, std::vector<std::string>, ExrChromaticities>;

/// True for the names that the format keeps for itself (channels, dataWindow, ...): no attribute of
/// ExrPart::Attributes may have one.
bool IsStructuralAttribute(const std::string& name);

/// One channel: its pixels either belong to the caller (writing) or to the channel (reading).
/// Sample (i, j), counted from the upper left of the data window in steps of the sampling, is at
/// Data[i * XStride + j * YStride], strides in samples; a picture stored bottom-up has a negative
/// YStride and Data at its last row.
struct ExrChannel
{
  enum class Memory
  {
    Float32,
    Float64,
    UInt32
  };

  std::string Name;
  ExrPixelType Type = ExrPixelType::Float;
  Memory Kind = Memory::Float32;
  const void* Data = nullptr;
  std::ptrdiff_t XStride = 1;
  std::ptrdiff_t YStride = 0;
  int XSampling = 1; ///< 2: every second pixel has a sample
  int YSampling = 1;
  std::shared_ptr<void> Owner; ///< keeps Data alive where the channel owns it

  /// A channel of the caller's pixels, packed row by row from the top.
  static ExrChannel View(
    const std::string& name, const float* data, int width, ExrPixelType type = ExrPixelType::Float);
  /// The sample as a number.
  double At(std::ptrdiff_t i, std::ptrdiff_t j) const;
};

/// One picture of a file (most files have one). The parts of a file share the display window, the
/// aspect ratio of pixels and the chromaticities.
struct ExrPart
{
  std::string Name; ///< must be set and unique in a file of several parts
  std::string View; ///< "left", "right" of a stereo pair, or empty
  ExrBox DataWindow;
  ExrBox DisplayWindow; ///< empty: the data window
  float PixelAspectRatio = 1.0f;
  ExrCompression Compression = ExrCompression::ZIP;
  float DwaLevel = 45.0f; ///< DWAA, DWAB: 0 nearly lossless, more is smaller and worse
  int TileWidth = 0; ///< 0: scan lines
  int TileHeight = 0;
  std::vector<ExrChannel> Channels;
  std::map<std::string, ExrAttribute> Attributes; ///< chromaticities, whiteLuminance, ...
  std::vector<std::string> SkippedAttributes;     ///< reading: present, of another type

  const ExrChannel* Find(const std::string& channel) const;
};

using ExrImage = std::vector<ExrPart>;

} // namespace radiometry::io
