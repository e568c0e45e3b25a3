// SPDX-License-Identifier: BSD-3-Clause
#include "io/GltfScene.h"

#include "io/GltfParts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace radiometry
{
namespace io
{
namespace
{

using nlohmann::json;

std::string NodeName(std::size_t index)
{
  return "nodes[" + std::to_string(index) + "]";
}

GltfTransform LocalTransform(const GltfDocument& file, const tinygltf::Node& node, std::size_t index)
{
  const std::string at = file.At(NodeName(index));
  const auto check = [&](const std::vector<double>& values, std::size_t size, const char* name) {
    if (values.size() != size)
    {
      throw InputError(at + "." + name, -1, std::to_string(values.size()) + " numbers",
        std::to_string(size) + " numbers");
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      if (!std::isfinite(values[i]))
      {
        throw InputError(at + "." + name, static_cast<long long>(i), values[i], "a finite number");
      }
    }
  };
  GltfTransform t;
  if (!node.matrix.empty())
  {
    const auto& m = node.matrix;
    check(m, 16, "matrix");
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
    {
      throw InputError(at + ".matrix", -1, "projective", "a last row of 0 0 0 1");
    }
    for (int c = 0; c < 3; ++c)
    {
      t.Column[c] = { m[4 * c], m[4 * c + 1], m[4 * c + 2] };
    }
    t.Translation = { m[12], m[13], m[14] };
    return t;
  }
  if (!node.rotation.empty())
  {
    check(node.rotation, 4, "rotation");
    double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    // glTF asks for a unit quaternion; files hold it in single precision.
    const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
    if (!(std::fabs(length - 1.0) < 0.01))
    {
      throw InputError(at + ".rotation", -1, length, "a quaternion of length 1");
    }
    x /= length;
    y /= length;
    z /= length;
    w /= length;
    t.Column[0] = { 1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y) };
    t.Column[1] = { 2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x) };
    t.Column[2] = { 2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y) };
  }
  if (!node.scale.empty())
  {
    check(node.scale, 3, "scale");
    for (int c = 0; c < 3; ++c)
    {
      t.Column[c] = node.scale[c] * t.Column[c];
    }
  }
  if (!node.translation.empty())
  {
    check(node.translation, 3, "translation");
    t.Translation = { node.translation[0], node.translation[1], node.translation[2] };
  }
  return t;
}

std::vector<int> RootNodes(const GltfDocument& file)
{
  const tinygltf::Model& model = file.Model();
  if (!model.scenes.empty())
  {
    const int scene = std::max(model.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model.scenes.size())
    {
      throw InputError(file.At("scene"), -1, scene, "a scene of the file");
    }
    return model.scenes[scene].nodes;
  }
  // Without scenes every node that is no child is a root.
  std::vector<bool> child(model.nodes.size(), false);
  for (const auto& node : model.nodes)
  {
    for (const int c : node.children)
    {
      if (c >= 0 && static_cast<std::size_t>(c) < child.size())
      {
        child[c] = true;
      }
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < child.size(); ++i)
  {
    if (!child[i])
    {
      roots.push_back(static_cast<int>(i));
    }
  }
  return roots;
}

struct PlacedNode
{
  std::size_t Index;
  GltfTransform Transform;
};

/// The visible nodes of the scene with their transforms, parents first, in the order of the file.
std::vector<PlacedNode> PlaceNodes(const GltfDocument& file, GltfScene& scene)
{
  const tinygltf::Model& model = file.Model();
  std::vector<PlacedNode> placed;
  std::vector<bool> seen(model.nodes.size(), false);
  std::vector<std::pair<int, GltfTransform>> open;
  const auto push = [&](const std::vector<int>& nodes, const GltfTransform& parent) {
    for (auto i = nodes.rbegin(); i != nodes.rend(); ++i)
    {
      open.emplace_back(*i, parent);
    }
  };
  push(RootNodes(file), {});
  while (!open.empty())
  {
    const auto [index, parent] = open.back();
    open.pop_back();
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size())
    {
      throw InputError(file.At("scene or children"), -1, index, "a node of the file");
    }
    if (seen[index])
    {
      throw InputError(file.At(NodeName(index)), -1, "reached twice", "nodes that form a tree");
    }
    seen[index] = true;
    const json& visibility = file.Extension("nodes", index, "KHR_node_visibility");
    if (visibility.is_object() && visibility.contains("visible") && visibility["visible"] == false)
    {
      Assume(scene, "Nodes that the file makes invisible are left out, with all below them.");
      continue;
    }
    const tinygltf::Node& node = model.nodes[index];
    const GltfTransform transform = Compose(parent, LocalTransform(file, node, index));
    placed.push_back({ static_cast<std::size_t>(index), transform });
    push(node.children, transform);
  }
  return placed;
}

