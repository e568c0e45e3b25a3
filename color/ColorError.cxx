// SPDX-License-Identifier: BSD-3-Clause
#include "color/ColorError.h"

namespace radiometry::color
{

ColorError::ColorError(const std::string& message)
  : std::runtime_error(message)
{
}

} // namespace radiometry::color
