// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiometry
{

/// What leaves elements of what falls on them: (R E)_i = rho_i E_i + sum over couplings to i of
/// tau E_from, the diffuse reflection of an element and what it lets through of the light on the
/// other side of the same piece of surface. A vector of reflectances is one without couplings.
struct DiffuseScattering
{
  struct Coupling
  {
    std::int32_t To = 0, From = 0;
  };
  std::vector<double> Reflectance;   // elements x bands
  std::vector<Coupling> Couplings;   // ascending in To, then in From
  std::vector<double> Transmittance; // couplings x bands

  DiffuseScattering() = default;
  DiffuseScattering(std::vector<double> reflectance) // NOLINT: meant to convert
    : Reflectance(std::move(reflectance))
  {
  }

  /// out = R E of so many bands; `out` may not be `E`.
  void Apply(const double* E, double* out, std::size_t bands) const;
  /// True when nothing leaves.
  bool Black() const;
  /// One band: the greatest of all bands.
  DiffuseScattering Greatest(std::size_t bands) const;
  /// The bands of this beside those of another (of the same couplings).
  DiffuseScattering Beside(
    std::size_t bands, const DiffuseScattering& other, std::size_t otherBands) const;
  /// The same between groups of elements: area-weighted means over the members of a group, of
  /// light that is constant on each group.
  DiffuseScattering Grouped(std::size_t bands, const std::vector<double>& areas,
    const std::vector<std::int32_t>& group, std::size_t groups) const;
};

} // namespace radiometry
