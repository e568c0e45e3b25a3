// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/InputError.h"

#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace radiometry
{
namespace io
{

/// A glTF file in memory: tinygltf's model, and the same document as JSON for what tinygltf does
/// not keep or check (extensions). Every index and length used through this class is checked.
class GltfDocument
{
public:
  /// Reads the file and its JSON. Throws InputError when it is missing, damaged, not glTF 2.0 or
  /// needs an extension that is not supported.
  explicit GltfDocument(const std::string& fileName);
  /// Fills Model() and fetches the buffers. Throws InputError.
  void LoadModel();

  const tinygltf::Model& Model() const { return this->Data; }
  const nlohmann::json& Json() const { return this->Root; }
  /// "room.glb: " + place, for messages.
  std::string At(const std::string& place) const { return this->BaseName + ": " + place; }

  /// What wrote the file; empty when it does not say.
  std::string Generator() const;
  /// The JSON object `name` of a `list`'s element's extensions; null JSON when absent.
  const nlohmann::json& Extension(const char* list, std::size_t index, const char* name) const;

  /// The values of an accessor as doubles, components of one element together; sparse values
  /// replaced, normalised integers scaled. `type` is a TINYGLTF_TYPE_ constant.
  std::vector<double> Values(int accessor, int type, const std::string& place) const;
  /// The values of an accessor of vertex indices, each below `limit`.
  std::vector<std::int32_t> Indices(int accessor, std::size_t limit, const std::string& place) const;

  /// Average linear Rec.709 colour of an sRGB texture. False when the image cannot be had.
  bool AverageColor(int texture, double rgb[3]) const;

private:
  std::string JsonText() const;
  void CheckExtensions() const;
  const unsigned char* Bytes(int view, std::size_t offset, std::size_t count, std::size_t size,
    std::size_t& stride, const std::string& place) const;

  std::string BaseName;
  std::string Folder;
  std::vector<unsigned char> FileBytes;
  tinygltf::Model Data;
  nlohmann::json Root;
};

} // namespace io
} // namespace radiometry
