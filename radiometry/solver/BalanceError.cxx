// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/BalanceError.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

void AddBalanceError(const FormFactorOperator& F, const std::vector<std::int32_t>& component,
  const std::vector<double>& lossShare, std::size_t bands, const std::vector<double>& formFactor,
  std::vector<double>& visibility)
{
  constexpr double closed = 1e-9;
  constexpr double together = 16.0;
  const std::size_t components = lossShare.size() / bands;
  std::vector<double> square(components * bands, 0.0), area(components, 0.0);
  std::vector<std::uint8_t> open(components * bands, 0);
  for (std::size_t i = 0; i < component.size(); ++i)
  {
    const auto c = static_cast<std::size_t>(component[i]);
    const double a = F.Areas()[i];
    area[c] += a;
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double v = visibility[i * bands + b], f = formFactor[i * bands + b];
      square[c * bands + b] += a * a * (v * v + together * f * f);
      if (std::abs(1.0 - F.RowSum(i, static_cast<int>(b))) > closed)
      {
        open[c * bands + b] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < component.size(); ++i)
  {
    const auto c = static_cast<std::size_t>(component[i]);
    for (std::size_t b = 0; b < bands; ++b)
    {
      const std::size_t k = c * bands + b;
      if (open[k] && lossShare[k] > 0.0)
      {
        double& v = visibility[i * bands + b];
        v = std::hypot(v, std::sqrt(square[k]) / (area[c] * lossShare[k]));
      }
    }
  }
}

} // namespace radiometry
