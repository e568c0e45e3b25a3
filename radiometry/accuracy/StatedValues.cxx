// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/accuracy/StatedValues.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace radiometry
{

namespace
{

/// Calls visit(index of the value, share) for each value of an item that counts; shares are those of
/// the weights and add up to 1, so that means of any finite values are finite.
template <class Visit>
void ForEach(const StatedValues& values, Visit visit)
{
  const auto bands = static_cast<std::size_t>(values.Bands);
  double greatest = 0.0;
  for (const double weight : values.Weights)
  {
    greatest = std::max(greatest, weight);
  }
  double total = 0.0;
  for (const double weight : values.Weights)
  {
    total += weight > 0.0 ? weight / greatest : 0.0;
  }
  for (std::size_t i = 0; i < values.Items(); ++i)
  {
    if (values.Weights[i] > 0.0)
    {
      for (std::size_t b = 0; b < bands; ++b)
      {
        visit(
          i * bands + b, values.Weights[i] / greatest / (total * static_cast<double>(bands)));
      }
    }
  }
}

double ErrorOf(const StatedValues& values, std::size_t i)
{
  return values.Errors.empty() ? 0.0 : values.Errors[i];
}

/// Of an error to the mean value; below 0 where it cannot be said.
double Ratio(double error, double mean)
{
  const double ratio = mean > 0.0 ? error / mean : 0.0;
  return (error > 0.0 && !(mean > 0.0)) || !std::isfinite(ratio) ? -1.0 : ratio;
}

/// The middle one, of an even number the mean of the two; 0 where there is none.
double Median(std::vector<double>& numbers)
{
  if (numbers.empty())
  {
    return 0.0;
  }
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return numbers.size() % 2 == 1 ? *middle
                                 : 0.5 * *middle + 0.5 * *std::max_element(numbers.begin(), middle);
}

void CheckAlike(const StatedValues& values, const StatedValues& reference)
{
  if (values.Bands != reference.Bands)
  {
    throw InputError("Reference", -1, std::to_string(reference.Bands) + " components",
      std::to_string(values.Bands));
  }
  if (values.Values.size() != reference.Values.size())
  {
    throw InputError("Reference", -1, std::to_string(reference.Values.size()) + " values",
      std::to_string(values.Values.size()));
  }
}

template <class Other>
RelativeDifference DifferencesFrom(const StatedValues& values, Other other)
{
  RelativeDifference found;
  std::vector<double> all;
  ForEach(values, [&](std::size_t i, double) {
    const double a = values.Values[i];
    const double b = other(i);
    const double scale = std::max(std::abs(a), std::abs(b));
    if (scale > 0.0)
    {
      all.push_back(std::abs(a - b) / scale);
      found.Greatest = std::max(found.Greatest, all.back());
    }
  });
  found.Values = all.size();
  found.Median = Median(all);
  return found;
}

} // namespace

StatedError SummarizeErrors(const StatedValues& values)
{
  StatedError found;
  ForEach(values, [&](std::size_t i, double share) {
    const double error = ErrorOf(values, i);
    found.MeanValue += share * std::abs(values.Values[i]);
    found.Absolute += share * error;
    found.Greatest = std::max(found.Greatest, error);
    ++found.Values;
  });
  found.Relative = Ratio(found.Absolute, found.MeanValue);
  return found;
}

Deviation Compare(const StatedValues& values, const StatedValues& reference)
{
  CheckAlike(values, reference);
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  Deviation found;
  double root = 0.0; // of the mean square so far
  double mean = 0.0;
  std::size_t covered = 0;
  std::vector<double> ratios;
  ForEach(values, [&](std::size_t i, double share) {
    const double exact = reference.Values[i];
    const double error = ErrorOf(values, i);
    const double off = std::abs(values.Values[i] - exact);
    const double doubt = std::max(ErrorOf(reference, i), rounding * std::abs(exact));
    root = std::hypot(root, std::sqrt(share) * off);
    mean += share * std::abs(exact);
    found.Absolute += share * off;
    found.Greatest = std::max(found.Greatest, off);
    covered += off <= std::hypot(error, doubt) ? 1 : 0;
    if (off > rounding * std::abs(exact))
    {
      ratios.push_back(std::min(error / off, std::numeric_limits<double>::max()));
    }
    ++found.Values;
  });
  if (found.Values == 0)
  {
    return found;
  }
  found.Coverage = static_cast<double>(covered) / static_cast<double>(found.Values);
  found.Relative = Ratio(root, mean);
  found.Sharpness = ratios.empty() ? -1.0 : Median(ratios);
  return found;
}

RelativeDifference Differences(const StatedValues& a, const StatedValues& b)
{
  CheckAlike(a, b);
  return DifferencesFrom(a, [&](std::size_t i) { return b.Values[i]; });
}

RelativeDifference FloatStorage(const StatedValues& values)
{
  return DifferencesFrom(
    values, [&](std::size_t i) { return static_cast<double>(static_cast<float>(values.Values[i])); });
}

} // namespace radiometry
