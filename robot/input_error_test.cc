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

TEST(MakeOfField, NamesTheFieldUnlessTheErrorNamesOneOrAFile) {
  EXPECT_EQ(MakeOfField("robot", [] { return 3; }), 3);
  const auto field_of = [](const auto& error) -> std::string {
    try {
      MakeOfField(EntryPath("pushes", 2), [&] { throw error; });
    } catch (const InputError& input_error) {
      return input_error.field();
    } catch (const Refusal&) {
      return "a file";
    }
    return "";
  };
  EXPECT_EQ(field_of(std::invalid_argument("is wrong")), "pushes[2]");
  EXPECT_EQ(field_of(InputError("robot", "is wrong")), "robot");
  EXPECT_EQ(field_of(Refusal("a.urdf", 1, "is wrong")), "a file");
}

}  // namespace
}  // namespace poise
