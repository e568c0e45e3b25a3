// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/Units.h"
#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace radiometry
{
namespace io
{

/// How the numbers of a glTF file are to be understood.
struct GltfOptions
{
  /// What KHR_lights_punctual intensities are.
  enum class LightUnits
  {
    Auto,        // Photometric: what the extension says
    Photometric, // cd and lx
    Radiometric  // W/sr and W/m^2
  };
  /// What emissiveFactor times emissiveStrength is.
  enum class EmissiveUnits
  {
    Auto,      // Radiance when Blender wrote the file, else Luminance
    Luminance, // cd/m^2: what KHR_materials_emissive_strength says
    Radiance,  // W/(m^2 sr): Blender's emission strength, which its exporter does not convert
    Exitance   // W/m^2
  };
  LightUnits Lights = LightUnits::Auto;
  EmissiveUnits Emission = EmissiveUnits::Auto;
  double LuminousEfficacy = units::MaximumLuminousEfficacy; // lm/W
  bool SpecularAsDiffuse = false;  // add every specular lobe to the diffuse reflectance
  bool UnreferencedLights = false; // put lights that no node refers to at the origin
};

/// A material of the file in the terms of docs/arrays.md; three bands, linear Rec.709.
struct GltfMaterial
{
  std::string Name;
  std::array<double, 3> Diffuse{ 0.0, 0.0, 0.0 };
  std::array<double, 3> Specular{ 0.0, 0.0, 0.0 };
  double Shininess = 10.0;
  std::array<double, 3> Exitance{ 0.0, 0.0, 0.0 }; // W/m^2
  bool TwoSided = false;
};

struct GltfCamera
{
  std::string Name;
  Vec3 Position;
  Vec3 Direction{ 0.0, 0.0, -1.0 }; // unit
  Vec3 ViewUp{ 0.0, 1.0, 0.0 };     // unit, normal to Direction
  bool Parallel = false;
  double ViewAngle = 30.0;    // degrees, vertical; perspective
  double ParallelScale = 1.0; // half the height of the view, m; parallel
  double AspectRatio = 0.0;   // width/height; 0: the file does not say
  double Near = 0.0;
  double Far = 0.0; // 0: infinite
};

/// A glTF scene with all its nodes' transforms applied (composed in double).
struct GltfScene
{
  std::vector<Vec3> Points;  // m
  std::vector<Vec3> Normals; // unit, one a point; empty when no mesh has any
  std::vector<std::array<std::int32_t, 3>> Triangles; // counter-clockwise seen from the front
  std::vector<std::int32_t> TriangleMaterial;         // index into Materials
  std::vector<std::int32_t> TriangleObject;           // index into Objects
  std::vector<GltfMaterial> Materials;
  std::vector<std::string> Objects; // the nodes that carry a mesh, in the order of the file
  std::vector<LightRecord> Lights;
  std::vector<GltfCamera> Cameras;
  bool PhotometricLights = true;
  std::string Generator;
  /// In whole sentences: each choice that was made and each thing in the file that was not used.
  std::vector<std::string> Assumptions;
};

/// Reads a .gltf or .glb file (glTF 2.0) through tinygltf.
///   Reads   the default scene: triangle meshes, materials, KHR_lights_punctual,
///           KHR_materials_emissive_strength, KHR_materials_ior, KHR_materials_specular,
///           KHR_mesh_quantization, KHR_node_visibility, cameras
///   Model   material: diffuse = (1 - m)(1 - F0) base; specular = (1 - m) F0 + m base, so that
///           diffuse + specular <= 1; F0 = 0.04, or by KHR_materials_ior and KHR_materials_specular;
///           Phong exponent 2/a^2 - 2 with a = roughness^2. A lobe of exponent below 2 counts as
///           diffuse
///   Cost    O(size of the file)
///   Source  Khronos glTF 2.0 specification, appendix B (metallic-roughness, F0 = 0.04);
///           Walter et al. 2007 (a^2 = 2/(n + 2) between Phong and Beckmann lobes)
///   Fails   InputError naming the place in the file, the value and what was expected
GltfScene ReadGltf(const std::string& fileName, const GltfOptions& options = {});

} // namespace io
} // namespace radiometry
