// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/DiffuseScattering.h"

#include <algorithm>
#include <map>
#include <utility>

namespace radiometry
{

void DiffuseScattering::Apply(const double* E, double* out, std::size_t bands) const
{
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    out[k] = this->Reflectance[k] * E[k];
  }
  for (std::size_t c = 0; c < this->Couplings.size(); ++c)
  {
    const auto to = static_cast<std::size_t>(this->Couplings[c].To) * bands;
    const auto from = static_cast<std::size_t>(this->Couplings[c].From) * bands;
    for (std::size_t b = 0; b < bands; ++b)
    {
      out[to + b] += this->Transmittance[c * bands + b] * E[from + b];
    }
  }
}

bool DiffuseScattering::Black() const
{
  const auto zero = [](double share) { return share == 0.0; };
  return std::all_of(this->Reflectance.begin(), this->Reflectance.end(), zero) &&
    std::all_of(this->Transmittance.begin(), this->Transmittance.end(), zero);
}

DiffuseScattering DiffuseScattering::Greatest(std::size_t bands) const
{
  const auto greatest = [bands](const std::vector<double>& of) {
    std::vector<double> out(of.size() / bands, 0.0);
    for (std::size_t k = 0; k < of.size(); ++k)
    {
      out[k / bands] = std::max(out[k / bands], of[k]);
    }
    return out;
  };
  DiffuseScattering out(greatest(this->Reflectance));
  out.Couplings = this->Couplings;
  out.Transmittance = greatest(this->Transmittance);
  return out;
}

DiffuseScattering DiffuseScattering::Beside(
  std::size_t bands, const DiffuseScattering& other, std::size_t otherBands) const
{
  const auto join = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const std::size_t width = bands + otherBands;
    std::vector<double> out(a.size() / bands * width);
    for (std::size_t row = 0; row < out.size() / width; ++row)
    {
      std::copy_n(&a[row * bands], bands, &out[row * width]);
      std::copy_n(&b[row * otherBands], otherBands, &out[row * width + bands]);
    }
    return out;
  };
  DiffuseScattering out(join(this->Reflectance, other.Reflectance));
  out.Couplings = this->Couplings;
  out.Transmittance = join(this->Transmittance, other.Transmittance);
  return out;
}

DiffuseScattering DiffuseScattering::Grouped(std::size_t bands, const std::vector<double>& areas,
  const std::vector<std::int32_t>& group, std::size_t groups) const
{
  DiffuseScattering out(std::vector<double>(groups * bands, 0.0));
  std::vector<double> groupArea(groups, 0.0);
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    groupArea[static_cast<std::size_t>(group[e])] += areas[e];
  }
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    const double share = areas[e] / groupArea[g];
    for (std::size_t b = 0; b < bands; ++b)
    {
      out.Reflectance[g * bands + b] += share * this->Reflectance[e * bands + b];
    }
  }
  // Ordered by (to, from): the same sums in any run.
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> joined;
  for (std::size_t c = 0; c < this->Couplings.size(); ++c)
  {
    const auto to = static_cast<std::size_t>(this->Couplings[c].To);
    const auto from = static_cast<std::size_t>(this->Couplings[c].From);
    std::vector<double>& tau =
      joined.try_emplace({ group[to], group[from] }, bands, 0.0).first->second;
    const double share = areas[to] / groupArea[static_cast<std::size_t>(group[to])];
    for (std::size_t b = 0; b < bands; ++b)
    {
      tau[b] += share * this->Transmittance[c * bands + b];
    }
  }
  for (const auto& [pair, tau] : joined)
  {
    out.Couplings.push_back({ pair.first, pair.second });
    out.Transmittance.insert(out.Transmittance.end(), tau.begin(), tau.end());
  }
  return out;
}

} // namespace radiometry
