// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/task_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/control/default_stack.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

Stack MakeStack() { return MakeDefaultStack(LoadHumanoid(), {}); }

std::string Refusal(const std::string& tasks) {
  Stack stack = MakeStack();
  try {
    ApplyTasks(YAML::Load(tasks), "f", &stack);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string SetRefusal(const std::string& text) {
  Stack stack = MakeStack();
  try {
    ApplyTaskSet(TestFile("set.yaml", text), &stack);
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    return message.substr(message.rfind('/') + 1);
  }
  return "accepted";
}

TEST(DescribeTasks, RestoresAllSettingsInAnotherStack) {
  Stack stack = MakeStack();
  ASSERT_TRUE(stack.Enable("yaw", false));
  ASSERT_TRUE(stack.SetLevel("posture", 7));
  ASSERT_TRUE(stack.SetWeight("posture", 0.1));
  ASSERT_TRUE(stack.SetParameter("posture", "kp", 100.0 / 3));
  YAML::Emitter text;
  text << DescribeTasks(stack);
  Stack again = MakeStack();
  ApplyTasks(YAML::Load(text.c_str()), "f", &again);
  for (int i = 0; i < stack.num_tasks(); ++i) {
    SCOPED_TRACE(stack.task(i).name());
    EXPECT_EQ(again.settings(i).enabled, stack.settings(i).enabled);
    EXPECT_EQ(again.settings(i).level, stack.settings(i).level);
    EXPECT_EQ(again.settings(i).weight, stack.settings(i).weight);
    for (size_t k = 0; k < stack.task(i).parameters().size(); ++k) {
      EXPECT_EQ(*again.task(i).parameters()[k].value,
                *stack.task(i).parameters()[k].value);
    }
  }
}

TEST(ApplyTasks, ErrorIsOneLineWithTheValue) {
  EXPECT_EQ(Refusal("[a]"), "f:1: tasks is the list '[a]', must be a map");
  EXPECT_EQ(Refusal("\"a\\nb\": on").find("f:1: task 'a b' is unknown"), 0u);
  EXPECT_EQ(Refusal("yaw: on\nposture: maybe"),
            "f:2: task 'posture' is 'maybe', must be on, off, or a map");
  EXPECT_EQ(Refusal("posture: {on: 3}"),
            "f:1: task 'posture': 'on' is '3', must be true or false");
  EXPECT_EQ(Refusal("posture:\n  rank: \"a\\nb\""),
            "f:2: task 'posture': 'rank' is 'a b', must be a finite number");
  EXPECT_EQ(Refusal("posture: {level: 2.5}"),
            "f:1: task 'posture': 'level' is '2.5', must be 1 to 8");
  EXPECT_EQ(Refusal("posture: {weight: .nan}"),
            "f:1: task 'posture': 'weight' is '.nan', must be a finite number");
  EXPECT_EQ(Refusal("posture: {kp: .nan}"),
            "f:1: task 'posture': 'kp' is '.nan', must be a finite number");
  EXPECT_EQ(Refusal("posture: {\"a\\nb\": 1}")
                .find("f:1: task 'posture' has no 'a b', only on, level"),
            0u);
  EXPECT_EQ(Refusal("posture: {kp: 30}"), "accepted");
}

TEST(ApplyTasks, AcceptsRankAsAliasOfLevel) {
  for (const std::string key : {"level", "rank"}) {
    SCOPED_TRACE(key);
    Stack stack = MakeStack();
    ApplyTasks(YAML::Load("posture: {" + key + ": 6}"), "f", &stack);
    EXPECT_EQ(stack.settings(*stack.Find("posture")).level, 6);
  }
  EXPECT_EQ(Refusal("posture: {level: 4, rank: 4}"),
            "f:1: task 'posture' has both 'level' and its alias 'rank', must "
            "have one");
}

TEST(FindTaskLinks, FindsLinksOfFrameTasksThatExist) {
  const Robot robot = LoadHumanoid();
  using Links = std::vector<std::string>;
  const std::filesystem::path file = TestFile(
      "set.yaml",
      "tasks: {frame.torso: on, frame.left_foot: on, frame.tail: on, yaw: on}");
  EXPECT_EQ(FindTaskLinks(file, {"frame.l_hand", "frame.torso", "zmp"}, robot),
            (Links{"torso", "l_hand"}));
  EXPECT_EQ(FindTaskLinks("default", {}, robot), Links{});
  EXPECT_EQ(FindTaskLinks("paper", {"frame."}, robot), Links{});
  EXPECT_EQ(FindTaskLinks(YAML::Load("[frame.torso]"), robot), Links{});
}

TEST(ApplyTaskSet, ReadsFile) {
  Stack stack = MakeStack();
  ApplyTaskSet(TestFile("set.yaml", "tasks: {posture: {kp: 30}, yaw: off}"),
               &stack);
  EXPECT_EQ(stack.GetParameter("posture", "kp"), 30);
  EXPECT_FALSE(stack.settings(*stack.Find("yaw")).enabled);
  EXPECT_EQ(SetRefusal("task: {}"), "set.yaml:1: has no section 'tasks'");
  EXPECT_EQ(SetRefusal("[tasks]"), "set.yaml:1: has no section 'tasks'");
  EXPECT_EQ(SetRefusal("\ntasks:\n  posture: {weight: 0}"),
            "set.yaml:3: task 'posture': 'weight' is '0', must be 1e-06 to "
            "1e+06");
}

TEST(TaskSet, ErrorsNameFileAndLine) {
  Stack stack = MakeStack();
  const auto message = [&](const char* yaml) -> std::string {
    try {
      ApplyTasks(YAML::Load(yaml), "x.yaml", &stack);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("yaw: off\ncop: {margin: 0.01, rank: 4}"), "");
  EXPECT_FALSE(stack.settings(*stack.Find("yaw")).enabled);
  EXPECT_EQ(stack.settings(*stack.Find("cop")).level, 4);
  EXPECT_EQ(*stack.GetParameter("cop", "margin"), 0.01);
  EXPECT_EQ(message("yaw: off\nposturing: {kp: 1}").substr(0, 32),
            "x.yaml:2: task 'posturing' is un");
  EXPECT_EQ(message("cop: {kp: 1}").substr(0, 34),
            "x.yaml:1: task 'cop' has no 'kp', ");
  EXPECT_EQ(message("posture: {kd: 1001}"),
            "x.yaml:1: task 'posture': 'kd' is '1001', must be 0 to 1000");
  EXPECT_EQ(message("cop:\n  rank: 9"),
            "x.yaml:2: task 'cop': 'rank' is '9', must be 1 to 8");
  EXPECT_EQ(message("cop: {margin: -1}"),
            "x.yaml:1: task 'cop': 'margin' is '-1', must be 0 to 1");
}

TEST(TaskSet, AppliesTaskSetOfPaper) {
  Stack stack = MakeStack();
  ApplyTaskSet("paper", &stack);
  EXPECT_FALSE(stack.settings(*stack.Find("joint_limits")).enabled);
  EXPECT_EQ(stack.GetParameter("momentum", "capture"), 0);
  EXPECT_EQ(stack.settings(*stack.Find("posture")).level, 4);
  EXPECT_THROW(ApplyTaskSet("papers", &stack), std::invalid_argument);
}

TEST(Stack, ChangesNothingOnInvalidNameOrValue) {
  Stack stack = MakeStack();
  const double kp = *stack.GetParameter("posture", "kp");
  EXPECT_FALSE(stack.SetParameter("posture", "kq", 1));
  EXPECT_FALSE(stack.SetParameter("postures", "kp", 1));
  EXPECT_FALSE(stack.SetParameter("posture", "kp", -1));
  EXPECT_FALSE(stack.SetParameter("posture", "kp",
                                  std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(stack.SetLevel("posture", 0));
  EXPECT_FALSE(stack.SetLevel("posture", Stack::kMaxLevel + 1));
  for (const double weight : {0.0, 9e-7, 1.1e6, 1e300, std::nan("")}) {
    EXPECT_FALSE(stack.SetWeight("posture", weight)) << weight;
  }
  for (const double ratio : {0.0, -100.0, 0.5, 1e7, std::nan("")}) {
    EXPECT_FALSE(stack.set_weighted(true, ratio)) << ratio;
  }
  EXPECT_EQ(stack.GetParameter("posture", "kp"), kp);
  EXPECT_EQ(stack.GetParameter("posture", "kq"), std::nullopt);
  EXPECT_EQ(stack.GetParameter("postures", "kp"), std::nullopt);
  EXPECT_EQ(stack.settings(*stack.Find("posture")).level, 5);
  EXPECT_EQ(stack.settings(*stack.Find("posture")).weight, 1);
  EXPECT_EQ(stack.RowName(0, 1000, true, Side::kNone), "");
}

// The two bounds differ: zero load, and the force limit of a foot that is
// loading.
TEST(Stack, RowNameContainsActiveSide) {
  const Stack stack = MakeStack();
  const auto name = [&stack](const char* task, Side side) {
    return stack.RowName({*stack.Find(task), 0, side, 5, 1, 0});
  };
  EXPECT_EQ(name("unilateral", Side::kLower), "left_foot.unilateral.fz.min");
  EXPECT_EQ(name("unilateral", Side::kUpper), "left_foot.unilateral.fz.max");
  EXPECT_EQ(name("torque_limits", Side::kLower).substr(0, 7), "torque.");
  EXPECT_EQ(name("torque_limits", Side::kUpper).substr(0, 7), "torque.");
  EXPECT_NE(name("torque_limits", Side::kLower),
            name("torque_limits", Side::kUpper));
  // The name of a one-sided row already contains its side.
  EXPECT_EQ(name("cop", Side::kUpper), "left_foot.cop.x_max");
}

// A user-defined task.
class Band : public Task {
 public:
  Band() : Task("band", {}, {{"band.x", "K", "the heat", RowKind::kLimit}}) {}
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput&, EqualityBlock*,
             InequalityBlock*) const noexcept override {}
};

TEST(Stack, RowNameContainsActiveSideForUserTask) {
  Stack stack = MakeStack();
  stack.Add(std::make_unique<Band>(), {});
  const int band = *stack.Find("band");
  EXPECT_EQ(stack.RowName({band, 0, Side::kLower, 5, 1, 0}), "band.x.min");
  EXPECT_EQ(stack.RowName({band, 0, Side::kUpper, 5, 1, 0}), "band.x.max");
}

TEST(Stack, DescribesEachRowByItsLogName) {
  const Stack stack = MakeStack();
  std::map<std::string, RowDescription> rows;
  for (const StackRow& described : stack.DescribeRows()) {
    SCOPED_TRACE(described.row.name);
    EXPECT_FALSE(described.row.unit.empty());
    EXPECT_FALSE(described.row.phrase.empty());
    EXPECT_FALSE(RowKindName(described.row.kind).empty());
    EXPECT_TRUE(rows.emplace(described.row.name, described.row).second);
  }
  EXPECT_EQ(rows["momentum.kx"].unit, "N m");
  EXPECT_EQ(rows["momentum.lx"].unit, "N");
  EXPECT_EQ(rows["com.x"].unit, "m/s2");
  EXPECT_EQ(rows["left_foot.contact.wx"].unit, "rad/s2");
  EXPECT_EQ(rows["frame.left_foot.vz"].unit, "m/s2");
  EXPECT_EQ(rows["posture.l_knee"].unit, "rad/s2");
  EXPECT_EQ(rows["torque_minimization.l_knee"].unit, "N m");
  EXPECT_EQ(rows["torque.l_knee.min"].phrase,
            "the torque of l knee at its lower limit");
  EXPECT_EQ(rows["left_foot.cop.y_max"].phrase,
            "the CoP of the left foot at its outer edge");
  EXPECT_EQ(rows["right_foot.cop.y_max"].phrase,
            "the CoP of the right foot at its inner edge");
  EXPECT_EQ(rows["right_foot.unilateral.fz.max"].phrase,
            "the normal force of the right foot at its upper limit");
}

TEST(Stack, DescribesBothSidesOfRowOfUserTask) {
  Stack stack = MakeStack();
  stack.Add(std::make_unique<Band>(), {});
  std::vector<std::string> phrases;
  for (const StackRow& described : stack.DescribeRows()) {
    if (described.task != "band") continue;
    EXPECT_EQ(described.row.unit, "K");
    phrases.push_back(described.row.name + ": " + described.row.phrase);
  }
  EXPECT_EQ(phrases, (std::vector<std::string>{
                         "band.x.min: the heat at its lower limit",
                         "band.x.max: the heat at its upper limit"}));
}

class Idle : public Task {
 public:
  explicit Idle(const std::string& name) : Task(name, {}, {}) {}
  void Write(const TaskInput&, EqualityBlock*,
             InequalityBlock*) const noexcept override {}
};

TEST(Stack, AddRejectsExistingNameAndInvalidSettings) {
  Stack stack = MakeStack();
  const int tasks = stack.num_tasks();
  const auto message = [&](const char* name, int rank,
                           double weight) -> std::string {
    try {
      stack.Add(std::make_unique<Idle>(name), {true, rank, weight});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("posture", 1, 1),
            "task 'posture': exists already, must have a new name");
  EXPECT_EQ(message("idle", 0, 1), "task 'idle': level is 0, must be 1 to 8");
  EXPECT_EQ(message("idle", 9, 1), "task 'idle': level is 9, must be 1 to 8");
  EXPECT_EQ(message("idle", 8, 0),
            "task 'idle': weight is 0, must be 1e-06 to 1e+06");
  EXPECT_EQ(stack.num_tasks(), tasks);
  EXPECT_EQ(message("idle", 8, 1), "accepted");
  EXPECT_EQ(stack.Find("idle"), tasks);
}

}  // namespace
}  // namespace poise
