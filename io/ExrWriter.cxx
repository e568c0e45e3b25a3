// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrWriter.h"

#include "io/AsideFile.h"
#include "io/ExrHeader.h"
#include "io/ExrThreads.h"

#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfTiledOutputPart.h>
#include <algorithm>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

namespace radiometry::io
{
namespace
{

class AsideStream : public Imf::OStream
{
public:
  AsideStream(AsideFile& file, const std::string& name)
    : Imf::OStream(name.c_str())
    , File(file)
  {
  }
  void write(const char c[], int n) override { this->File.Write(c, static_cast<std::size_t>(n)); }
  std::uint64_t tellp() override { return this->File.Tell(); }
  void seekp(std::uint64_t position) override { this->File.Seek(position); }

private:
  AsideFile& File;
};

/// What is wrong with writing a value as this type; null when nothing is.
const char* Objection(double value, ExrPixelType type, bool keepNonFinite)
{
  if (type == ExrPixelType::UInt)
  {
    const bool fits = value >= 0.0 && value <= UINT32_MAX && value == std::floor(value);
    return fits ? nullptr : "expected a whole number from 0 to 4294967295";
  }
  if (!std::isfinite(value))
  {
    return keepNonFinite ? nullptr : "expected a finite number (KeepNonFinite writes it as it is)";
  }
  if (type == ExrPixelType::Half && std::abs(value) >= 65520.0)
  {
    return "does not fit half, which ends at 65504: use float";
  }
  return std::abs(value) > FLT_MAX ? "does not fit float, which ends at 3.4e38" : nullptr;
}

struct Extent
{
  long long Columns;
  long long Rows;
};

Extent SampleExtent(const ExrChannel& channel, const ExrBox& window)
{
  return { CountSamples(channel.XSampling, window.XMin, window.XMax),
    CountSamples(channel.YSampling, window.YMin, window.YMax) };
}

void CheckChannel(
  const std::string& file, const ExrPart& part, const ExrChannel& channel, bool keepNonFinite)
{
  if (!channel.Data)
  {
    throw FileError(file, "channel '" + channel.Name + "' has no data");
  }
  const ExrBox& w = part.DataWindow;
  if (channel.XSampling < 1 || channel.YSampling < 1 || w.XMin % channel.XSampling ||
    w.YMin % channel.YSampling || w.Width() % channel.XSampling || w.Height() % channel.YSampling)
  {
    throw FileError(
      file, "channel '" + channel.Name + "': its sampling does not divide the data window");
  }
  const Extent extent = SampleExtent(channel, w);
  for (long long j = 0; j < extent.Rows; ++j)
  {
    for (long long i = 0; i < extent.Columns; ++i)
    {
      const double value = channel.At(i, j);
      if (const char* objection = Objection(value, channel.Type, keepNonFinite))
      {
        char number[40];
        std::snprintf(number, sizeof number, "%.9g", value);
        throw FileError(file,
          "channel '" + channel.Name + "', pixel (" +
            std::to_string(w.XMin + i * channel.XSampling) + ", " +
            std::to_string(w.YMin + j * channel.YSampling) + "): " + number + ": " + objection);
      }
    }
  }
}

/// Some rows of one channel in the type of the file.
struct Block
{
  std::vector<char> Bytes;

