// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// How a number of measuring points becomes whole.
enum class GridRounding
{
  Up,      // never wider than the spacing asked for
  Nearest, // EN 12464-1:2011: "the nearest whole number of d/p"
  Odd      // up to an odd number (DIN 5035-6): a point in the middle
};

/// Greatest spacing of measuring points on an area of these two sides [m].
///   Model   p = 0.2 * 5^log10(d), at most 10 m, so 0.2 m at 1 m, 1 m at 10 m, 5 m at 100 m;
///           d is the longer side, or the shorter one where the longer is at least twice as long
///   Source  EN 12464-1:2011, 4.4 (and EN 12193), formula 1; A. Stockmar 1992
///   Fails   InputError: sides that are not finite and above 0
double MeasuringGridSpacing(double side1, double side2);

/// Numbers of points along both sides for a spacing; at least 1 each. Nearest counts along the side
/// that decides (see above) first, and the other side with the spacing that this gives, so that
/// cells come close to squares.
///   Fails   InputError: more than MaximumSensors points in all
std::array<std::int64_t, 2> MeasuringGridCounts(
  double side1, double side2, double spacing, GridRounding rounding);

/// More measuring points than this are taken for a mistake.
constexpr std::int64_t MaximumSensors = 10'000'000;

/// A measuring point with the piece of surface that it stands for.
struct Sensor
{
  Vec3 Point;                  // the middle of the piece
  Vec3 Normal;                 // unit
  std::array<Vec3, 4> Corners; // counter-clockwise about Normal; the last one twice: a triangle
};

/// A parallelogram by a corner and two sides.
struct GridParallelogram
{
  Vec3 Origin;
  Vec3 Side1;
  Vec3 Side2;
};

/// Adds counts[0] * counts[1] sensors, each in the middle of its part; along Side1 fastest.
void AddSensors(const GridParallelogram& area, const std::array<std::int64_t, 2>& counts,
  std::vector<Sensor>& sensors);

/// Adds sensors on a triangle, cut into n^2 triangles of its shape whose edges are no longer than
/// `spacing`; nothing where it has no area.
void AddSensors(const Triangle3& triangle, double spacing, std::vector<Sensor>& sensors);

/// The same on a quadrilateral, cut into n1 * n2; false (and nothing added) where it is not convex
/// or not flat to rounding: triangulate it then.
bool AddSensors(const std::array<Vec3, 4>& quad, double spacing, std::vector<Sensor>& sensors);

/// The extent of a room about an up direction: horizontal planes in it. First all points are added,
/// then the polygons of its floor; where those span at least half of the whole both ways, they are
/// the extent (a window's reveal or a porch is none of it), else the points are.
class RoomExtent
{
public:
  /// Fails: InputError, a direction of no length.
  explicit RoomExtent(const Vec3& up);
  void Add(const Vec3& point);
  bool Empty() const { return this->Whole.Count == 0; }
  /// Whether a point is as low as the lowest one, within a thousandth of the height.
  bool OnFloor(const Vec3& point) const;
  void AddFloor(const Vec3& point);
  /// The plane at `height` above the lowest point, `margin` away from the outermost points, but at
  /// most a quarter of the side, so that something is left of a narrow room; its front is up. Along
  /// a coordinate axis as up, its sides follow the other two axes.
  GridParallelogram Plane(double height, double margin) const;

private:
  struct Box
  {
    std::array<double, 3> Low{};
    std::array<double, 3> High{};
    std::int64_t Count = 0;
    void Add(const std::array<Vec3, 3>& axes, const Vec3& point);
    double Side(int k) const { return this->High[k] - this->Low[k]; }
  };
  std::array<Vec3, 3> Axes; // side 1, side 2, up: right-handed
  Box Whole;
  Box Floor;
};

} // namespace radiometry
