// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClusterNetwork.h"

#include "radiometry/formfactor/ClusterCode.h"
#include "radiometry/formfactor/ClusterExchange.h"

#include <algorithm>

namespace radiometry
{
namespace
{

constexpr double FarShare = 0.5; // of a source's unevenness that lines up with the kernel's

} // namespace

void ClusterNetwork::Multiply(
  const std::vector<double>& scale, const double* x, double* out, int bands) const
{
  const std::size_t n = this->Tree.Order().size();
  if (n == 0)
  {
    return;
  }
  bands == 1
    ? this->Product<1>(scale, x, out, 1)
    : (bands == 3 ? this->Product<3>(scale, x, out, 3) : this->Product<0>(scale, x, out, bands));
  this->Total(out, n * static_cast<std::size_t>(bands));
}

/// out = F x: moments of x go up the tree, links carry them across, values and slopes go down.
/// Moments: sums of A x times 1, place - centre, and, where normals differ, normal - mean normal.
template <int Fixed>
void ClusterNetwork::Product(
  const std::vector<double>& scales, const double* x, double* out, int bands) const
{
  const auto nb = static_cast<std::size_t>(Fixed > 0 ? Fixed : bands);
  const std::size_t width = 4 * nb, bent = 3 * nb;
  std::vector<double> moments(this->Tree.Size() * width), field(this->Tree.Size() * width);
  std::vector<double> turns(this->CurvedCount * bent), turned(this->CurvedCount * bent);
  const auto curved = [&](std::int32_t at) { return this->Curved[static_cast<std::size_t>(at)]; };
  const auto addFrom = [&](std::int32_t at, std::int32_t child) {
    const ElementTree::Node& node = this->Tree[at];
    double* m = moments.data() + static_cast<std::size_t>(at) * width;
    const double* c = moments.data() + static_cast<std::size_t>(child) * width;
    const Vec3 d = this->Tree[child].Center - node.Center;
    for (std::size_t b = 0; b < nb; ++b)
    {
      m[4 * b] += c[4 * b];
      m[4 * b + 1] += c[4 * b + 1] + c[4 * b] * d.x;
      m[4 * b + 2] += c[4 * b + 2] + c[4 * b] * d.y;
      m[4 * b + 3] += c[4 * b + 3] + c[4 * b] * d.z;
    }
    if (curved(at) < 0)
    {
      return;
    }
    double* t = turns.data() + static_cast<std::size_t>(curved(at)) * bent;
    const double* u =
      curved(child) < 0 ? nullptr : turns.data() + static_cast<std::size_t>(curved(child)) * bent;
    const Vec3 n = this->Tree[child].Normal - node.Normal;
    for (std::size_t b = 0; b < nb; ++b)
    {
      for (int k = 0; k < 3; ++k)
      {
        t[3 * b + static_cast<std::size_t>(k)] +=
          (u ? u[3 * b + static_cast<std::size_t>(k)] : 0.0) + c[4 * b] * n[k];
      }
    }
  };
  this->Up([&](std::int32_t at) {
    const ElementTree::Node& node = this->Tree[at];
    if (!node.Leaf())
    {
      addFrom(at, at + 1);
      addFrom(at, node.Second);
      return;
    }
    double* m = moments.data() + static_cast<std::size_t>(at) * width;
    const std::size_t item = this->Item(node);
    const double weight = node.Area * scales[item];
    for (std::size_t b = 0; b < nb; ++b)
    {
      m[4 * b] = weight * x[item * nb + b];
    }
  });
  const double unit = 1.0 / this->Tree[0].Area;
  const auto gather = [&](std::int32_t at) {
    const ElementTree::Node& node = this->Tree[at];
    double* f = field.data() + static_cast<std::size_t>(at) * width;
    double* g =
      curved(at) < 0 ? nullptr : turned.data() + static_cast<std::size_t>(curved(at)) * bent;
    const auto n = static_cast<std::size_t>(at);
    for (std::size_t e = this->Begin[n]; e < this->Begin[n + 1]; ++e)
    {
      const Entry& entry = this->Entries[e];
      const double* m = moments.data() + static_cast<std::size_t>(entry.Other) * width;
      const double kernel = unit * static_cast<double>(entry.Kernel);
      if (entry.Turn == 0)
      {
        for (std::size_t b = 0; b < nb; ++b)
        {
          f[4 * b] += kernel * m[4 * b];
        }
        continue;
      }
      const double slope[3] = { kernel * static_cast<double>(entry.Slope[0]),
        kernel * static_cast<double>(entry.Slope[1]),
        kernel * static_cast<double>(entry.Slope[2]) };
      for (std::size_t b = 0; b < nb; ++b)
      {
        const double* mb = m + 4 * b;
        f[4 * b] += kernel * mb[0] - (slope[0] * mb[1] + slope[1] * mb[2] + slope[2] * mb[3]);
        f[4 * b + 1] += slope[0] * mb[0];
        f[4 * b + 2] += slope[1] * mb[0];
        f[4 * b + 3] += slope[2] * mb[0];
      }
      const std::int32_t bend = curved(entry.Other);
      if (!g && bend < 0)
      {
        continue;
      }
      const ExchangeSlope model(node, this->Tree[entry.Other]);
      const double scale = kernel * (entry.Turn / 255.0);
      const double* t = bend < 0 ? nullptr : turns.data() + static_cast<std::size_t>(bend) * bent;
      const Vec3 there = (scale * model.TurnB) * model.R;
      const Vec3 here = (scale * model.TurnA) * model.R;
      for (std::size_t b = 0; b < nb; ++b)
      {
        if (t)
        {
          f[4 * b] -= there.x * t[3 * b] + there.y * t[3 * b + 1] + there.z * t[3 * b + 2];
        }
        for (std::size_t k = 0; g && k < 3; ++k)
        {
          g[3 * b + k] += m[4 * b] * here[static_cast<int>(k)];
        }
      }
    }
    if (at == 0 && node.Leaf())
    {
      std::fill(out, out + nb, 0.0); // one element sees nothing of itself
    }
  };
  this->Down(gather, [&](std::int32_t at, std::int32_t parent) {
    const ElementTree::Node& node = this->Tree[at];
    const ElementTree::Node& above = this->Tree[parent];
    const Vec3 d = node.Center - above.Center;
    double* f = field.data() + static_cast<std::size_t>(at) * width;
    const double* p = field.data() + static_cast<std::size_t>(parent) * width;
    for (std::size_t b = 0; b < nb; ++b)
    {
      f[4 * b] += p[4 * b] + (p[4 * b + 1] * d.x + p[4 * b + 2] * d.y + p[4 * b + 3] * d.z);
      f[4 * b + 1] += p[4 * b + 1];
      f[4 * b + 2] += p[4 * b + 2];
      f[4 * b + 3] += p[4 * b + 3];
    }
    if (curved(parent) >= 0)
    {
      const Vec3 n = node.Normal - above.Normal;
      const double* q = turned.data() + static_cast<std::size_t>(curved(parent)) * bent;
      double* g =
        curved(at) < 0 ? nullptr : turned.data() + static_cast<std::size_t>(curved(at)) * bent;
      for (std::size_t b = 0; b < nb; ++b)
      {
        f[4 * b] += q[3 * b] * n.x + q[3 * b + 1] * n.y + q[3 * b + 2] * n.z;
        for (std::size_t k = 3 * b; g && k < 3 * b + 3; ++k)
        {
          g[k] += q[k];
        }
      }
    }
    if (node.Leaf())
    {
      const std::size_t item = this->Item(node);
      for (std::size_t b = 0; b < nb; ++b)
      {
        out[item * nb + b] = scales[item] * f[4 * b];
      }
    }
  });
}

void ClusterNetwork::SquareErrors(const double* B, const double* received,
  const std::vector<std::uint8_t>& closed, double* formOut, double* sightOut, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  const std::size_t values = this->Tree.Order().size() * nb;
  std::fill(formOut, formOut + values, 0.0);
  std::fill(sightOut, sightOut + values, 0.0);
  if (values == 0)
  {
    return;
  }
  // Of each node: areas times 1, B and B^2; closed area and what it receives.
  std::vector<double> first(this->Tree.Size() * nb), second(first), level(first), form(first),
    sight(first);
  this->Up([&](std::int32_t at) {
    const ElementTree::Node& node = this->Tree[at];
    const std::size_t n = static_cast<std::size_t>(at) * nb;
    const auto below = static_cast<std::size_t>(at + 1) * nb;
    const auto beside = static_cast<std::size_t>(std::max(0, node.Second)) * nb;
    for (std::size_t b = 0; b < nb; ++b)
    {
      if (node.Leaf())
      {
        const std::size_t item = this->Item(node);
        const double value = B[item * nb + b];
        first[n + b] = node.Area * value;
        second[n + b] = node.Area * value * value;
        level[n + b] = closed[item] ? node.Area * received[item * nb + b] : 0.0;
        continue;
      }
      first[n + b] = first[below + b] + first[beside + b];
      second[n + b] = second[below + b] + second[beside + b];
      level[n + b] = level[below + b] + level[beside + b];
    }
  });
  const auto gather = [&](std::int32_t at) {
    const auto n = static_cast<std::size_t>(at);
    for (std::size_t e = this->Begin[n]; e < this->Begin[n + 1]; ++e)
    {
      const Entry& entry = this->Entries[e];
      const double factor = Decoded(entry.Factor);
      const double own = factor * Decoded(entry.Form), far = factor * Decoded(entry.Far);
      const double hidden = factor * Decoded(entry.Sight), dim = factor * Decoded(entry.Dim);
      const auto other = static_cast<std::size_t>(entry.Other) * nb;
      const double area = this->Tree[entry.Other].Area;
      for (std::size_t b = 0; b < nb; ++b)
      {
        const double mean = first[other + b] / area;
        const double base = level[n * nb + b] / this->Tree[at].Area;
        const double off = (mean - base) * (mean - base);
        const double spread = std::max(0.0, second[other + b] / area - mean * mean);
        form[n * nb + b] += own * own * off + FarShare * FarShare * far * far * spread;
        sight[n * nb + b] += hidden * hidden * off + dim * dim * spread;
      }
    }
  };
  this->Down(gather, [&](std::int32_t at, std::int32_t parent) {
    const std::size_t n = static_cast<std::size_t>(at) * nb;
    const std::size_t p = static_cast<std::size_t>(parent) * nb;
    const bool leaf = this->Tree[at].Leaf();
    for (std::size_t b = 0; b < nb; ++b)
    {
      form[n + b] += form[p + b];
      sight[n + b] += sight[p + b];
      if (leaf)
      {
        const std::size_t item = this->Item(this->Tree[at]) * nb + b;
        formOut[item] = form[n + b];
        sightOut[item] = sight[n + b];
      }
    }
  });
  this->Total(formOut, values);
  this->Total(sightOut, values);
}

} // namespace radiometry
