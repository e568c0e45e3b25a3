// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/PatchBlockers.h"

#include "radiometry/visibility/ExactHit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace radiometry
{
namespace
{

// As in ExactHit: what is closer to a plane lies on it.
constexpr double OnPlane = 1e-14;
// A shaft takes in what rounding may have moved out of it.
constexpr double ShaftMargin = 1e-13;

/// The least and greatest height of a group over a plane: of its box where that tells, else of its
/// corners.
struct Heights
{
  double Low, High;
  Heights(const PatchGroup& g, const Vec3& n, const Vec3& through)
  {
    const double middle = Dot(n, g.Center - through);
    const double reach =
      std::fabs(n.x) * g.Half.x + std::fabs(n.y) * g.Half.y + std::fabs(n.z) * g.Half.z;
    this->Low = middle - reach;
    this->High = middle + reach;
    if (this->Low > 2.0 * OnPlane || this->High < -2.0 * OnPlane)
    {
      return;
    }
    this->Low = std::numeric_limits<double>::infinity();
    this->High = -this->Low;
    for (std::int32_t k = 0; k < g.Count; ++k)
    {
      for (const Vec3& p : g.Patches[k].Corners)
      {
        const double h = Dot(n, p - through);
        this->Low = std::min(this->Low, h);
        this->High = std::max(this->High, h);
      }
      if (this->Low < -OnPlane && this->High > OnPlane)
      {
        return; // on both sides: enough
      }
    }
  }
  bool Above() const { return this->Low >= -OnPlane; }
  bool Below() const { return this->High <= OnPlane; }
  bool Within() const { return this->Above() && this->Below(); }
};

/// True when a triangle lies behind or on the plane of every patch of a group.
bool BehindAll(const Triangle3& t, std::int32_t number, const PatchGroup& g)
{
  for (std::int32_t k = 0; k < g.Count; ++k)
  {
    const PlacedPatch& p = g.Patches[k];
    if (p.Triangle == number)
    {
      continue;
    }
    for (const Vec3& corner : t)
    {
      if (Dot(p.Normal, corner - p.Corners[0]) > OnPlane)
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace

PatchGroup::PatchGroup(const PlacedPatch* patches, std::int32_t count)
  : Patches(patches)
  , Count(count)
{
  for (std::int32_t k = 0; k < count; ++k)
  {
    for (const Vec3& p : patches[k].Corners)
    {
      this->Bounds.Add(p);
    }
  }
  this->Center = this->Bounds.Center();
  this->Half = 0.5 * this->Bounds.Size();
}

PatchBlockers::PatchBlockers(const Scene& scene)
{
  const std::size_t count = scene.Triangles.size();
  if (count == 0)
  {
    return;
  }
  Box3 bounds;
  for (const auto& t : scene.Triangles)
  {
    for (const std::int32_t p : t)
    {
      bounds.Add(scene.Points[p]);
    }
  }
  const Vec3 size = bounds.Size();
  this->Center = bounds.Center();
  this->Scale = std::exp2(-std::ceil(std::log2(std::max({ size.x, size.y, size.z }))));

  // Of triangles with the same corners one hides all that the others do.
  std::vector<std::array<std::int32_t, 4>> corners(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    auto v = scene.Triangles[t];
    std::sort(v.begin(), v.end());
    corners[t] = { v[0], v[1], v[2], static_cast<std::int32_t>(t) };
  }
  std::sort(corners.begin(), corners.end());
  this->Repeated.assign(count, 0);
  for (std::size_t k = 1; k < count; ++k)
  {
    this->Repeated[corners[k][3]] =
      std::equal(corners[k].begin(), corners[k].begin() + 3, corners[k - 1].begin()) ? 1 : 0;
  }

  struct Side
  {
    std::int32_t A, B, Triangle, Corner;
    bool Back;
  };
  std::vector<Side> sides;
  sides.reserve(3 * count);
  std::vector<Box3> boxes(count);
  this->Triangles.resize(count);
  this->Normals.resize(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Triangles[t][k] = this->Place(scene.Points[scene.Triangles[t][k]]);
      boxes[t].Add(this->Triangles[t][k]);
      const std::int32_t a = scene.Triangles[t][k];
      const std::int32_t b = scene.Triangles[t][(k + 1) % 3];
      if (!this->Repeated[t])
      {
        sides.push_back({ std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), k, a > b });
      }
    }
    this->Normals[t] = Normalized(AreaNormal2(this->Triangles[t]));
  }
  this->Tree = BoxTree(boxes);
  std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
    return std::tie(l.A, l.B, l.Triangle, l.Corner) < std::tie(r.A, r.B, r.Triangle, r.Corner);
  });
  this->Neighbour.assign(count, { NoNeighbour, NoNeighbour, NoNeighbour });
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end)
  {
    for (end = begin; end < sides.size() && sides[end].A == sides[begin].A &&
         sides[end].B == sides[begin].B;)
    {
      ++end;
    }
    if (end - begin == 2)
    {
      const Side& s = sides[begin];
      const Side& o = sides[begin + 1];
      const int turned = s.Back == o.Back ? 1 : 0;
      this->Neighbour[static_cast<std::size_t>(s.Triangle)][s.Corner] = 2 * o.Triangle + turned;
      this->Neighbour[static_cast<std::size_t>(o.Triangle)][o.Corner] = 2 * s.Triangle + turned;
    }
  }
}

