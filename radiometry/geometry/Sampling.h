// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>

namespace radiometry
{

/// A well-mixing 64-bit hash (the finaliser of SplitMix64, Steele, Lea and Flood 2014).
constexpr std::uint64_t Hash64(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}
constexpr std::uint64_t Hash64(std::uint64_t a, std::uint64_t b) { return Hash64(a ^ Hash64(b)); }

/// Points of the four-dimensional Sobol sequence, Owen-scrambled by a hash of a key.
///   Model   digits of the sequence from the direction numbers of Joe and Kuo (2008); the order
///           of the points and the digits of each dimension are scrambled as in Burley (2020),
///           "Practical hash-based Owen scrambling"
///   Cost    some 30 integer operations a coordinate; no state: any point in any order
/// Two sequences with different keys are independent; equal keys give equal bytes.
class SobolSequence
{
public:
  explicit SobolSequence(std::uint64_t key)
  {
    for (int d = 0; d < 5; ++d)
    {
      this->Seed[d] = static_cast<std::uint32_t>(Hash64(key, static_cast<std::uint64_t>(d)) >> 16);
    }
  }

  /// The index-th point, each coordinate in (0, 1).
  std::array<double, 4> operator()(std::uint32_t index) const
  {
    const std::uint32_t i = NestedScramble(index, this->Seed[4]);
    std::array<double, 4> p;
    for (int d = 0; d < 4; ++d)
    {
      p[d] = (NestedScramble(Digits(i, d), this->Seed[d]) + 0.5) * 0x1p-32;
    }
    return p;
  }

private:
  static std::uint32_t Reverse(std::uint32_t x)
  {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  }
  /// Flips each digit by a hash of the digits above it.
  static std::uint32_t NestedScramble(std::uint32_t x, std::uint32_t seed)
  {
    x = Reverse(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return Reverse(x);
  }
  static std::uint32_t Digits(std::uint32_t index, int dimension);

  std::uint32_t Seed[5];
};

/// Uniform point of a triangle from two uniform numbers; neighbours in the square stay neighbours
/// (Heitz 2019, "A low-distortion map between triangle and square").
inline Vec3 TrianglePoint(const Triangle3& t, double u, double v)
{
  double b0, b1;
  if (v > u)
  {
    b0 = 0.5 * u;
    b1 = v - b0;
  }
  else
  {
    b1 = 0.5 * v;
    b0 = u - b1;
  }
  return (1.0 - b0 - b1) * t[0] + b0 * t[1] + b1 * t[2];
}

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al. 2017).
inline void Frame(const Vec3& n, Vec3& s, Vec3& t)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  s = { 1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x };
  t = { b, sign + n.y * n.y * a, -n.y };
}

/// Direction about the unit normal n with density cos(theta)/pi, from two uniform numbers.
Vec3 CosineDirection(const Vec3& n, double u, double v);
/// The same for many about one normal, whose Frame is s, t.
Vec3 CosineDirection(const Vec3& n, const Vec3& s, const Vec3& t, double u, double v);

} // namespace radiometry
