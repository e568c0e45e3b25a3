// SPDX-License-Identifier: BSD-3-Clause
// Every damaged file is read or refused: by a child with little memory and little time, so that a
// crash, a hang or an allocation by a lying header is a failure and not the end of the tests.
#include "io/ExrReader.h"
#include "io/ExrWriter.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace radiometry::io;
namespace fs = std::filesystem;

namespace
{

constexpr int wasRead = 10;
constexpr int wasRefused = 11;
constexpr int wrongException = 12;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true; // its shadow needs terabytes of addresses
#else
constexpr bool sanitized = false;
#endif

/// What became of a child that reads the file: one of the numbers above, or minus a signal.
int ReadInChild(const std::string& file)
{
  const pid_t child = fork();
  if (child == 0)
  {
    const rlimit time{ 10, 10 };
    setrlimit(RLIMIT_CPU, &time);
    if (!sanitized)
    {
      const rlimit memory{ rlim_t(1) << 30, rlim_t(1) << 30 };
      setrlimit(RLIMIT_AS, &memory);
    }
    alarm(20);
    ExrReadOptions options;
    options.MemoryLimit = std::uint64_t(256) << 20;
    try
    {
      ReadExr(file, options);
      _exit(wasRead);
    }
    catch (const FileError&)
    {
      _exit(wasRefused);
    }
    catch (...)
    {
      _exit(wrongException);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

bool Clean(int outcome) { return outcome == wasRead || outcome == wasRefused; }

} // namespace

TEST(ExrDamaged, FilesOfTheFormatsOwnCollection)
{
  const fs::path folder = RADIOMETRY_SHARED_DATA "/exr/Damaged";
  if (!fs::exists(folder))
  {
    GTEST_SKIP() << "no " << folder;
  }
  int refused = 0;
  int all = 0;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    const int outcome = ReadInChild(entry.path().string());
    EXPECT_TRUE(Clean(outcome)) << entry.path().filename() << ": " << outcome;
    refused += outcome == wasRefused;
    ++all;
  }
  RecordProperty("files", all);
  RecordProperty("refused", refused);
  std::cout << refused << " of " << all << " refused\n";
  EXPECT_GT(refused, all / 2); // they are damaged: most cannot be read
}

TEST(ExrDamaged, OwnFilesCutShortOrWithWrongBytes)
{
  const std::string good = testing::TempDir() + "/damaged-good.exr";
  const std::string bad = testing::TempDir() + "/damaged-bad.exr";
  std::vector<float> values(64 * 48);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<float>(i % 131);
  }
  std::mt19937 random(1);
  int refused = 0;
  for (const auto compression :
    { ExrCompression::None, ExrCompression::ZIP, ExrCompression::PIZ, ExrCompression::DWAA })
  {
    ExrPart part;
    part.DataWindow = ExrBox::OfSize(64, 48);
    part.Compression = compression;
    part.Channels = { ExrChannel::View("R", values.data(), 64),
      ExrChannel::View("Irradiance", values.data(), 64, ExrPixelType::Half) };
    WriteExr(good, { part });
    std::ifstream in(good, std::ios::binary);
    const std::string bytes{ std::istreambuf_iterator<char>(in), {} };
    for (int trial = 0; trial < 25; ++trial)
    {
      std::string text = bytes;
      if (trial < 10)
      {
        text.resize(text.size() * trial / 10);
      }
      else
      {
        for (int k = 0; k < 1 + trial % 4; ++k)
        {
          // Half of the damage to the header, where it hurts most.
          const std::size_t range = k % 2 ? text.size() : 400;
          text[random() % range] = static_cast<char>(random());
        }
      }
      std::ofstream(bad, std::ios::binary) << text;
      const int outcome = ReadInChild(bad);
      EXPECT_TRUE(Clean(outcome)) << ToString(compression) << " trial " << trial << ": " << outcome;
      refused += outcome == wasRefused;
      if (trial < 10)
      {
        EXPECT_EQ(outcome, wasRefused) << ToString(compression) << " cut to " << text.size();
      }
    }
  }
  EXPECT_GE(refused, 40);
}

TEST(ExrDamaged, WhatIsNoPicture)
{
  const std::string file = testing::TempDir() + "/no-picture.exr";
  std::ofstream(file) << "";
  EXPECT_THROW(ReadExr(file), FileError);
  std::ofstream(file) << "a text, and a long one at that, but no picture";
  EXPECT_THROW(ReadExr(file), FileError);
  EXPECT_THROW(ReadExr("/nowhere/x.exr"), FileError);
  EXPECT_THROW(ReadExr("/tmp"), FileError);
  EXPECT_THROW(ReadExr("/dev/zero"), FileError);
  try
  {
    ReadExr("/nowhere/x.exr");
  }
  catch (const FileError& e)
  {
    EXPECT_STREQ(e.what(), "/nowhere/x.exr: no such file");
  }
}

TEST(ExrDamaged, MessagesAreOneLineOfText)
{
  const std::string odd = std::string("a\nb\x01") + "\xff" + "\xc3\xa9" + "\xe2\x82";
  EXPECT_STREQ(FileError("x.exr", odd).what(), "x.exr: a b??\xc3\xa9??");
}

TEST(ExrDamaged, MemoryLimitIsKept)
{
  const std::string file = testing::TempDir() + "/large.exr";
  std::vector<float> row(4000, 1.0f);
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(4000, 3000);
  part.Channels = { ExrChannel::View("Y", row.data(), 0) };
  WriteExr(file, { part });
  ExrReadOptions options;
  options.MemoryLimit = 47'000'000; // the picture takes 48 000 000
  EXPECT_THROW(ReadExr(file, options), FileError);
  options.MemoryLimit = 48'000'000;
  EXPECT_EQ(ReadExr(file, options)[0].Channels.size(), 1u);
  fs::remove(file);
}
