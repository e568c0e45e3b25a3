// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/PolygonFormFactor.h"

namespace radiometry
{

/// The double contour integral (1/2pi) contour int contour int ln r dr_i.dr_j of two convex
/// polygons that lie wholly in front of each other. `error` gets the estimated error: what the
/// last halving of the step changed, and the digits that the sum of the edges lost, which `lost` gets
/// by themselves. Ends when `error` is below the relative tolerance, or `absolute` (m^2).
double ContourExchange(const SmallPolygon& outer, const SmallPolygon& inner,
  double relativeTolerance, double absolute, double& error, double& lost);

} // namespace radiometry
