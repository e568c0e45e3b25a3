// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SampleMean.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

SampleMean::SampleMean(double companionMean)
  : CompanionMean(companionMean)
{
}

void SampleMean::Add(double b1, double b2, double companion, double value)
{
  this->Samples[0][this->N] = 1.0;
  this->Samples[1][this->N] = b1 - 1.0 / 3.0;
  this->Samples[2][this->N] = b2 - 1.0 / 3.0;
  this->Samples[3][this->N] = companion / this->CompanionMean - 1.0;
  this->Values[this->N++] = value;
}

double SampleMean::Mean(double& variance) const
{
  const double n = this->N;
  int seeing = 0, shaded = 0; // samples that see something; from which something is hidden
  for (int i = 0; i < this->N; ++i)
  {
    const double companion = (this->Samples[3][i] + 1.0) * this->CompanionMean;
    seeing += this->Values[i] > 0.0 ? 1 : 0;
    shaded += this->Values[i] < (1.0 - 1e-12) * companion ? 1 : 0;
  }
  // A shadow (or light) that no point met is smaller than a point's share, and faint at its rim.
  const int met = std::min(seeing, shaded);
  const double missed = this->CompanionMean / (4.0 * n * (1.0 + met));
  if (met == 0)
  {
    variance = missed * missed;
    return shaded == 0 ? this->CompanionMean : 0.0;
  }

  // Columns made square to one another in turn; the exact mean of each goes along.
  double column[Columns][Count];
  double mean[Columns] = { 1.0, 0.0, 0.0, 0.0 };
  double norm[Columns];
  double residual[Count];
  std::copy(this->Values, this->Values + this->N, residual);
  double estimate = 0.0;
  double leverage = 0.0;
  int used = 0;
  for (int c = 0; c < Columns; ++c)
  {
    std::copy(this->Samples[c], this->Samples[c] + this->N, column[c]);
    const auto dot = [&](const double* a, const double* b) {
      double sum = 0.0;
      for (int i = 0; i < this->N; ++i)
      {
        sum += a[i] * b[i];
      }
      return sum;
    };
    const double before = dot(column[c], column[c]);
    for (int k = 0; k < c; ++k)
    {
      if (norm[k] > 0.0)
      {
        const double r = dot(column[c], column[k]) / norm[k];
        for (int i = 0; i < this->N; ++i)
        {
          column[c][i] -= r * column[k][i];
        }
        mean[c] -= r * mean[k];
      }
    }
    norm[c] = dot(column[c], column[c]);
    if (!(norm[c] > 1e-8 * before))
    {
      norm[c] = 0.0; // nothing new
      continue;
    }
    const double beta = dot(residual, column[c]) / norm[c];
    for (int i = 0; i < this->N; ++i)
    {
      residual[i] -= beta * column[c][i];
    }
    estimate += beta * mean[c];
    leverage += c > 0 ? mean[c] * mean[c] / norm[c] : 0.0;
    ++used;
  }

  double squares = 0.0, between = 0.0;
  for (int set = 0; set < Sets; ++set)
  {
    double sum = 0.0;
    for (int i = set * Each; i < (set + 1) * Each; ++i)
    {
      squares += residual[i] * residual[i];
      sum += residual[i];
    }
    between += (sum / Each) * (sum / Each);
  }
  const double free = n - used;
  const double sigma2 = squares / free;
  const double ofSets = between / (Sets * (Sets - 1.0)) * n / free;
  variance = 0.5 * (ofSets + sigma2 / n) + sigma2 * leverage + missed * missed;
  return estimate;
}

} // namespace radiometry
