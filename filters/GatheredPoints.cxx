// SPDX-License-Identifier: BSD-3-Clause
// The points of SurfacePoints where several processes hold parts of the surface.
#include "SceneAdapter.h"
#include "SceneGathering.h"
#include "SurfacePoints.h"
#include "SurfacePolygons.h"
#include "radiometry/scene/Units.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace
{

using Place = std::array<double, 3>;
using Numbers = std::vector<std::int64_t>;

/// The parts of one leaf as one surface.
struct JoinedSurface
{
  std::vector<radiometry::Vec3> Points; // metres, relative to the scene's origin
  std::vector<Numbers> PointOf;         // of each part's points
  SurfacePolygons Polygons;             // by the numbers of their cells (Origin)
  Numbers FirstOf;                      // polygon of each cell from FirstCell on, and the end
  std::int64_t FirstCell = 0;
};

Place PlaceOf(vtkPolyData* data, vtkIdType i)
{
  Place p;
  data->GetPoint(i, p.data());
  for (double& x : p)
  {
    x += 0.0; // no -0
  }
  return p;
}

/// The points of all parts that are one: those with the same global id, where all parts have ids
/// that agree with the places; else the k-th at a place in every part.
void JoinPoints(const SceneAdapter::Block* begin, const SceneAdapter::Block* end,
  JoinedSurface& joined, std::vector<Place>& places)
{
  using Key = std::pair<long long, Place>;
  std::map<Key, std::int64_t> known;
  bool ids = true;
  std::map<long long, Place> placeOfId;
  for (const SceneAdapter::Block* part = begin; part != end && ids; ++part)
  {
    vtkDataArray* own = part->Data->GetPointData()->GetArray(GatheredPointIds);
    const vtkIdType count = part->Data->GetNumberOfPoints();
    ids = count == 0 || own;
    for (vtkIdType i = 0; i < count && ids; ++i)
    {
      const Place p = PlaceOf(part->Data, i);
      const auto id = static_cast<long long>(own->GetComponent(i, 0));
      ids = placeOfId.emplace(id, p).first->second == p;
    }
  }
  std::vector<std::vector<Key>> keys;
  for (const SceneAdapter::Block* part = begin; part != end; ++part)
  {
    vtkDataArray* own = part->Data->GetPointData()->GetArray(GatheredPointIds);
    std::map<Place, long long> met;
    keys.emplace_back();
    for (vtkIdType i = 0; i < part->Data->GetNumberOfPoints(); ++i)
    {
      const Place p = PlaceOf(part->Data, i);
      keys.back().emplace_back(
        ids ? static_cast<long long>(own->GetComponent(i, 0)) : met[p]++, p);
      const Key& key = keys.back().back();
      if (known.emplace(key, static_cast<std::int64_t>(places.size())).second)
      {
        places.push_back(p);
      }
    }
  }
  if (ids) // in the order of the undivided surface
  {
    std::int64_t next = 0;
    for (auto& [key, number] : known)
    {
      number = next++;
      places[static_cast<std::size_t>(number)] = key.second;
    }
  }
  for (const std::vector<Key>& part : keys)
  {
    joined.PointOf.emplace_back();
    for (const Key& key : part)
    {
      joined.PointOf.back().push_back(known[key]);
    }
  }
}

JoinedSurface Join(const SceneAdapter::Block* begin, const SceneAdapter::Block* end,
  const radiometry::Scene& scene, double metersPerUnit)
{
  JoinedSurface joined;
  std::vector<Place> places;
  JoinPoints(begin, end, joined, places);
  for (const Place& p : places)
  {
    joined.Points.push_back(metersPerUnit * radiometry::Vec3{ p[0], p[1], p[2] } - scene.Origin);
  }
  struct Polygon
  {
    std::int32_t Cell;
    std::vector<vtkIdType> Corners;
  };
  std::vector<Polygon> all;
  for (const SceneAdapter::Block* part = begin; part != end; ++part)
  {
    const Numbers& pointOf = joined.PointOf[static_cast<std::size_t>(part - begin)];
    const SurfacePolygons polygons = CollectPolygons(part->Data);
    for (std::size_t c = 0; c < polygons.Origin.size(); ++c)
    {
      const std::int32_t cell = part->Number(polygons.Origin[c]);
      if (cell < 0)
      {
        continue;
      }
      all.push_back({ cell, {} });
      for (std::int64_t k = polygons.Offsets[c]; k < polygons.Offsets[c + 1]; ++k)
      {
        all.back().Corners.push_back(pointOf[polygons.Corners[k]]);
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
    [](const Polygon& a, const Polygon& b) { return a.Cell < b.Cell; });
  joined.FirstCell = all.empty() ? 0 : all.front().Cell;
  for (const Polygon& polygon : all)
  {
    const auto cell = static_cast<std::size_t>(polygon.Cell - joined.FirstCell);
    joined.FirstOf.resize(cell + 1, static_cast<std::int64_t>(joined.Polygons.Origin.size()));
    joined.Polygons.Add(polygon.Corners.size(), polygon.Corners.data(), polygon.Cell);
  }
  joined.FirstOf.push_back(static_cast<std::int64_t>(joined.Polygons.Origin.size()));
  return joined;
}

/// How a part's own points are split, as the whole surface is. `numbers` gets the point of the whole
/// that each is (-1: none).
radiometry::SplitSurface SplitPart(const SceneAdapter::Block& own, const SurfacePolygons& polygons,
  const Numbers& pointOf, const JoinedSurface& joined, const radiometry::SplitSurface& whole,
  std::vector<std::int32_t>& numbers)
{
  // The point of the whole at each corner.
  Numbers at(polygons.Corners.size(), -1);
  vtkIdType cell = -1;
  std::int64_t among = 0; // polygons of the same cell
  for (std::size_t c = 0; c < polygons.Origin.size(); ++c)
  {
    among = polygons.Origin[c] == cell ? among + 1 : 0;
    cell = polygons.Origin[c];
    const std::int64_t number = own.Numbers[static_cast<std::size_t>(cell)] - joined.FirstCell;
    if (number < 0 || number + 1 >= static_cast<std::int64_t>(joined.FirstOf.size()) ||
      joined.FirstOf[number] + among >= joined.FirstOf[number + 1])
    {
      continue; // of no process, or of another leaf
    }
    const std::int64_t twin = joined.FirstOf[number] + among;
    const auto begin = joined.Polygons.Corners.begin() + joined.Polygons.Offsets[twin];
    const auto end = joined.Polygons.Corners.begin() + joined.Polygons.Offsets[twin + 1];
    for (std::int64_t k = polygons.Offsets[c]; k < polygons.Offsets[c + 1]; ++k)
    {
      // By its place, since of several points at one another may have been joined.
      const std::int64_t point = pointOf[polygons.Corners[k]];
      auto corner = std::find(begin, end, point);
      corner = corner != end ? corner : std::find_if(begin, end, [&](std::int64_t other) {
        return joined.Points[other] == joined.Points[point];
      });
      at[k] = corner == end ? -1 : whole.Corners[corner - joined.Polygons.Corners.begin()];
    }
  }

  // The sheets that meet at each of the part's points.
  std::vector<Numbers> sheets(pointOf.size());
  for (std::size_t k = 0; k < at.size(); ++k)
  {
    Numbers& known = sheets[polygons.Corners[k]];
    if (std::find(known.begin(), known.end(), at[k]) == known.end())
    {
      known.push_back(at[k]);
    }
  }
  radiometry::SplitSurface split;
  split.Source.resize(pointOf.size());
  std::iota(split.Source.begin(), split.Source.end(), std::int64_t{ 0 });
  Numbers points(pointOf); // of the whole, of each of the part's split points
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> placeOf;
  for (std::size_t p = 0; p < sheets.size(); ++p)
  {
    Numbers& known = sheets[p];
    std::sort(known.begin(), known.end());
    const bool kept = known.empty() || std::binary_search(known.begin(), known.end(), pointOf[p]);
    points[p] = kept ? pointOf[p] : known.front();
    for (const std::int64_t s : known)
    {
      std::int64_t place = static_cast<std::int64_t>(p);
      if (s != points[p])
      {
        place = static_cast<std::int64_t>(split.Source.size());
        split.Source.push_back(static_cast<std::int64_t>(p));
        points.push_back(s);
      }
      placeOf[{ static_cast<std::int64_t>(p), s }] = place;
    }
  }
  for (std::size_t k = 0; k < at.size(); ++k)
  {
    split.Corners.push_back(placeOf[{ polygons.Corners[k], at[k] }]);
  }
  for (const std::int64_t p : points)
  {
    split.Normals.push_back(p < 0 ? radiometry::Vec3() : whole.Normals[p]);
    numbers.push_back(static_cast<std::int32_t>(p));
  }
  return split;
}

} // namespace

void SurfacePoints::Gather(const SceneAdapter& adapter, const radiometry::Scene& scene,
  double metersPerUnit, bool wanted, double featureAngle)
{
  const std::vector<SceneAdapter::Block>& parts = adapter.Blocks();
  const std::vector<SceneAdapter::Block>& own = adapter.OwnBlocks();
  this->Carriers.resize(own.size());
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end)
  {
    std::size_t sensors = 0;
    bool cells = false;
    for (end = first; end < parts.size() && parts[end].Leaf == parts[first].Leaf; ++end)
    {
      for (const std::int32_t number : parts[end].PointNumbers)
      {
        sensors = std::max(sensors, static_cast<std::size_t>(number + 1));
      }
      cells = cells || (parts[end].Cells > 0 && !parts[end].Sensors);
    }
    const std::size_t base = this->All.size();
    this->All.resize(base + sensors);
    for (std::size_t k = first; k < end; ++k)
    {
      if (parts[k].Sensors)
      {
        const auto read = ReadSensors(parts[k].Data, scene, metersPerUnit);
        for (std::size_t i = 0; i < read.size(); ++i)
        {
          if (parts[k].PointNumbers[i] >= 0)
          {
            this->All[base + static_cast<std::size_t>(parts[k].PointNumbers[i])] = read[i];
          }
        }
      }
    }
    JoinedSurface joined;
    radiometry::SplitSurface split;
    if (wanted && cells)
    {
      joined = Join(&parts[first], &parts[first] + (end - first), scene, metersPerUnit);
      split = radiometry::SplitAtCreases(joined.Points, joined.Polygons.Offsets,
        joined.Polygons.Corners, std::cos(radiometry::units::Radians(featureAngle)));
      this->AddSplit(joined.Points, joined.Polygons, 0, split, scene);
    }
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      Block& carrier = this->Carriers[k];
      if (own[k].Part < first || own[k].Part >= end)
      {
        continue;
      }
      if (own[k].Sensors)
      {
        carrier.Data = own[k].Data;
        carrier.Numbers = own[k].PointNumbers;
      }
      else if (wanted && own[k].Cells > 0)
      {
        const SurfacePolygons polygons = CollectPolygons(own[k].Data);
        carrier.Data = MakePolyData(own[k].Data, polygons,
          SplitPart(own[k], polygons, joined.PointOf[own[k].Part - first], joined, split,
            carrier.Numbers));
      }
      for (std::int32_t& number : carrier.Numbers)
      {
        number += number >= 0 ? static_cast<std::int32_t>(base) : 0;
      }
    }
  }
}
