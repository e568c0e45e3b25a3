// SPDX-License-Identifier: BSD-3-Clause
#include "io/AsideFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace radiometry::io
{
namespace
{

constexpr std::size_t bufferSize = 1 << 18;

/// Names beside the target, tried in turn.
std::string NameAside(const std::filesystem::path& target, int attempt)
{
  const std::string name = "." + target.filename().string() + "." + std::to_string(getpid()) +
    (attempt ? "-" + std::to_string(attempt) : "") + ".tmp";
  return (target.parent_path() / name).string();
}

} // namespace

AsideFile::AsideFile(const std::string& fileName)
  : FileName(fileName)
{
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path target = fileName;
  if (fileName.empty())
  {
    throw FileError("''", "no file name was given");
  }
  if (fs::exists(target, error) && !fs::is_regular_file(target, error))
  {
    throw FileError(fileName, "exists and is not a regular file");
  }
  if (fs::is_symlink(target, error))
  {
    const fs::path resolved = fs::weakly_canonical(target, error);
    target = error ? target : resolved;
  }
  this->Target = target.string();
  const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";

#ifdef O_TMPFILE
  this->Descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
#endif
  for (int attempt = 0; this->Descriptor < 0 && attempt < 100; ++attempt)
  {
    this->Aside = NameAside(target, attempt);
    this->Descriptor = open(this->Aside.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (this->Descriptor < 0 && errno != EEXIST)
    {
      break;
    }
  }
  if (this->Descriptor < 0)
  {
    this->Aside.clear();
    this->Fail("cannot be written");
  }
}

AsideFile::~AsideFile()
{
  if (this->Descriptor >= 0)
  {
    close(this->Descriptor);
  }
  if (!this->Aside.empty())
  {
    unlink(this->Aside.c_str());
  }
}

void AsideFile::Fail(const std::string& step)
{
  this->Broken = true;
  throw FileError(this->FileName, step + ": " + std::strerror(errno));
}

void AsideFile::Flush()
{
  const char* from = this->Buffer.data();
  std::size_t left = this->Buffer.size();
  while (left > 0)
  {
    const ssize_t written = write(this->Descriptor, from, left);
    if (written < 0)
    {
      if (errno == EINTR)
      {
        continue;
      }
      this->Fail("cannot be written");
    }
    from += written;
    left -= static_cast<std::size_t>(written);
  }
  this->Buffer.clear();
}

void AsideFile::Write(const void* bytes, std::size_t n)
{
  this->Buffer.append(static_cast<const char*>(bytes), n);
  if (this->Buffer.size() >= bufferSize)
  {
    this->Flush();
  }
}

std::uint64_t AsideFile::Tell()
{
  const off_t position = lseek(this->Descriptor, 0, SEEK_CUR);
  if (position < 0)
  {
    this->Fail("cannot be written");
  }
  return static_cast<std::uint64_t>(position) + this->Buffer.size();
}

void AsideFile::Seek(std::uint64_t position)
{
  this->Flush();
  if (lseek(this->Descriptor, static_cast<off_t>(position), SEEK_SET) < 0)
  {
    this->Fail("cannot be written");
  }
}

void AsideFile::Commit()
{
  if (this->Broken)
  {
    throw FileError(this->FileName, "was not written in full");
  }
  this->Flush();
  if (fsync(this->Descriptor) != 0 && errno != EINVAL && errno != EROFS)
  {
    this->Fail("cannot be brought to the disk");
  }
  if (this->Aside.empty())
  {
    // A nameless file can only be linked to a name that is free: take one aside, then rename.
    const std::string self = "/proc/self/fd/" + std::to_string(this->Descriptor);
    int linked = -1;
    for (int attempt = 0; linked != 0 && attempt < 100; ++attempt)
    {
      const std::string name = NameAside(this->Target, attempt);
      linked = linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
      if (linked == 0)
      {
        this->Aside = name;
      }
      else if (errno != EEXIST)
      {
        break;
      }
    }
    if (linked != 0)
    {
      this->Fail("cannot be given its name");
    }
  }
  if (std::rename(this->Aside.c_str(), this->Target.c_str()) != 0)
  {
    this->Fail("cannot be given its name");
  }
  this->Aside.clear();
}

} // namespace radiometry::io
