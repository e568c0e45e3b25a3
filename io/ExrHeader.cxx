// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrHeader.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTileDescription.h>
#include <ImfVecAttribute.h>
#include <set>

namespace radiometry::io
{
namespace
{

/// What the attribute "envmap" is as text.
const char* const latLongMap = "latlong";
const char* const cubeMap = "cube";

/// Where the level of DWA stands.
const char* const dwaLevel = "dwaCompressionLevel";

/// OpenEXR's limit on the length of names.
constexpr std::size_t longestName = 255;

const std::set<std::string>& StructuralNames()
{
  static const std::set<std::string> names = { "channels", "compression", "dataWindow",
    "displayWindow", "lineOrder", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth",
    "type", "name", "version", "chunkCount", "tiles", "maxSamplesPerPixel", "view" };
  return names;
}

void CheckName(const std::string& file, const std::string& kind, const std::string& name)
{
  if (name.empty() || name.size() > longestName || name.find('\0') != std::string::npos)
  {
    throw FileError(file,
      kind + " '" + name.substr(0, 40) + "' has a name of " + std::to_string(name.size()) +
        " characters: expected 1 to 255");
  }
}

Imf::PixelType FileType(ExrPixelType type)
{
  return type == ExrPixelType::Half ? Imf::HALF
                                    : (type == ExrPixelType::UInt ? Imf::UINT : Imf::FLOAT);
}

Imf::Chromaticities FromArray(const ExrChromaticities& c)
{
  return { { c[0], c[1] }, { c[2], c[3] }, { c[4], c[5] }, { c[6], c[7] } };
}

Imath::Box2i ToBox(const ExrBox& box) { return { { box.XMin, box.YMin }, { box.XMax, box.YMax } }; }

ExrBox FromBox(const Imath::Box2i& box) { return { box.min.x, box.min.y, box.max.x, box.max.y }; }

/// Puts one attribute of any type into the header.
struct Insert
{
  Imf::Header& Header;
  const std::string& Name;

