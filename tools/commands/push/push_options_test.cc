// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/push_options.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace poise {
namespace {

PushOptions Read(std::vector<std::string> words) {
  words.insert(words.begin(), "push");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return ReadPushOptions(static_cast<int>(argv.size()), argv.data());
}

TEST(PushOptions, RampIsTheScenarioSetting) {
  EXPECT_EQ(Read({}).experiment.scenario.control.ramp, 0);
  EXPECT_EQ(Read({"--ramp", "0.3"}).experiment.scenario.control.ramp, 0.3);
}

TEST(PushOptions, RefusesNegativeRampByNameOfTheOption) {
  try {
    (void)Read({"--ramp", "-1"});
    FAIL() << "accepts a negative ramp";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--ramp is -1, must be 0 to 100 s");
  }
}

TEST(PushOptions, FrictionPyramidHasTheOldNameAsAnAlias) {
  EXPECT_FALSE(Read({}).experiment.scenario.control.inscribed);
  for (const char* name : {"--friction-pyramid", "--friction"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(
        Read({name, "inscribed"}).experiment.scenario.control.inscribed);
    EXPECT_FALSE(
        Read({name, "circumscribed"}).experiment.scenario.control.inscribed);
  }
}

}  // namespace
}  // namespace poise
