// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/ReflectionSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr std::size_t Block = 2048; // elements

} // namespace

ReflectionSystem::ReflectionSystem(const FormFactorOperator& op, DiffuseScattering scattering,
  std::size_t columns, std::vector<std::int32_t> component, int threads,
  const StageProgress& progress)
  : F(op)
  , Scattering(std::move(scattering))
  , N(op.Size())
  , Columns(columns)
  , Component(std::move(component))
  , Threads(threads)
  , Progress(progress)
{
  std::int32_t components = 0;
  for (const std::int32_t c : this->Component)
  {
    components = std::max(components, c + 1);
  }
  this->ComponentArea.assign(static_cast<std::size_t>(components), 0.0);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    this->ComponentArea[static_cast<std::size_t>(this->Component[i])] += op.Areas()[i];
  }
}

void ReflectionSystem::Exchange(const Values& x, Values& out, std::size_t columns)
{
  out.resize(this->N * columns);
  this->F.Apply(x.data(), out.data(), static_cast<int>(columns));
  ++this->Iterations;
  Report(this->Progress.Listener,
    this->Progress.Begin +
      (this->Progress.End - this->Progress.Begin) * (1.0 - 1.0 / (1.0 + 0.1 * this->Iterations)),
    this->Progress.Name);
}

ReflectionSystem::Values ReflectionSystem::OverBlocks(std::size_t sums, const Body& body) const
{
  const std::size_t blocks = (this->N + Block - 1) / Block;
  Values partial(blocks * sums, 0.0);
  const auto one = [&](std::size_t b) {
    body(b * Block, std::min(this->N, (b + 1) * Block), partial.data() + b * sums);
  };
  if (blocks < 8)
  {
    for (std::size_t b = 0; b < blocks; ++b)
    {
      one(b);
    }
  }
  else
  {
    ParallelFor(blocks, this->Threads, {}, one, 1e-9 * Block * static_cast<double>(this->Columns));
  }
  Values total(sums, 0.0);
  for (std::size_t k = 0; k < partial.size(); ++k)
  {
    total[k % sums] += partial[k];
  }
  return total;
}

void ReflectionSystem::SetLoss(const Values& returned)
{
  this->Loss.resize(returned.size());
  this->LossSum.assign(this->Components() * this->Columns, 0.0);
  this->LossSquare = this->LossSum;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    const std::size_t c = static_cast<std::size_t>(this->Component[i]) * this->Columns;
    for (std::size_t b = 0; b < this->Columns; ++b)
    {
      const double loss = 1.0 - returned[i * this->Columns + b];
      this->Loss[i * this->Columns + b] = loss;
      this->LossSum[c + b] += this->F.Areas()[i] * loss;
      this->LossSquare[c + b] += this->F.Areas()[i] * loss * loss;
    }
  }
}

ReflectionSystem::Values ReflectionSystem::LeastLoss() const
{
  Values least(this->Columns, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < this->Loss.size(); ++k)
  {
    least[k % this->Columns] = std::min(least[k % this->Columns], this->Loss[k]);
  }
  return least;
}

void ReflectionSystem::Blacken(std::size_t component, std::size_t column)
{
  for (std::size_t i = 0; i < this->N; ++i)
  {
    if (static_cast<std::size_t>(this->Component[i]) == component)
    {
      this->Scattering.Reflectance[i * this->Columns + column] = 0.0;
      this->Loss[i * this->Columns + column] = 1.0;
    }
  }
  for (std::size_t k = 0; k < this->Scattering.Couplings.size(); ++k)
  {
    const auto to = static_cast<std::size_t>(this->Scattering.Couplings[k].To);
    if (static_cast<std::size_t>(this->Component[to]) == component)
    {
      this->Scattering.Transmittance[k * this->Columns + column] = 0.0;
    }
  }
  this->LossSum[component * this->Columns + column] = this->ComponentArea[component];
  this->LossSquare[component * this->Columns + column] = this->ComponentArea[component];
}

void ReflectionSystem::AddConstants(const Values& shares, Values& x) const
{
  this->OverBlocks(0, [&](std::size_t begin, std::size_t end, double*) {
    for (std::size_t i = begin; i < end; ++i)
    {
      const double* share =
        shares.data() + static_cast<std::size_t>(this->Component[i]) * this->Columns;
      for (std::size_t b = 0; b < this->Columns; ++b)
      {
        x[i * this->Columns + b] += share[b];
      }
    }
  });
}

