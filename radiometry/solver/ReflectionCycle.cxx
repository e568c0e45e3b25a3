// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/ReflectionSystem.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiometry
{

/// The basis of a cycle and, for each column, its Hessenberg matrix rotated to upper triangular.
struct ReflectionSystem::Arnoldi
{
  Arnoldi(const ReflectionSystem& system, std::size_t width)
    : S(system)
    , Width(width)
    , H(system.Columns, Values((width + 1) * width, 0.0))
    , Cos(system.Columns, Values(width))
    , Sin(Cos)
    , G(system.Columns, Values(width + 1, 0.0))
  {
  }

  double& At(std::size_t column, std::size_t row, std::size_t k)
  {
    return this->H[column][row * this->Width + k];
  }

  void Push(const Values& v, const Values& norms)
  {
    const std::size_t columns = this->S.Columns;
    this->Basis.push_back(v);
    Values& to = this->Basis.back();
    this->S.OverBlocks(0, [&](std::size_t begin, std::size_t end, double*) {
      for (std::size_t k = begin * columns; k < end * columns; ++k)
      {
        const double norm = norms[k % columns];
        to[k] = norm > 0.0 ? v[k] / norm : 0.0;
      }
    });
  }

  /// w -= V V^T w, twice where much of it goes: the inner products are added to column k of H.
  /// Returns the norms of what is left.
  Values Orthogonalise(Values& w, std::size_t k)
  {
    const std::size_t columns = this->S.Columns;
    const std::vector<double>& areas = this->S.F.Areas();
    Values norms = this->S.Norm(w);
    for (int pass = 0; pass < 2; ++pass)
    {
      const Values h =
        this->S.OverBlocks((k + 1) * columns, [&](std::size_t begin, std::size_t end, double* sum) {
          for (std::size_t j = 0; j <= k; ++j)
          {
            const double* v = this->Basis[j].data();
            for (std::size_t i = begin; i < end; ++i)
            {
              for (std::size_t b = 0; b < columns; ++b)
              {
                sum[j * columns + b] += areas[i] * v[i * columns + b] * w[i * columns + b];
              }
            }
          }
        });
      const Values squares =
        this->S.OverBlocks(columns, [&](std::size_t begin, std::size_t end, double* sum) {
          for (std::size_t j = 0; j <= k; ++j)
          {
            const double* v = this->Basis[j].data();
            for (std::size_t i = begin; i < end; ++i)
            {
              for (std::size_t b = 0; b < columns; ++b)
              {
                w[i * columns + b] -= h[j * columns + b] * v[i * columns + b];
              }
            }
          }
          for (std::size_t i = begin; i < end; ++i)
          {
            for (std::size_t b = 0; b < columns; ++b)
            {
              sum[b] += areas[i] * w[i * columns + b] * w[i * columns + b];
            }
          }
        });
      bool again = false;
      for (std::size_t b = 0; b < columns; ++b)
      {
        for (std::size_t j = 0; j <= k; ++j)
        {
          this->At(b, j, k) += h[j * columns + b];
        }
        const double left = std::sqrt(squares[b]);
        again = again || left < 0.3 * norms[b];
        norms[b] = left;
      }
      if (!again)
      {
        break;
      }
    }
    return norms;
  }

  /// Rotates column k of H; true when the residual of each column is below its goal. `norms` are
  /// those of the new direction, zero where rounding made it of nothing.
  bool Rotate(std::size_t k, Values& norms, const Values& goal)
  {
    bool done = true;
    for (std::size_t b = 0; b < this->S.Columns; ++b)
    {
      for (std::size_t j = 0; j < k; ++j)
      {
        const double upper =
          this->Cos[b][j] * this->At(b, j, k) + this->Sin[b][j] * this->At(b, j + 1, k);
        this->At(b, j + 1, k) =
          -this->Sin[b][j] * this->At(b, j, k) + this->Cos[b][j] * this->At(b, j + 1, k);
        this->At(b, j, k) = upper;
      }
      const double length = std::hypot(this->At(b, k, k), norms[b]);
      this->Cos[b][k] = length > 0.0 ? this->At(b, k, k) / length : 1.0;
      this->Sin[b][k] = length > 0.0 ? norms[b] / length : 0.0;
      this->At(b, k, k) = length;
      this->G[b][k + 1] = -this->Sin[b][k] * this->G[b][k];
      this->G[b][k] *= this->Cos[b][k];
      norms[b] = norms[b] > 1e-14 * length ? norms[b] : 0.0;
      done = done && std::abs(this->G[b][k + 1]) <= goal[b];
    }
    return done;
  }

  /// The coefficients of the step in the basis, and of the residual that it leaves.
  void Coefficients(std::size_t column, std::size_t used, Values& y, Values& left)
  {
    y.assign(used, 0.0);
    for (std::size_t row = used; row-- > 0;)
    {
      double sum = this->G[column][row];
      for (std::size_t k = row + 1; k < used; ++k)
      {
        sum -= this->At(column, row, k) * y[k];
      }
      const double pivot = this->At(column, row, row);
      y[row] = std::abs(pivot) > 1e-300 ? sum / pivot : 0.0;
    }
    left.assign(used + 1, 0.0);
    left[used] = this->G[column][used];
    for (std::size_t j = used; j-- > 0;)
    {
      const double lower = left[j + 1];
      left[j] = -this->Sin[column][j] * lower;
      left[j + 1] = this->Cos[column][j] * lower;
    }
  }

  const ReflectionSystem& S;
  std::size_t Width;
  std::vector<Values> Basis, H, Cos, Sin, G;
};

void ReflectionSystem::Cycle(const Values& goal, int steps, Values& r, Values& x)
{
  const std::size_t columns = this->Columns;
  this->AddConstants(this->ProjectConstants(r), x);
  std::vector<Values> outer(this->Outer.size(), Values(columns, 0.0));
  this->ProjectOuter(r, outer);
  const auto addOuter = [&](Values& to, double sign) {
    for (std::size_t o = 0; o < this->Outer.size(); ++o)
    {
      for (std::size_t k = 0; k < to.size(); ++k)
      {
        to[k] += sign * outer[o][k % columns] * this->Outer[o].first[k];
      }
    }
  };
  addOuter(x, 1.0);

  const double bytes = 8.0 * static_cast<double>(std::max<std::size_t>(1, r.size()));
  const int longest = std::clamp(static_cast<int>(CycleBytes / bytes), 10, LongestCycle);
  Arnoldi arnoldi(*this, static_cast<std::size_t>(std::min(longest, std::max(1, steps))));
  Values norms = this->Norm(r);
  bool done = true;
  for (std::size_t b = 0; b < columns; ++b)
  {
    arnoldi.G[b][0] = norms[b];
    done = done && norms[b] <= goal[b];
  }
  if (done)
  {
    return;
  }
  arnoldi.Push(r, norms);

  Values w(r.size()), scattered;
  std::vector<Values> constants;                            // of each step
  std::vector<std::vector<Values>> outerShares;             // of each step
  std::size_t used = 0;
  while (used < arnoldi.Width && !done)
  {
    const Values& v = arnoldi.Basis[used];
    this->Scatter(v, scattered);
    this->Exchange(scattered, w, columns);
    ++this->Steps;
    this->OverBlocks(0, [&](std::size_t begin, std::size_t end, double*) {
      for (std::size_t k = begin * columns; k < end * columns; ++k)
      {
        w[k] = v[k] - w[k];
      }
    });
    constants.push_back(this->ProjectConstants(w));
    outerShares.emplace_back(this->Outer.size(), Values(columns, 0.0));
    this->ProjectOuter(w, outerShares.back());
    norms = arnoldi.Orthogonalise(w, used);
    done = arnoldi.Rotate(used, norms, goal);
    ++used;
    arnoldi.Push(w, norms);
  }

  // The step, its image, and what remains.
  std::vector<Values> y(columns), left(columns);
  Values shares(this->LossSum.size(), 0.0);
  for (Values& o : outer)
  {
    o.assign(columns, 0.0);
  }
  for (std::size_t b = 0; b < columns; ++b)
  {
    arnoldi.Coefficients(b, used, y[b], left[b]);
    for (std::size_t k = 0; k < used; ++k)
    {
      for (std::size_t c = b; c < shares.size(); c += columns)
      {
        shares[c] -= y[b][k] * constants[k][c];
      }
      for (std::size_t o = 0; o < outer.size(); ++o)
      {
        outer[o][b] += y[b][k] * outerShares[k][o][b];
      }
    }
  }
  Values step(r.size(), 0.0), image = r;
  this->OverBlocks(0, [&](std::size_t begin, std::size_t end, double*) {
    std::fill(&r[begin * columns], &r[0] + end * columns, 0.0);
    for (std::size_t j = 0; j <= used; ++j)
    {
      const Values& v = arnoldi.Basis[j];
      for (std::size_t k = begin * columns; k < end * columns; ++k)
      {
        r[k] += left[k % columns][j] * v[k];
        step[k] += j < used ? y[k % columns][j] * v[k] : 0.0;
      }
    }
    for (std::size_t k = begin * columns; k < end * columns; ++k)
    {
      image[k] -= r[k];
    }
  });
  this->AddConstants(shares, step);
  addOuter(step, -1.0);
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    x[k] += step[k];
  }
  if (!done)
  {
    this->KeepOuter(std::move(step), std::move(image));
  }
}

} // namespace radiometry
