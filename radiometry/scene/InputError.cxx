// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/InputError.h"

#include <cstdio>
#include <utility>

namespace radiometry
{
namespace
{

std::string Message(
  const std::string& array, long long index, const std::string& value, const std::string& expected)
{
  std::string text = array;
  if (index >= 0)
  {
    text += "[" + std::to_string(index) + "]";
  }
  return text + " = " + value + ": expected " + expected;
}

std::string Number(double value)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

} // namespace

InputError::InputError(std::string array, long long index, std::string value, std::string expected)
  : std::runtime_error(Message(array, index, value, expected))
  , Array(std::move(array))
  , Index(index)
  , Value(std::move(value))
  , Expected(std::move(expected))
{
}

InputError::InputError(std::string array, long long index, double value, std::string expected)
  : InputError(std::move(array), index, Number(value), std::move(expected))
{
}

} // namespace radiometry
