// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <sstream>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

namespace fs = std::filesystem;

std::string Refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string Refusal(const fs::path& file) {
  return Refusal([&] { RequireWritable(file); });
}

std::string Read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Returns a new, empty folder.
fs::path Folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(WriteFile, ReplacesAFileAndLeavesNothingElse) {
  const fs::path folder = Folder("replaces"), file = folder / "file";
  fs::create_symlink("file", folder / "link");
  for (const char* text : {"a longer text\n", "", "short"}) {
    WriteFile(file, text);
    EXPECT_EQ(Read(file), text);
  }
  WriteFile(folder / "link", "by a link");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(Read(file), "by a link");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
}

TEST(WriteFile, KeepsTheOldFileIfTheNewOneDoesNotFit) {
  const fs::path folder = Folder("full"), file = folder / "file";
  WriteFile(file, "old");
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {10, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string refusal =
      Refusal([&] { WriteFile(file, std::string(100, 'x')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(refusal, file.string() + ": cannot be written: File too large");
  EXPECT_EQ(Read(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST(WriteFile, GivesTheReasonOfTheSystem) {
  const auto refusal = [](const fs::path& file) {
    return Refusal([&] { WriteFile(file, "text"); });
  };
  const fs::path folder = Folder("reasons");
  EXPECT_EQ(refusal("/dev/full"),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(refusal("/dev/null"), "");
  EXPECT_EQ(refusal(folder),
            folder.string() + ": cannot be written: Is a directory");
  EXPECT_EQ(refusal(folder / "no" / "file"),
            (folder / "no" / "file").string() +
                ": cannot be written: No such file or directory");
}

TEST(WriteFile, OpensAPipeOnce) {
  const fs::path pipe = Folder("pipe") / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // The reader gets all that is written until the pipe is closed for the first
  // time. Often enough, so that a second opening would be seen.
  for (int i = 0; i < 200; ++i) {
    std::future<std::string> read =
        std::async(std::launch::async, [&] { return Read(pipe); });
    WriteFile(pipe, "text");
    ASSERT_EQ(read.get(), "text");
  }
}

TEST(MakeFolder, MakesFoldersOrGivesTheReason) {
  const fs::path folder = Folder("folders");
  MakeFolder(folder / "a" / "b");
  MakeFolder(folder / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
  WriteFile(folder / "file", "");
  for (const fs::path& wrong : {folder / "file", folder / "file" / "x"}) {
    EXPECT_EQ(Refusal([&] { MakeFolder(wrong); }),
              wrong.string() + ": cannot be made a folder: Not a directory");
  }
}

TEST(RequireWritable, AcceptsWritableFilesAndChangesNothing) {
  const fs::path folder = fs::path(testing::TempDir()) / "accepts";
  fs::create_directories(folder);
  const fs::path old = folder / "old";
  std::ofstream(old) << "text";
  EXPECT_EQ(Refusal(old), "");
  EXPECT_EQ(fs::file_size(old), 4u);
  EXPECT_EQ(Refusal(folder / "new"), "");
  EXPECT_FALSE(fs::exists(folder / "new"));
  EXPECT_EQ(Refusal(folder / "no" / "folder"), "");
}

TEST(RequireWritable, NamesTheFileAndTheReason) {
  const fs::path folder = fs::path(testing::TempDir()) / "refuses";
  fs::create_directories(folder);
  EXPECT_EQ(Refusal(folder),
            folder.string() + ": cannot be written: Is a directory");
  if (geteuid() == 0) return;  // Root can write every file.
  std::ofstream(folder / "old") << "text";
  fs::permissions(folder / "old", fs::perms::owner_read);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* name : {"old", "new"}) {
    EXPECT_EQ(
        Refusal(folder / name),
        (folder / name).string() + ": cannot be written: Permission denied");
  }
  fs::permissions(folder, fs::perms::owner_all);
}

}  // namespace
}  // namespace poise
