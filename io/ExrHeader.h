// SPDX-License-Identifier: BSD-3-Clause
// Private to io/: between ExrPart and OpenEXR's header.
#pragma once

#include "io/ExrImage.h"

#include <ImfHeader.h>

namespace radiometry::io
{

/// The number of samples of a channel in [min, max], both included.
long long CountSamples(int sampling, int min, int max);

/// What an ExrPart says, as a header. Fails with FileError for what a file cannot say.
Imf::Header MakeHeader(const std::string& fileName, const ExrPart& part, bool named);

/// The other way; channels come without data.
ExrPart ReadHeader(const Imf::Header& header);

/// The scan lines that are packed together, and so the fewest that can be unpacked.
int LinesPerChunk(Imf::Compression compression);

} // namespace radiometry::io
