// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/input_error.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

std::string Option(const std::string& field) { return "--" + field; }

TEST(InputError, ReplacesBothFieldPaths) {
  const InputError error =
      InputError::OfValue("rate", " is 3, must be a part of ", "step", ", 4");
  EXPECT_STREQ(error.what(), "rate is 3, must be a part of step, 4");
  EXPECT_EQ(error.Say(Option), "--rate is 3, must be a part of --step, 4");
  EXPECT_EQ(error.field(), "rate");
  EXPECT_EQ(error.other(), "step");
}

TEST(InputError, ReplacesASingleFieldPath) {
  const InputError error = InputError::OfValue("rate", " is 3, must be 4");
  EXPECT_EQ(error.Say(Option), "--rate is 3, must be 4");
  EXPECT_EQ(error.other(), "");
}

TEST(InputError, KeepsAMessageWithoutAFieldPath) {
  const InputError error("robot", "robot 'box' has no foot");
  EXPECT_STREQ(error.what(), "robot 'box' has no foot");
  EXPECT_EQ(error.Say(Option), error.what());
  EXPECT_EQ(error.field(), "robot");
}

}  // namespace
}  // namespace poise
