// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace radiometry::io
{

/// The exception of this folder: a file that cannot be read or written, or an image that cannot
/// be put into one. The text is one line and begins with the file's name.
class FileError : public std::runtime_error
{
public:
  FileError(const std::string& file, const std::string& what);
};

} // namespace radiometry::io
