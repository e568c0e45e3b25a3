// SPDX-License-Identifier: BSD-3-Clause
#include "SceneGathering.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/ArrayNames.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

using Block = SceneAdapter::Block;
using Blocks = std::vector<Block>;

namespace
{

/// A cell or a sensor of a part.
struct Item
{
  std::uint64_t Shape = 0; // of the same coordinates: the same
  long long Id = -1;
  std::int32_t Number = -1;
  bool Copy = false; // of another one
  bool Inner = false;        // of the faces of solids: between two parts
  std::uint64_t Corners = 0; // of faces of solids: of the same corners, in any order, the same
};
using Items = std::vector<Item>;

std::uint64_t Mixed(std::uint64_t hash, double value)
{
  const double v = value + 0.0; // no -0
  std::uint64_t bits = 0;
  std::memcpy(&bits, &v, sizeof(bits));
  return radiometry::Hash64(hash, bits);
}

/// The corners from the least one on, so that copies that begin elsewhere are the same.
std::uint64_t ShapeOf(vtkPolyData* data, const vtkIdType* ids, vtkIdType count, bool ring)
{
  static thread_local std::vector<std::array<double, 3>> corners;
  corners.clear();
  const vtkIdType points = data->GetNumberOfPoints();
  for (vtkIdType k = 0; k < count; ++k)
  {
    corners.emplace_back();
    if (ids[k] >= 0 && ids[k] < points) // an error that is reported later
    {
      data->GetPoint(ids[k], corners.back().data());
    }
  }
  const auto least = std::min_element(corners.begin(), corners.end());
  const auto first = static_cast<std::size_t>(ring ? least - corners.begin() : 0);
  std::uint64_t hash = static_cast<std::uint64_t>(count);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    for (const double x : corners[(first + k) % corners.size()])
    {
      hash = Mixed(hash, x);
    }
  }
  return hash;
}

bool IsDuplicate(vtkDataArray* ghosts, vtkIdType i)
{
  return ghosts &&
    (static_cast<int>(ghosts->GetComponent(i, 0)) & vtkDataSetAttributes::DUPLICATECELL) != 0;
}

long long IdAt(vtkDataArray* ids, vtkIdType i)
{
  return ids ? static_cast<long long>(ids->GetComponent(i, 0)) : -1;
}

/// The places of the corners in any order.
std::uint64_t CornersOf(vtkPolyData* data, const vtkIdType* ids, vtkIdType count)
{
  std::vector<std::uint64_t> places;
  for (vtkIdType k = 0; k < count; ++k)
  {
    places.push_back(ShapeOf(data, ids + k, 1, false));
  }
  std::sort(places.begin(), places.end());
  std::uint64_t hash = static_cast<std::uint64_t>(count);
  for (const std::uint64_t place : places)
  {
    hash = radiometry::Hash64(hash, place);
  }
  return hash;
}

Items CellsOf(const Block& block)
{
  vtkPolyData* data = block.Data;
  vtkDataArray* ghosts = data->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  vtkDataArray* ids = data->GetCellData()->GetArray(GatheredCellIds);
  Items items;
  vtkCellArray* const kinds[] = { data->GetVerts(), data->GetLines(), data->GetPolys(),
    data->GetStrips() };
  for (vtkCellArray* cells : kinds)
  {
    const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType n = 0;
      const vtkIdType* corners = nullptr;
      iterator->GetCurrentCell(n, corners);
      const auto i = static_cast<vtkIdType>(items.size());
      items.push_back({ ShapeOf(data, corners, n, cells == data->GetPolys()), IdAt(ids, i), -1,
        IsDuplicate(ghosts, i), false, block.Skin ? CornersOf(data, corners, n) : 0 });
    }
  }
  return items;
}

/// The corners of faces of solids that two parts have in common.
std::unordered_set<std::uint64_t> InnerFaces(const std::vector<Items>& parts)
{
  std::unordered_map<std::uint64_t, std::size_t> partOf;
  std::unordered_set<std::uint64_t> inner;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    for (const Item& item : parts[k])
    {
      if (item.Corners != 0 && !item.Copy &&
        partOf.emplace(item.Corners, k).first->second != k)
      {
        inner.insert(item.Corners);
      }
    }
  }
  return inner;
}