void PlaceLight(const GltfDocument& file, const PlacedNode& node,
  const std::vector<LightRecord>& definitions, std::vector<bool>& used, GltfScene& scene)
{
  const json& extension = file.Extension("nodes", node.Index, "KHR_lights_punctual");
  if (!extension.is_object())
  {
    return;
  }
  const auto light = extension.find("light");
  if (light == extension.end() || !light->is_number_integer() || light->get<long long>() < 0 ||
    light->get<long long>() >= static_cast<long long>(definitions.size()))
  {
    throw InputError(file.At(NodeName(node.Index) + ".KHR_lights_punctual.light"), -1,
      light == extension.end() ? "missing" : light->dump(), "the index of a light of the file");
  }
  const std::size_t index = light->get<std::size_t>();
  used[index] = true;
  LightRecord record = definitions[index];
  const std::string& name = file.Model().nodes[node.Index].name;
  record.Name = name.empty() ? record.Name : name;
  record.Position = node.Transform.Translation;
  // Scale has no effect on a light, only on where it looks.
  record.Direction =
    UnitDirection(file.At(NodeName(node.Index) + " direction").c_str(), Vec3{} - node.Transform.Column[2]);
  scene.Lights.push_back(record);
}

void NoteWhatIsIgnored(const GltfDocument& file, GltfScene& scene)
{
  static const std::set<std::string> used{ "KHR_lights_punctual",
    "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
    "KHR_mesh_quantization", "KHR_node_visibility" };
  for (const std::string& name : file.Model().extensionsUsed)
  {
    if (used.count(name) == 0)
    {
      Assume(scene, "Extension " + name + " is ignored.");
    }
  }
  if (!file.Model().animations.empty())
  {
    Assume(scene, "Animations are ignored: nodes are where the file puts them at rest.");
  }
  if (!file.Model().skins.empty())
  {
    Assume(scene, "Skins are ignored: meshes are in their rest pose.");
  }
}

} // namespace

void Assume(GltfScene& scene, const std::string& sentence)
{
  auto& list = scene.Assumptions;
  if (std::find(list.begin(), list.end(), sentence) == list.end())
  {
    list.push_back(sentence);
  }
}

GltfScene ReadGltf(const std::string& fileName, const GltfOptions& options)
{
  GltfDocument file(fileName);
  GltfScene scene;
  scene.Generator = file.Generator();
  Assume(scene, "Geometry: metres, Y up, as glTF says.");
  // Before tinygltf sees the file: it reads lights too, but does not say which one is wrong.
  const std::vector<LightRecord> definitions = ReadGltfLights(file, options, scene);
  file.LoadModel();
  ReadGltfMaterials(file, options, scene);
  std::vector<bool> used(definitions.size(), false);
  for (const PlacedNode& placed : PlaceNodes(file, scene))
  {
    const tinygltf::Node& node = file.Model().nodes[placed.Index];
    if (node.mesh >= 0)
    {
      const auto object = static_cast<std::int32_t>(scene.Objects.size());
      scene.Objects.push_back(node.name.empty() ? "node " + std::to_string(placed.Index) : node.name);
      ReadGltfMesh(file, node.mesh, placed.Transform, object, scene);
    }
    if (node.camera >= 0)
    {
      scene.Cameras.push_back(ReadGltfCamera(file, node.camera, placed.Transform));
      if (scene.Cameras.back().Name.empty())
      {
        scene.Cameras.back().Name = node.name;
      }
    }
    PlaceLight(file, placed, definitions, used, scene);
  }
  for (std::size_t i = 0; i < definitions.size(); ++i)
  {
    if (!used[i] && options.UnreferencedLights)
    {
      scene.Lights.push_back(definitions[i]);
    }
    if (!used[i])
    {
      Assume(scene,
        "Light \"" + definitions[i].Name + "\" belongs to no node of the scene and is " +
          (options.UnreferencedLights ? "put at the origin." : "left out."));
    }
  }
  NoteWhatIsIgnored(file, scene);
  return scene;
}

} // namespace io
} // namespace radiometry
