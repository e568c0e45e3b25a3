// SPDX-License-Identifier: BSD-3-Clause
#include "color/ColorError.h"
#include "color/Primaries.h"

#include <gtest/gtest.h>

using namespace radiometry::color;

namespace
{

void ExpectNear(const Matrix3& a, const Matrix3& b, double tolerance)
{
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(a[i], b[i], tolerance) << "entry " << i;
  }
}

} // namespace

TEST(Primaries, Rec709ToXyzIsTheStandards)
{
  // IEC 61966-2-1 prints four decimals.
  ExpectNear(RgbToXyz(Primaries::Rec709()),
    { 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505 }, 5.1e-5);
}

TEST(Primaries, AcesToXyzIsTheStandards)
{
  // SMPTE ST 2065-1, ten decimals.
  ExpectNear(RgbToXyz(Primaries::ACES_AP0()),
    { 0.9525523959, 0.0, 0.0000936786, 0.3439664498, 0.7281660966, -0.0721325464, 0.0, 0.0,
      1.0088251844 },
    1e-10);
}

TEST(Primaries, XyzItselfIsTheIdentity)
{
  // Red, green and blue at the corners of the diagram and the white of equal energy: R, G, B are
  // X, Y, Z. Two of these primaries have y = 0.
  const Primaries xyz{ { 1, 0 }, { 0, 1 }, { 0, 0 }, { 1.0 / 3, 1.0 / 3 } };
  ExpectNear(RgbToXyz(xyz), { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, 1e-14);
}

TEST(Primaries, WhiteGoesToWhiteAndBack)
{
  const Primaries sets[] = { Primaries::Rec709(), Primaries::ACES_AP0(), Primaries::ACES_AP1(),
    Primaries::DisplayP3() };
  for (const Primaries& from : sets)
  {
    for (const Primaries& to : sets)
    {
      const Matrix3 m = RgbToRgb(from, to);
      for (int row = 0; row < 3; ++row)
      {
        EXPECT_NEAR(m[3 * row] + m[3 * row + 1] + m[3 * row + 2], 1.0, 1e-13);
      }
      ExpectNear(Multiply(RgbToRgb(to, from), m), { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, 1e-13);
    }
  }
}

TEST(Primaries, DegenerateOnesAreRefused)
{
  Primaries line = Primaries::Rec709();
  line.Blue = { 0.5 * (line.Red[0] + line.Green[0]), 0.5 * (line.Red[1] + line.Green[1]) };
  EXPECT_THROW(RgbToXyz(line), ColorError);
  Primaries dark = Primaries::Rec709();
  dark.White = { 0.3, 0.0 };
  EXPECT_THROW(RgbToXyz(dark), ColorError);
  dark.White = { 0.3, std::numeric_limits<double>::quiet_NaN() };
  EXPECT_THROW(RgbToXyz(dark), ColorError);
}
