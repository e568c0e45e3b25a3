// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrReader.h"

#include "io/ExrColor.h"
#include "io/ExrHeader.h"
#include "io/ExrThreads.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <ImfXdr.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>

namespace radiometry::io
{
namespace
{

std::string Pixels(const ExrBox& box)
{
  return std::to_string(box.Width()) + " x " + std::to_string(box.Height()) + " pixels";
}

/// Bytes that the samples of one pixel take at full sampling.
double BytesPerPixel(const ExrPart& part)
{
  return 4.0 * static_cast<double>(part.Channels.size());
}

/// Refuses a header before OpenEXR allocates what it asks for. `left` is the number of bytes that
/// follow the headers: every chunk of pixels takes at least 8 of them for its place in the table.
void CheckHeader(const std::string& file, const Imf::Header& header, const ExrPart& part,
  double left, const ExrReadOptions& options)
{
  const auto refuse = [&](const std::string& what) { throw FileError(file, what); };
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE)
  {
    refuse("the part '" + part.Name + "' is of type '" + header.type() +
      "': expected a picture of scan lines or tiles");
  }
  const ExrBox& w = part.DataWindow;
  if (w.Width() < 1 || w.Height() < 1)
  {
    refuse("is damaged: a data window of " + Pixels(w));
  }
  for (const ExrChannel& channel : part.Channels)
  {
    if (channel.XSampling < 1 || channel.YSampling < 1)
    {
      refuse("is damaged: sampling of channel '" + channel.Name + "'");
    }
  }
  const double limit = static_cast<double>(options.MemoryLimit);
  const double width = static_cast<double>(w.Width());
  const double height = static_cast<double>(w.Height());
  const double bytes = BytesPerPixel(part);
  double buffer = 0;
  double chunks = 0;
  if (header.hasTileDescription())
  {
    const Imf::TileDescription& tiles = header.tileDescription();
    if (tiles.xSize < 1 || tiles.ySize < 1)
    {
      refuse("is damaged: tiles without pixels");
    }
    buffer = bytes * tiles.xSize * std::max<double>(tiles.ySize, 1) +
      bytes * width * tiles.ySize; // a row of tiles, to read lines from
    chunks = std::ceil(width / tiles.xSize) * std::ceil(height / tiles.ySize);
  }
  else
  {
    const int lines = LinesPerChunk(header.compression());
    buffer = bytes * width * lines;
    chunks = std::ceil(height / lines);
  }
  if (bytes * width * height > limit || buffer > limit)
  {
    char size[40];
    std::snprintf(size, sizeof size, "%.3g", std::max(bytes * width * height, buffer) / 1048576.0);
    refuse("asks for " + std::string(size) + " MiB (" + Pixels(w) + ", " +
      std::to_string(part.Channels.size()) + " channels): more than the memory limit of " +
      std::to_string(options.MemoryLimit >> 20) + " MiB");
  }
  if (8.0 * chunks > left)
  {
    refuse("is damaged or cut short: " + Pixels(w) + " in " +
      std::to_string(static_cast<long long>(left)) + " bytes");
  }
}

/// Reads and checks the headers, before any object of OpenEXR that allocates by them.
ExrImage CheckedHeaders(const std::string& fileName, const ExrReadOptions& options)
{
  std::error_code error;
  const auto status = std::filesystem::status(fileName, error);
  if (!std::filesystem::exists(status))
  {
    throw FileError(fileName, "no such file");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw FileError(fileName, "is not a regular file");
  }
  const auto size = std::filesystem::file_size(fileName, error);
  if (error)
  {
    throw FileError(fileName, error.message());
  }
  Imf::StdIFStream stream(fileName.c_str());
  int magic = 0;
  int version = 0;
  Imf::Xdr::read<Imf::StreamIO>(stream, magic);
  Imf::Xdr::read<Imf::StreamIO>(stream, version);
  if (magic != Imf::MAGIC)
  {
    throw FileError(fileName, "is not an OpenEXR file");
  }
  if (Imf::getVersion(version) != Imf::EXR_VERSION || !Imf::supportsFlags(Imf::getFlags(version)))
  {
    throw FileError(fileName, "is of a version of OpenEXR that is not known");
  }
  if (Imf::isNonImage(version))
  {
    throw FileError(fileName, "holds deep data: expected a picture of scan lines or tiles");
  }
  std::vector<Imf::Header> headers;
  do
  {
    Imf::Header header;
    header.readFrom(stream, version);
    if (header.readsNothing())
    {
      break;
    }
    headers.push_back(header);
  } while (Imf::isMultiPart(version));
  ExrImage image;
  const double left = static_cast<double>(size) - static_cast<double>(stream.tellg());
  double total = 0;
  for (Imf::Header& header : headers)
  {
    header.sanityCheck(header.hasTileDescription(), Imf::isMultiPart(version));
    image.push_back(ReadHeader(header));
    CheckHeader(fileName, header, image.back(), left, options);
    const ExrBox& w = image.back().DataWindow;
    total += BytesPerPixel(image.back()) * static_cast<double>(w.Width()) * w.Height();
  }
  if (total > static_cast<double>(options.MemoryLimit))
  {
    throw FileError(fileName, "all parts together take more than the memory limit");
  }
  if (image.empty())
  {
    throw FileError(fileName, "is damaged: no header");
  }
  return image;
}

/// Memory that grows as lines arrive, so that a short file never takes what its header promises.
template <typename T>
struct Samples
{
  std::shared_ptr<std::vector<T>> Values = std::make_shared<std::vector<T>>();
};

void CheckFinite(const std::string& file, const ExrPart& part)
{
  for (const ExrChannel& channel : part.Channels)
  {
    if (channel.Kind == ExrChannel::Memory::UInt32)
    {
      continue;
    }
    const ExrBox& w = part.DataWindow;
    const long long columns = CountSamples(channel.XSampling, w.XMin, w.XMax);
    const long long rows = CountSamples(channel.YSampling, w.YMin, w.YMax);
    for (long long k = 0; k < columns * rows; ++k)
    {
      const float value = static_cast<const float*>(channel.Data)[k];
      if (!std::isfinite(value))
      {
        throw FileError(file,
          "channel '" + channel.Name + "', pixel (" +
            std::to_string(w.XMin + (k % columns) * channel.XSampling) + ", " +
            std::to_string(w.YMin + (k / columns) * channel.YSampling) +
            "): " + std::to_string(value) + ": expected a finite number");
      }
    }
  }
}

void ReadPart(Imf::MultiPartInputFile& file, int index, ExrPart& part)
{
  Imf::InputPart input(file, index);
  const ExrBox& w = part.DataWindow;
  const Imath::Box2i window{ { w.XMin, w.YMin }, { w.XMax, w.YMax } };
  std::vector<std::function<void(long long)>> grow;
  std::vector<std::function<void()>> publish;
  Imf::FrameBuffer frame;
  for (ExrChannel& channel : part.Channels)
  {
    const long long columns = CountSamples(channel.XSampling, w.XMin, w.XMax);
    const long long rows = CountSamples(channel.YSampling, w.YMin, w.YMax);
    const auto prepare = [&](auto samples, Imf::PixelType type) {
      auto values = samples.Values;
      values->reserve(std::max<long long>(columns * rows, 1)); // the address never changes after
      frame.insert(channel.Name,
        Imf::Slice::Make(
          type, values->data(), window, 4, 4 * columns, channel.XSampling, channel.YSampling));
      grow.push_back([values, columns, w, &channel](long long yLast) {
        values->resize(columns * CountSamples(channel.YSampling, w.YMin, static_cast<int>(yLast)));
      });
      publish.push_back([values, columns, &channel] {
        channel.Owner = values;
        channel.Data = values->data();
        channel.YStride = columns;
      });
    };
    if (channel.Type == ExrPixelType::UInt)
    {
      prepare(Samples<std::uint32_t>(), Imf::UINT);
    }
    else
    {
      prepare(Samples<float>(), Imf::FLOAT);
    }
  }
  input.setFrameBuffer(frame);
  const long long step = part.TileHeight > 0
    ? part.TileHeight
    : std::max(64, 8 * LinesPerChunk(static_cast<Imf::Compression>(part.Compression)));
  for (long long y = w.YMin; y <= w.YMax; y += step)
  {
    const long long last = std::min<long long>(y + step - 1, w.YMax);
    for (const auto& f : grow)
    {
      f(last);
    }
    input.readPixels(static_cast<int>(y), static_cast<int>(last));
  }
  for (const auto& f : publish)
  {
    f();
  }
}

ExrImage Guarded(const std::string& fileName, const std::function<ExrImage()>& body)
{
  try
  {
    return body();
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    throw FileError(fileName, "asks for more memory than there is");
  }
  catch (const std::exception& e)
  {
    throw FileError(fileName, std::string("cannot be read: ") + e.what());
  }
}

} // namespace

ExrImage ReadExrHeaders(const std::string& fileName, const ExrReadOptions& options)
{
  return Guarded(fileName, [&] { return CheckedHeaders(fileName, options); });
}

ExrImage ReadExr(const std::string& fileName, const ExrReadOptions& options)
{
  return Guarded(fileName, [&] {
    ExrImage image = CheckedHeaders(fileName, options);
    {
      Imf::MultiPartInputFile file(fileName.c_str(), ExrThreads(options.Threads), false);
      if (file.parts() != static_cast<int>(image.size()))
      {
        throw FileError(fileName, "is damaged: its parts do not match its headers");
      }
      for (std::size_t i = 0; i < image.size(); ++i)
      {
        ReadPart(file, static_cast<int>(i), image[i]);
      }
    }
    for (ExrPart& part : image)
    {
      if (options.DecodeLuminanceChroma)
      {
        DecodeLuminanceChroma(fileName, part);
      }
      if (!options.KeepNonFinite)
      {
        CheckFinite(fileName, part);
      }
    }
    return image;
  });
}

} // namespace radiometry::io
