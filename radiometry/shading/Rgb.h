// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace radiometry
{

/// Three linear bands of a displayed quantity; not clamped to anything.
struct Rgb
{
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;

  constexpr Rgb& operator+=(const Rgb& o)
  {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
};

constexpr Rgb operator+(const Rgb& a, const Rgb& b)
{
  return { a.r + b.r, a.g + b.g, a.b + b.b };
}
/// Band by band: a filter or a reflectance applied to light.
constexpr Rgb operator*(const Rgb& a, const Rgb& b)
{
  return { a.r * b.r, a.g * b.g, a.b * b.b };
}
constexpr Rgb operator*(double s, const Rgb& a)
{
  return { s * a.r, s * a.g, s * a.b };
}
constexpr bool operator==(const Rgb& a, const Rgb& b)
{
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

} // namespace radiometry
