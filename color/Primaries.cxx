// SPDX-License-Identifier: BSD-3-Clause
#include "color/Primaries.h"

#include "color/ColorError.h"

#include <cmath>

namespace radiometry::color
{
namespace
{

using Vector3 = std::array<double, 3>;

Vector3 Xyz(const std::array<double, 2>& xy)
{
  return { xy[0] / xy[1], 1.0, (1.0 - xy[0] - xy[1]) / xy[1] };
}

Vector3 Apply(const Matrix3& m, const Vector3& v)
{
  Vector3 result;
  for (int i = 0; i < 3; ++i)
  {
    result[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
  }
  return result;
}

Matrix3 Scale(const Vector3& s) { return { s[0], 0, 0, 0, s[1], 0, 0, 0, s[2] }; }

/// Lam (1985), as used by the ICC and by the ACES transforms.
const Matrix3 bradford = { 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685,
  1.0296 };

} // namespace

Primaries Primaries::Rec709()
{
  return { { 0.64, 0.33 }, { 0.30, 0.60 }, { 0.15, 0.06 }, { 0.3127, 0.3290 } };
}

Primaries Primaries::ACES_AP0()
{
  return { { 0.7347, 0.2653 }, { 0.0, 1.0 }, { 0.0001, -0.0770 }, { 0.32168, 0.33767 } };
}

Primaries Primaries::ACES_AP1()
{
  return { { 0.713, 0.293 }, { 0.165, 0.830 }, { 0.128, 0.044 }, { 0.32168, 0.33767 } };
}

Primaries Primaries::DisplayP3()
{
  return { { 0.680, 0.320 }, { 0.265, 0.690 }, { 0.150, 0.060 }, { 0.3127, 0.3290 } };
}

Matrix3 Multiply(const Matrix3& a, const Matrix3& b)
{
  Matrix3 m{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int k = 0; k < 3; ++k)
      {
        m[3 * i + j] += a[3 * i + k] * b[3 * k + j];
      }
    }
  }
  return m;
}

Matrix3 Inverse(const Matrix3& m)
{
  const Matrix3 cofactors = { m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8],
    m[1] * m[5] - m[2] * m[4], m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6],
    m[2] * m[3] - m[0] * m[5], m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7],
    m[0] * m[4] - m[1] * m[3] };
  const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
  double size = 1.0;
  for (int i = 0; i < 3; ++i)
  {
    size *= std::hypot(m[3 * i], m[3 * i + 1], m[3 * i + 2]);
  }
  if (!(std::abs(determinant) > 1e-12 * size) || !std::isfinite(determinant))
  {
    throw ColorError("a colour matrix cannot be inverted (do the primaries lie on a line?)");
  }
  Matrix3 inverse;
  for (int i = 0; i < 9; ++i)
  {
    inverse[i] = cofactors[i] / determinant;
  }
  return inverse;
}

Matrix3 RgbToXyz(const Primaries& p)
{
  // The primaries as (x, y, z), not divided by y: AP0's blue has a negative y, and 0 is legal.
  Matrix3 columns{};
  int column = 0;
  for (const auto& xy : { p.Red, p.Green, p.Blue })
  {
    columns[column] = xy[0];
    columns[3 + column] = xy[1];
    columns[6 + column] = 1.0 - xy[0] - xy[1];
    ++column;
  }
  if (!(p.White[1] > 0.0))
  {
    throw ColorError("the white point has y = " + std::to_string(p.White[1]) + ": expected y > 0");
  }
  return Multiply(columns, Scale(Apply(Inverse(columns), Xyz(p.White))));
}

Matrix3 RgbToRgb(const Primaries& from, const Primaries& to)
{
  const Matrix3 toXyz = RgbToXyz(from);
  const Matrix3 fromXyz = Inverse(RgbToXyz(to));
  if (from.White == to.White)
  {
    return Multiply(fromXyz, toXyz);
  }
  const Vector3 source = Apply(bradford, Xyz(from.White));
  const Vector3 target = Apply(bradford, Xyz(to.White));
  const Matrix3 gain =
    Scale({ target[0] / source[0], target[1] / source[1], target[2] / source[2] });
  const Matrix3 adapt = Multiply(Inverse(bradford), Multiply(gain, bradford));
  return Multiply(fromXyz, Multiply(adapt, toXyz));
}

} // namespace radiometry::color
