// SPDX-License-Identifier: BSD-3-Clause
// A file appears under its name whole or not at all.
#include "io/AsideFile.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using radiometry::io::AsideFile;
using radiometry::io::FileError;
namespace fs = std::filesystem;

namespace
{

class Aside : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string pattern = testing::TempDir() + "/asideXXXXXX";
    this->Folder = mkdtemp(pattern.data());
    this->File = this->Folder / "picture.exr";
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  void Put(const std::string& text) const { std::ofstream(this->File) << text; }
  std::string Content() const
  {
    std::ifstream in(this->File);
    return { std::istreambuf_iterator<char>(in), {} };
  }
  std::ptrdiff_t Entries() const
  {
    return std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator());
  }

  fs::path Folder;
  fs::path File;
};

} // namespace

TEST_F(Aside, TakesItsNameOnCommitOnly)
{
  this->Put("old");
  {
    AsideFile file(this->File.string());
    file.Write("new content", 11);
    EXPECT_EQ(this->Content(), "old");
    file.Seek(0);
    file.Write("NEW", 3);
    EXPECT_EQ(file.Tell(), 3u);
    file.Commit();
  }
  EXPECT_EQ(this->Content(), "NEW content");
  EXPECT_EQ(this->Entries(), 1);
}

TEST_F(Aside, LeavesNothingWithoutCommit)
{
  {
    AsideFile file(this->File.string());
    file.Write("abc", 3);
  }
  EXPECT_EQ(this->Entries(), 0);
}

TEST_F(Aside, LeavesNothingWhenKilled)
{
  this->Put("old");
  const pid_t child = fork();
  if (child == 0)
  {
    AsideFile file(this->File.string());
    const std::string block(1 << 20, 'x');
    file.Write(block.data(), block.size());
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(this->Content(), "old");
  EXPECT_EQ(this->Entries(), 1);
}

TEST_F(Aside, AFullDiskIsAnErrorAndLeavesTheOldFile)
{
  this->Put("old");
  const pid_t child = fork();
  if (child == 0)
  {
    // A limit on file size stands for a full disk.
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ 1 << 20, 1 << 20 };
    setrlimit(RLIMIT_FSIZE, &limit);
    try
    {
      AsideFile file(this->File.string());
      const std::string block(4 << 20, 'x');
      try
      {
        file.Write(block.data(), block.size());
      }
      catch (const FileError&)
      {
      }
      file.Commit(); // must refuse what was not written in full
      _exit(1);
    }
    catch (const FileError& e)
    {
      _exit(std::string(e.what()).find("picture.exr") != std::string::npos ? 7 : 2);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(this->Content(), "old");
  EXPECT_EQ(this->Entries(), 1);
}

TEST_F(Aside, RefusesWhatIsNoPlaceForAFile)
{
  EXPECT_THROW(AsideFile((this->Folder / "no" / "such" / "folder.exr").string()), FileError);
  EXPECT_THROW(AsideFile(this->Folder.string()), FileError);
  EXPECT_THROW(AsideFile("/dev/null"), FileError);
  EXPECT_THROW(AsideFile(""), FileError);
  EXPECT_THROW(AsideFile("/proc/picture.exr"), FileError);
  EXPECT_EQ(this->Entries(), 0);
}

TEST_F(Aside, FollowsALink)
{
  this->Put("old");
  const fs::path link = this->Folder / "link.exr";
  fs::create_symlink("picture.exr", link);
  AsideFile file(link.string());
  file.Write("new", 3);
  file.Commit();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(this->Content(), "new");
}

TEST_F(Aside, PermissionsAreThoseOfAnOrdinaryFile)
{
  const mode_t before = umask(0027);
  AsideFile file(this->File.string());
  umask(before);
  file.Commit();
  EXPECT_EQ(fs::status(this->File).permissions(), fs::perms(0640));
}
