// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ExrImage.h"

namespace radiometry::io
{

/// How a part holds a picture of all directions: its attribute "envmap", "latlong" or "cube"; empty
/// where it does not say.
std::string EnvironmentKind(const ExrPart& part);

/// A cube map (six square faces below each other, in the format's order and orientation) as a
/// lat-long picture of the same directions; anything else stays as it is.
///   Model   each pixel is the mean of the cube over it, taken bilinearly within a face at 4 x 4
///           points (2 x 2 for faces of 512 and more)
///   Writes  4n x 2n pixels for faces of n x n, as floats; all channels of full sampling. Pixels are
///           areas: the first row begins at latitude 90 degrees, the first column at longitude 180,
///           +y is up, +z in the middle, +x to the left of it
///   Cost    some 100 million lookups a channel for faces of 1024
///   Fails   FileError for a cube that is not six times as high as wide, and for sub-sampled channels
///   Source  OpenEXR, Technical Introduction and ImfEnvmap.h
ExrPart ToLatLong(const std::string& fileName, const ExrPart& part);

} // namespace radiometry::io
