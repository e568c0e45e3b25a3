// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/IsoLines.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

namespace
{

/// Where the level lies between the lower and the upper end of an edge.
Vec3 Crossing(Vec3 lower, double low, Vec3 upper, double high, double level)
{
  if (low > high)
  {
    std::swap(lower, upper);
    std::swap(low, high);
  }
  const double t = (0.5 * level - 0.5 * low) / (0.5 * high - 0.5 * low); // no overflow
  return (1.0 - t) * lower + t * upper;
}

/// m * 10^p without the last bits that powers of ten leave.
double Decimal(double m, int p)
{
  return p >= 0 ? m * std::pow(10.0, p) : m / std::pow(10.0, -p);
}

} // namespace

void AddIsoSegment(const Triangle3& triangle, const std::array<double, 3>& values, double level,
  std::vector<IsoSegment>& segments)
{
  std::array<Vec3, 2> ends;
  int found = 0;
  for (int k = 0; k < 3; ++k)
  {
    const int next = (k + 1) % 3;
    if ((values[k] >= level) != (values[next] >= level) && found < 2)
    {
      ends[found++] =
        Crossing(triangle[k], values[k], triangle[next], values[next], level);
    }
  }
  if (found == 2 && !(ends[0] == ends[1]))
  {
    segments.push_back({ ends[0], ends[1] });
  }
}

void AddIsoSegments(const std::array<Vec3, 4>& quad, const std::array<double, 4>& values,
  double level, std::vector<IsoSegment>& segments)
{
  const Vec3 middle = 0.25 * (quad[0] + quad[1] + quad[2] + quad[3]);
  const double mean =
    0.25 * values[0] + 0.25 * values[1] + 0.25 * values[2] + 0.25 * values[3];
  for (int k = 0; k < 4; ++k)
  {
    const int next = (k + 1) % 4;
    AddIsoSegment(
      { quad[k], quad[next], middle }, { values[k], values[next], mean }, level, segments);
  }
}

std::vector<double> NiceLevels(double minimum, double maximum)
{
  std::vector<double> levels;
  if (!(maximum > minimum) || !std::isfinite(minimum) || !std::isfinite(maximum))
  {
    return levels;
  }
  const auto add = [&](double level) {
    if (level > minimum && level < maximum)
    {
      levels.push_back(level);
    }
  };
  if (minimum >= 0.0 && maximum > 15.0 * minimum)
  {
    const int top = static_cast<int>(std::floor(std::log10(maximum)));
    for (int p = top - 2; p <= top; ++p)
    {
      for (const double m : { 1.0, 2.0, 5.0 })
      {
        add(Decimal(m, p));
      }
    }
    return levels;
  }
  const double raw = (maximum - minimum) / 8.0;
  const int power = static_cast<int>(std::floor(std::log10(raw)));
  double m = 10.0;
  for (const double candidate : { 5.0, 2.0, 1.0 })
  {
    m = Decimal(candidate, power) >= 0.75 * raw ? candidate : m;
  }
  const double first = std::ceil(minimum / Decimal(m, power));
  for (double k = first; Decimal(k * m, power) < maximum; k += 1.0)
  {
    if (levels.size() > 64) // steps below the rounding of the values
    {
      break;
    }
    add(Decimal(k * m, power));
  }
  return levels;
}

} // namespace radiometry
