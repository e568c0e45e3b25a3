// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/ElementOptics.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{
namespace
{

/// The values of a cell's side; the back has the front's where it has none of its own. Null: none.
const double* Row(const std::array<std::vector<double>, 2>& values, std::size_t side,
  std::size_t cell, std::size_t bands)
{
  const std::vector<double>& v = values[side].empty() ? values[0] : values[side];
  return v.empty() ? nullptr : v.data() + cell * bands;
}

void CheckArray(const std::vector<double>& values, const Scene& scene, const std::string& name,
  double greatest, const char* expected)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  if (values.empty())
  {
    return;
  }
  if (values.size() != scene.Cells * bands)
  {
    throw InputError(name, -1, static_cast<double>(values.size()),
      std::to_string(scene.Cells * bands) + " values, one for each cell and band");
  }
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    if (!(values[k] >= 0.0 && values[k] <= greatest))
    {
      throw InputError(name, static_cast<long long>(k / bands), values[k], expected);
    }
  }
}

} // namespace

ElementOptics::ElementOptics(
  const Scene& scene, const ElementSet& elements, bool emission, bool transmission)
  : Bands(scene.Optics.Bands)
{
  const auto bands = static_cast<std::size_t>(this->Bands);
  const std::vector<double>& through = scene.Optics.DiffuseTransmittance;
  const bool diffusing = transmission &&
    std::any_of(through.begin(), through.end(), [](double share) { return share > 0.0; });
  this->Reflectance.assign(elements.Size() * bands, 0.0);
  this->Exitance.assign(elements.Size() * bands, 0.0);
  this->Transmittance.assign(diffusing ? elements.Size() * bands : 0, 0.0);
  this->Opposite.assign(diffusing ? elements.Size() : 0, -1);
  for (std::size_t e = 0; e < elements.Size(); ++e)
  {
    const Patch& p = elements.GetPatches()[e];
    const auto cell = static_cast<std::size_t>(p.Cell);
    if (diffusing)
    {
      this->Opposite[e] = elements.Opposite(e);
      std::copy_n(&through[cell * bands], bands, &this->Transmittance[e * bands]);
    }
    if (p.Side == 1 && !(cell < scene.Optics.TwoSided.size() && scene.Optics.TwoSided[cell]))
    {
      continue;
    }
    if (const double* rho = Row(scene.Optics.DiffuseReflectance, p.Side, cell, bands))
    {
      std::copy(rho, rho + bands, this->Reflectance.data() + e * bands);
    }
    const double* m = Row(scene.Optics.EmittedExitance, p.Side, cell, bands);
    if (emission && m)
    {
      std::copy(m, m + bands, this->Exitance.data() + e * bands);
    }
  }
}

DiffuseScattering ElementOptics::Scattering() const
{
  const auto bands = static_cast<std::size_t>(this->Bands);
  DiffuseScattering out(this->Reflectance);
  for (std::size_t e = 0; e < this->Opposite.size(); ++e)
  {
    const double* tau = this->Transmittance.data() + e * bands;
    if (this->Opposite[e] >= 0 && std::any_of(tau, tau + bands, [](double t) { return t > 0.0; }))
    {
      out.Couplings.push_back({ static_cast<std::int32_t>(e), this->Opposite[e] });
      out.Transmittance.insert(out.Transmittance.end(), tau, tau + bands);
    }
  }
  return out;
}

void ElementOptics::Leave(
  const std::vector<double>& irradiance, bool emission, std::vector<double>& leaving) const
{
  const auto bands = static_cast<std::size_t>(this->Bands);
  leaving.resize(irradiance.size());
  for (std::size_t k = 0; k < leaving.size(); ++k)
  {
    leaving[k] = this->Reflectance[k] * irradiance[k] + (emission ? this->Exitance[k] : 0.0);
    const std::int32_t other = this->Opposite.empty() ? -1 : this->Opposite[k / bands];
    if (other >= 0)
    {
      leaving[k] += this->Transmittance[k] *
        irradiance[static_cast<std::size_t>(other) * bands + k % bands];
    }
  }
}

void CheckOptics(const Scene& scene)
{
  for (std::size_t side = 0; side < 2; ++side)
  {
    const std::string prefix = side ? names::BackPrefix : "";
    CheckArray(scene.Optics.DiffuseReflectance[side], scene, prefix + names::DiffuseReflectance,
      1.0, "a reflectance between 0 and 1");
    CheckArray(scene.Optics.EmittedExitance[side], scene, prefix + names::EmittedExitance, 1e300,
      "a finite exitance of at least 0 W/m^2");
  }
  CheckArray(scene.Optics.DiffuseTransmittance, scene, names::DiffuseTransmittance, 1.0,
    "a transmittance between 0 and 1");
  for (std::size_t k = 0; k < scene.Optics.DiffuseTransmittance.size(); ++k)
  {
    for (const std::vector<double>& rho : scene.Optics.DiffuseReflectance)
    {
      const double sum = scene.Optics.DiffuseTransmittance[k] + (rho.empty() ? 0.0 : rho[k]);
      if (sum > 1.0 + 1e-12)
      {
        throw InputError(std::string(names::DiffuseReflectance) + " + " +
            names::DiffuseTransmittance,
          static_cast<long long>(k / static_cast<std::size_t>(scene.Optics.Bands)), sum,
          "at most 1 in each band");
      }
    }
  }
}

EmitterSet SmallEmitters(
  const Scene& scene, const ElementSet& elements, bool backFaces, std::size_t mostPairs)
{
  const ElementSet whole(scene, backFaces);
  const ElementOptics optics(scene, whole, true);
  const auto bands = static_cast<std::size_t>(optics.Bands);
  EmitterSet emitters;
  emitters.Bands = optics.Bands;
  double area = 0.0, emitting = 0.0;
  for (std::size_t e = 0; e < whole.Size(); ++e)
  {
    area += whole.GetAreas()[e];
    const auto row = optics.Exitance.begin() + static_cast<std::ptrdiff_t>(e * bands);
    if (std::any_of(row, row + optics.Bands, [](double m) { return m > 0.0; }))
    {
      emitting += whole.GetAreas()[e];
      emitters.Patches.push_back(whole.GetPatches()[e]);
      emitters.Exitance.insert(emitters.Exitance.end(), row, row + optics.Bands);
    }
  }
  if (emitting > 0.25 * area || emitters.Patches.size() * elements.Size() > mostPairs)
  {
    emitters.Patches.clear();
    emitters.Exitance.clear();
  }
  return emitters;
}

} // namespace radiometry
