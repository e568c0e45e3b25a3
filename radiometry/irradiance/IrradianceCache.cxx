// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceCache.h"

#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"

#include <utility>

namespace radiometry
{
namespace
{

void Add(ContentKey& key, const Vec3& v)
{
  key.Add(v.x);
  key.Add(v.y);
  key.Add(v.z);
}

void Add(ContentKey& key, const CandelaWeb* web)
{
  key.Add(static_cast<std::uint64_t>(web ? 1 + static_cast<int>(web->GetType()) : 0));
  if (web)
  {
    key.Add(web->GetHorizontal());
    key.Add(web->GetVertical());
    key.Add(web->GetValues());
  }
}

void Add(ContentKey& key, const SkyRadiance* sky)
{
  key.Add(static_cast<std::uint64_t>(sky ? 1 + static_cast<int>(sky->Model()) : 0));
  if (sky)
  {
    key.AddBytes(sky->Coefficients().data(), sizeof(double) * sky->Coefficients().size());
    Add(key, sky->ToSun());
    key.Add(sky->GroundRadiance());
    key.Add(static_cast<std::uint64_t>(sky->Width()));
    key.Add(static_cast<std::uint64_t>(sky->Height()));
    key.Add(static_cast<std::uint64_t>(sky->Bands()));
    key.Add(sky->Values());
  }
}

void Add(ContentKey& key, const Light& light)
{
  key.Add(static_cast<std::uint64_t>(light.Type));
  key.Add(static_cast<std::uint64_t>(
    (light.SmoothEdge ? 1 : 0) + (light.TwoSided ? 2 : 0) + (light.Enabled ? 4 : 0)));
  Add(key, light.Position);
  Add(key, light.Direction);
  Add(key, light.Reference);
  key.Add(light.Intensity);
  for (const double number : { light.CosCutoff, light.CosInnerCutoff, light.VersineCutoff,
         light.VersineInnerCutoff, light.Exponent, light.Attenuation[0], light.Attenuation[1],
         light.Attenuation[2] })
  {
    key.Add(number);
  }
  key.Add(light.Polygon);
  Add(key, light.Web.get());
  Add(key, light.Environment.get());
}

template <typename Vector>
std::size_t BytesOf(const Vector& v)
{
  return v.capacity() * sizeof(typename Vector::value_type);
}

ContentKey KeyOfTriangles(const Scene& scene)
{
  ContentKey key;
  key.Add(scene.Points);
  key.Add(scene.Triangles);
  key.Add(scene.TriangleTransmittance);
  key.Add(static_cast<std::uint64_t>(scene.Optics.Bands));
  return key;
}

} // namespace

std::size_t IrradianceKept::MemoryBytes() const
{
  std::size_t bytes = this->Cells.MemoryBytes() + BytesOf(this->Pieces.Points) +
    BytesOf(this->Pieces.Corners) + BytesOf(this->Pieces.First) + BytesOf(this->Pieces.Cell);
  for (std::size_t side = 0; side < 2; ++side)
  {
    bytes += this->Points[side].MemoryBytes() + BytesOf(this->CellShares[side]) +
      BytesOf(this->PointShares[side]);
  }
  return bytes;
}

IrradianceCache::IrradianceCache() = default;
IrradianceCache::~IrradianceCache() = default;

const OcclusionScene& IrradianceCache::Occluders(const Scene& scene)
{
  const ContentKey key = KeyOfTriangles(scene);
  if (!this->Visibility || key != this->Geometry)
  {
    this->Release();
    this->Visibility = std::make_unique<OcclusionScene>(scene);
    this->Geometry = key;
  }
  return *this->Visibility;
}

std::unique_ptr<IrradianceKept> IrradianceCache::Take(const ContentKey& key)
{
  if (key != this->Content)
  {
    this->Values.reset();
  }
  return std::move(this->Values);
}

void IrradianceCache::Keep(const ContentKey& key, std::unique_ptr<IrradianceKept> values)
{
  this->Content = key;
  this->Values = std::move(values);
}

void IrradianceCache::Release()
{
  this->Values.reset();
  this->Visibility.reset();
}

std::size_t IrradianceCache::MemoryBytes() const
{
  return (this->Values ? this->Values->MemoryBytes() : 0) +
    (this->Visibility ? this->Visibility->MemoryBytes() : 0);
}

ContentKey KeyOfDirectLight(const ContentKey& geometry, const Scene& scene,
  const std::vector<SurfacePoint>& points, const DirectOptions& options)
{
  ContentKey key = geometry;
  Add(key, scene.Origin);
  key.Add(scene.TriangleCell);
  key.Add(static_cast<std::uint64_t>(scene.ReceiverTriangles));
  key.Add(static_cast<std::uint64_t>(scene.Cells));
  key.Add(scene.Optics.TwoSided);
  key.Add(scene.Optics.EmittedExitance[0]);
  key.Add(scene.Optics.EmittedExitance[1]);
  key.Add(static_cast<std::uint64_t>(scene.Lights.size()));
  for (const Light& light : scene.Lights)
  {
    Add(key, light);
  }
  key.Add(static_cast<std::uint64_t>(points.size()));
  for (const SurfacePoint& p : points)
  {
    Add(key, p.Point);
    Add(key, p.Normal);
    key.Add(static_cast<std::uint64_t>(static_cast<std::int64_t>(p.Triangle)));
    key.Add(p.Around);
    key.Add(p.Rounding);
  }
  std::uint64_t flags = 0;
  for (const bool flag : { options.Occlusion, options.SpotShape, options.Attenuation,
         options.Environment, options.Emission, options.Transmission, options.DropAreas,
         options.DropSky })
  {
    flags = 2 * flags + (flag ? 1 : 0);
  }
  key.Add(flags);
  key.Add(options.Dropped);
  return key;
}

} // namespace radiometry