  template <typename A, typename V>
  void As(const V& value)
  {
    this->Header.insert(this->Name.c_str(), A(value));
  }
  void operator()(int v) { this->As<Imf::IntAttribute>(v); }
  void operator()(float v) { this->As<Imf::FloatAttribute>(v); }
  void operator()(double v)
  {
    // This one is defined as a float, whatever the caller keeps it in.
    this->Name == "whiteLuminance" ? this->As<Imf::FloatAttribute>(static_cast<float>(v))
                                   : this->As<Imf::DoubleAttribute>(v);
  }
  void operator()(const std::string& v)
  {
    if (this->Name == "envmap")
    {
      this->As<Imf::EnvmapAttribute>(v == cubeMap ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
      return;
    }
    this->As<Imf::StringAttribute>(v);
  }
  void operator()(const std::array<float, 2>& v)
  {
    this->As<Imf::V2fAttribute>(Imath::V2f(v[0], v[1]));
  }
  void operator()(const std::array<float, 3>& v)
  {
    this->As<Imf::V3fAttribute>(Imath::V3f(v[0], v[1], v[2]));
  }
  void operator()(const std::array<double, 3>& v)
  {
    this->As<Imf::V3dAttribute>(Imath::V3d(v[0], v[1], v[2]));
  }
  void operator()(const std::vector<float>& v) { this->As<Imf::FloatVectorAttribute>(v); }
  void operator()(const std::vector<std::string>& v) { this->As<Imf::StringVectorAttribute>(v); }
  void operator()(const ExrChromaticities& v)
  {
    this->As<Imf::ChromaticitiesAttribute>(FromArray(v));
  }
};

template <typename A>
const A* As(const Imf::Attribute& attribute)
{
  return dynamic_cast<const A*>(&attribute);
}

/// One attribute of the header; false where ExrAttribute has no such type.
bool Extract(const Imf::Attribute& a, ExrAttribute& out)
{
  if (const auto* i = As<Imf::IntAttribute>(a))
  {
    out = i->value();
  }
  else if (const auto* f = As<Imf::FloatAttribute>(a))
  {
    out = f->value();
  }
  else if (const auto* d = As<Imf::DoubleAttribute>(a))
  {
    out = d->value();
  }
  else if (const auto* map = As<Imf::EnvmapAttribute>(a))
  {
    out = std::string(map->value() == Imf::ENVMAP_CUBE ? cubeMap : latLongMap);
  }
  else if (const auto* s = As<Imf::StringAttribute>(a))
  {
    out = s->value();
  }
  else if (const auto* v2 = As<Imf::V2fAttribute>(a))
  {
    out = std::array<float, 2>{ v2->value().x, v2->value().y };
  }
  else if (const auto* v3 = As<Imf::V3fAttribute>(a))
  {
    out = std::array<float, 3>{ v3->value().x, v3->value().y, v3->value().z };
  }
  else if (const auto* v3d = As<Imf::V3dAttribute>(a))
  {
    out = std::array<double, 3>{ v3d->value().x, v3d->value().y, v3d->value().z };
  }
  else if (const auto* fv = As<Imf::FloatVectorAttribute>(a))
  {
    out = fv->value();
  }
  else if (const auto* sv = As<Imf::StringVectorAttribute>(a))
  {
    out = sv->value();
  }
  else if (const auto* c = As<Imf::ChromaticitiesAttribute>(a))
  {
    const Imf::Chromaticities& v = c->value();
    out = ExrChromaticities{ v.red.x, v.red.y, v.green.x, v.green.y, v.blue.x, v.blue.y, v.white.x,
      v.white.y };
  }
  else
  {
    return false;
  }
  return true;
}

void CheckWindow(const std::string& file, const ExrBox& box)
{
  if (box.Width() < 1 || box.Height() < 1)
  {
    throw FileError(file,
      "the data window has " + std::to_string(box.Width()) + " x " + std::to_string(box.Height()) +
        " pixels: expected at least one");
  }
}

} // namespace

bool IsStructuralAttribute(const std::string& name) { return StructuralNames().count(name) > 0; }

long long CountSamples(int sampling, int min, int max)
{
  const auto floorDivide = [](long long a, long long b) {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
  };
  return floorDivide(max, sampling) - floorDivide(static_cast<long long>(min) - 1, sampling);
}

Imf::Header MakeHeader(const std::string& file, const ExrPart& part, bool named)
{
  CheckWindow(file, part.DataWindow);
  const bool sameWindow = part.DisplayWindow.Width() < 1 || part.DisplayWindow.Height() < 1;
  Imf::Header header(ToBox(sameWindow ? part.DataWindow : part.DisplayWindow),
    ToBox(part.DataWindow), part.PixelAspectRatio);
  header.compression() = static_cast<Imf::Compression>(part.Compression);
  const bool tiled = part.TileWidth > 0 || part.TileHeight > 0;
  header.setType(tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (tiled)
  {
    if (part.TileWidth < 1 || part.TileHeight < 1)
    {
      throw FileError(file,
        "tiles of " + std::to_string(part.TileWidth) + " x " + std::to_string(part.TileHeight) +
          ": expected both above 0, or both 0 for scan lines");
    }
    header.setTileDescription(Imf::TileDescription(part.TileWidth, part.TileHeight));
  }
  if (named)
  {
    CheckName(file, "part", part.Name);
  }
  if (!part.Name.empty())
  {
    header.setName(part.Name);
  }
  if (!part.View.empty())
  {
    header.setView(part.View);
  }
  if (part.Compression == ExrCompression::DWAA || part.Compression == ExrCompression::DWAB)
  {
    if (!(part.DwaLevel >= 0.0f && part.DwaLevel <= 100000.0f))
    {
      throw FileError(file,
        "DWA level " + std::to_string(part.DwaLevel) + ": expected 0 to 100000 (45 is usual)");
    }
    header.insert(dwaLevel, Imf::FloatAttribute(part.DwaLevel)); // the packer reads it there
  }
  if (part.Channels.empty())
  {
    throw FileError(file, "no channels to write");
  }
  for (const ExrChannel& channel : part.Channels)
  {
    CheckName(file, "channel", channel.Name);
    if (header.channels().findChannel(channel.Name))
    {
      throw FileError(file, "two channels named '" + channel.Name + "'");
    }
    header.channels().insert(
      channel.Name, Imf::Channel(FileType(channel.Type), channel.XSampling, channel.YSampling));
  }
  for (const auto& [name, value] : part.Attributes)
  {
    CheckName(file, "attribute", name);
    if (IsStructuralAttribute(name))
    {
      throw FileError(file, "attribute '" + name + "' belongs to the format: choose another name");
    }
    if (name == "chromaticities" && !std::holds_alternative<ExrChromaticities>(value))
    {
      throw FileError(file, "attribute 'chromaticities' must be eight numbers (xy of R, G, B, W)");
    }
    const auto* text = std::get_if<std::string>(&value);
    if (name == "envmap" && !(text && (*text == latLongMap || *text == cubeMap)))
    {
      throw FileError(file, "attribute 'envmap' must be the text 'latlong' or 'cube'");
    }
    if (name != dwaLevel)
    {
      std::visit(Insert{ header, name }, value);
    }
  }
  return header;
}

ExrPart ReadHeader(const Imf::Header& header)
{
  ExrPart part;
  part.Name = header.hasName() ? header.name() : "";
  part.View = header.hasView() ? header.view() : "";
  part.DataWindow = FromBox(header.dataWindow());
  part.DisplayWindow = FromBox(header.displayWindow());
  part.PixelAspectRatio = header.pixelAspectRatio();
  part.Compression = static_cast<ExrCompression>(header.compression());
  if (header.hasTileDescription())
  {
    part.TileWidth = static_cast<int>(header.tileDescription().xSize);
    part.TileHeight = static_cast<int>(header.tileDescription().ySize);
  }
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
  {
    ExrChannel channel;
    channel.Name = c.name();
    channel.Type = c.channel().type == Imf::HALF
      ? ExrPixelType::Half
      : (c.channel().type == Imf::UINT ? ExrPixelType::UInt : ExrPixelType::Float);
    channel.Kind =
      c.channel().type == Imf::UINT ? ExrChannel::Memory::UInt32 : ExrChannel::Memory::Float32;
    channel.XSampling = c.channel().xSampling;
    channel.YSampling = c.channel().ySampling;
    part.Channels.push_back(channel);
  }
  for (auto a = header.begin(); a != header.end(); ++a)
  {
    ExrAttribute value;
    if (IsStructuralAttribute(a.name()))
    {
      continue;
    }
    if (Extract(a.attribute(), value))
    {
      part.Attributes[a.name()] = value;
      const auto* level = std::get_if<float>(&value);
      part.DwaLevel = level && std::string(a.name()) == dwaLevel ? *level : part.DwaLevel;
    }
    else
    {
      part.SkippedAttributes.push_back(a.name());
    }
  }
  return part;
}

int LinesPerChunk(Imf::Compression compression)
{
  switch (compression)
  {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 1;
  }
}

} // namespace radiometry::io
