// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrImage.h"

#include <stdexcept>

namespace radiometry::io
{
namespace
{

const char* const compressionNames[] = { "None", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44",
  "B44A", "DWAA", "DWAB" };

} // namespace

std::string ToString(ExrCompression compression)
{
  return compressionNames[static_cast<int>(compression)];
}

ExrCompression CompressionFromString(const std::string& name)
{
  int i = 0;
  for (const char* known : compressionNames)
  {
    if (name == known)
    {
      return static_cast<ExrCompression>(i);
    }
    ++i;
  }
  throw std::invalid_argument("no compression '" + name +
    "'; there are None, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB");
}

ExrChromaticities Rec709Chromaticities()
{
  return { 0.6400f, 0.3300f, 0.3000f, 0.6000f, 0.1500f, 0.0600f, 0.3127f, 0.3290f };
}

ExrChannel ExrChannel::View(
  const std::string& name, const float* data, int width, ExrPixelType type)
{
  ExrChannel channel;
  channel.Name = name;
  channel.Type = type;
  channel.Data = data;
  channel.YStride = width;
  return channel;
}

double ExrChannel::At(std::ptrdiff_t i, std::ptrdiff_t j) const
{
  const std::ptrdiff_t at = i * this->XStride + j * this->YStride;
  switch (this->Kind)
  {
    case Memory::Float64:
      return static_cast<const double*>(this->Data)[at];
    case Memory::UInt32:
      return static_cast<const std::uint32_t*>(this->Data)[at];
    default:
      return static_cast<const float*>(this->Data)[at];
  }
}

const ExrChannel* ExrPart::Find(const std::string& channel) const
{
  for (const ExrChannel& c : this->Channels)
  {
    if (c.Name == channel)
    {
      return &c;
    }
  }
  return nullptr;
}

} // namespace radiometry::io
