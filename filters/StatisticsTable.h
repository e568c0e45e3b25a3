// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StatisticsBlocks.h"

#include "radiometry/accuracy/AreaStatistics.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

class vtkTable;

/// Statistics of one array's component over a surface or one of its groups of cells.
struct StatisticsEntry
{
  explicit StatisticsEntry(const std::vector<double>& thresholds, bool keepPieces = false)
    : Values(thresholds.begin(), thresholds.end())
    , KeepPieces(keepPieces)
  {
  }
  std::vector<radiometry::AreaStatisticsCollector> Values; // one a threshold
  bool KeepPieces;
  radiometry::AreaQuantiles Quantiles; // where pieces are kept
  std::string Name;
  vtkIdType Cells = 0;
  vtkIdType LastCell = -1;

  void Add(const StatisticsField& field, const SurfacePiece& piece, int component);
};

struct StatisticsKey
{
  long long Group; // everyGroup: all cells
  std::string Array;
  int Component;
  bool operator<(const StatisticsKey& o) const
  {
    return std::tie(this->Group, this->Array, this->Component) <
      std::tie(o.Group, o.Array, o.Component);
  }
};

/// Collects the rows of vtkRadiometricStatistics' table and writes it.
class StatisticsTable
{
public:
  /// `thresholds`: at least one. `percentiles`: in (0, 100), any number. `groupArray`: may be empty.
  /// `withWhole`: a first block "(all)".
  StatisticsTable(std::vector<double> thresholds, std::vector<double> percentiles,
    std::string groupArray, bool withWhole)
    : Thresholds(std::move(thresholds))
    , Percentiles(std::move(percentiles))
    , GroupArray(std::move(groupArray))
    , WithWhole(withWhole)
  {
  }
  /// Adds the arrays of one block that it has.
  ///   Fails   radiometry::InputError: values not finite, a group below 0
  void Add(const StatisticsBlock& block, const std::vector<SurfacePiece>& pieces,
    const std::vector<std::string>& arrays);
  /// By block, then array as listed here, then group, then component.
  void Write(const std::vector<std::string>& arrays, vtkTable* table) const;

private:
  using Entries = std::map<StatisticsKey, StatisticsEntry>;
  void AddArray(const StatisticsBlock& block, const std::vector<SurfacePiece>& pieces,
    const std::string& array, Entries& entries);

  std::vector<double> Thresholds;
  std::vector<double> Percentiles;
  std::string GroupArray;
  bool WithWhole;
  Entries Whole;
  std::vector<std::pair<std::string, Entries>> Parts;
};