/// Sensors are points; one is a copy where it is marked so, or all of its vertices are.
Items SensorsOf(vtkPolyData* data)
{
  vtkDataArray* ghosts = data->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  vtkDataArray* ids = data->GetPointData()->GetArray(GatheredPointIds);
  vtkDataArray* normals = data->GetPointData()->GetArray(radiometry::names::Normals);
  Items items;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Item item{ ShapeOf(data, &i, 1, false), IdAt(ids, i), -1, IsDuplicate(ghosts, i) };
    for (int k = 0; normals && k < normals->GetNumberOfComponents(); ++k)
    {
      item.Shape = Mixed(item.Shape, normals->GetComponent(i, k));
    }
    items.push_back(item);
  }
  Block vertices;
  vertices.Data = data;
  const Items cells = CellsOf(vertices);
  std::vector<char> owned(items.size(), 0), copied(items.size(), 0);
  vtkIdType c = 0;
  const auto iterator = vtk::TakeSmartPointer(data->GetVerts()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell(), ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* corners = nullptr;
    iterator->GetCurrentCell(n, corners);
    for (vtkIdType k = 0; k < n; ++k)
    {
      if (corners[k] >= 0 && corners[k] < data->GetNumberOfPoints())
      {
        (cells[static_cast<std::size_t>(c)].Copy ? copied : owned)[corners[k]] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    items[i].Copy = items[i].Copy || (copied[i] != 0 && owned[i] == 0);
  }
  return items;
}

/// The items of one leaf get numbers from `first` on; those of copies stay open. Returns the next.
std::int32_t NumberLeaf(std::vector<Items>& parts, std::int32_t first)
{
  std::vector<Item*> owners, copies;
  bool ids = true;
  for (Items& part : parts)
  {
    for (Item& item : part)
    {
      if (!item.Inner)
      {
        (item.Copy ? copies : owners).push_back(&item);
        ids = ids && item.Id >= 0;
      }
    }
  }
  std::vector<Item*> sorted = owners;
  if (ids)
  {
    std::stable_sort(
      sorted.begin(), sorted.end(), [](const Item* a, const Item* b) { return a->Id < b->Id; });
    for (std::size_t k = 1; k < sorted.size(); ++k)
    {
      // Ids that different cells have in common tell nothing.
      ids = ids && (sorted[k]->Id != sorted[k - 1]->Id || sorted[k]->Shape == sorted[k - 1]->Shape);
    }
  }
  if (!ids)
  {
    for (Item* item : owners)
    {
      item->Number = first++;
    }
    return first;
  }
  for (std::size_t k = 0; k < sorted.size(); ++k)
  {
    sorted[k]->Copy = k > 0 && sorted[k]->Id == sorted[k - 1]->Id;
    sorted[k]->Number = sorted[k]->Copy ? sorted[k - 1]->Number : first++;
  }
  for (Item* copy : copies)
  {
    const auto owner = std::lower_bound(sorted.begin(), sorted.end(), copy->Id,
      [](const Item* a, long long id) { return a->Id < id; });
    if (owner != sorted.end() && (*owner)->Id == copy->Id)
    {
      copy->Number = (*owner)->Number;
    }
  }
  return first;
}

/// Copies that have no number yet get that of an item of the same shape, of any leaf.
void NumberByShape(std::vector<Items*>& parts)
{
  std::unordered_map<std::uint64_t, std::int32_t> numbers;
  for (const Items* part : parts)
  {
    for (const Item& item : *part)
    {
      if (item.Copy && item.Number < 0 && !item.Inner)
      {
        numbers.emplace(item.Shape, -1);
      }
    }
  }
  for (const Items* part : parts)
  {
    for (const Item& item : *part)
    {
      const auto wanted = numbers.empty() || item.Copy || item.Inner ? numbers.end() : numbers.find(item.Shape);
      if (wanted != numbers.end() && wanted->second < 0)
      {
        wanted->second = item.Number;
      }
    }
  }
  for (Items* part : parts)
  {
    for (Item& item : *part)
    {
      if (item.Copy && item.Number < 0 && !item.Inner)
      {
        item.Number = numbers[item.Shape];
      }
    }
  }
}

std::vector<std::int32_t> Taken(const Items& items, bool copies)
{
  std::vector<std::int32_t> numbers;
  for (const Item& item : items)
  {
    numbers.push_back(copies || !item.Copy ? item.Number : -1);
  }
  return numbers;
}

/// The end of the parts of the same leaf.
std::size_t LeafEnd(const Blocks& parts, std::size_t first)
{
  std::size_t end = first;
  while (end < parts.size() && parts[end].Leaf == parts[first].Leaf)
  {
    ++end;
  }
  return end;
}

} // namespace

std::size_t PartNumbers::OfCells(Blocks& parts, std::vector<std::vector<std::int32_t>>& all)
{
  std::vector<std::vector<Items>> leaves;
  std::vector<Items*> every;
  std::int32_t next = 0;
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end)
  {
    end = LeafEnd(parts, first);
    leaves.emplace_back();
    for (std::size_t k = first; k < end; ++k)
    {
      leaves.back().push_back(CellsOf(parts[k]));
    }
    const auto inner = InnerFaces(leaves.back());
    for (Items& part : leaves.back())
    {
      for (Item& item : part)
      {
        item.Inner = item.Corners != 0 && inner.count(item.Corners) != 0;
      }
    }
    next = NumberLeaf(leaves.back(), next);
  }
  for (std::vector<Items>& leaf : leaves)
  {
    for (Items& part : leaf)
    {
      every.push_back(&part);
    }
  }
  NumberByShape(every);
  all.clear();
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    parts[k].Gathered = true;
    parts[k].Numbers = Taken(*every[k], false);
    all.push_back(Taken(*every[k], true));
  }
  return static_cast<std::size_t>(next);
}

void PartNumbers::OfSensors(Blocks& parts, std::vector<std::vector<std::int32_t>>& all)
{
  all.assign(parts.size(), {});
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end)
  {
    end = LeafEnd(parts, first);
    std::vector<Items> leaf;
    for (std::size_t k = first; k < end; ++k)
    {
      leaf.push_back(parts[k].Sensors ? SensorsOf(parts[k].Data) : Items());
    }
    NumberLeaf(leaf, 0);
    std::vector<Items*> every;
    for (Items& part : leaf)
    {
      every.push_back(&part);
    }
    NumberByShape(every);
    for (std::size_t k = first; k < end; ++k)
    {
      parts[k].PointNumbers = Taken(leaf[k - first], false);
      all[k] = Taken(leaf[k - first], true);
    }
  }
}
