// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/SkyRadiance.h"

#include <memory>
#include <string>

class vtkImageData;

/// The map of an OpenEXR file, lat-long or (attribute envmap) a cube: R, G, B, taken to Rec.709 by the
/// file's chromaticities, as three bands, else its only channel (or Y, or the
/// first) as one. `grey`: three bands become their luminance.
/// Fails: radiometry::InputError naming FileName, or EnvironmentMap with pixel and value.
std::shared_ptr<const radiometry::SkyRadiance> ReadPicture(const std::string& file, bool grey);

/// The map of an image's active point scalars, a band a component (of four, the last is alpha and
/// not used); its row 0 is the lowest.
std::shared_ptr<const radiometry::SkyRadiance> PictureOf(vtkImageData* image, bool grey);
