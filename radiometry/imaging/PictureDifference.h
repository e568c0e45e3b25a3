// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace radiometry
{
namespace imaging
{

/// How far one channel of a picture B is from that of its reference A.
struct ChannelDifference
{
  std::size_t Pixels = 0;     ///< counted: finite in both
  std::size_t NonFiniteA = 0; ///< a NaN or an infinity
  std::size_t NonFiniteB = 0;
  std::size_t Unlike = 0; ///< not finite in one alone, or not the same kind of it in both
  double MeanA = 0.0;
  double MeanB = 0.0;
  double MeanDifference = 0.0;         ///< mean of B - A
  double MeanAbsolute = 0.0;           ///< mean of |B - A|
  double MeanRelative = 0.0;           ///< mean of |B - A| / max(|A|, floor)
  double RootMeanSquare = 0.0;         ///< RMSE
  double RelativeRootMeanSquare = 0.0; ///< RMSE over the root mean square of A; 0 where both are 0
  double Maximum = 0.0;                ///< greatest |B - A|
  long long MaximumAt = -1;            ///< the pixel of it; -1 where no two pixels differ
  double PeakSignalToNoise = 0.0;      ///< [dB] 20 log10(peak/RMSE); infinite where they are equal
};

/// Compares channel `channel` of two pictures of `count` pixels. `peak` 0: the greatest |A|.
///   Model   PSNR = 20 log10(peak/RMSE). Pixels not finite in either are counted and left out
///   Cost    O(count)
ChannelDifference CompareChannel(const double* a, const double* b, std::size_t count,
  int components, int channel, double floor, double peak);

/// What a picture of the difference shows.
enum class DifferenceKind
{
  Absolute = 0, ///< |B - A|
  Signed = 1,   ///< B - A
  Relative = 2, ///< |B - A| / max(|A|, floor)
};

/// The difference of one pair of values; a NaN where either is not finite.
double Difference(double a, double b, DifferenceKind kind, double floor);

/// The floor of relative differences where none is stated: 1e-3 of the mean |A| of finite values; 1e-30
/// where that is 0.
double RelativeFloor(const double* a, std::size_t values);

} // namespace imaging
} // namespace radiometry
