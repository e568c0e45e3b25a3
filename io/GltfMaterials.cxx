// SPDX-License-Identifier: BSD-3-Clause
#include "io/GltfParts.h"

#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace radiometry
{
namespace io
{
namespace
{

using EmissiveUnits = GltfOptions::EmissiveUnits;

constexpr double dielectricF0 = 0.04;   // glTF 2.0, B.2.2: index of refraction 1.5
constexpr double leastAlpha = 0.01;     // Phong exponent 19998: a mirror to any picture
constexpr double broadestLobe = 2.0;    // Phong exponents below it count as diffuse

/// W/m^2 of exitance for 1 of the file's emission.
double ExitancePerUnit(EmissiveUnits unitsOfFile, double efficacy)
{
  switch (unitsOfFile)
  {
    case EmissiveUnits::Luminance:
      return units::Pi * units::Radiometric(1.0, efficacy); // M = pi L of a Lambertian emitter
    case EmissiveUnits::Radiance:
      return units::Pi;
    default:
      return 1.0;
  }
}

double InRange(double value, double low, double high, const std::string& place, long long index)
{
  if (!(value >= low && value <= high))
  {
    char expected[80];
    std::snprintf(expected, sizeof expected,
      high < 1e300 ? "a number in [%g, %g]" : "a finite number, at least %g", low, high);
    throw InputError(place, index, value, expected);
  }
  return value;
}

EmissiveUnits Resolve(const GltfDocument& file, const GltfOptions& options)
{
  if (options.Emission != EmissiveUnits::Auto)
  {
    return options.Emission;
  }
  const bool blender = file.Generator().find("Blender") != std::string::npos;
  return blender ? EmissiveUnits::Radiance : EmissiveUnits::Luminance;
}

/// The factor of a texture: its average colour, or 1 where the image cannot be had.
std::array<double, 3> TextureFactor(const GltfDocument& file, int texture,
  const std::string& place, const char* what, GltfScene& scene)
{
  std::array<double, 3> rgb{ 1.0, 1.0, 1.0 };
  if (texture >= 0)
  {
    const bool known = file.AverageColor(texture, rgb.data());
    if (!known)
    {
      rgb = { 1.0, 1.0, 1.0 };
    }
    Assume(scene,
      place + ": the " + what +
        (known ? " texture is replaced by its average." : " texture cannot be read and is ignored."));
  }
  return rgb;
}

/// Reflectance of the dielectric part at normal incidence: KHR_materials_ior and
/// KHR_materials_specular change the 0.04 of an index of refraction of 1.5.
std::array<double, 3> DielectricF0(
  const GltfDocument& file, std::size_t index, const std::string& at)
{
  std::array<double, 3> f0{ dielectricF0, dielectricF0, dielectricF0 };
  const auto number = [&](const nlohmann::json& value, const std::string& name, double low,
                        double high, long long i) {
    if (!value.is_number())
    {
      throw InputError(at + name, i, value.dump(), "a number");
    }
    return InRange(value.get<double>(), low, high, at + name, i);
  };
  const auto& ior = file.Extension("materials", index, "KHR_materials_ior");
  if (ior.is_object() && ior.contains("ior"))
  {
    const double n = number(ior["ior"], ".ior", 0.0, 1e301, -1);
    const double r = n == 0.0 ? 1.0 : (n - 1.0) / (n + 1.0); // 0 stands for infinite
    f0.fill(n == 0.0 || n >= 1.0 ? r * r : number(ior["ior"], ".ior", 1.0, 1e301, -1));
  }
  const auto& specular = file.Extension("materials", index, "KHR_materials_specular");
  if (specular.is_object())
  {
    const double factor = specular.contains("specularFactor")
      ? number(specular["specularFactor"], ".specularFactor", 0.0, 1.0, -1)
      : 1.0;
    const auto color = specular.find("specularColorFactor");
    if (color != specular.end() && (!color->is_array() || color->size() != 3))
    {
      throw InputError(at + ".specularColorFactor", -1, color->dump(), "an array of 3 numbers");
    }
    for (std::size_t b = 0; b < 3; ++b)
    {
      const double tint = color == specular.end()
        ? 1.0
        : number((*color)[b], ".specularColorFactor", 0.0, 1e301, static_cast<long long>(b));
      f0[b] = std::min(1.0, f0[b] * tint) * factor;
    }
  }
  return f0;
}

void MapReflectance(const std::array<double, 3>& base, const std::array<double, 3>& f0,
  double metal, double roughness, bool specularAsDiffuse, GltfMaterial& out)
{
  const double alpha = std::max(roughness * roughness, leastAlpha);
  const double exponent = 2.0 / (alpha * alpha) - 2.0;
  const bool fold = specularAsDiffuse || exponent < broadestLobe;
  for (int b = 0; b < 3; ++b)
  {
    const double diffuse = (1.0 - metal) * (1.0 - f0[b]) * base[b];
    const double specular = (1.0 - metal) * f0[b] + metal * base[b];
    // The sum may exceed 1 by rounding only.
    out.Diffuse[b] = fold ? std::min(1.0, diffuse + specular) : diffuse;
    out.Specular[b] = fold ? 0.0 : std::min(specular, 1.0 - diffuse);
  }
  out.Shininess = exponent;
}

GltfMaterial ReadMaterial(const GltfDocument& file, const tinygltf::Material& m, std::size_t index,
  double exitancePerUnit, const GltfOptions& options, GltfScene& scene)
{
  GltfMaterial out;
  out.Name = m.name.empty() ? "material " + std::to_string(index) : m.name;
  const std::string place = "materials[" + std::to_string(index) + "] \"" + out.Name + "\"";
  const std::string at = file.At(place);
  const auto& pbr = m.pbrMetallicRoughness;
  if (pbr.baseColorFactor.size() != 4 || m.emissiveFactor.size() != 3)
  {
    throw InputError(at, -1, "a colour of another size",
      "4 numbers in baseColorFactor and 3 in emissiveFactor");
  }
  const double metal = InRange(pbr.metallicFactor, 0, 1, at + ".metallicFactor", -1);
  const double roughness = InRange(pbr.roughnessFactor, 0, 1, at + ".roughnessFactor", -1);
  std::array<double, 3> base =
    TextureFactor(file, pbr.baseColorTexture.index, place, "base colour", scene);
  for (int b = 0; b < 3; ++b)
  {
    base[b] *= InRange(pbr.baseColorFactor[b], 0, 1, at + ".baseColorFactor", b);
  }
  MapReflectance(
    base, DielectricF0(file, index, at), metal, roughness, options.SpecularAsDiffuse, out);
  out.TwoSided = m.doubleSided;

  double strength = 1.0;
  const auto& extension = file.Extension("materials", index, "KHR_materials_emissive_strength");
  if (extension.is_object() && extension.contains("emissiveStrength"))
  {
    const auto& value = extension["emissiveStrength"];
    if (!value.is_number())
    {
      throw InputError(at + ".emissiveStrength", -1, value.dump(), "a number");
    }
    strength = InRange(value.get<double>(), 0, 1e301, at + ".emissiveStrength", -1);
  }
  std::array<double, 3> emission{ 1.0, 1.0, 1.0 };
  if (m.emissiveFactor[0] > 0.0 || m.emissiveFactor[1] > 0.0 || m.emissiveFactor[2] > 0.0)
  {
    emission = TextureFactor(file, m.emissiveTexture.index, place, "emission", scene);
  }
  for (int b = 0; b < 3; ++b)
  {
    out.Exitance[b] = exitancePerUnit * strength * emission[b] *
      InRange(m.emissiveFactor[b], 0, 1e301, at + ".emissiveFactor", b);
  }
  if (metal > 0.0 && !options.SpecularAsDiffuse && out.Specular[1] > 0.0)
  {
    Assume(scene,
      place + " is metallic: its light is in the specular lobe, which a diffuse-only solver leaves "
              "out (SpecularAsDiffuse keeps it).");
  }
  if (pbr.metallicRoughnessTexture.index >= 0)
  {
    Assume(scene, place + ": the metallic-roughness texture is ignored.");
  }
  if (m.alphaMode != "OPAQUE" && !m.alphaMode.empty())
  {
    Assume(scene, place + ": alpha mode " + m.alphaMode + " is taken as opaque.");
  }
  return out;
}

} // namespace

void ReadGltfMaterials(const GltfDocument& file, const GltfOptions& options, GltfScene& scene)
{
  const EmissiveUnits unitsOfFile = Resolve(file, options);
  const double perUnit = ExitancePerUnit(unitsOfFile, options.LuminousEfficacy);
  const auto& materials = file.Model().materials;
  bool emits = false;
  for (std::size_t i = 0; i < materials.size(); ++i)
  {
    scene.Materials.push_back(ReadMaterial(file, materials[i], i, perUnit, options, scene));
    const auto& e = scene.Materials.back().Exitance;
    emits = emits || e[0] > 0.0 || e[1] > 0.0 || e[2] > 0.0;
  }
  GltfMaterial standard;
  standard.Name = "(default)";
  MapReflectance({ 1.0, 1.0, 1.0 }, {}, 1.0, 1.0, options.SpecularAsDiffuse, standard);
  scene.Materials.push_back(standard);

  Assume(scene,
    options.SpecularAsDiffuse
      ? "Materials: diffuse reflectance (1 - F0) (1 - metallic) base colour, plus the whole specular "
        "reflectance F0 (1 - metallic) + metallic base colour; F0 = 0.04 unless the file says "
        "otherwise."
      : "Materials: diffuse reflectance (1 - F0) (1 - metallic) base colour; specular F0 (1 - "
        "metallic) + metallic base colour in a Phong lobe of exponent 2/roughness^4 - 2, which "
        "counts as diffuse where the exponent is below 2; F0 = 0.04 unless the file says "
        "otherwise.");
  if (emits)
  {
    const char* how = unitsOfFile == EmissiveUnits::Luminance
      ? "luminance in cd/m^2 (glTF): exitance = pi L / efficacy"
      : unitsOfFile == EmissiveUnits::Radiance
      ? "radiance in W/(m^2 sr) (Blender's emission strength): exitance = pi L"
      : "exitance in W/m^2";
    Assume(scene, std::string("Emission: factor times strength is taken as ") + how + ".");
  }
}

} // namespace io
} // namespace radiometry
