// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/task_set.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "robot/control/default_stack.h"
#include "robot/profile.h"

namespace poise {
namespace {

Stack MakeStack() {
  return MakeDefaultStack(
      LoadRobot("robot/models/humanoid.urdf",
                LoadProfile("robot/profiles/humanoid.yaml")),
      {});
}

std::string Refusal(const std::string& tasks) {
  Stack stack = MakeStack();
  try {
    ApplyTasks(YAML::Load(tasks), "f", &stack);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DescribeTasks, MakesAnotherStackTheSame) {
  Stack stack = MakeStack();
  ASSERT_TRUE(stack.Enable("yaw", false));
  ASSERT_TRUE(stack.SetRank("posture", 7));
  ASSERT_TRUE(stack.SetWeight("posture", 0.1));
  ASSERT_TRUE(stack.SetParameter("posture", "kp", 100.0 / 3));
  YAML::Emitter text;
  text << DescribeTasks(stack);
  Stack again = MakeStack();
  ApplyTasks(YAML::Load(text.c_str()), "f", &again);
  for (int i = 0; i < stack.num_tasks(); ++i) {
    SCOPED_TRACE(stack.task(i).name());
    EXPECT_EQ(again.settings(i).enabled, stack.settings(i).enabled);
    EXPECT_EQ(again.settings(i).rank, stack.settings(i).rank);
    EXPECT_EQ(again.settings(i).weight, stack.settings(i).weight);
    for (size_t k = 0; k < stack.task(i).parameters().size(); ++k) {
      EXPECT_EQ(*again.task(i).parameters()[k].value,
                *stack.task(i).parameters()[k].value);
    }
  }
}

TEST(ApplyTasks, RefusesInOneLineWithTheValue) {
  EXPECT_EQ(Refusal("[a]"), "f:1: tasks is a list, must be a map");
  EXPECT_EQ(Refusal("\"a\\nb\": on").find("f:1: task 'a b' is unknown"), 0u);
  EXPECT_EQ(Refusal("yaw: on\nposture: maybe"),
            "f:2: task 'posture' is 'maybe', must be on, off, or a map");
  EXPECT_EQ(Refusal("posture: {on: 3}"),
            "f:1: task 'posture': 'on' is '3', must be true or false");
  EXPECT_EQ(Refusal("posture:\n  rank: \"a\\nb\""),
            "f:2: task 'posture': 'rank' is 'a b', must be a finite number");
  EXPECT_EQ(Refusal("posture: {rank: 2.5}"),
            "f:1: task 'posture': 'rank' is '2.5', must be 1 to 8");
  EXPECT_EQ(Refusal("posture: {weight: .nan}"),
            "f:1: task 'posture': 'weight' is '.nan', must be a finite number");
  EXPECT_EQ(Refusal("posture: {kp: .nan}"),
            "f:1: task 'posture': 'kp' is '.nan', must be a finite number");
  EXPECT_EQ(Refusal("posture: {\"a\\nb\": 1}")
                .find("f:1: task 'posture' has no 'a b', only on, rank"),
            0u);
  EXPECT_EQ(Refusal("posture: {kp: 30}"), "accepted");
}

}  // namespace
}  // namespace poise
