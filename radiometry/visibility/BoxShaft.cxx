// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/BoxShaft.h"

#include <cmath>

namespace radiometry
{

BoxShaft::BoxShaft(const Box3& a, const Box3& b, double margin)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Low[axis] = std::fmin(a.Min[axis], b.Min[axis]) - margin;
    this->High[axis] = std::fmax(a.Max[axis], b.Max[axis]) + margin;
  }
  for (int i = 0; i < 2; ++i)
  {
    for (int j = i + 1; j < 3; ++j)
    {
      this->Join(a, b, i, j, margin);
    }
  }
}

/// Seen along the third axis the boxes are two rectangles: the sides of their hull that run from one
/// to the other, where one is the outermost along one axis and the other along the other.
void BoxShaft::Join(const Box3& a, const Box3& b, int i, int j, double margin)
{
  for (const double si : { -1.0, 1.0 })
  {
    for (const double sj : { -1.0, 1.0 })
    {
      const double ai = si > 0.0 ? a.Max[i] : -a.Min[i];
      const double bi = si > 0.0 ? b.Max[i] : -b.Min[i];
      const double aj = sj > 0.0 ? a.Max[j] : -a.Min[j];
      const double bj = sj > 0.0 ? b.Max[j] : -b.Min[j];
      const double di = ai - bi, dj = aj - bj;
      if (!(di * dj < 0.0))
      {
        continue; // one of them is outermost along both
      }
      double ni = std::fabs(dj), nj = std::fabs(di);
      const double length = std::sqrt(ni * ni + nj * nj);
      if (!(length > 0.0))
      {
        continue;
      }
      ni /= length;
      nj /= length;
      const double offset = std::fmax(ni * ai + nj * aj, ni * bi + nj * bj) + margin;
      Plane& plane = this->Planes[this->Count++];
      plane = { {}, offset };
      plane.N[i] = si * ni;
      plane.N[j] = sj * nj;
    }
  }
}

bool BoxShaft::Reaches(const Box3& box) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (box.Min[axis] > this->High[axis] || box.Max[axis] < this->Low[axis])
    {
      return false;
    }
  }
  for (int k = 0; k < this->Count; ++k)
  {
    const Plane& p = this->Planes[k];
    const double least = p.N.x * (p.N.x > 0.0 ? box.Min.x : box.Max.x) +
      p.N.y * (p.N.y > 0.0 ? box.Min.y : box.Max.y) +
      p.N.z * (p.N.z > 0.0 ? box.Min.z : box.Max.z);
    if (least > p.Offset)
    {
      return false;
    }
  }
  return true;
}

} // namespace radiometry
