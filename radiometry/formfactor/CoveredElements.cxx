// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/CoveredElements.h"

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/geometry/PolygonFormFactor.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace radiometry
{
namespace
{

// Of the scene's size: nearer than that two elements lie in one plane.
constexpr double InPlane = 1e-12;
// Of an element's area: what rounding makes neighbours overlap by.
constexpr double LeastShare = 1e-9;

bool Overlap(const Box3& a, const Box3& b, double reach)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a.Min[axis] > b.Max[axis] + reach || a.Max[axis] < b.Min[axis] - reach)
    {
      return false;
    }
  }
  return true;
}

/// The area of a triangle within another one in the same plane, of normal n.
double CommonArea(const Triangle3& a, const Triangle3& b, const Vec3& n)
{
  SmallPolygon part(a);
  for (int k = 0; k < 3 && part.N > 0; ++k)
  {
    const Vec3 inward = Cross(n, b[(k + 1) % 3] - b[k]);
    double heights[SmallPolygon::Capacity];
    for (int c = 0; c < part.N; ++c)
    {
      heights[c] = Dot(inward, part.P[c] - b[k]);
    }
    part = ClipToPositive(part, heights);
  }
  Vec3 twice;
  for (int c = 1; c + 1 < part.N; ++c)
  {
    twice += Cross(part.P[c] - part.P[0], part.P[c + 1] - part.P[0]);
  }
  return 0.5 * Length(twice);
}

} // namespace

CoveredElements::CoveredElements(
  const std::vector<Patch>& patches, int threads, const StageProgress& stage)
{
  const std::size_t n = patches.size();
  std::vector<Box3> boxes(n);
  std::vector<Vec3> normals(n);
  Box3 all;
  for (std::size_t i = 0; i < n; ++i)
  {
    for (const Vec3& p : patches[i].Corners)
    {
      boxes[i].Add(p);
    }
    all.Add(boxes[i]);
    normals[i] = Normalized(AreaNormal2(patches[i].Corners));
  }
  const BoxTree tree(boxes);
  const double reach = n > 0 ? InPlane * Length(all.Size()) : 0.0;
  std::vector<std::vector<Cover>> found(n);
  ParallelFor(n, threads, stage, [&](std::size_t i) {
    const Triangle3& own = patches[i].Corners;
    const double area = Area(own);
    tree.Visit([&](const Box3& box) { return Overlap(box, boxes[i], reach); },
      [&](std::int32_t other) {
        const auto k = static_cast<std::size_t>(other);
        if (patches[k].Triangle >= patches[i].Triangle || !Overlap(boxes[k], boxes[i], reach) ||
          Dot(normals[k], normals[i]) < 1.0 - 1e-9)
        {
          return true;
        }
        for (int c = 0; c < 3; ++c)
        {
          if (std::fabs(Dot(normals[i], patches[k].Corners[c] - own[0])) > reach)
          {
            return true;
          }
        }
        const double share = CommonArea(own, patches[k].Corners, normals[i]) / area;
        if (share > LeastShare)
        {
          found[i].push_back({ static_cast<std::int32_t>(i), other, share });
        }
        return true;
      });
  });
  for (std::size_t i = 0; i < n; ++i)
  {
    if (found[i].empty())
    {
      continue;
    }
    // What lies on top of all covers first; others at most what is left.
    std::sort(found[i].begin(), found[i].end(), [&](const Cover& l, const Cover& r) {
      const auto a = static_cast<std::size_t>(l.Top), b = static_cast<std::size_t>(r.Top);
      return std::tie(patches[a].Triangle, l.Top) < std::tie(patches[b].Triangle, r.Top);
    });
    this->Left.resize(n, 1.0);
    double& left = this->Left[i];
    for (Cover& cover : found[i])
    {
      cover.Share = std::min(cover.Share, left);
      left -= cover.Share;
      if (cover.Share > 0.0)
      {
        this->Covers.push_back(cover);
      }
    }
    left = left < 1e-6 ? 0.0 : left;
  }
  std::stable_sort(this->Covers.begin(), this->Covers.end(), [&](const Cover& l, const Cover& r) {
    return patches[static_cast<std::size_t>(l.Element)].Triangle <
      patches[static_cast<std::size_t>(r.Element)].Triangle;
  });
}

void CoveredElements::Receive(double* values, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  for (const Cover& cover : this->Covers)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      values[static_cast<std::size_t>(cover.Element) * nb + b] +=
        cover.Share * values[static_cast<std::size_t>(cover.Top) * nb + b];
    }
  }
}

void CoveredElements::Save(ArchiveWriter& out) const
{
  out.Put(this->Covers);
  out.Put(this->Left);
}

void CoveredElements::Load(ArchiveReader& in, std::size_t n)
{
  in.Get(this->Covers);
  in.Get(this->Left);
  const auto valid = [&](std::int32_t e) { return e >= 0 && static_cast<std::size_t>(e) < n; };
  if (!(this->Left.empty() || this->Left.size() == n) ||
    !std::all_of(this->Covers.begin(), this->Covers.end(),
      [&](const Cover& c) { return valid(c.Element) && valid(c.Top); }))
  {
    throw std::runtime_error("is damaged: what covers elements");
  }
}

} // namespace radiometry
