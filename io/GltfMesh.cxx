// SPDX-License-Identifier: BSD-3-Clause
#include "io/GltfParts.h"

#include <cmath>
#include <utility>

namespace radiometry
{
namespace io
{
namespace
{

using Index3 = std::array<std::int32_t, 3>;

std::vector<Vec3> Vectors(const GltfDocument& file, int accessor, const std::string& place)
{
  const std::vector<double> values = file.Values(accessor, TINYGLTF_TYPE_VEC3, place);
  std::vector<Vec3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    vectors[i] = { values[3 * i], values[3 * i + 1], values[3 * i + 2] };
    if (!IsFinite(vectors[i]))
    {
      const int bad = std::isfinite(vectors[i].x) ? (std::isfinite(vectors[i].y) ? 2 : 1) : 0;
      throw InputError(
        file.At(place), static_cast<long long>(i), vectors[i][bad], "finite coordinates");
    }
  }
  return vectors;
}

/// Triangles of the vertex list by the primitive's mode, all turning as glTF prescribes.
std::vector<Index3> Triangulate(const std::vector<std::int32_t>& v, int mode)
{
  std::vector<Index3> triangles;
  const std::size_t n = v.size();
  if (mode == TINYGLTF_MODE_TRIANGLES)
  {
    for (std::size_t i = 0; i + 2 < n; i += 3)
    {
      triangles.push_back({ v[i], v[i + 1], v[i + 2] });
    }
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < n; ++i)
  {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
    {
      triangles.push_back({ v[i + 1], v[i + 2], v[0] });
    }
    else
    {
      triangles.push_back({ v[i], v[i + 1 + i % 2], v[i + 2 - i % 2] });
    }
  }
  return triangles;
}

Vec3 FaceNormal(const std::vector<Vec3>& p, const Index3& t)
{
  return Normalized(AreaNormal2({ p[t[0]], p[t[1]], p[t[2]] }));
}

/// glTF: a primitive without normals has flat ones, so each triangle gets points of its own.
void MakeFlat(std::vector<Vec3>& points, std::vector<Vec3>& normals, std::vector<Index3>& triangles)
{
  std::vector<Vec3> split;
  normals.clear();
  for (Index3& t : triangles)
  {
    const Vec3 n = FaceNormal(points, t);
    for (std::int32_t& corner : t)
    {
      split.push_back(points[corner]);
      normals.push_back(n);
      corner = static_cast<std::int32_t>(split.size() - 1);
    }
  }
  points = std::move(split);
}

struct Piece
{
  std::vector<Vec3> Points;
  std::vector<Vec3> Normals;
  std::vector<Index3> Triangles;
};

Piece ReadPrimitive(const GltfDocument& file, const tinygltf::Primitive& primitive,
  const GltfTransform& transform, const std::string& place)
{
  Piece piece;
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end())
  {
    throw InputError(file.At(place), -1, "no POSITION", "vertex positions");
  }
  piece.Points = Vectors(file, position->second, place + ".POSITION");
  const std::size_t n = piece.Points.size();
  const auto normal = primitive.attributes.find("NORMAL");
  if (normal != primitive.attributes.end())
  {
    piece.Normals = Vectors(file, normal->second, place + ".NORMAL");
    if (piece.Normals.size() != n)
    {
      throw InputError(file.At(place + ".NORMAL"), -1,
        std::to_string(piece.Normals.size()) + " normals", std::to_string(n) + " as positions");
    }
  }
  std::vector<std::int32_t> indices;
  if (primitive.indices >= 0)
  {
    indices = file.Indices(primitive.indices, n, place + ".indices");
  }
  else
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      indices.push_back(static_cast<std::int32_t>(i));
    }
  }
  piece.Triangles = Triangulate(indices, primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode);

  for (Vec3& p : piece.Points)
  {
    p = transform.Point(p);
  }
  for (Vec3& v : piece.Normals)
  {
    v = transform.Normal(v);
  }
  if (transform.Determinant() < 0.0)
  {
    // A mirrored mesh keeps its fronts when its corners turn the other way (glTF 3.7.4).
    for (Index3& t : piece.Triangles)
    {
      std::swap(t[1], t[2]);
    }
  }
  for (const Vec3& p : piece.Points)
  {
    if (!IsFinite(p))
    {
      throw InputError(file.At(place), -1, "a vertex that its node moves to infinity",
        "finite coordinates");
    }
  }
  // A normal of no length (in the file, or flattened by a scale of 0) becomes its triangle's.
  for (const Index3& t : piece.Triangles)
  {
    for (const std::int32_t corner : t)
    {
      if (!piece.Normals.empty() && LengthSquared(piece.Normals[corner]) == 0.0)
      {
        piece.Normals[corner] = FaceNormal(piece.Points, t);
      }
    }
  }
  return piece;
}

bool HasNormals(const GltfDocument& file)
{
  for (const auto& mesh : file.Model().meshes)
  {
    for (const auto& primitive : mesh.primitives)
    {
      if (primitive.attributes.count("NORMAL") != 0)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

void ReadGltfMesh(const GltfDocument& file, int mesh, const GltfTransform& transform,
  std::int32_t object, GltfScene& scene)
{
  const auto& model = file.Model();
  if (static_cast<std::size_t>(mesh) >= model.meshes.size())
  {
    throw InputError(file.At("nodes[].mesh"), -1, mesh, "a mesh of the file");
  }
  const bool normals = HasNormals(file);
  const auto& primitives = model.meshes[mesh].primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i)
  {
    const tinygltf::Primitive& primitive = primitives[i];
    const std::string place =
      "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(i) + "]";
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP)
    {
      Assume(scene, "Points and lines are left out.");
      continue;
    }
    if (!primitive.targets.empty())
    {
      Assume(scene, "Morph targets are ignored.");
    }
    if (primitive.attributes.count("COLOR_0") != 0)
    {
      Assume(scene, "Vertex colours are ignored.");
    }
    const auto standard = static_cast<std::int32_t>(scene.Materials.size() - 1);
    const std::int32_t material = primitive.material < 0 ? standard : primitive.material;
    if (material > standard || (primitive.material >= 0 && material == standard))
    {
      throw InputError(file.At(place + ".material"), -1, primitive.material,
        "a material of the file");
    }
    Piece piece = ReadPrimitive(file, primitive, transform, place);
    if (normals && piece.Normals.empty())
    {
      MakeFlat(piece.Points, piece.Normals, piece.Triangles);
    }
    const auto first = static_cast<std::int32_t>(scene.Points.size());
    scene.Points.insert(scene.Points.end(), piece.Points.begin(), piece.Points.end());
    scene.Normals.insert(scene.Normals.end(), piece.Normals.begin(), piece.Normals.end());
    for (const Index3& t : piece.Triangles)
    {
      scene.Triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
      scene.TriangleMaterial.push_back(material);
      scene.TriangleObject.push_back(object);
    }
  }
}

} // namespace io
} // namespace radiometry
