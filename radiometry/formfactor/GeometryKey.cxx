// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/GeometryKey.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

ContentKey KeyOfGeometry(const Scene& scene)
{
  ContentKey key;
  key.Add(scene.Points);
  key.Add(scene.Triangles);
  key.Add(scene.TriangleCell);
  key.Add(scene.ReceiverTriangles);
  key.Add(scene.Cells);
  const std::vector<double>& through = scene.Optics.DiffuseTransmittance;
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::vector<std::uint8_t> both(scene.Cells, 0);
  for (std::size_t c = 0; c < scene.Cells; ++c)
  {
    both[c] = c < scene.Optics.TwoSided.size() && scene.Optics.TwoSided[c];
    for (std::size_t k = c * bands; k < (c + 1) * bands && k < through.size(); ++k)
    {
      both[c] = both[c] || through[k] > 0.0;
    }
  }
  key.Add(both);
  key.Add(scene.TriangleTransmittance);
  key.Add(scene.TriangleTransmittance.empty() ? 0u : bands);
  return key;
}

ContentKey KeyOfMirrors(const Scene& scene)
{
  ContentKey key;
  for (int side = 0; side < 2; ++side)
  {
    key.Add(scene.Optics.SpecularReflectance[side]);
    key.Add(scene.Optics.Shininess[side]);
  }
  key.Add(static_cast<std::uint64_t>(scene.Optics.Bands));
  return key;
}

} // namespace radiometry
