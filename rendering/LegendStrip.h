// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: a legend drawn into bytes.
#ifndef LegendStrip_h
#define LegendStrip_h

#include "radiometry/imaging/FalseColor.h"

#include <string>
#include <utility>
#include <vector>

/// A label beside the bar, at a height in [0, 1].
using LegendTick = std::pair<double, std::string>;

/// What fits a picture of so many rows.
int LegendStripWidth(int height);

/// A number as legends show it: three digits, or the integer from 100 to 1e6.
std::string LegendNumber(double value);

/// The limits of the bands, or round values of a continuous scale, as many as have room.
std::vector<LegendTick> LegendTicks(
  const radiometry::imaging::FalseColorMap& map, radiometry::imaging::ColorScale scale, int height);

/// Draws bar, ticks and title (two lines: what, unit) into columns x to x + LegendStripWidth of an image
/// of `columns` columns, RGB, from the bottom row up. The bar has the map's very colours.
void DrawLegendStrip(std::vector<unsigned char>& rgb, int columns, int height, int x,
  const radiometry::imaging::FalseColorMap& map, const std::vector<LegendTick>& ticks,
  const std::string& title, const std::string& unit);

#endif
