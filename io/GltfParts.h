// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/GltfDocument.h"
#include "io/GltfScene.h"

#include <array>

namespace radiometry
{
namespace io
{

/// An affine map in double: the 3 x 3 part and the translation.
struct GltfTransform
{
  std::array<Vec3, 3> Column{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  Vec3 Translation;

  Vec3 Vector(const Vec3& v) const
  {
    return v.x * this->Column[0] + v.y * this->Column[1] + v.z * this->Column[2];
  }
  Vec3 Point(const Vec3& p) const { return this->Vector(p) + this->Translation; }
  double Determinant() const
  {
    return Dot(this->Column[0], Cross(this->Column[1], this->Column[2]));
  }
  /// The direction of a transformed normal: the inverse transpose up to a positive factor.
  Vec3 Normal(const Vec3& n) const
  {
    const Vec3 v = n.x * Cross(this->Column[1], this->Column[2]) +
      n.y * Cross(this->Column[2], this->Column[0]) + n.z * Cross(this->Column[0], this->Column[1]);
    return Normalized(this->Determinant() < 0.0 ? -v : v);
  }
};

/// `first` applied after `second`.
inline GltfTransform Compose(const GltfTransform& first, const GltfTransform& second)
{
  GltfTransform result;
  for (int c = 0; c < 3; ++c)
  {
    result.Column[c] = first.Vector(second.Column[c]);
  }
  result.Translation = first.Point(second.Translation);
  return result;
}

/// All materials of the file and, last, glTF's default material. Adds to the assumptions.
void ReadGltfMaterials(const GltfDocument& file, const GltfOptions& options, GltfScene& scene);

/// The file's light definitions, in SI, at the origin and along -Z. Adds to the assumptions.
std::vector<LightRecord> ReadGltfLights(
  const GltfDocument& file, const GltfOptions& options, GltfScene& scene);

/// A camera definition placed by a node's transform.
GltfCamera ReadGltfCamera(const GltfDocument& file, int camera, const GltfTransform& transform);

/// Appends the triangles of a mesh under a transform to the scene. Adds to the assumptions.
void ReadGltfMesh(const GltfDocument& file, int mesh, const GltfTransform& transform,
  std::int32_t object, GltfScene& scene);

/// Adds a sentence once.
void Assume(GltfScene& scene, const std::string& sentence);

} // namespace io
} // namespace radiometry
