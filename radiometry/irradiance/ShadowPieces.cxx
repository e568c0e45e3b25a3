// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/ShadowPieces.h"

#include "radiometry/irradiance/CellCutter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <unordered_map>

namespace radiometry
{
namespace
{

struct PointHash
{
  std::size_t operator()(const std::array<double, 3>& p) const
  {
    std::size_t h = 0;
    for (const double x : p)
    {
      h = 1000003 * h + std::hash<double>()(x);
    }
    return h;
  }
};

std::vector<std::vector<std::int32_t>> TrianglesOfCells(const Scene& scene)
{
  std::vector<std::vector<std::int32_t>> triangles(scene.Cells);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    triangles[scene.TriangleCell[t]].push_back(static_cast<std::int32_t>(t));
  }
  return triangles;
}

/// Of the triangles of a cell, the one on which a point of it lies.
std::int32_t TriangleUnder(
  const Scene& scene, const std::vector<std::int32_t>& triangles, const Vec3& p)
{
  std::int32_t best = triangles.front();
  double most = -std::numeric_limits<double>::infinity();
  for (const std::int32_t t : triangles)
  {
    const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(t));
    const Vec3 n = AreaNormal2(v);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
    {
      least = std::min(least, Dot(n, Cross(v[(k + 1) % 3] - v[k], p - v[k])) / Dot(n, n));
    }
    if (least > most)
    {
      most = least;
      best = t;
    }
  }
  return best;
}

/// The pieces of a cell as numbers, for other ranks.
void Write(const CellPieces& cell, std::vector<double>& numbers)
{
  numbers.push_back(cell.Full ? 1.0 : 0.0);
  numbers.push_back(static_cast<double>(cell.Points.size()));
  for (const Vec3& p : cell.Points)
  {
    numbers.insert(numbers.end(), { p.x, p.y, p.z });
  }
  numbers.push_back(static_cast<double>(cell.Loops.size()));
  for (const auto& loop : cell.Loops)
  {
    numbers.push_back(static_cast<double>(loop.size()));
    numbers.insert(numbers.end(), loop.begin(), loop.end());
  }
}
CellPieces Read(const double*& at)
{
  CellPieces cell;
  cell.Full = *at++ != 0.0;
  cell.Points.resize(static_cast<std::size_t>(*at++));
  for (Vec3& p : cell.Points)
  {
    p = { at[0], at[1], at[2] };
    at += 3;
  }
  cell.Loops.resize(static_cast<std::size_t>(*at++));
  for (auto& loop : cell.Loops)
  {
    loop.resize(static_cast<std::size_t>(*at++));
    for (auto& corner : loop)
    {
      corner = static_cast<std::int32_t>(*at++);
    }
  }
  return cell;
}

/// Cell c was cut by rank c % Size(): each gets the pieces of all.
void Exchange(const Communicator& ranks, std::vector<CellPieces>& cells, std::atomic<bool>& expired)
{
  const auto size = static_cast<std::size_t>(ranks.Size());
  const auto own = static_cast<std::size_t>(ranks.Rank());
  std::vector<double> mine;
  for (std::size_t c = own; c < cells.size(); c += size)
  {
    Write(cells[c], mine);
  }
  std::vector<double> lengths(size, 0.0);
  lengths[own] = static_cast<double>(mine.size());
  ranks.Largest(lengths.data(), size);
  std::vector<std::size_t> begin(1, 0);
  for (const double length : lengths)
  {
    begin.push_back(begin.back() + static_cast<std::size_t>(length));
  }
  std::vector<double> all(begin.back());
  std::copy(mine.begin(), mine.end(), all.begin() + static_cast<std::ptrdiff_t>(begin[own]));
  ranks.Gather(all.data(), begin);
  for (std::size_t r = 0; r < size; ++r)
  {
    const double* at = all.data() + begin[r];
    for (std::size_t c = r; c < cells.size(); c += size)
    {
      cells[c] = Read(at);
    }
  }
  double late = expired ? 1.0 : 0.0;
  ranks.Largest(&late, 1);
  expired = late > 0.0;
}

} // namespace

