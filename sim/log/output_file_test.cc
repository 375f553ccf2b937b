// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/output_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

namespace fs = std::filesystem;

std::string Refusal(const fs::path& file) {
  try {
    RequireWritable(file);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(OutputFile, AcceptsWritableFilesAndChangesNothing) {
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

TEST(OutputFile, NamesTheFileAndTheReason) {
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
