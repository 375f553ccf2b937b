// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/output_file.h"

#include <fcntl.h>
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
#include <utility>
#include <vector>

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

TEST(WriteFile, LosesNoOtherFile) {
  const fs::path folder = Folder("others");
  const std::vector<std::string> others = {
      "file.new", "file~", "file.tmp",
      "file." + std::to_string(getpid()) + "-0"};
  for (const std::string& name : others) std::ofstream(folder / name) << name;
  WriteFile(folder / "file", "text");
  EXPECT_EQ(Read(folder / "file"), "text");
  for (const std::string& name : others) EXPECT_EQ(Read(folder / name), name);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 5);
}

TEST(WriteFile, KeepsOwnerAndPermissions) {
  const fs::path file = Folder("permissions") / "file";
  struct stat status;
  const mode_t umask_before = umask(027);
  WriteFile(file, "new");
  umask(umask_before);
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
  // Only root can give a file to another user, and not in every sandbox.
  const uid_t other = 65534;
  const uid_t owner = chown(file.c_str(), other, -1) == 0 ? other : geteuid();
  for (const mode_t mode : {0600u, 0755u, 0666u}) {
    ASSERT_EQ(chmod(file.c_str(), mode), 0);
    WriteFile(file, "text");
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, mode);
    EXPECT_EQ(status.st_uid, owner);
  }
}

TEST(WriteFile, KeepsLinks) {
  const fs::path folder = Folder("links"), file = folder / "file";
  WriteFile(file, "old");
  fs::create_hard_link(file, folder / "hard");
  WriteFile(file, "new");
  EXPECT_EQ(Read(folder / "hard"), "new");
  // A chain of links, to a file that does not exist yet.
  fs::create_directory(folder / "a");
  fs::create_symlink("../later", folder / "a" / "link");
  fs::create_symlink(folder / "a" / "link", folder / "first");
  WriteFile(folder / "first", "text");
  EXPECT_EQ(fs::read_symlink(folder / "a" / "link"), "../later");
  EXPECT_EQ(Read(folder / "later"), "text");
  // A circle of links.
  fs::create_symlink("circle", folder / "circle");
  EXPECT_EQ(Refusal([&] { WriteFile(folder / "circle", "text"); }),
            (folder / "circle").string() +
                ": cannot be written: Too many levels of symbolic links");
}

TEST(WriteFile, WritesAnOpenFileByItsDescriptor) {
  const fs::path file = Folder("descriptor") / "file";
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(descriptor, 0);
  // A link to a folder of such links, as /dev/fd is.
  fs::create_symlink("/proc/self/fd", file.parent_path() / "fd");
  const fs::path folders[] = {"/proc/self/fd", file.parent_path() / "fd"};
  for (const fs::path& folder : folders) {
    WriteFile(folder / std::to_string(descriptor), "text");
    char read[5] = {};
    EXPECT_EQ(pread(descriptor, read, 4, 0), 4);
    EXPECT_STREQ(read, "text");
    ASSERT_EQ(ftruncate(descriptor, 0), 0);
  }
  close(descriptor);
}

TEST(WriteFile, NeedsAWritableFileAndNoMore) {
  const fs::path folder = Folder("closed");
  // The name leaves no room for that of a draft.
  const fs::path longest = folder / std::string(255, 'x');
  for (const char* text : {"created", "changed"}) {
    WriteFile(longest, text);
    EXPECT_EQ(Read(longest), text);
  }
  if (geteuid() == 0) return;  // Root can create files everywhere.
  const fs::path file = folder / "file";
  WriteFile(file, "a long old text");
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_EQ(Refusal([&] { WriteFile(file, "text"); }),
            file.string() + ": cannot be written: Permission denied");
  EXPECT_EQ(Read(file), "a long old text");
  fs::permissions(file, fs::perms::owner_all);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(Refusal(file), "");
  WriteFile(file, "text");
  EXPECT_EQ(Read(file), "text");
  EXPECT_EQ(
      Refusal([&] { WriteFile(folder / "new", "text"); }),
      (folder / "new").string() + ": cannot be written: Permission denied");
  fs::permissions(folder, fs::perms::owner_all);
}

TEST(WriteFile, GivesTheReasonOfTheSystem) {
  const auto refusal = [](const fs::path& file) {
    return Refusal([&] { WriteFile(file, "text"); });
  };
  const fs::path folder = Folder("reasons");
  // The devices are named by descriptors: a defect then cannot replace the
  // machine's own.
  for (const auto& [device, reason] :
       {std::pair("/dev/full", ": cannot be written: No space left on device"),
        std::pair("/dev/null", "")}) {
    const int descriptor = open(device, O_WRONLY);
    ASSERT_GE(descriptor, 0);
    const std::string name = "/proc/self/fd/" + std::to_string(descriptor);
    EXPECT_EQ(refusal(name), *reason == '\0' ? "" : name + reason);
    close(descriptor);
  }
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
  EXPECT_TRUE(fs::is_fifo(pipe));
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
  const fs::path folder = Folder("accepts");
  const fs::path old = folder / "old";
  std::ofstream(old) << "text";
  EXPECT_EQ(Refusal(old), "");
  EXPECT_EQ(fs::file_size(old), 4u);
  EXPECT_EQ(Refusal(folder / "new"), "");
  EXPECT_FALSE(fs::exists(folder / "new"));
  EXPECT_EQ(Refusal(folder / "no" / "folder"), "");
  // An open for writing would wait for a reader.
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(Refusal(folder / "pipe"), "");
}

TEST(RequireWritable, NamesTheFileAndTheReason) {
  const fs::path folder = Folder("refuses");
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
