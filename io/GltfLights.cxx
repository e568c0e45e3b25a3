// SPDX-License-Identifier: BSD-3-Clause
#include "io/GltfParts.h"

#include "radiometry/scene/Units.h"

#include <cmath>

namespace radiometry
{
namespace io
{
namespace
{

using nlohmann::json;

/// A number of an object, or the default where it is absent.
double Number(const json& object, const char* name, double standard, const std::string& place)
{
  const auto found = object.find(name);
  if (found == object.end())
  {
    return standard;
  }
  if (!found->is_number())
  {
    throw InputError(place + "." + name, -1, found->dump(), "a number");
  }
  return found->get<double>();
}

std::array<double, 3> Color(const json& light, const std::string& place)
{
  std::array<double, 3> color{ 1.0, 1.0, 1.0 };
  const auto found = light.find("color");
  if (found == light.end())
  {
    return color;
  }
  if (!found->is_array() || found->size() != 3)
  {
    throw InputError(place + ".color", -1, found->dump(), "an array of 3 numbers");
  }
  for (std::size_t b = 0; b < 3; ++b)
  {
    const json& value = (*found)[b];
    if (!value.is_number() || !(value.get<double>() >= 0.0))
    {
      throw InputError(
        place + ".color", static_cast<long long>(b), value.dump(), "a number, not negative");
    }
    color[b] = value.get<double>();
  }
  return color;
}

void Cone(const json& light, const std::string& place, LightRecord& record)
{
  const auto spot = light.find("spot");
  if (spot == light.end() || !spot->is_object())
  {
    throw InputError(place + ".spot", -1, spot == light.end() ? "missing" : spot->dump(),
      "an object with the angles of the cone");
  }
  const double inner = Number(*spot, "innerConeAngle", 0.0, place + ".spot");
  double outer = Number(*spot, "outerConeAngle", 0.25 * units::Pi, place + ".spot");
  // pi/2 written from single precision is a little above pi/2.
  const double rightAngle = static_cast<float>(0.5 * units::Pi);
  if (!(outer > 0.0 && outer <= rightAngle))
  {
    throw InputError(
      place + ".spot.outerConeAngle", -1, outer, "radians above 0 and at most pi/2");
  }
  if (!(inner >= 0.0 && inner < outer))
  {
    throw InputError(place + ".spot.innerConeAngle", -1, inner,
      "radians in [0, outerConeAngle = " + std::to_string(outer) + ")");
  }
  record.SpotCutoff = std::fmin(90.0, units::Degrees(outer));
  record.SpotInnerCutoff = units::Degrees(inner);
}

LightRecord ReadLight(const json& light, std::size_t index, double toSI, const GltfDocument& file,
  GltfScene& scene)
{
  std::string place = "KHR_lights_punctual.lights[" + std::to_string(index) + "]";
  LightRecord record;
  record.Name = "light " + std::to_string(index);
  if (!light.is_object())
  {
    throw InputError(file.At(place), -1, light.dump(), "an object");
  }
  const auto name = light.find("name");
  if (name != light.end() && name->is_string())
  {
    record.Name = name->get<std::string>();
    place += " \"" + record.Name + "\"";
  }
  const std::string at = file.At(place);
  const auto type = light.find("type");
  const std::string kind =
    type != light.end() && type->is_string() ? type->get<std::string>() : std::string();
  if (kind == "point")
  {
    record.Type = LightType::Point;
  }
  else if (kind == "spot")
  {
    record.Type = LightType::Spot;
    Cone(light, at, record);
  }
  else if (kind == "directional")
  {
    record.Type = LightType::Directional;
  }
  else
  {
    throw InputError(at + ".type", -1, type == light.end() ? "missing" : type->dump(),
      "\"point\", \"spot\" or \"directional\"");
  }
  const double intensity = Number(light, "intensity", 1.0, at);
  if (!(intensity >= 0.0) || !std::isfinite(intensity))
  {
    throw InputError(at + ".intensity", -1, intensity, "a finite number, not negative");
  }
  if (light.contains("range"))
  {
    const double range = Number(light, "range", 1.0, at);
    if (!(range > 0.0))
    {
      throw InputError(at + ".range", -1, range, "a number above 0");
    }
    Assume(scene,
      "Lights: range is ignored (it hides a light beyond a distance; the fall-off here is physical, "
      "1/r^2).");
  }
  const std::array<double, 3> color = Color(light, at);
  record.Intensity = { color[0] * intensity * toSI, color[1] * intensity * toSI,
    color[2] * intensity * toSI };
  return record;
}

} // namespace

std::vector<LightRecord> ReadGltfLights(
  const GltfDocument& file, const GltfOptions& options, GltfScene& scene)
{
  std::vector<LightRecord> lights;
  scene.PhotometricLights = options.Lights != GltfOptions::LightUnits::Radiometric;
  const double photometricToSI = units::Radiometric(1.0, options.LuminousEfficacy);
  const double toSI = scene.PhotometricLights ? photometricToSI : 1.0;
  const json& root = file.Json();
  const json::json_pointer where("/extensions/KHR_lights_punctual/lights");
  if (!root.contains(where))
  {
    return lights;
  }
  const json& list = root.at(where);
  if (!list.is_array())
  {
    throw InputError(file.At("KHR_lights_punctual.lights"), -1, "not an array", "an array");
  }
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    lights.push_back(ReadLight(list[i], i, toSI, file, scene));
  }
  if (!lights.empty())
  {
    char text[160];
    std::snprintf(text, sizeof text,
      "Lights: intensities are taken as cd and lx and divided by %g lm/W.",
      options.LuminousEfficacy);
    Assume(scene,
      scene.PhotometricLights ? std::string(text)
                              : "Lights: intensities are taken as W/sr and W/m^2.");
    if (scene.PhotometricLights &&
      file.Generator().find("Blender") != std::string::npos)
    {
      Assume(scene,
        "Lights: Blender wrote the file, and multiplies its watts by 683 lm/W: they come back to 3 "
        "parts in a million.");
    }
  }
  return lights;
}

GltfCamera ReadGltfCamera(const GltfDocument& file, int index, const GltfTransform& transform)
{
  const auto& cameras = file.Model().cameras;
  if (index < 0 || static_cast<std::size_t>(index) >= cameras.size())
  {
    throw InputError(file.At("nodes[].camera"), -1, index, "a camera of the file");
  }
  const tinygltf::Camera& source = cameras[index];
  const std::string at = file.At("cameras[" + std::to_string(index) + "]");
  GltfCamera camera;
  camera.Name = source.name;
  camera.Position = transform.Translation;
  camera.Direction = Normalized(-transform.Column[2]);
  const Vec3 up = transform.Column[1];
  camera.ViewUp = Normalized(up - Dot(up, camera.Direction) * camera.Direction);
  if (LengthSquared(camera.Direction) == 0.0 || LengthSquared(camera.ViewUp) == 0.0)
  {
    throw InputError(at, -1, "a node that flattens it", "a transform that can be inverted");
  }
  camera.Parallel = source.type == "orthographic";
  const double size = camera.Parallel ? source.orthographic.ymag : source.perspective.yfov;
  const double most = camera.Parallel ? 1e300 : units::Pi;
  if (!(size > 0.0 && size < most))
  {
    throw InputError(at + (camera.Parallel ? ".ymag" : ".yfov"), -1, size,
      camera.Parallel ? "a number above 0" : "radians above 0 and below pi");
  }
  if (camera.Parallel)
  {
    camera.ParallelScale = size;
    camera.AspectRatio = source.orthographic.xmag / size;
    camera.Near = source.orthographic.znear;
    camera.Far = source.orthographic.zfar;
  }
  else
  {
    camera.ViewAngle = units::Degrees(size);
    camera.AspectRatio = source.perspective.aspectRatio;
    camera.Near = source.perspective.znear;
    camera.Far = source.perspective.zfar;
  }
  return camera;
}

} // namespace io
} // namespace radiometry
