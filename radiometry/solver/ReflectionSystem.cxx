// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/ReflectionSystem.h"

#include <limits>

namespace radiometry
{

void ReflectionSystem::Cycle(
  const std::vector<double>& r, const std::vector<double>& goal, int steps, std::vector<double>& x)
{
  const std::size_t nb = this->Bands;
  // As long a cycle as half a gigabyte of basis allows.
  const double bytes = 8.0 * static_cast<double>(std::max<std::size_t>(1, r.size()));
  const int Restart = std::clamp(static_cast<int>(5e8 / bytes), 10, LongestCycle);
  std::vector<std::vector<double>> basis;
  // Per band: the Hessenberg matrix rotated to upper triangular, and the rotated right-hand side.
  const auto width = static_cast<std::size_t>(Restart);
  std::vector<std::vector<double>> h(nb, std::vector<double>((width + 1) * width, 0.0));
  std::vector<std::vector<double>> cs(nb, std::vector<double>(width));
  std::vector<std::vector<double>> sn = cs;
  std::vector<std::vector<double>> g(nb, std::vector<double>(width + 1, 0.0));
  std::vector<double> inner;

  const auto pushNormalised = [&](const std::vector<double>& v, const std::vector<double>& norms) {
    basis.push_back(v);
    for (std::size_t k = 0; k < v.size(); ++k)
    {
      const double norm = norms[k % nb];
      basis.back()[k] = norm > 0.0 ? v[k] / norm : 0.0;
    }
  };
  this->Inner(r, r, inner);
  std::vector<double> norms(nb);
  for (std::size_t b = 0; b < nb; ++b)
  {
    norms[b] = std::sqrt(inner[b]);
    g[b][0] = norms[b];
  }
  pushNormalised(r, norms);

  std::vector<double> w(r.size());
  int used = 0;
  for (int k = 0; k < std::min(steps, Restart); ++k)
  {
    this->Reflect(basis[static_cast<std::size_t>(k)], w);
    for (std::size_t i = 0; i < w.size(); ++i)
    {
      w[i] = basis[static_cast<std::size_t>(k)][i] - w[i];
    }
    for (int j = 0; j <= k; ++j)
    {
      const auto& v = basis[static_cast<std::size_t>(j)];
      this->Inner(w, v, inner);
      for (std::size_t b = 0; b < nb; ++b)
      {
        h[b][static_cast<std::size_t>(j * Restart + k)] = inner[b];
      }
      for (std::size_t i = 0; i < w.size(); ++i)
      {
        w[i] -= inner[i % nb] * v[i];
      }
    }
    this->Inner(w, w, inner);
    bool done = true;
    for (std::size_t b = 0; b < nb; ++b)
    {
      norms[b] = std::sqrt(inner[b]);
      auto at = [&](
                  int row) -> double& { return h[b][static_cast<std::size_t>(row * Restart + k)]; };
      for (int j = 0; j < k; ++j)
      {
        const auto q = static_cast<std::size_t>(j);
        const double upper = cs[b][q] * at(j) + sn[b][q] * at(j + 1);
        at(j + 1) = -sn[b][q] * at(j) + cs[b][q] * at(j + 1);
        at(j) = upper;
      }
      const double length = std::hypot(at(k), norms[b]);
      const auto q = static_cast<std::size_t>(k);
      cs[b][q] = length > 0.0 ? at(k) / length : 1.0;
      sn[b][q] = length > 0.0 ? norms[b] / length : 0.0;
      at(k) = length;
      g[b][q + 1] = -sn[b][q] * g[b][q];
      g[b][q] *= cs[b][q];
      // A direction that rounding made of nothing is none.
      norms[b] = norms[b] > 1e-14 * length ? norms[b] : 0.0;
      done = done && std::abs(g[b][q + 1]) <= goal[b];
    }
    used = k + 1;
    if (done)
    {
      break;
    }
    pushNormalised(w, norms);
  }
  for (std::size_t b = 0; b < nb; ++b)
  {
    std::vector<double> y(static_cast<std::size_t>(used), 0.0);
    for (int row = used - 1; row >= 0; --row)
    {
      double sum = g[b][static_cast<std::size_t>(row)];
      for (int col = row + 1; col < used; ++col)
      {
        sum -=
          h[b][static_cast<std::size_t>(row * Restart + col)] * y[static_cast<std::size_t>(col)];
      }
      const double pivot = h[b][static_cast<std::size_t>(row * Restart + row)];
      y[static_cast<std::size_t>(row)] = std::abs(pivot) > 1e-300 ? sum / pivot : 0.0;
    }
    for (int k = 0; k < used; ++k)
    {
      const auto& v = basis[static_cast<std::size_t>(k)];
      for (std::size_t i = b; i < v.size(); i += nb)
      {
        x[i] += y[static_cast<std::size_t>(k)] * v[i];
      }
    }
  }
}

std::vector<double> BoundOfInverse(ReflectionSystem& system)
{
  const std::vector<double> one(system.N, 1.0);
  std::vector<double> w = one, r(system.N);
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> bound(system.N, std::numeric_limits<double>::infinity());
  double area = 0.0;
  for (const double a : system.F.Areas())
  {
    area += a;
  }
  for (int cycle = 0; cycle < 40; ++cycle)
  {
    system.Residual(one, w, r);
    system.Deflate(r, w);
    system.Residual(one, w, r);
    double least = std::numeric_limits<double>::infinity(); // of (I - rho F) w
    double lowest = least, worst = 0.0;
    for (std::size_t i = 0; i < system.N; ++i)
    {
      least = std::min(least, 1.0 - r[i]);
      lowest = std::min(lowest, w[i]);
      worst = std::max(worst, std::abs(r[i]));
    }
    if (least > 0.0 && lowest > 0.0 && worst < best)
    {
      best = worst;
      for (std::size_t i = 0; i < system.N; ++i)
      {
        bound[i] = w[i] / least;
      }
    }
    if (best <= 0.25)
    {
      break;
    }
    system.Cycle(r, { 0.02 * std::sqrt(area) }, LongestCycle, w);
  }
  return bound;
}

} // namespace radiometry
