// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace radiometry
{

/// The one exception of the core for input that cannot be computed with: it names the array, the
/// index (tuple; -1 where the array as a whole is meant), the offending value and what was expected.
class InputError : public std::runtime_error
{
public:
  InputError(std::string array, long long index, std::string value, std::string expected);
  /// The same for a number, printed so that it reads back exactly.
  InputError(std::string array, long long index, double value, std::string expected);

  const std::string Array;
  const long long Index;
  const std::string Value;
  const std::string Expected;
};

/// Thrown from inside a computation when its Monitor asked to stop. Not an error: the caller
/// reports "aborted" and writes nothing.
class Aborted : public std::runtime_error
{
public:
  Aborted()
    : std::runtime_error("aborted")
  {
  }
};

} // namespace radiometry
