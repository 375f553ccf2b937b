// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/text_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

std::string Refusal(const std::filesystem::path& file) {
  try {
    (void)ReadTextFile(file, 1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "read";
}

TEST(ReadTextFile, GivesTheReasonOfTheSystem) {
  const std::filesystem::path file = TestFile("file.txt", "text");
  const std::string folder = file.parent_path().string();
  EXPECT_EQ(ReadTextFile(file, 1), "text");
  EXPECT_EQ(Refusal(folder + "/no"),
            folder + "/no: cannot be read: No such file or directory");
  EXPECT_EQ(Refusal(folder), folder + ": cannot be read: Is a directory");
  EXPECT_EQ(Refusal(file / "no"),
            (file / "no").string() + ": cannot be read: Not a directory");
  EXPECT_EQ(Refusal("/proc/self/mem"),
            "/proc/self/mem: cannot be read: Input/output error");
  EXPECT_EQ(Refusal("/dev/zero"), "/dev/zero: is not a regular file");
}

TEST(ReadTextFile, SaysThatPermissionIsDenied) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read every file";
  const std::filesystem::path file = TestFile("secret.txt", "text");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_EQ(Refusal(file),
            file.string() + ": cannot be read: Permission denied");
}

}  // namespace
}  // namespace poise
