// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace test
{

/// Random numbers of a seed, the same with every standard library.
class Dice
{
public:
  explicit Dice(std::uint64_t seed)
    : Engine(seed * 0x9E3779B97F4A7C15ULL + 1)
  {
  }

  double Uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(this->Engine() >> 11) * 0x1p-53;
  }
  int Below(int count) { return static_cast<int>(this->Uniform(0.0, count)); }
  bool Chance(double p) { return this->Uniform(0.0, 1.0) < p; }
  radiometry::Vec3 InBox(double half)
  {
    const double x = this->Uniform(-half, half);
    const double y = this->Uniform(-half, half);
    return { x, y, this->Uniform(-half, half) };
  }
  radiometry::Vec3 Direction()
  {
    const double z = this->Uniform(-1.0, 1.0);
    const double turn = this->Uniform(0.0, 2.0 * std::acos(-1.0));
    const double s = std::sqrt(1.0 - z * z);
    return { s * std::cos(turn), s * std::sin(turn), z };
  }

private:
  std::mt19937_64 Engine;
};

/// The bands of a scene, some of which may be identical in all that the scene is made of.
class Bands
{
public:
  explicit Bands(Dice& dice)
  {
    const int count = dice.Chance(0.5) ? 1 : 2 + dice.Below(3);
    for (int b = 0; b < count; ++b)
    {
      this->Kind.push_back(dice.Chance(0.5) ? 0 : dice.Below(count));
    }
  }

  int Count() const { return static_cast<int>(this->Kind.size()); }

  /// A value of up to `most` in each band; the same in bands of one kind.
  std::vector<double> Spectrum(Dice& dice, double most) const
  {
    std::vector<double> ofKind(this->Kind.size());
    for (double& v : ofKind)
    {
      v = dice.Uniform(0.3, 1.0) * most;
    }
    std::vector<double> values;
    for (const int kind : this->Kind)
    {
      values.push_back(ofKind[static_cast<std::size_t>(kind)]);
    }
    return values;
  }

  std::string Words() const
  {
    std::string text = "bands ";
    for (const int kind : this->Kind)
    {
      text += static_cast<char>('a' + kind);
    }
    return text;
  }

private:
  std::vector<int> Kind;
};

} // namespace test
