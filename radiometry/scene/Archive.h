// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace radiometry
{

/// Writes values and arrays of values, in the machine's own byte order, and sums what it wrote (FNV-1a)
/// so that a reader knows damage.
class ArchiveWriter
{
public:
  explicit ArchiveWriter(std::ostream& stream)
    : Stream(stream)
  {
  }

  template <class T>
  void Put(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Bytes(&value, sizeof(T));
  }
  template <class T>
  void Put(const std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Put(static_cast<std::uint64_t>(values.size()));
    this->Bytes(values.data(), values.size() * sizeof(T));
  }
  void Put(const std::string& text)
  {
    this->Put(std::vector<char>(text.begin(), text.end()));
  }
  /// The sum of all so far.
  std::uint64_t Checksum() const { return this->Sum; }

private:
  void Bytes(const void* data, std::size_t count)
  {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < count; ++k)
    {
      this->Sum = (this->Sum ^ bytes[k]) * 1099511628211ull;
    }
    this->Stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
    if (!this->Stream)
    {
      throw std::runtime_error("could not be written");
    }
  }

  std::ostream& Stream;
  std::uint64_t Sum = 14695981039346656037ull;
};

/// Reads what ArchiveWriter wrote, in the same order. Throws std::runtime_error where it ends early
/// or an array is longer than `most` bytes.
class ArchiveReader
{
public:
  ArchiveReader(std::istream& stream, std::uint64_t most)
    : Stream(stream)
    , Most(most)
  {
  }

  template <class T>
  T Get()
  {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    this->Bytes(&value, sizeof(T));
    return value;
  }
  template <class T>
  void Get(std::vector<T>& values)
  {
    const auto count = this->Get<std::uint64_t>();
    if (count > this->Most / sizeof(T))
    {
      throw std::runtime_error("is damaged: an array is longer than the file");
    }
    values.resize(static_cast<std::size_t>(count));
    this->Bytes(values.data(), values.size() * sizeof(T));
  }
  std::string GetText()
  {
    std::vector<char> text;
    this->Get(text);
    return { text.begin(), text.end() };
  }
  std::uint64_t Checksum() const { return this->Sum; }

private:
  void Bytes(void* data, std::size_t count)
  {
    this->Stream.read(static_cast<char*>(data), static_cast<std::streamsize>(count));
    if (static_cast<std::size_t>(this->Stream.gcount()) != count)
    {
      throw std::runtime_error("ends early");
    }
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < count; ++k)
    {
      this->Sum = (this->Sum ^ bytes[k]) * 1099511628211ull;
    }
  }

  std::istream& Stream;
  std::uint64_t Most;
  std::uint64_t Sum = 14695981039346656037ull;
};

} // namespace radiometry
