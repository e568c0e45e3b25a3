// SPDX-License-Identifier: BSD-3-Clause
#include "io/FileError.h"

namespace radiometry::io
{

FileError::FileError(const std::string& file, const std::string& what)
  : std::runtime_error(file + ": " + what)
{
}

} // namespace radiometry::io
