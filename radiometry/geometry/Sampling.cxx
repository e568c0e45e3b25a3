// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Sampling.h"

#include <algorithm>

namespace radiometry
{
namespace
{

/// Direction numbers of dimensions 2 to 4 (degree s, coefficients a and first m of the primitive
/// polynomials tabulated by Joe and Kuo, 2008); dimension 1 is the van der Corput sequence.
struct DirectionNumbers
{
  std::uint32_t V[4][32];

  DirectionNumbers()
  {
    struct Polynomial
    {
      int s;
      std::uint32_t a;
      std::uint32_t m[3];
    };
    const Polynomial polynomials[3] = { { 1, 0, { 1, 0, 0 } }, { 2, 1, { 1, 3, 0 } },
      { 3, 1, { 1, 3, 1 } } };
    for (int k = 0; k < 32; ++k)
    {
      this->V[0][k] = 0x80000000u >> k;
    }
    for (int d = 1; d < 4; ++d)
    {
      const Polynomial& p = polynomials[d - 1];
      for (int k = 0; k < 32; ++k)
      {
        if (k < p.s)
        {
          this->V[d][k] = p.m[k] << (31 - k);
          continue;
        }
        std::uint32_t v = this->V[d][k - p.s] ^ (this->V[d][k - p.s] >> p.s);
        for (int j = 1; j < p.s; ++j)
        {
          if ((p.a >> (p.s - 1 - j)) & 1u)
          {
            v ^= this->V[d][k - j];
          }
        }
        this->V[d][k] = v;
      }
    }
  }
};

/// The same, summed for each byte of the index: four look-ups a coordinate.
struct ByteTables
{
  std::uint32_t T[4][4][256]; // dimension, byte, value

  ByteTables()
  {
    const DirectionNumbers numbers;
    for (int d = 0; d < 4; ++d)
    {
      for (int byte = 0; byte < 4; ++byte)
      {
        for (int value = 0; value < 256; ++value)
        {
          std::uint32_t x = 0;
          for (int bit = 0; bit < 8; ++bit)
          {
            x ^= (value >> bit) & 1 ? numbers.V[d][8 * byte + bit] : 0u;
          }
          this->T[d][byte][value] = x;
        }
      }
    }
  }
};

const ByteTables Tables;

/// Of angles in [-pi/4, pi/4], by their series to rounding (2e-16): the library's functions spend
/// their time on angles of any size.
void SmallSineCosine(double angle, double& sine, double& cosine)
{
  const double x = angle * angle;
  sine = angle *
    (1.0 +
      x *
        (-1.0 / 6.0 +
          x *
            (1.0 / 120.0 +
              x *
                (-1.0 / 5040.0 +
                  x *
                    (1.0 / 362880.0 +
                      x *
                        (-1.0 / 39916800.0 +
                          x * (1.0 / 6227020800.0 + x * (-1.0 / 1307674368000.0))))))));
  cosine = 1.0 +
    x *
      (-0.5 +
        x *
          (1.0 / 24.0 +
            x *
              (-1.0 / 720.0 +
                x *
                  (1.0 / 40320.0 +
                    x *
                      (-1.0 / 3628800.0 +
                        x *
                          (1.0 / 479001600.0 +
                            x * (-1.0 / 87178291200.0 + x * (1.0 / 20922789888000.0))))))));
}

} // namespace

std::uint32_t SobolSequence::Digits(std::uint32_t index, int dimension)
{
  const auto& t = Tables.T[dimension];
  return t[0][index & 255u] ^ t[1][(index >> 8) & 255u] ^ t[2][(index >> 16) & 255u] ^
    t[3][index >> 24];
}

Vec3 CosineDirection(const Vec3& n, double u, double v)
{
  Vec3 s, t;
  Frame(n, s, t);
  return CosineDirection(n, s, t, u, v);
}

Vec3 CosineDirection(const Vec3& n, const Vec3& s, const Vec3& t, double u, double v)
{
  // Concentric map of the square to the disc (Shirley and Chiu 1997), lifted to the hemisphere.
  const double a = 2.0 * u - 1.0;
  const double b = 2.0 * v - 1.0;
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b;
  const double across = wide ? b : a;
  double sine, cosine; // of the angle from the nearer axis, within an eighth of the circle
  SmallSineCosine(0.78539816339744830962 * (r != 0.0 ? across / r : 0.0), sine, cosine);
  const double x = r * (wide ? cosine : sine);
  const double y = r * (wide ? sine : cosine);
  // 1 - r^2 as a product keeps its digits near the horizon.
  const double z = std::sqrt(std::max(0.0, (1.0 - std::abs(r)) * (1.0 + std::abs(r))));
  return x * s + y * t + z * n;
}

} // namespace radiometry
