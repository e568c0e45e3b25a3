// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ExrImage.h"

namespace radiometry::io
{

struct ExrWriteOptions
{
  /// NaN and infinities are written as they are. Else the first one is an error that names
  /// channel, pixel and value, and nothing is written.
  bool KeepNonFinite = false;
  /// Threads that pack pixels (0: all). The bytes of the file do not depend on it.
  int Threads = 0;
};

/// Writes an OpenEXR file of one part or several, scan lines or tiles.
///
///   Cost    one pass over the pixels to check them, one to pack them; memory for some lines
///   Fails   FileError: no channels, a window that is empty or does not fit the channels, a name
///           twice, NaN or infinity (see options), a value that the pixel type cannot hold (more
///           than 65504 for half; a negative value or a fraction for uint), the system's reason
///           where the file cannot be written; parts that differ in what the format makes them share
///           (display window, aspect ratio of pixels, chromaticities). The target is then what it was before.
///
/// The file appears under its name when it is complete (AsideFile). Float values reach the file
/// bit by bit with every compression up to PIZ; double values are rounded to float.
void WriteExr(
  const std::string& fileName, const ExrImage& image, const ExrWriteOptions& options = {});

} // namespace radiometry::io
