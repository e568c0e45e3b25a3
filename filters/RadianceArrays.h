// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RadiometricJob.h"
#include "SceneAdapter.h"
#include "SurfacePoints.h"
#include "radiometry/irradiance/IrradianceSimulation.h"

#include <array>
#include <string>
#include <vector>

/// What a surface brings along of an earlier simulation: Radiosity or Irradiance of its cells or points.
struct SurfaceLight
{
  bool Radiosity = false; // else Irradiance
  bool Any = false;       // false: the surface has neither
  /// Front and back, cells x bands; of points: the mean of a cell's corners. Empty: not there.
  std::array<radiometry::FieldValues, 2> Cells;
  /// The same at Job::Points, where the input has values at points and they are wanted there.
  std::array<radiometry::FieldValues, 2> Points;
};

/// Finds and checks the arrays.
///   Fails  InputError naming the array of the block: values negative or not finite, other components
///          than the scene's bands, some blocks without
SurfaceLight ReadSurfaceLight(const vtkRadiometricFilter::Job& job);

/// LightVisibility of the cells or points, receivers x lights; empty where there is none of that many
/// lights.
std::vector<float> ReadLightVisibility(const vtkRadiometricFilter::Job& job);

/// Whether cells (or points) of some block carry Radiosity or Irradiance.
bool CarryLight(const std::vector<SceneAdapter::Block>& blocks, bool points);
