// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/push_options.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

PushOptions Read(std::vector<std::string> words) {
  words.insert(words.begin(), "push");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return ReadPushOptions(static_cast<int>(argv.size()), argv.data());
}

TEST(PushOptions, RampIsTheScenarioSetting) {
  EXPECT_EQ(Read({}).loop->scenario().control.ramp, 0);
  EXPECT_EQ(Read({"--ramp", "0.3"}).loop->scenario().control.ramp, 0.3);
}

// Returns the message with which the options are rejected, or an empty string.
std::string Refusal(const std::vector<std::string>& words) {
  try {
    (void)Read(words);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PushOptions, NamesTheOptionOfAnInvalidValue) {
  EXPECT_EQ(Refusal({"--ramp", "-1"}), "--ramp is -1, must be 0 to 100 s");
  EXPECT_EQ(Refusal({"--plant-rate", "300"}),
            "control.rate is 1000, must evenly divide --plant-rate, which "
            "is 300");
  EXPECT_EQ(Refusal({"--link", "nose"}),
            "link 'nose' is unknown, must be a link of robot 'humanoid'");
}

TEST(PushOptions, NamesTheFileOfAnInvalidValue) {
  const std::string pushes =
      TestFile("pushes.yaml", "pushes: [{force: [1, 0, 0]}, {link: nose}]\n")
          .string();
  EXPECT_EQ(
      Refusal({"--pushes", pushes}),
      pushes +
          ":1: link 'nose' is unknown, must be a link of robot 'humanoid'");
  const std::string scenario =
      TestFile("rates.yaml", "control: {rate: 300}\n").string();
  EXPECT_EQ(Refusal({"--scenario", scenario}),
            scenario +
                ":1: control.rate is 300, must evenly divide plant.rate, "
                "which is 1000");
}

// The saved profile must not replace a file that the run reads.
TEST(PushOptions, RefusesToSaveTheProfileOverAnInput) {
  const std::pair<const char*, const char*> inputs[] = {
      {"--robot", "the robot's file"},
      {"--scenario", "the scenario's file"},
      {"--pushes", "the file of pushes"},
      {"--tasks", "the task set"},
      {"--profile", "the profile that is read"}};
  for (const auto& [option, name] : inputs) {
    const std::string file = TestFile("mine", "pushes: []").string();
    EXPECT_EQ(
        Refusal({option, file, "--save-profile", file}),
        file + ": is " + name + " and would be replaced, choose another name");
    std::string left;
    std::getline(std::ifstream(file), left);
    EXPECT_EQ(left, "pushes: []") << option;
  }
}

// Tasks from options follow tasks from the file. The message names the file
// only for a task from the file.
TEST(PushOptions, DistinguishesTasksOfFileAndOptions) {
  const std::string scenario =
      TestFile("tasks.yaml", "tasks: {with: [frame.nose]}\n").string();
  const std::string unknown =
      "task 'frame.nose' is unknown, must be frame.LINK with a link of the "
      "robot";
  EXPECT_EQ(Refusal({"--scenario", scenario, "--with", "zmp"}),
            scenario + ":1: " + unknown);
  EXPECT_EQ(Refusal({"--with", "frame.nose"}), unknown);
}

TEST(PushOptions, ReplacesTheBudgetOfAScenario) {
  const std::string scenario =
      TestFile("budget.yaml", "control: {budget_us: 300, budget_clock: true}\n")
          .string();
  const auto read = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {"--scenario", scenario};
    words.insert(words.end(), options.begin(), options.end());
    const PushOptions push = Read(words);
    const ControlSettings& control = push.loop->scenario().control;
    return std::pair(control.budget_us, control.budget_clock);
  };
  EXPECT_EQ(read({}), std::pair(300.0, true));
  EXPECT_EQ(read({"--budget-us", "200"}), std::pair(200.0, true));
  EXPECT_EQ(read({"--budget-us", "0"}), std::pair(0.0, false));
  EXPECT_EQ(read({"--budget-clock=false"}), std::pair(300.0, false));
  EXPECT_EQ(Refusal({"--budget-us", "-1"}),
            "--budget-us is -1, must be 0 to 1e+06 us");
  EXPECT_EQ(Refusal({"--budget-clock"}),
            "--budget-clock is true, must come with --budget-us above 0 us");
  const std::string clock =
      TestFile("clock.yaml", "control: {budget_clock: true}\n").string();
  EXPECT_EQ(Refusal({"--scenario", clock}),
            clock +
                ":1: control.budget_clock is true, must come with "
                "control.budget_us above 0 us");
}

// The help says so.
TEST(PushOptions, AddAPushToAScenarioWithoutPushes) {
  const auto pushes = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"--scenario", "stand"});
    return Read(words).loop->scenario().pushes;
  };
  EXPECT_TRUE(pushes({"--time", "2"}).empty());
  const std::pair<const char*, const char*> options[] = {{"--at", "0.2"},
                                                         {"--duration", "0.3"},
                                                         {"--point", "0,0,0"},
                                                         {"--force", "50"}};
  for (const auto& [option, value] : options) {
    const auto added = pushes({option, value});
    ASSERT_EQ(added.size(), 1u) << option;
    EXPECT_EQ(added[0].force, Eigen::Vector3d(0, 50, 0)) << option;
  }
  EXPECT_EQ(pushes({"--at", "0.2"})[0].start, 0.2);
  // cos(pi) and sin(pi) are rounded.
  EXPECT_TRUE(pushes({"--direction", "180"})[0].force.isApprox(
      Eigen::Vector3d(-50, 0, 0)));
}

TEST(PushOptions, RefusesOptionsWithoutEffect) {
  EXPECT_EQ(Refusal({"--with", "zmp,cop", "--without", "yaw,cop"}),
            "task 'cop' is in --with and in --without, must be in one of them");
  const std::string scenario =
      TestFile("off.yaml", "tasks: {without: [cop]}\n").string();
  EXPECT_EQ(Refusal({"--scenario", scenario, "--with", "cop"}), "");
  EXPECT_EQ(Refusal({"--freeze", "1.05,0"}),
            "--freeze is 1.05,0, must be AT,FOR with FOR above 0 s");
  EXPECT_EQ(Refusal({"--freeze", "1.05,0.1"}), "");
}

// A value in the file may be invalid if an option replaces it.
TEST(PushOptions, ValidatesOnlyTheFinalSettings) {
  const std::string scenario =
      TestFile("slow.yaml", "control: {rate: 300}\n").string();
  EXPECT_EQ(Refusal({"--scenario", scenario, "--control-rate", "500"}), "");
}

TEST(PushOptions, FrictionIsAnAliasOfFrictionPyramid) {
  EXPECT_FALSE(Read({}).loop->scenario().control.inscribed);
  for (const char* name : {"--friction-pyramid", "--friction"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(Read({name, "inscribed"}).loop->scenario().control.inscribed);
    EXPECT_FALSE(
        Read({name, "circumscribed"}).loop->scenario().control.inscribed);
  }
}

}  // namespace
}  // namespace poise
