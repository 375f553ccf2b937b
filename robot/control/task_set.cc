// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/task_set.h"

#include <stdexcept>

namespace poise {
namespace {

// Four ranks, no limits, no yaw rows, nothing that holds the pelvis.
constexpr char kPaper[] = R"(
torque_limits: off
joint_limits: off
yaw: off
contact: {rank: 2}
cop: {rank: 2}
friction: {rank: 2}
unilateral: {rank: 2}
momentum: {rank: 3, k_orientation: 0}
posture: {rank: 4}
force_regularizer: {rank: 4}
)";

[[noreturn]] void Refuse(const YAML::Node& at, const std::string& file,
                         const std::string& why) {
  throw std::invalid_argument(file + ":" + std::to_string(at.Mark().line + 1) +
                              ": " + why);
}

std::string NamesOf(const Stack& stack) {
  std::string names;
  for (int i = 0; i < stack.num_tasks(); ++i) {
    names += (i == 0 ? "" : ", ") + stack.task(i).name();
  }
  return names;
}

std::string NamesOf(const Task& task) {
  std::string names = "on, rank, weight";
  for (const Parameter& each : task.parameters()) names += ", " + each.name;
  return names;
}

void ApplyTask(const std::string& name, const YAML::Node& node,
               const std::string& file, Stack* stack) {
  const std::string what = "task '" + name + "'";
  bool on = false;
  if (node.IsScalar() && YAML::convert<bool>::decode(node, on)) {
    (void)stack->Enable(name, on);
    return;
  }
  if (!node.IsMap()) {
    Refuse(node, file, what + " must be on, off, or a map");
  }
  for (const auto& field : node) {
    const auto key = field.first.as<std::string>("");
    const YAML::Node& value = field.second;
    if (key == "on") {
      if (!value.IsScalar() || !YAML::convert<bool>::decode(value, on)) {
        Refuse(value, file, what + ": on must be true or false");
      }
      (void)stack->Enable(name, on);
      continue;
    }
    const std::string given = value.IsScalar() ? value.Scalar() : "no number";
    double number = 0;
    if (!value.IsScalar() || !YAML::convert<double>::decode(value, number)) {
      Refuse(value, file,
             what + ": " + key + " is " + given + ", must be a number");
    }
    if (key == "rank") {
      const int rank = number >= 1 && number <= Stack::kMaxRank
                           ? static_cast<int>(number)
                           : 0;
      if (rank != number || !stack->SetRank(name, rank)) {
        Refuse(value, file,
               what + ": rank is " + given + ", must be 1 to " +
                   std::to_string(Stack::kMaxRank));
      }
    } else if (key == "weight") {
      if (!stack->SetWeight(name, number)) {
        Refuse(value, file,
               what + ": weight is " + given + ", must be positive");
      }
    } else if (!stack->GetParameter(name, key)) {
      Refuse(field.first, file,
             what + " has no '" + key + "', only " +
                 NamesOf(stack->task(*stack->Find(name))));
    } else if (!stack->SetParameter(name, key, number)) {
      Refuse(
          value, file,
          what + ": " + key + " is " + given + ", which is out of its range");
    }
  }
}

}  // namespace

void ApplyTasks(const YAML::Node& tasks, const std::string& file,
                Stack* stack) {
  if (!tasks.IsMap()) Refuse(tasks, file, "tasks must be a map by task name");
  for (const auto& field : tasks) {
    const auto name = field.first.as<std::string>("");
    if (!stack->Find(name)) {
      Refuse(
          field.first, file,
          "task '" + name + "' is unknown, must be one of " + NamesOf(*stack));
    }
    ApplyTask(name, field.second, file, stack);
  }
}

void ApplyTaskSet(const std::string& name, Stack* stack) {
  if (name.empty() || name == "default") return;
  if (name == "paper") {
    ApplyTasks(YAML::Load(kPaper), "task set 'paper'", stack);
    return;
  }
  YAML::Node root;
  try {
    root = YAML::LoadFile(name);
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument("task set '" + name +
                                "': is neither default, paper, nor a file "
                                "that can be read");
  } catch (const YAML::ParserException& error) {
    throw std::invalid_argument(
        name + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  if (!root.IsMap() || !root["tasks"]) {
    throw std::invalid_argument(name + ":1: has no section 'tasks'");
  }
  ApplyTasks(root["tasks"], name, stack);
}

}  // namespace poise
