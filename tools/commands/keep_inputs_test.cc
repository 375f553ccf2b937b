// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/keep_inputs.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

class KeepInputsTest : public testing::Test {
 protected:
  std::string Refusal(const fs::path& output) const {
    try {
      KeepInputs(output.string(), {{"", "the profile"},
                                   {robot_, "the robot's file"},
                                   {"no_such.yaml", "the task set"}});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

  const fs::path robot_ = TestFile("robot.urdf", "<robot/>");
  const fs::path folder_ = robot_.parent_path();
};

TEST_F(KeepInputsTest, AcceptsAnyOtherFile) {
  EXPECT_EQ(Refusal(""), "accepted");
  EXPECT_EQ(Refusal(folder_ / "new.yaml"), "accepted");
  EXPECT_EQ(Refusal(TestFile("old.yaml", "")), "accepted");
}

TEST_F(KeepInputsTest, RefusesAnInputByAnyOfItsNames) {
  const fs::path link = folder_ / "link.yaml", hard = folder_ / "hard.yaml";
  fs::remove(link);
  fs::remove(hard);
  fs::create_symlink(robot_, link);
  fs::create_hard_link(robot_, hard);
  for (const fs::path& name :
       {robot_, folder_ / "." / "robot.urdf", link, hard}) {
    EXPECT_EQ(Refusal(name), name.string() +
                                 ": is the robot's file and would be replaced, "
                                 "choose another name");
  }
}

}  // namespace
}  // namespace poise
