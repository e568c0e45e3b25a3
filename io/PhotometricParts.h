// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/PhotometricFile.h"
#include "io/PhotometricText.h"

namespace radiometry::io
{

/// What the parsers give before units and flux are looked at: PhotometricFile with its web; Greatest
/// in the file's own unit.
PhotometricFile ParseIes(const PhotometricText& text, const PhotometricOptions& options);
PhotometricFile ParseLdt(const PhotometricText& text, const PhotometricOptions& options);

/// The opening that LM-63 says by the signs of width (along y), length (along x) and height, in
/// metres. What a width and a height below 0 without a length mean changed with the version of 2002.
LuminousOpening IesOpening(double width, double length, double height, int version);

/// A number for messages.
std::string Say(double value);

} // namespace radiometry::io
