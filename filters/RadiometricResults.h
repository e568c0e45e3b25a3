// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RadiometricJob.h"
#include "RunReport.h"
#include "SceneAdapter.h"

#include "radiometry/irradiance/LightVisibility.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class SurfacePoints;
class vtkCompositeDataSet;
class vtkDataObject;
class vtkFieldData;
class vtkPolyData;

/// Hands the shares of lights of front and back over, where there are any.
void AddShares(std::array<radiometry::LightShares, 2>& computed,
  std::vector<vtkRadiometricFilter::Result::Shares>& shares);

/// What the run left out and what its errors are made of.
PlanReport ReportPlan(const vtkRadiometricFilter::Result& result);

/// Writes what a simulating filter computed onto its outputs.
class RadiometricResults
{
public:
  using Result = vtkRadiometricFilter::Result;

  /// `efficacy` above 0: photometric arrays are added [lm/W]. `wavelengths` [nm] of the bands: these
  /// arrays are then weighted by V(lambda), and the outputs state the wavelengths; may be empty.
  RadiometricResults(int bands, double efficacy, std::vector<double> wavelengths,
    std::string filter, std::string options)
    : Bands(bands)
    , Efficacy(efficacy)
    , Wavelengths(std::move(wavelengths))
    , Filter(std::move(filter))
    , Options(std::move(options))
  {
  }

  /// `blocks`: those of the adapter, or what became of them when cells were cut.
  void WriteSurface(const Result& result, const std::vector<SceneAdapter::Block>& blocks,
    const SurfacePoints& points, vtkDataObject* output, vtkDataObject* input) const;

private:
  /// `numbers`: where each item's value is (below 0: it has none); empty: one after the other from
  /// `first`.
  void AddArrays(const std::vector<Result::Quantity>& quantities, std::size_t first,
    const std::vector<std::int32_t>& numbers, vtkIdType count, vtkFieldData* data) const;
  static void AddLightShares(const std::vector<Result::Shares>& shares, std::size_t lights,
    std::size_t first, const std::vector<std::int32_t>& numbers, vtkIdType count,
    vtkFieldData* data);
  static void AddScalars(const std::vector<Result::Scalars>& scalars, std::size_t first,
    const std::vector<std::int32_t>& numbers, vtkIdType count, vtkFieldData* data);
  void AddFieldData(const Result& result, vtkDataObject* output) const;

  int Bands;
  double Efficacy;
  std::vector<double> Wavelengths;
  std::string Filter;
  std::string Options;
};