PlacedPatch PatchBlockers::Place(const Patch& patch) const
{
  PlacedPatch placed;
  for (int k = 0; k < 3; ++k)
  {
    placed.Corners[k] = this->Place(patch.Corners[k]);
  }
  placed.Normal = Normalized(AreaNormal2(placed.Corners));
  placed.Triangle = patch.Triangle;
  return placed;
}

void PatchBlockers::Classify(Candidate& c, const PatchGroup& a, const PatchGroup& b) const
{
  const std::int32_t t = c.Triangle;
  c.Kind = Place3::Harmless;
  if ((a.Count == 1 && a.Patches[0].Triangle == t) || (b.Count == 1 && b.Patches[0].Triangle == t))
  {
    return;
  }
  const Triangle3& v = this->Triangles[t];
  const Vec3& n = this->Normals[t];
  if (n == Vec3{})
  {
    return; // without area it hides nothing
  }
  const Heights ofA(a, n, v[0]);
  if (ofA.Within())
  {
    return;
  }
  const Heights ofB(b, n, v[0]);
  if ((ofA.Above() && ofB.Above()) || (ofA.Below() && ofB.Below()) || ofB.Within())
  {
    return;
  }
  if (ofA.Low > OnPlane && ofB.High < -OnPlane)
  {
    c.Kind = Place3::Parts;
    c.AAbove = true;
    return;
  }
  if (ofA.High < -OnPlane && ofB.Low > OnPlane)
  {
    c.Kind = Place3::Parts;
    return;
  }
  c.Kind = BehindAll(v, t, a) || BehindAll(v, t, b) ? Place3::Harmless : Place3::Across;
  return;
}

Sight PatchBlockers::Between(
  const PatchGroup& a, const PatchGroup& b, const Candidates* from, Candidates& found,
  std::size_t most) const
{
  thread_local std::vector<Candidate> list;
  std::vector<Candidate>& kept = list;
  kept.clear();
  found.Triangles.clear();
  found.Parting.clear();
  found.Complete = true;
  const BoxShaft shaft(a.Bounds, b.Bounds, ShaftMargin);
  const auto look = [&](std::int32_t t, std::uint8_t parting) {
    std::uint32_t codes[3];
    if (this->Repeated[t] || !shaft.Touches(this->Triangles[t], codes))
    {
      return true;
    }
    Candidate c;
    c.Triangle = t;
    c.Kind = Place3::Parts;
    c.AAbove = parting == 2;
    if (parting == 0)
    {
      this->Classify(c, a, b);
    }
    if (c.Kind != Place3::Harmless)
    {
      for (int k = 0; k < 3; ++k)
      {
        c.EdgeWithin[k] = (codes[k] & codes[(k + 1) % 3]) == 0;
      }
      kept.push_back(c);
    }
    return kept.size() <= most;
  };
  if (from && from->Complete)
  {
    for (std::size_t k = 0; k < from->Triangles.size(); ++k)
    {
      look(from->Triangles[k], from->Parting[k]);
    }
  }
  else
  {
    found.Complete = this->Tree.Visit([&](const Box3& box) { return shaft.Reaches(box); },
      [&](std::int32_t t) { return look(t, 0); });
  }
  if (kept.empty())
  {
    return found.Complete ? Sight::Clear : Sight::Mixed;
  }
  Sight sight = this->Sheets(a, b, kept);
  sight = sight == Sight::Clear && !found.Complete ? Sight::Mixed : sight;
  if (sight == Sight::Mixed)
  {
    for (const Candidate& c : kept)
    {
      found.Triangles.push_back(c.Triangle);
      found.Parting.push_back(c.Kind != Place3::Parts ? 0 : (c.AAbove ? 2 : 1));
    }
  }
  return sight;
}

