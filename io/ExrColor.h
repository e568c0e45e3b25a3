// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ExrImage.h"

namespace radiometry::io
{

/// What R, G, B of a part mean: its attribute "chromaticities", else Rec.709 as the format says.
ExrChromaticities ChromaticitiesOf(const ExrPart& part);

/// Takes R, G, B of a part to linear Rec.709 by its chromaticities; the attribute then says so.
///   Model   the same CIE XYZ, white (1, 1, 1) having Y = 1 in both: whites are not adapted, as the
///           format's own examples want it (their four pictures then look alike)
///   Reads   R, G and B of full sampling; parts without them, and those in Rec.709, stay as they are
///   Writes  float samples
///   Fails   FileError for chromaticities that make no colour space (primaries on a line, a white
///           without luminance, a value that is not finite)
void ConvertToRec709(const std::string& fileName, ExrPart& part);

/// Replaces luminance and chroma, channels Y, RY = (R - Y)/Y and BY = (B - Y)/Y, by R, G, B; parts
/// without these three, or with an R, stay as they are.
///   Model   R = (RY + 1) Y, B = (BY + 1) Y, G from Y as the chromaticities weigh it. Chroma of every
///           second pixel or line is interpolated by six taps of a windowed sine (Lanczos, 3 lobes),
///           of any other sampling repeated
///   Writes  float samples
///   Fails   as ConvertToRec709
void DecodeLuminanceChroma(const std::string& fileName, ExrPart& part);

} // namespace radiometry::io
