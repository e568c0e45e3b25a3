// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FileError.h"

#include <cstdint>
#include <string>

namespace radiometry::io
{

/// A file that is written aside and takes its name only when it is complete.
///
/// Readers of the name see the old file or the new one, never a part. A process that dies on the
/// way leaves nothing: where the file system allows it the file has no name at all until Commit
/// (O_TMPFILE); elsewhere it is called ".NAME.PID.tmp" beside the target and is removed by the
/// destructor. A symbolic link is followed, so that the link stays a link.
///   Fails   FileError with the reason of the system: no such folder, no right to write, disk full
class AsideFile
{
public:
  explicit AsideFile(const std::string& fileName);
  ~AsideFile();
  AsideFile(const AsideFile&) = delete;
  AsideFile& operator=(const AsideFile&) = delete;

  void Write(const void* bytes, std::size_t n);
  std::uint64_t Tell();
  void Seek(std::uint64_t position);
  /// Brings everything to the disk and gives the file its name, replacing what had it.
  void Commit();

private:
  void Flush();
  [[noreturn]] void Fail(const std::string& step);

  std::string FileName; ///< as the caller said
  std::string Target;   ///< with links followed
  std::string Aside;    ///< empty while the file has no name
  std::string Buffer;
  int Descriptor = -1;
  bool Broken = false; ///< something failed before: never commit
};

} // namespace radiometry::io
