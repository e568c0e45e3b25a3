// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace radiometry
{

/// The mean over a triangle of a function v(x) from few samples, where a companion w(x) >= v(x) of
/// known mean is sampled with it.
///   Model     least squares of v by 1, b1, b2 (barycentric) and w, whose means over the triangle are
///             exact; what the fit leaves is the noise. Exact where v is linear, or a multiple of w
///   Samples   Sets independent scrambled sequences of Each points
///   Variance  of the residuals' mean, from all of them and from the sets', and of the fit; where no
///             sample was hidden, or none was seen, what that many samples may have missed
class SampleMean
{
public:
  static constexpr int Sets = 4;
  static constexpr int Each = 4;

  explicit SampleMean(double companionMean);
  void Add(double b1, double b2, double companion, double value);
  double Mean(double& variance) const;

private:
  static constexpr int Count = Sets * Each;
  static constexpr int Columns = 4;
  double Samples[Columns][Count];
  double Values[Count];
  double CompanionMean;
  int N = 0;
};

} // namespace radiometry
