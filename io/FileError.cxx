// SPDX-License-Identifier: BSD-3-Clause
#include "io/FileError.h"

namespace radiometry::io
{
namespace
{

/// The number of bytes of the UTF-8 character at `at`; 0 where there is none.
std::size_t CharacterLength(const std::string& text, std::size_t at)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  const std::size_t length = first < 0x80 ? 1
    : first >= 0xC2 && first < 0xE0       ? 2
    : first >= 0xE0 && first < 0xF0       ? 3
    : first >= 0xF0 && first < 0xF5       ? 4
                                          : 0;
  for (std::size_t i = 1; i < length; ++i)
  {
    if (at + i >= text.size() || byte(at + i) < 0x80 || byte(at + i) >= 0xC0)
    {
      return 0;
    }
  }
  return length;
}

/// One line of readable text: a damaged file gives names of any bytes.
std::string OneLine(const std::string& text)
{
  std::string line;
  for (std::size_t i = 0; i < text.size();)
  {
    const std::size_t length = CharacterLength(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    if (length == 0 || (length == 1 && (first < 0x20 || first == 0x7F)))
    {
      line += first == '\n' || first == '\t' ? ' ' : '?';
      ++i;
      continue;
    }
    line.append(text, i, length);
    i += length;
  }
  return line;
}

} // namespace

FileError::FileError(const std::string& file, const std::string& what)
  : std::runtime_error(OneLine(file + ": " + what))
{
}

} // namespace radiometry::io
