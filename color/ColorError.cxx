// SPDX-License-Identifier: BSD-3-Clause
#include "color/ColorError.h"

#include <algorithm>
#include <cctype>

namespace radiometry::color
{
namespace
{

/// OpenColorIO's messages have several lines, and quote what they found.
std::string OneLine(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

} // namespace

ColorError::ColorError(const std::string& message)
  : std::runtime_error(OneLine(message))
{
}

} // namespace radiometry::color