Sight PatchBlockers::Sheets(
  const PatchGroup& a, const PatchGroup& b, std::vector<Candidate>& candidates) const
{
  const auto count = static_cast<std::int32_t>(candidates.size());
  thread_local std::vector<std::int32_t> places, opens;
  std::vector<std::int32_t>& place = places; // of a triangle among the candidates
  std::vector<std::int32_t>& open = opens;   // where a sheet ends within the shaft, and what hangs on it
  if (place.size() < this->Triangles.size())
  {
    place.assign(this->Triangles.size(), -1);
  }
  open.clear();
  const auto end = [&](std::int32_t k) {
    candidates[k].Open = true;
    open.push_back(k);
  };
  for (std::int32_t k = 0; k < count; ++k)
  {
    place[candidates[k].Triangle] = k;
  }
  for (std::int32_t k = 0; k < count; ++k)
  {
    Candidate& c = candidates[k];
    bool ends = c.Kind != Place3::Parts;
    for (int corner = 0; corner < 3; ++corner)
    {
      c.Next[corner] = -1;
      if (!c.EdgeWithin[corner])
      {
        continue;
      }
      // Who carries on what this one hides.
      const std::int32_t code = this->Neighbour[c.Triangle][corner];
      const std::int32_t o = code < 0 ? -1 : place[code >> 1];
      const bool turned = (code & 1) != 0;
      const bool carriesOn = o >= 0 && candidates[o].Kind == Place3::Parts &&
        (candidates[o].AAbove == c.AAbove) != turned;
      ends = ends || !carriesOn;
      c.Next[corner] = carriesOn ? o : -1;
    }
    if (ends)
    {
      end(k);
    }
  }
  for (std::size_t done = 0; done < open.size(); ++done)
  {
    for (const std::int32_t next : candidates[open[done]].Next)
    {
      if (next >= 0 && !candidates[next].Open)
      {
        end(next);
      }
    }
  }
  for (const Candidate& c : candidates)
  {
    place[c.Triangle] = -1;
  }
  if (open.size() == candidates.size())
  {
    return Sight::Mixed;
  }
  // What remains closed is crossed by all segments or by none.
  const Vec3 x = Centroid(a.Patches[0].Corners);
  const Vec3 y = Centroid(b.Patches[0].Corners);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k)
  {
    if (candidates[k].Open)
    {
      candidates[kept++] = candidates[k];
    }
    else if (this->Crosses(candidates[k].Triangle, x, y))
    {
      return Sight::Hidden;
    }
  }
  candidates.resize(kept);
  return kept == 0 ? Sight::Clear : Sight::Mixed;
}

/// Whether the open segment passes through the triangle, its rim included; the same as Judge with
/// the ends on no triangle.
bool PatchBlockers::Crosses(std::int32_t t, const Vec3& x, const Vec3& y) const
{
  const Triangle3& v = this->Triangles[t];
  const Vec3& n = this->Normals[t];
  const double h0 = Dot(n, x - v[0]);
  const double h1 = Dot(n, y - v[0]);
  if (std::fabs(h0) <= OnPlane || std::fabs(h1) <= OnPlane || (h0 > 0.0) == (h1 > 0.0))
  {
    return false;
  }
  const Vec3 along = y - x;
  const Vec3 p0 = v[0] - x, p1 = v[1] - x, p2 = v[2] - x;
  const double f0 = Dot(along, Cross(p0, p1));
  const double f1 = Dot(along, Cross(p1, p2));
  const double f2 = Dot(along, Cross(p2, p0));
  const double least = std::min({ f0, f1, f2 });
  const double most = std::max({ f0, f1, f2 });
  // No edge and no segment is longer than two: within some rounding of the rim, ask exactly.
  constexpr double near = 1e-13;
  if (least > near || most < -near)
  {
    return true;
  }
  if (least < -near && most > near)
  {
    return false;
  }
  RayQuery ray;
  ray.Start = x;
  ray.Length = Length(along);
  ray.Direction = along / ray.Length;
  ray.Triangles = &this->Triangles;
  ray.Normals = &this->Normals;
  double distance = 0.0;
  return Judge(ray, t, true, distance) == Verdict::Hit;
}

bool PatchBlockers::Blocked(const Vec3& x, const PlacedPatch& a, const Vec3& y,
  const PlacedPatch& b, const Candidates& candidates) const
{
  for (const std::int32_t t : candidates.Triangles)
  {
    if (t != a.Triangle && t != b.Triangle && this->Crosses(t, x, y))
    {
      return true;
    }
  }
  return false;
}

} // namespace radiometry