ShadowPieces CutAlongShadows(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool backFaces, std::size_t most, const StageProgress& stage)
{
  const std::vector<std::vector<std::int32_t>> triangles = TrianglesOfCells(scene);
  std::vector<CellPieces> cells(scene.Cells);
  const ConvergenceRecord clock;
  std::atomic<bool> expired{ false };
  if (options.Occlusion && !scene.Triangles.empty())
  {
    StageProgress preparing = stage;
    preparing.End = 0.5 * (stage.Begin + stage.End);
    const CellCutter cutter(
      scene, occluders, options, backFaces, std::max<std::size_t>(1, most), preparing);
    StageProgress cutting = stage;
    cutting.Begin = preparing.End;
    // Of several ranks each cuts its share.
    const std::size_t first =
      options.Ranks ? static_cast<std::size_t>(options.Ranks->Rank()) : std::size_t{ 0 };
    const std::size_t step =
      options.Ranks ? static_cast<std::size_t>(options.Ranks->Size()) : std::size_t{ 1 };
    const std::size_t count = scene.Cells > first ? (scene.Cells - first + step - 1) / step : 0;
    ParallelFor(count, options.Threads, cutting,
      [&](std::size_t k) {
        const std::size_t c = first + k * step;
        if (options.SecondsLeft > 0.0 && clock.Elapsed() > 0.5 * options.SecondsLeft)
        {
          expired = true;
        }
        else if (!triangles[c].empty())
        {
          cells[c] = cutter.Cut(triangles[c]);
        }
      },
      1e-5);
    if (options.Ranks)
    {
      Exchange(*options.Ranks, cells, expired);
    }
  }
  ShadowPieces pieces;
  pieces.TimedOut = expired;
  pieces.First.push_back(0);
  std::unordered_map<std::array<double, 3>, std::int32_t, PointHash> numbers;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const CellPieces& cell = cells[c];
    pieces.Full += cell.Full ? 1 : 0;
    std::vector<std::int32_t> number;
    for (const Vec3& p : cell.Points)
    {
      const auto [at, isNew] = numbers.emplace(
        std::array<double, 3>{ p.x, p.y, p.z }, static_cast<std::int32_t>(pieces.Points.size()));
      number.push_back(at->second);
      if (isNew)
      {
        pieces.Points.push_back(p);
      }
    }
    for (const auto& loop : cell.Loops)
    {
      for (const std::int32_t p : loop)
      {
        pieces.Corners.push_back(number[p]);
      }
      pieces.First.push_back(pieces.Corners.size());
      pieces.Cell.push_back(static_cast<std::int32_t>(c));
      pieces.Whole.push_back(0);
    }
    if (cell.Loops.empty())
    {
      pieces.First.push_back(pieces.Corners.size());
      pieces.Cell.push_back(static_cast<std::int32_t>(c));
      pieces.Whole.push_back(1);
    }
  }
  return pieces;
}

std::vector<Patch> MakePatches(const Scene& scene, const ShadowPieces& pieces, bool backFaces)
{
  const std::vector<std::vector<std::int32_t>> triangles = TrianglesOfCells(scene);
  std::vector<Patch> patches;
  for (int side = 0; side < (backFaces ? 2 : 1); ++side)
  {
    const auto add = [&](Triangle3 corners, std::int32_t t, std::size_t piece) {
      if (side == 1)
      {
        std::swap(corners[1], corners[2]);
      }
      patches.push_back(
        { corners, t, static_cast<std::int32_t>(piece), static_cast<std::uint8_t>(side) });
    };
    for (std::size_t i = 0; i < pieces.Size(); ++i)
    {
      const std::int32_t cell = pieces.Cell[i];
      if (side == 1 && !scene.Optics.TwoSided[cell])
      {
        continue;
      }
      if (pieces.Whole[i])
      {
        for (const std::int32_t t : triangles[cell])
        {
          add(scene.TriangleAt(static_cast<std::size_t>(t)), t, i);
        }
        continue;
      }
      for (std::size_t k = pieces.First[i] + 2; k < pieces.First[i + 1]; ++k)
      {
        const Triangle3 fan{ pieces.Points[pieces.Corners[pieces.First[i]]],
          pieces.Points[pieces.Corners[k - 1]], pieces.Points[pieces.Corners[k]] };
        if (Area(fan) > 0.0)
        {
          add(fan, TriangleUnder(scene, triangles[cell], Centroid(fan)), i);
        }
      }
    }
  }
  return patches;
}

} // namespace radiometry
