// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/LightKey.h"

#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"

#include <array>
#include <cstring>

namespace radiometry
{
namespace
{

void Add(ContentKey& key, double value)
{
  std::uint64_t word = 0;
  std::memcpy(&word, &value, sizeof(word));
  key.Add(word);
}
void Add(ContentKey& key, const Vec3& v)
{
  for (const double x : { v.x, v.y, v.z })
  {
    Add(key, x);
  }
}
void Add(ContentKey& key, bool flag) { key.Add(static_cast<std::uint64_t>(flag)); }

void Add(ContentKey& key, const CandelaWeb* web)
{
  Add(key, web != nullptr);
  if (web)
  {
    key.Add(static_cast<std::uint64_t>(web->GetType()));
    key.Add(web->GetHorizontal());
    key.Add(web->GetVertical());
    key.Add(web->GetValues());
  }
}
void Add(ContentKey& key, const SkyRadiance* sky)
{
  Add(key, sky != nullptr);
  if (sky)
  {
    key.Add(static_cast<std::uint64_t>(sky->Model()));
    for (const double c : sky->Coefficients())
    {
      Add(key, c);
    }
    Add(key, sky->ToSun());
    Add(key, sky->GroundRadiance());
    key.Add(static_cast<std::uint64_t>(sky->Width()));
    key.Add(static_cast<std::uint64_t>(sky->Bands()));
    key.Add(sky->Values());
  }
}
void Add(ContentKey& key, const Light& light)
{
  key.Add(static_cast<std::uint64_t>(light.Type));
  Add(key, light.Position);
  Add(key, light.Direction);
  Add(key, light.Reference);
  key.Add(light.Intensity);
  for (const double v : { light.CosCutoff, light.CosInnerCutoff, light.VersineCutoff,
         light.VersineInnerCutoff, light.Exponent, light.Attenuation[0], light.Attenuation[1],
         light.Attenuation[2] })
  {
    Add(key, v);
  }
  Add(key, light.SmoothEdge);
  key.Add(light.Polygon);
  Add(key, light.TwoSided);
  Add(key, light.Enabled);
  Add(key, light.Web.get());
  Add(key, light.Environment.get());
}

} // namespace

ContentKey KeyOfLight(const Scene& scene, const RadiosityOptions& options)
{
  ContentKey key;
  key.Add(static_cast<std::uint64_t>(scene.Lights.size()));
  for (const Light& light : scene.Lights)
  {
    Add(key, light);
  }
  key.Add(scene.GlobalAmbient);
  const Materials& optics = scene.Optics;
  key.Add(static_cast<std::uint64_t>(optics.Bands));
  for (const auto* sides : { &optics.DiffuseReflectance, &optics.SpecularReflectance,
         &optics.EmittedExitance, &optics.Shininess })
  {
    for (const std::vector<double>& side : *sides)
    {
      key.Add(side);
    }
  }
  key.Add(optics.Transmittance);
  key.Add(optics.DiffuseTransmittance);
  for (const bool on : { options.Interreflection, options.Occlusion, options.BackFaces,
         options.Emission, options.SpotShape, options.Attenuation, options.Environment,
         options.Transmission, options.SpecularTransport, options.PathTransmission })
  {
    Add(key, on);
  }
  key.Add(static_cast<std::uint64_t>(options.MaximumBounces));
  return key;
}

} // namespace radiometry
