// SPDX-License-Identifier: BSD-3-Clause
#include "io/PhotometricText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace radiometry::io
{
namespace
{

constexpr std::uintmax_t MostBytes = std::uintmax_t(64) << 20;

bool IsBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r' || c == '\x1a';
}

std::string Trimmed(const std::string& text)
{
  std::size_t from = 0;
  std::size_t to = text.size();
  while (from < to && IsBlank(text[from]))
  {
    ++from;
  }
  while (to > from && IsBlank(text[to - 1]))
  {
    --to;
  }
  return text.substr(from, to - from);
}

bool IsUtf8(const std::string& text)
{
  std::size_t more = 0;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (more > 0)
    {
      if ((byte & 0xC0) != 0x80)
      {
        return false;
      }
      --more;
    }
    else if (byte >= 0x80)
    {
      more = byte >= 0xF0 && byte < 0xF5 ? 3 : (byte >= 0xE0 && byte < 0xF0 ? 2 : (byte >= 0xC2 && byte < 0xE0 ? 1 : 0));
      if (more == 0)
      {
        return false;
      }
    }
  }
  return more == 0;
}

std::string FromLatin1(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
    {
      out += c;
    }
    else
    {
      out += static_cast<char>(0xC0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

} // namespace

PhotometricText::PhotometricText(const std::string& fileName)
  : FileName(fileName)
{
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(fileName, error))
  {
    throw FileError(fileName, "no such file");
  }
  if (!fs::is_regular_file(fileName, error))
  {
    throw FileError(fileName, "not a file");
  }
  if (fs::file_size(fileName, error) > MostBytes)
  {
    throw FileError(fileName, "above 64 MiB: no photometric file");
  }
  std::ifstream in(fileName, std::ios::binary);
  std::ostringstream buffer;
  buffer << in.rdbuf();
  std::string bytes = buffer.str();
  if (!in || bytes.empty())
  {
    throw FileError(fileName, in ? "is empty" : "cannot be read");
  }
  if (bytes.compare(0, 3, "\xEF\xBB\xBF") == 0)
  {
    bytes.erase(0, 3);
  }
  if (bytes.find('\0') != std::string::npos)
  {
    throw FileError(fileName, "not a text file");
  }
  std::string line;
  const auto finish = [&] {
    this->Text.push_back(IsUtf8(line) ? line : FromLatin1(line));
    line.clear();
  };
  for (std::size_t k = 0; k < bytes.size(); ++k)
  {
    if (bytes[k] == '\n' || bytes[k] == '\r')
    {
      finish();
      k += bytes[k] == '\r' && k + 1 < bytes.size() && bytes[k + 1] == '\n' ? 1 : 0;
    }
    else
    {
      line += bytes[k];
    }
  }
  if (!line.empty())
  {
    finish();
  }
}

std::string PhotometricText::Line(std::size_t k) const
{
  return k < this->Text.size() ? Trimmed(this->Text[k]) : std::string();
}

void PhotometricText::Fail(std::size_t line, const std::string& what) const
{
  throw FileError(this->FileName, "line " + std::to_string(line + 1) + ": " + what);
}

bool PhotometricText::IsNumber(std::string text, double& value)
{
  text = Trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
  {
    text = text.substr(1, text.size() - 2);
  }
  std::replace(text.begin(), text.end(), ',', '.');
  if (text.empty() || text.size() > 400 ||
    text.find_first_not_of("+-.0123456789eE") != std::string::npos)
  {
    return false;
  }
  // Not strtod, which would follow the language of the system.
  const char* first = text.data() + (text.front() == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc() && end == last && std::isfinite(value);
}

PhotometricNumbers::PhotometricNumbers(const PhotometricText& text, std::size_t firstLine)
  : Text(text)
  , NextLine(firstLine)
  , LastLine(firstLine)
{
}

bool PhotometricNumbers::Token(std::string& token)
{
  const auto parts = [](char c) { return IsBlank(c) || c == ',' || c == ';'; };
  for (;;)
  {
    while (this->At < this->Rest.size() && parts(this->Rest[this->At]))
    {
      ++this->At;
    }
    if (this->At < this->Rest.size())
    {
      break;
    }
    if (this->NextLine >= this->Text.Lines())
    {
      return false;
    }
    this->LastLine = this->NextLine;
    this->Rest = this->Text.Line(this->NextLine++);
    this->At = 0;
  }
  const std::size_t from = this->At;
  while (this->At < this->Rest.size() && !parts(this->Rest[this->At]))
  {
    ++this->At;
  }
  token = this->Rest.substr(from, this->At - from);
  return true;
}

double PhotometricNumbers::Next(const std::string& what)
{
  return this->Next(what, 0, 0);
}

double PhotometricNumbers::Next(const std::string& what, std::size_t k, std::size_t count)
{
  const auto whole = [&] {
    return count == 0 ? what : what + " " + std::to_string(k + 1) + " of " + std::to_string(count);
  };
  std::string token;
  if (!this->Token(token))
  {
    this->Text.Fail(this->Text.Lines(), "the file ends where " + whole() + " should stand");
  }
  double value = 0.0;
  if (!PhotometricText::IsNumber(token, value))
  {
    this->Fail("\"" + token.substr(0, 40) + "\" where " + whole() + " should stand");
  }
  return value;
}

std::size_t PhotometricNumbers::NextCount(const std::string& what, std::size_t least)
{
  const double value = this->Next(what);
  // No file has room for more numbers than bytes.
  if (value != std::floor(value) || value < static_cast<double>(least) || value > 1e7)
  {
    std::ostringstream text;
    text << what << " is " << value << ": expected a whole number of at least " << least;
    this->Fail(text.str());
  }
  return static_cast<std::size_t>(value);
}

std::vector<double> PhotometricNumbers::Next(std::size_t count, const std::string& what)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
  {
    values.push_back(this->Next(what, k, count));
  }
  return values;
}

std::size_t PhotometricNumbers::Left()
{
  std::size_t count = 0;
  std::string token;
  while (this->Token(token))
  {
    ++count;
  }
  return count;
}

} // namespace radiometry::io
