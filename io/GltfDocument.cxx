// SPDX-License-Identifier: BSD-3-Clause
#include "io/GltfDocument.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace radiometry
{
namespace io
{
namespace
{

const std::set<std::string> supportedExtensions{ "KHR_lights_punctual",
  "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
  "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_node_visibility", "KHR_texture_transform" };

std::string FirstLine(const std::string& text)
{
  return text.substr(0, text.find_first_of("\r\n"));
}

std::uint32_t LittleEndian(const unsigned char* p)
{
  return p[0] | (p[1] << 8) | (p[2] << 16) | (static_cast<std::uint32_t>(p[3]) << 24);
}

/// Keeps an external image as the bytes of its file; one inside a buffer is fetched later, with
/// its range checked.
bool KeepImageBytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
  const unsigned char* bytes, int size, void*)
{
  if (image->bufferView < 0)
  {
    image->image.assign(bytes, bytes + size);
  }
  return true;
}

template <class T>
double Component(const unsigned char* p, bool normalized)
{
  T value;
  std::memcpy(&value, p, sizeof value);
  if (!normalized || !std::numeric_limits<T>::is_integer)
  {
    return static_cast<double>(value);
  }
  return std::fmax(-1.0, static_cast<double>(value) / std::numeric_limits<T>::max());
}

double Component(const unsigned char* p, int type, bool normalized)
{
  switch (type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return Component<std::int8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return Component<std::uint8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return Component<std::int16_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return Component<std::uint16_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Component<std::uint32_t>(p, normalized);
    default:
      return Component<float>(p, normalized);
  }
}

bool IsComponentType(int type)
{
  return type == TINYGLTF_COMPONENT_TYPE_FLOAT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
    (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

/// sRGB's curve (IEC 61966-2-1) for 8-bit codes.
std::array<double, 256> MakeLinear()
{
  std::array<double, 256> linear{};
  for (int i = 0; i < 256; ++i)
  {
    const double v = i / 255.0;
    linear[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return linear;
}

} // namespace

GltfDocument::GltfDocument(const std::string& fileName)
{
  const std::size_t slash = fileName.find_last_of("/\\");
  this->BaseName = slash == std::string::npos ? fileName : fileName.substr(slash + 1);
  this->Folder = slash == std::string::npos ? "." : fileName.substr(0, slash + 1);

  std::ifstream file(fileName, std::ios::binary);
  try
  {
    this->FileBytes.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  catch (const std::ios_base::failure&) // a folder, for one
  {
    file.setstate(std::ios_base::badbit);
  }
  if (!file.is_open() || file.bad())
  {
    throw InputError("FileName", -1, fileName, "a file that can be read");
  }
  try
  {
    this->Root = nlohmann::json::parse(this->JsonText());
  }
  catch (const nlohmann::json::exception& error)
  {
    throw InputError(
      this->BaseName, -1, FirstLine(error.what()), "a glTF 2.0 document in JSON (is it cut off?)");
  }
  const auto asset = this->Root.find("asset");
  if (!this->Root.is_object() || asset == this->Root.end() || !asset->is_object() ||
    !asset->contains("version") || !(*asset)["version"].is_string())
  {
    throw InputError(this->At("asset.version"), -1, "missing", "a glTF 2.0 document");
  }
  const std::string version = (*asset)["version"];
  if (version.rfind("2.", 0) != 0)
  {
    throw InputError(this->At("asset.version"), -1, version, "2.0");
  }
  this->CheckExtensions();
}

void GltfDocument::LoadModel()
{
  const std::vector<unsigned char>& bytes = this->FileBytes;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(KeepImageBytes, nullptr);
  std::string error;
  std::string warning;
  bool good = false;
  try
  {
    const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    const auto size = static_cast<unsigned int>(bytes.size());
    good = binary
      ? loader.LoadBinaryFromMemory(&this->Data, &error, &warning, bytes.data(), size, this->Folder)
      : loader.LoadASCIIFromString(&this->Data, &error, &warning,
          reinterpret_cast<const char*>(bytes.data()), size, this->Folder);
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (!good)
  {
    throw InputError(this->BaseName, -1, error.empty() ? "unreadable" : FirstLine(error),
      "a complete glTF 2.0 file");
  }
}

std::string GltfDocument::Generator() const
{
  const auto& asset = this->Root["asset"];
  const auto generator = asset.find("generator");
  return generator != asset.end() && generator->is_string() ? generator->get<std::string>()
                                                            : std::string();
}

std::string GltfDocument::JsonText() const
{
  const std::vector<unsigned char>& bytes = this->FileBytes;
  if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0)
  {
    std::string json(bytes.begin(), bytes.end());
    const std::size_t first = json.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string::npos || json[first] != '{')
    {
      throw InputError(this->BaseName, -1,
        bytes.empty() ? "an empty file" : "neither JSON nor binary glTF", "a .gltf or .glb file");
    }
    return json;
  }
  if (bytes.size() >= std::numeric_limits<std::uint32_t>::max())
  {
    throw InputError(this->BaseName, -1, static_cast<double>(bytes.size()), "less than 4 GiB");
  }
  const std::size_t length = bytes.size() < 20 ? 20 : LittleEndian(&bytes[8]);
  if (bytes.size() < length)
  {
    throw InputError(this->BaseName, -1, std::to_string(bytes.size()) + " bytes",
      std::to_string(length) + " bytes as its header says (is it cut off?)");
  }
  const std::size_t jsonLength = LittleEndian(&bytes[12]);
  if (std::memcmp(&bytes[16], "JSON", 4) != 0 || jsonLength > length - 20)
  {
    throw InputError(this->At("first chunk"), -1, std::to_string(jsonLength) + " bytes",
      "a JSON chunk that lies inside the file");
  }
  return { bytes.begin() + 20, bytes.begin() + 20 + static_cast<std::ptrdiff_t>(jsonLength) };
}

void GltfDocument::CheckExtensions() const
{
  const auto required = this->Root.find("extensionsRequired");
  if (required == this->Root.end() || !required->is_array())
  {
    return;
  }
  for (const auto& name : *required)
  {
    if (!name.is_string() || supportedExtensions.count(name.get<std::string>()) == 0)
    {
      throw InputError(this->At("extensionsRequired"), -1, name.dump(),
        "only extensions that this reader supports");
    }
  }
}

const nlohmann::json& GltfDocument::Extension(
  const char* list, std::size_t index, const char* name) const
{
  static const nlohmann::json none;
  const auto elements = this->Root.find(list);
  if (elements == this->Root.end() || !elements->is_array() || index >= elements->size())
  {
    return none;
  }
  const nlohmann::json& element = (*elements)[index];
  const auto extensions = element.find("extensions");
  if (!element.is_object() || extensions == element.end() || !extensions->is_object())
  {
    return none;
  }
  const auto found = extensions->find(name);
  return found == extensions->end() ? none : *found;
}

const unsigned char* GltfDocument::Bytes(int view, std::size_t offset, std::size_t count,
  std::size_t size, std::size_t& stride, const std::string& place) const
{
  const auto& views = this->Data.bufferViews;
  const auto& buffers = this->Data.buffers;
  if (view < 0 || static_cast<std::size_t>(view) >= views.size() || views[view].buffer < 0 ||
    static_cast<std::size_t>(views[view].buffer) >= buffers.size())
  {
    throw InputError(this->At(place), -1, "bufferView " + std::to_string(view),
      "a buffer view of a buffer in the file");
  }
  const tinygltf::BufferView& v = views[view];
  const std::vector<unsigned char>& data = buffers[v.buffer].data;
  stride = v.byteStride > 0 ? v.byteStride : size;
  // Compared so that nothing can overflow: each term is at most the buffer's size when it is added.
  const bool viewFits = v.byteOffset <= data.size() && v.byteLength <= data.size() - v.byteOffset;
  const bool fits = viewFits && count > 0 && offset <= v.byteLength &&
    size <= v.byteLength - offset && (count - 1) <= (v.byteLength - offset - size) / stride;
  if (!fits)
  {
    throw InputError(this->At(place), -1,
      std::to_string(count) + " elements of " + std::to_string(size) + " bytes in bufferView " +
        std::to_string(view),
      "at least one, and none beyond the end of the buffer");
  }
  return data.data() + v.byteOffset + offset;
}

std::vector<double> GltfDocument::Values(int index, int type, const std::string& place) const
{
  if (index < 0 || static_cast<std::size_t>(index) >= this->Data.accessors.size())
  {
    throw InputError(this->At(place), -1, "accessor " + std::to_string(index), "one of the file");
  }
  const tinygltf::Accessor& accessor = this->Data.accessors[index];
  if (accessor.type != type || !IsComponentType(accessor.componentType))
  {
    throw InputError(this->At(place), -1,
      "accessor " + std::to_string(index) + " of another type", "the type that glTF prescribes");
  }
  const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(type));
  const auto bytes =
    static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(accessor.componentType));
  std::vector<double> values;
  std::size_t stride = 0;
  const auto fetch = [&](const unsigned char* data, std::size_t element, double* out) {
    for (std::size_t c = 0; c < components; ++c)
    {
      out[c] = Component(
        data + element * stride + c * bytes, accessor.componentType, accessor.normalized);
    }
  };
  if (accessor.bufferView >= 0)
  {
    const unsigned char* data = this->Bytes(
      accessor.bufferView, accessor.byteOffset, accessor.count, components * bytes, stride, place);
    values.resize(accessor.count * components);
    for (std::size_t i = 0; i < accessor.count; ++i)
    {
      fetch(data, i, &values[i * components]);
    }
  }
  else
  {
    // Zeros, which sparse values replace. 1e8: no mesh of this size fits the formats used here.
    if (accessor.count > 100000000)
    {
      throw InputError(this->At(place), -1, static_cast<double>(accessor.count), "fewer elements");
    }
    values.resize(accessor.count * components, 0.0);
  }
  if (accessor.sparse.isSparse)
  {
    const auto& sparse = accessor.sparse;
    const int indexType = sparse.indices.componentType;
    if (sparse.count < 0 || !IsComponentType(indexType) ||
      indexType == TINYGLTF_COMPONENT_TYPE_FLOAT)
    {
      throw InputError(this->At(place), -1, "a bad sparse accessor", "integer indices");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto indexSize = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(indexType));
    std::size_t indexStride = 0;
    const unsigned char* indices = this->Bytes(sparse.indices.bufferView,
      static_cast<std::size_t>(sparse.indices.byteOffset), count, indexSize, indexStride, place);
    const unsigned char* data = this->Bytes(sparse.values.bufferView,
      static_cast<std::size_t>(sparse.values.byteOffset), count, components * bytes, stride, place);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double at = Component(indices + i * indexStride, indexType, false);
      if (at < 0.0 || at >= static_cast<double>(accessor.count))
      {
        throw InputError(this->At(place), static_cast<long long>(i), at, "a sparse index in range");
      }
      fetch(data, i, &values[static_cast<std::size_t>(at) * components]);
    }
  }
  return values;
}

std::vector<std::int32_t> GltfDocument::Indices(
  int accessor, std::size_t limit, const std::string& place) const
{
  const std::vector<double> values = this->Values(accessor, TINYGLTF_TYPE_SCALAR, place);
  std::vector<std::int32_t> indices(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!(values[i] >= 0.0 && values[i] < static_cast<double>(limit)))
    {
      throw InputError(this->At(place), static_cast<long long>(i), values[i],
        "an index below the " + std::to_string(limit) + " vertices");
    }
    indices[i] = static_cast<std::int32_t>(values[i]);
  }
  return indices;
}

bool GltfDocument::AverageColor(int texture, double rgb[3]) const
{
  const auto& textures = this->Data.textures;
  if (texture < 0 || static_cast<std::size_t>(texture) >= textures.size() ||
    textures[texture].source < 0 ||
    static_cast<std::size_t>(textures[texture].source) >= this->Data.images.size())
  {
    return false;
  }
  const tinygltf::Image& stored = this->Data.images[textures[texture].source];
  std::vector<unsigned char> bytes = stored.image;
  if (stored.bufferView >= 0)
  {
    const auto& views = this->Data.bufferViews;
    const std::size_t length = static_cast<std::size_t>(stored.bufferView) < views.size()
      ? views[stored.bufferView].byteLength
      : 0;
    std::size_t stride = 0;
    const unsigned char* data =
      this->Bytes(stored.bufferView, 0, 1, length, stride, "images of the textures");
    bytes.assign(data, data + length);
  }
  tinygltf::Image image;
  std::string error;
  std::string warning;
  if (bytes.empty() ||
    !tinygltf::LoadImageData(&image, 0, &error, &warning, 0, 0, bytes.data(),
      static_cast<int>(bytes.size()), nullptr))
  {
    return false;
  }
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  const std::size_t step = image.bits / 8;
  const std::size_t components = image.component;
  if (pixels == 0 || (step != 1 && step != 2) ||
    image.image.size() < pixels * components * step)
  {
    return false;
  }
  static const std::array<double, 256> linear = MakeLinear();
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t p = 0; p < pixels; ++p)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      // Of 16 bits (native little-endian) the high byte: an average needs no more.
      const std::size_t at = (p * components + (components < 3 ? 0 : c)) * step + (step - 1);
      sum[c] += linear[image.image[at]];
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] = sum[c] / static_cast<double>(pixels);
  }
  return true;
}

} // namespace io
} // namespace radiometry