void ReflectionSystem::Balance(Values& r, Values& x) const
{
  Values share(this->LossSum.size(), 0.0);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    double* sum = share.data() + static_cast<std::size_t>(this->Component[i]) * this->Columns;
    for (std::size_t b = 0; b < this->Columns; ++b)
    {
      sum[b] += this->F.Areas()[i] * r[i * this->Columns + b];
    }
  }
  for (std::size_t k = 0; k < share.size(); ++k)
  {
    share[k] = this->LossSum[k] > 0.0 ? share[k] / this->LossSum[k] : 0.0;
  }
  this->AddConstants(share, x);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    const double* s = share.data() + static_cast<std::size_t>(this->Component[i]) * this->Columns;
    for (std::size_t b = 0; b < this->Columns; ++b)
    {
      r[i * this->Columns + b] -= s[b] * this->Loss[i * this->Columns + b];
    }
  }
}

ReflectionSystem::Values ReflectionSystem::ProjectConstants(Values& r) const
{
  Values share(this->LossSquare.size(), 0.0);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    double* sum = share.data() + static_cast<std::size_t>(this->Component[i]) * this->Columns;
    for (std::size_t b = 0; b < this->Columns; ++b)
    {
      const std::size_t k = i * this->Columns + b;
      sum[b] += this->F.Areas()[i] * this->Loss[k] * r[k];
    }
  }
  for (std::size_t k = 0; k < share.size(); ++k)
  {
    share[k] = this->LossSquare[k] > 0.0 ? share[k] / this->LossSquare[k] : 0.0;
  }
  this->OverBlocks(0, [&](std::size_t begin, std::size_t end, double*) {
    for (std::size_t i = begin; i < end; ++i)
    {
      const double* s = share.data() + static_cast<std::size_t>(this->Component[i]) * this->Columns;
      for (std::size_t b = 0; b < this->Columns; ++b)
      {
        r[i * this->Columns + b] -= s[b] * this->Loss[i * this->Columns + b];
      }
    }
  });
  return share;
}

ReflectionSystem::Values ReflectionSystem::Inner(const Values& a, const Values& b) const
{
  return this->OverBlocks(this->Columns, [&](std::size_t begin, std::size_t end, double* sums) {
    for (std::size_t i = begin; i < end; ++i)
    {
      for (std::size_t c = 0; c < this->Columns; ++c)
      {
        const std::size_t k = i * this->Columns + c;
        sums[c] += this->F.Areas()[i] * a[k] * b[k];
      }
    }
  });
}

void ReflectionSystem::ProjectOuter(Values& r, std::vector<Values>& shares) const
{
  for (std::size_t o = 0; o < this->Outer.size(); ++o)
  {
    const Values& image = this->Outer[o].second;
    const Values inner = this->Inner(image, r);
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      r[k] -= inner[k % this->Columns] * image[k];
    }
    for (std::size_t c = 0; c < this->Columns; ++c)
    {
      shares[o][c] += inner[c];
    }
  }
}

void ReflectionSystem::KeepOuter(Values step, Values image)
{
  const double bytes = 16.0 * static_cast<double>(step.size());
  const auto most = static_cast<std::size_t>(std::clamp(0.4 * CycleBytes / bytes, 2.0, 12.0));
  const Values norm = this->Norm(image);
  for (std::size_t k = 0; k < step.size(); ++k)
  {
    const double length = norm[k % this->Columns];
    step[k] = length > 0.0 ? step[k] / length : 0.0;
    image[k] = length > 0.0 ? image[k] / length : 0.0;
  }
  if (this->Outer.size() == most)
  {
    this->Outer.erase(this->Outer.begin());
  }
  this->Outer.emplace_back(std::move(step), std::move(image));
}

ReflectionSystem::Values ReflectionSystem::Norm(const Values& v) const
{
  Values norm = this->Inner(v, v);
  for (double& square : norm)
  {
    square = std::sqrt(square);
  }
  return norm;
}

ReflectionSystem::Values ReflectionSystem::Greatest(const Values& v) const
{
  Values out(this->Columns, 0.0);
  for (std::size_t k = 0; k < v.size(); ++k)
  {
    out[k % this->Columns] = std::max(out[k % this->Columns], std::abs(v[k]));
  }
  return out;
}

ReflectionSystem::Values ReflectionSystem::Mean(const Values& v) const
{
  double area = 0.0;
  for (const double a : this->ComponentArea)
  {
    area += a;
  }
  Values out =
    this->OverBlocks(this->Columns, [&](std::size_t begin, std::size_t end, double* sums) {
      for (std::size_t i = begin; i < end; ++i)
      {
        for (std::size_t b = 0; b < this->Columns; ++b)
        {
          sums[b] += this->F.Areas()[i] * std::abs(v[i * this->Columns + b]);
        }
      }
    });
  for (double& m : out)
  {
    m /= area;
  }
  return out;
}

} // namespace radiometry
