// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/output_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

std::string Refusal(const std::string& out) {
  try {
    (void)MakeOutputFolder(out);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "made";
}

TEST(MakeOutputFolder, MakesFoldersAndAcceptsThem) {
  const std::filesystem::path folder =
      TestFile("file", "").parent_path() / "a/b";
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(MakeOutputFolder(folder.string()), folder);
    EXPECT_TRUE(std::filesystem::is_directory(folder));
  }
}

TEST(MakeOutputFolder, GivesTheReasonOfTheSystem) {
  const std::string file = TestFile("file", "").string();
  const std::string reason = ": cannot be made a folder: Not a directory";
  EXPECT_EQ(Refusal("/dev/null"), "/dev/null" + reason);
  EXPECT_EQ(Refusal("/dev/null/x"), "/dev/null/x" + reason);
  EXPECT_EQ(Refusal(file), file + reason);
  EXPECT_EQ(Refusal("/proc/x"),
            "/proc/x: cannot be made a folder: No such file or directory");
}

}  // namespace
}  // namespace poise
