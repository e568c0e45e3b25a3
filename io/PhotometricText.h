// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FileError.h"

#include <cstddef>
#include <string>
#include <vector>

namespace radiometry::io
{

/// A text file by lines, as UTF-8: any of the three line ends, a byte order mark removed, bytes that
/// are no UTF-8 taken as Latin-1.
class PhotometricText
{
public:
  /// Fails: FileError when it cannot be read, is empty, binary or above 64 MiB.
  explicit PhotometricText(const std::string& fileName);

  std::size_t Lines() const { return this->Text.size(); }
  /// Line k (from 0) without blanks around it; empty beyond the end.
  std::string Line(std::size_t k) const;
  const std::string& Name() const { return this->FileName; }
  /// Throws FileError "NAME: line k+1: what".
  [[noreturn]] void Fail(std::size_t line, const std::string& what) const;

  /// The number that a whole text is; comma or point before the decimals.
  static bool IsNumber(std::string text, double& value);

private:
  std::string FileName;
  std::vector<std::string> Text;
};

/// The numbers of LM-63's data, one after another: blanks, commas and line ends part them.
class PhotometricNumbers
{
public:
  PhotometricNumbers(const PhotometricText& text, std::size_t firstLine);

  /// The next number. Fails: FileError with `what` it should have been.
  double Next(const std::string& what);
  /// The same for a count that the rest of the file must have room for.
  std::size_t NextCount(const std::string& what, std::size_t least);
  std::vector<double> Next(std::size_t count, const std::string& what);
  /// Numbers that are left.
  std::size_t Left();
  /// The line of the number read last (from 0).
  std::size_t Line() const { return this->LastLine; }
  [[noreturn]] void Fail(const std::string& what) const { this->Text.Fail(this->LastLine, what); }

private:
  double Next(const std::string& what, std::size_t k, std::size_t count);
  bool Token(std::string& token);

  const PhotometricText& Text;
  std::size_t NextLine;
  std::size_t LastLine;
  std::string Rest;
  std::size_t At = 0;
};

} // namespace radiometry::io
