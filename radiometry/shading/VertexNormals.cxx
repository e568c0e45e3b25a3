// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/VertexNormals.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

double LargestComponent(const Vec3& v)
{
  return std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) });
}

/// The corners of a cell about its first one, in units of its own extent, so that no product of
/// lengths overflows or vanishes.
struct ScaledCell
{
  std::vector<Vec3> Corners;
  Vec3 Normal;           // unit, or zero
  double Area = 0.0;     // in units of Extent squared
  double Extent = 0.0;

  template <typename Point>
  void Set(std::size_t count, const Point& point)
  {
    this->Corners.clear();
    this->Normal = {};
    this->Area = this->Extent = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      // Halves, as a difference of finite numbers may overflow.
      const Vec3 p = 0.5 * point(i) - 0.5 * point(0);
      if (!IsFinite(p))
      {
        return;
      }
      this->Corners.push_back(p);
      this->Extent = std::max(this->Extent, LargestComponent(p));
    }
    if (!(this->Extent > 0.0))
    {
      return;
    }
    Vec3 sum;
    for (Vec3& p : this->Corners)
    {
      p = { p.x / this->Extent, p.y / this->Extent, p.z / this->Extent };
    }
    for (std::size_t i = 1; i + 1 < count; ++i)
    {
      sum += Cross(this->Corners[i], this->Corners[i + 1]);
    }
    const double length = Length(sum);
    if (length > 0.0)
    {
      this->Normal = sum / length;
      this->Area = 0.5 * length;
    }
  }

  /// The angle inside the cell at a corner, in [0, 2 pi); 0 at the repetition of the one before.
  double Angle(std::size_t i) const
  {
    const std::size_t n = this->Corners.size();
    const Vec3& here = this->Corners[i];
    if (this->Corners[(i + n - 1) % n] == here)
    {
      return 0.0;
    }
    std::size_t after = (i + 1) % n;
    while (after != i && this->Corners[after] == here)
    {
      after = (after + 1) % n;
    }
    const Vec3 a = this->Corners[after] - here;
    const Vec3 b = this->Corners[(i + n - 1) % n] - here;
    const Vec3 product = Cross(a, b);
    const double turned = Dot(product, this->Normal);
    const double angle = std::atan2(Length(product), Dot(a, b));
    return turned < 0.0 ? 6.283185307179586477 - angle : angle;
  }
};

template <typename Corner>
std::vector<Vec3> Average(const std::vector<Vec3>& points, std::size_t cells,
  const std::vector<std::int64_t>* offsets, const Corner& corner, NormalWeight weight)
{
  const auto begin = [&](std::size_t c) {
    return offsets ? static_cast<std::size_t>((*offsets)[c]) : 3 * c;
  };
  ScaledCell cell;
  const auto set = [&](std::size_t c) {
    cell.Set(begin(c + 1) - begin(c),
      [&](std::size_t i) -> const Vec3& { return points[corner(begin(c) + i)]; });
  };
  double unit = 0.0; // the greatest extent of the cells: areas count in its square
  if (weight == NormalWeight::Area)
  {
    for (std::size_t c = 0; c < cells; ++c)
    {
      set(c);
      unit = cell.Area > 0.0 ? std::max(unit, cell.Extent) : unit;
    }
  }
  std::vector<Vec3> normals(points.size());
  for (std::size_t c = 0; c < cells; ++c)
  {
    set(c);
    if (cell.Normal == Vec3{})
    {
      continue;
    }
    const double relative = cell.Extent / unit;
    for (std::size_t i = 0; i < cell.Corners.size(); ++i)
    {
      const double share = weight == NormalWeight::Angle ? cell.Angle(i)
        : weight == NormalWeight::Area                   ? cell.Area * relative * relative
                                                         : 1.0;
      normals[corner(begin(c) + i)] += share * cell.Normal;
    }
  }
  for (Vec3& n : normals)
  {
    n = Normalized(n);
  }
  return normals;
}

} // namespace

Vec3 CellNormal(const Vec3* corners, std::size_t count)
{
  ScaledCell cell;
  cell.Set(count, [corners](std::size_t i) -> const Vec3& { return corners[i]; });
  return cell.Normal;
}

std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& corners,
  NormalWeight weight)
{
  return Average(
    points, offsets.empty() ? 0 : offsets.size() - 1, &offsets,
    [&](std::size_t k) { return static_cast<std::size_t>(corners[k]); }, weight);
}

std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, NormalWeight weight)
{
  return Average(
    points, triangles.size(), nullptr,
    [&](std::size_t k) { return static_cast<std::size_t>(triangles[k / 3][k % 3]); }, weight);
}

SeparatedPoints SeparateSheets(std::size_t points, const std::vector<std::int64_t>& corners,
  const std::vector<std::int64_t>& sheetOfCorner)
{
  SeparatedPoints result;
  result.Source.resize(points);
  result.Sheet.assign(points, -1);
  result.Corners = corners;
  for (std::size_t p = 0; p < points; ++p)
  {
    result.Source[p] = static_cast<std::int64_t>(p);
  }
  std::vector<std::int64_t> next(points, -1); // the next copy of the same point
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    auto p = static_cast<std::size_t>(corners[k]);
    if (result.Sheet[p] < 0)
    {
      result.Sheet[p] = sheetOfCorner[k];
    }
    while (result.Sheet[p] != sheetOfCorner[k])
    {
      if (next[p] < 0)
      {
        next[p] = static_cast<std::int64_t>(result.Source.size());
        result.Source.push_back(corners[k]);
        result.Sheet.push_back(sheetOfCorner[k]);
        next.push_back(-1);
      }
      p = static_cast<std::size_t>(next[p]);
    }
    result.Corners[k] = static_cast<std::int64_t>(p);
  }
  return result;
}

Vec3 TransformNormal(const Matrix3& m, const Vec3& normal)
{
  const auto finite = [](const std::array<double, 3>& row) {
    return std::isfinite(row[0]) && std::isfinite(row[1]) && std::isfinite(row[2]);
  };
  if (!IsFinite(normal) || !std::all_of(m.begin(), m.end(), finite))
  {
    return {};
  }
  // The cofactor matrix is det(M) M^-T; in long double its products of three factors of any size
  // stay within range.
  using Wide = long double;
  const auto cofactor = [&m](int i, int j) -> Wide {
    const int a = (i + 1) % 3;
    const int b = (i + 2) % 3;
    const int c = (j + 1) % 3;
    const int d = (j + 2) % 3;
    return Wide(m[a][c]) * m[b][d] - Wide(m[a][d]) * m[b][c];
  };
  Wide carried[3];
  Wide largest = 0.0L;
  for (int i = 0; i < 3; ++i)
  {
    carried[i] =
      cofactor(i, 0) * normal.x + cofactor(i, 1) * normal.y + cofactor(i, 2) * normal.z;
    largest = std::max(largest, std::fabs(carried[i]));
  }
  if (!(largest > 0.0L))
  {
    return {};
  }
  const Wide determinant =
    cofactor(0, 0) * m[0][0] + cofactor(0, 1) * m[0][1] + cofactor(0, 2) * m[0][2];
  const Wide sign = determinant < 0.0L ? -1.0L : 1.0L;
  return Normalized({ static_cast<double>(sign * carried[0] / largest),
    static_cast<double>(sign * carried[1] / largest),
    static_cast<double>(sign * carried[2] / largest) });
}

} // namespace radiometry
