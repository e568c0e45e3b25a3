// SPDX-License-Identifier: BSD-3-Clause
#include "PhotometricNames.h"

#include "radiometry/scene/ArrayNames.h"

#include <array>

namespace names = radiometry::names;

namespace
{

constexpr std::array<Photometry, 5> PhotometricNames{ Photometry{ names::Irradiance,
                                                        names::Illuminance, "lx" },
  Photometry{ names::Radiosity, names::LuminousExitance, "lm/m^2" },
  Photometry{ names::Radiance, names::Luminance, "cd/m^2" },
  Photometry{ names::Dose, names::LuminousExposure, "lx s" },
  Photometry{ names::ImageIrradiance, names::ImageIlluminance, "lx" } };

} // namespace

const Photometry* Counterpart(const std::string& name, std::string& renamed)
{
  for (const Photometry& p : PhotometricNames)
  {
    if (name == p.Radiometric || name == std::string(p.Radiometric) + names::BackSuffix)
    {
      renamed = p.Photometric + name.substr(std::string(p.Radiometric).size());
      return &p;
    }
  }
  return nullptr;
}
