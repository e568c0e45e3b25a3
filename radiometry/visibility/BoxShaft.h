// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Vec3.h"

#include <cstdint>

namespace radiometry
{

/// A convex region that holds all segments between two boxes: their joint box, cut by planes along
/// one axis each. What lies within `margin` of it counts as inside.
///   Source  Haines and Wallace (1991), Shaft culling for efficient ray-traced radiosity
class BoxShaft
{
public:
  BoxShaft(const Box3& a, const Box3& b, double margin);

  /// False only where the box lies outside.
  bool Reaches(const Box3& box) const;
  /// A bit for each plane that the point lies outside of: what has a bit in common at all of its
  /// corners lies outside.
  std::uint32_t Outside(const Vec3& p) const
  {
    std::uint32_t code = 0;
    for (int k = 0; k < 6; ++k)
    {
      const double x = k % 3 == 0 ? p.x : (k % 3 == 1 ? p.y : p.z);
      code |= static_cast<std::uint32_t>(k < 3 ? x < this->Low[k] : x > this->High[k - 3]) << k;
    }
    for (int k = 0; k < this->Count; ++k)
    {
      const Plane& q = this->Planes[k];
      code |= static_cast<std::uint32_t>(q.N.x * p.x + q.N.y * p.y + q.N.z * p.z > q.Offset)
        << (6 + k);
    }
    return code;
  }
  /// False only where the triangle lies outside; `codes` gets those of its corners.
  bool Touches(const Triangle3& triangle, std::uint32_t* codes) const
  {
    for (int c = 0; c < 3; ++c)
    {
      codes[c] = this->Outside(triangle[c]);
    }
    return (codes[0] & codes[1] & codes[2]) == 0;
  }

private:
  void Join(const Box3& a, const Box3& b, int i, int j, double margin);

  struct Plane
  {
    Vec3 N; // along two axes
    double Offset; // outside: N . x > Offset
  };
  double Low[3], High[3];
  Plane Planes[12];
  int Count = 0;
};

} // namespace radiometry