  Imf::Slice Fill(const ExrChannel& channel, const ExrBox& window, int yBegin, int yEnd)
  {
    const long long columns = SampleExtent(channel, window).Columns;
    const long long first = CountSamples(channel.YSampling, window.YMin, yBegin - 1);
    const long long end = CountSamples(channel.YSampling, window.YMin, yEnd - 1);
    const std::size_t size = channel.Type == ExrPixelType::Half ? 2 : 4;
    this->Bytes.resize(std::max<std::size_t>(size, size * columns * (end - first)));
    char* to = this->Bytes.data();
    for (long long j = first; j < end; ++j)
    {
      for (long long i = 0; i < columns; ++i, to += size)
      {
        this->Put(channel, channel.Data, i * channel.XStride + j * channel.YStride, to);
      }
    }
    const Imf::PixelType type = channel.Type == ExrPixelType::Half
      ? Imf::HALF
      : (channel.Type == ExrPixelType::UInt ? Imf::UINT : Imf::FLOAT);
    const Imath::Box2i rows{ { window.XMin, yBegin }, { window.XMax, yEnd - 1 } };
    return Imf::Slice::Make(
      type, this->Bytes.data(), rows, size, size * columns, channel.XSampling, channel.YSampling);
  }

private:
  static void Put(const ExrChannel& channel, const void* data, std::ptrdiff_t at, char* to)
  {
    // Float to float is a copy of bits, so that a NaN keeps its payload.
    if (channel.Kind == ExrChannel::Memory::Float32 && channel.Type == ExrPixelType::Float)
    {
      std::memcpy(to, static_cast<const float*>(data) + at, 4);
      return;
    }
    double value = 0;
    switch (channel.Kind)
    {
      case ExrChannel::Memory::Float32:
        value = static_cast<const float*>(data)[at];
        break;
      case ExrChannel::Memory::Float64:
        value = static_cast<const double*>(data)[at];
        break;
      case ExrChannel::Memory::UInt32:
        value = static_cast<const std::uint32_t*>(data)[at];
        break;
    }
    if (channel.Type == ExrPixelType::UInt)
    {
      const auto u = static_cast<std::uint32_t>(value);
      std::memcpy(to, &u, 4);
    }
    else if (channel.Type == ExrPixelType::Half)
    {
      const Imath::half h(static_cast<float>(value));
      std::memcpy(to, &h, 2);
    }
    else
    {
      const float f = static_cast<float>(value);
      std::memcpy(to, &f, 4);
    }
  }
};

void WritePart(Imf::MultiPartOutputFile& file, int index, const ExrPart& part)
{
  const ExrBox& w = part.DataWindow;
  const bool tiled = part.TileWidth > 0;
  const int step = tiled
    ? part.TileHeight
    : std::max(LinesPerChunk(static_cast<Imf::Compression>(part.Compression)) * 8, 64);
  std::vector<Block> blocks(part.Channels.size());
  for (long long begin = w.YMin; begin <= w.YMax; begin += step)
  {
    const int yBegin = static_cast<int>(begin);
    const int yEnd = static_cast<int>(std::min<long long>(begin + step, w.YMax + 1LL));
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < blocks.size(); ++c)
    {
      frame.insert(part.Channels[c].Name, blocks[c].Fill(part.Channels[c], w, yBegin, yEnd));
    }
    if (tiled)
    {
      Imf::TiledOutputPart out(file, index);
      out.setFrameBuffer(frame);
      const int row = (yBegin - w.YMin) / part.TileHeight;
      out.writeTiles(0, out.numXTiles() - 1, row, row);
    }
    else
    {
      Imf::OutputPart out(file, index);
      out.setFrameBuffer(frame);
      out.writePixels(yEnd - yBegin);
    }
  }
}

/// A copy in which the parts agree on what the format makes them share: a display window that is not
/// said is that of the others, or all of their pixels; chromaticities of one are those of all.
ExrImage WithSharedAttributes(const std::string& file, ExrImage image)
{
  const auto disagree = [&](const ExrPart& part, const char* what) {
    throw FileError(file,
      "part '" + part.Name + "' has another " + what +
        " than the parts before it: all parts of a file share it");
  };
  ExrBox shared;
  ExrBox pixels = image.front().DataWindow;
  const ExrAttribute* chromaticities = nullptr;
  for (const ExrPart& part : image)
  {
    const bool said = part.DisplayWindow.Width() > 0 && part.DisplayWindow.Height() > 0;
    if (said && shared.Width() > 0 && !(shared == part.DisplayWindow))
    {
      disagree(part, "display window");
    }
    shared = said ? part.DisplayWindow : shared;
    pixels = { std::min(pixels.XMin, part.DataWindow.XMin),
      std::min(pixels.YMin, part.DataWindow.YMin), std::max(pixels.XMax, part.DataWindow.XMax),
      std::max(pixels.YMax, part.DataWindow.YMax) };
    if (part.PixelAspectRatio != image.front().PixelAspectRatio)
    {
      disagree(part, "aspect ratio of pixels");
    }
    const auto own = part.Attributes.find("chromaticities");
    if (own != part.Attributes.end())
    {
      if (chromaticities && *chromaticities != own->second)
      {
        disagree(part, "set of chromaticities");
      }
      chromaticities = &own->second;
    }
  }
  const ExrAttribute colours = chromaticities ? *chromaticities : ExrAttribute();
  for (ExrPart& part : image)
  {
    part.DisplayWindow = shared.Width() > 0 ? shared : pixels;
    if (chromaticities)
    {
      part.Attributes["chromaticities"] = colours;
    }
  }
  return image;
}

} // namespace

void WriteExr(const std::string& fileName, const ExrImage& parts, const ExrWriteOptions& options)
{
  if (parts.empty())
  {
    throw FileError(fileName, "no image to write");
  }
  const ExrImage image = parts.size() > 1 ? WithSharedAttributes(fileName, parts) : parts;
  std::vector<Imf::Header> headers;
  std::set<std::string> names;
  for (const ExrPart& part : image)
  {
    headers.push_back(MakeHeader(fileName, part, image.size() > 1));
    if (image.size() > 1 && !names.insert(part.Name).second)
    {
      throw FileError(fileName, "two parts named '" + part.Name + "'");
    }
    for (const ExrChannel& channel : part.Channels)
    {
      CheckChannel(fileName, part, channel, options.KeepNonFinite);
    }
  }
  AsideFile aside(fileName);
  try
  {
    AsideStream stream(aside, fileName);
    Imf::MultiPartOutputFile file(
      stream, headers.data(), static_cast<int>(headers.size()), false, ExrThreads(options.Threads));
    for (std::size_t i = 0; i < image.size(); ++i)
    {
      WritePart(file, static_cast<int>(i), image[i]);
    }
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw FileError(fileName, e.what());
  }
  aside.Commit();
}

} // namespace radiometry::io
