// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include "vtkPoints.h"

#include <array>
#include <functional>
#include <unordered_map>

/// Merges points with the same coordinates, bit for bit.
class PointMerger
{
public:
  explicit PointMerger(vtkPoints* points)
    : Points(points)
  {
  }
  vtkIdType Add(const radiometry::Vec3& p)
  {
    const std::array<double, 3> key{ p.x + 0.0, p.y + 0.0, p.z + 0.0 }; // no -0
    const auto [entry, added] = this->Known.emplace(key, this->Points->GetNumberOfPoints());
    if (added)
    {
      this->Points->InsertNextPoint(key.data());
    }
    return entry->second;
  }

private:
  struct Hash
  {
    std::size_t operator()(const std::array<double, 3>& p) const
    {
      std::size_t h = 0;
      for (const double x : p)
      {
        h = h * 0x9E3779B97F4A7C15ULL + std::hash<double>()(x);
        h ^= h >> 29;
      }
      return h;
    }
  };
  vtkPoints* Points;
  std::unordered_map<std::array<double, 3>, vtkIdType, Hash> Known;
};
