// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace radiometry::color
{

/// The one exception of this folder: a config that is missing or broken, a name that a config
/// does not have, a transform that OpenColorIO cannot build. The text is one line and says
/// what, and what there is instead.
class ColorError : public std::runtime_error
{
public:
  explicit ColorError(const std::string& message);
};

} // namespace radiometry::color
