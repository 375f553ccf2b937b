// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/task_set.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/robot/profile/yaml_file.h"

namespace poise {
namespace {

// Four levels, without torque, joint and yaw limits, and without a task for the
// orientation of the pelvis.
constexpr char kPaper[] = R"(
torque_limits: off
joint_limits: off
yaw: off
contact: {level: 2}
cop: {level: 2}
friction: {level: 2}
unilateral: {level: 2}
momentum: {level: 3, k_orientation: 0, capture: 0}
posture: {level: 4, inertia: 0}
force_regularizer: {level: 4}
)";

std::string NamesOf(const Stack& stack) {
  std::string names;
  for (int i = 0; i < stack.num_tasks(); ++i) {
    names += (i == 0 ? "" : ", ") + stack.task(i).name();
  }
  return names + ", or frame.LINK";
}

constexpr std::string_view kFrame = "frame.";

bool IsFrame(const std::string& task) { return task.rfind(kFrame, 0) == 0; }

std::string NamesOf(const Task& task) {
  std::string names = "on, level, weight";
  for (const Parameter& each : task.parameters()) names += ", " + each.name;
  return names;
}

// Returns nullptr if the task has no such parameter. pre: the task exists.
const Parameter* FindParameter(const Stack& stack, const std::string& task,
                               const std::string& name) {
  for (const Parameter& each : stack.task(*stack.Find(task)).parameters()) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

std::string MustBe(double least, double most) {
  return "must be " + PrintNumber(least) + " to " + PrintNumber(most);
}

void ApplyTask(const std::string& name, const YAML::Node& node,
               const std::string& file, Stack* stack) {
  const std::string what = "task " + Quoted(name);
  bool on = false;
  if (node.IsScalar() && YAML::convert<bool>::decode(node, on)) {
    (void)stack->Enable(name, on);
    return;
  }
  if (!node.IsMap()) {
    Refuse(file, node,
           what + " is " + Shown(node) + ", must be on, off, or a map");
  }
  if (node["level"] && node["rank"]) {
    Refuse(file, node,
           what + " has both 'level' and its alias 'rank', must have one");
  }
  for (const auto& field : node) {
    const std::string& key = field.first.Scalar();
    const YAML::Node& value = field.second;
    const auto refuse = [&](const std::string& wanted) {
      Refuse(file, value,
             what + ": " + Quoted(key) + " is " + Shown(value) + ", " + wanted);
    };
    if (key == "on") {
      if (!value.IsScalar() || !YAML::convert<bool>::decode(value, on)) {
        refuse("must be true or false");
      }
      (void)stack->Enable(name, on);
      continue;
    }
    const auto read = ToNumber(value);
    if (!read) refuse("must be a finite number");
    const double number = *read;
    if (key == "level" || key == "rank") {
      const int level = number >= 1 && number <= Stack::kMaxLevel
                            ? static_cast<int>(number)
                            : 0;
      if (level != number || !stack->SetLevel(name, level)) {
        refuse("must be 1 to " + std::to_string(Stack::kMaxLevel));
      }
    } else if (key == "weight") {
      if (!stack->SetWeight(name, number)) {
        refuse(MustBe(Stack::kLeastWeight, Stack::kMostWeight));
      }
    } else if (const Parameter* of = FindParameter(*stack, name, key)) {
      if (!stack->SetParameter(name, key, number)) {
        refuse(MustBe(of->lower, of->upper));
      }
    } else {
      Refuse(file, field.first,
             what + " has no " + Quoted(key) + ", only " +
                 NamesOf(stack->task(*stack->Find(name))));
    }
  }
}

// Returns the section `tasks` of a file.
YAML::Node LoadTasks(const std::string& file) {
  std::error_code too_long;  // Set if the name is too long for a file.
  if (!std::filesystem::exists(file, too_long)) {
    throw std::invalid_argument("task set " + Quoted(file) +
                                ": is neither default, paper, nor a file");
  }
  const YAML::Node root = LoadYaml(file);
  if (!root.IsMap() || !root["tasks"]) {
    Refuse(file, root, "has no section 'tasks'");
  }
  return root["tasks"];
}

bool IsFile(const std::string& set) {
  return !set.empty() && set != "default" && set != "paper";
}

void AddLink(const std::string& task, const Robot& robot,
             std::vector<std::string>* links) {
  if (!IsFrame(task)) return;
  const std::string link = task.substr(kFrame.size());
  for (const Foot& foot : robot.feet) {
    if (foot.name == link) return;  // A foot has its task already.
  }
  if (!robot.model.tree.FindFrame(link)) return;
  if (std::find(links->begin(), links->end(), link) != links->end()) return;
  links->push_back(link);
}

// Returns the shortest text that is read back as the same number.
std::string Shortest(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return {text, end};
}

}  // namespace

std::string UnknownTask(const std::string& name, const Stack& stack) {
  return "task " + Quoted(name) + " is unknown, must be " +
         (IsFrame(name) ? "frame.LINK with a link of the robot"
                        : "one of " + NamesOf(stack));
}

void ApplyTasks(const YAML::Node& tasks, const std::string& file,
                Stack* stack) {
  if (!tasks.IsMap()) {
    Refuse(file, tasks, "tasks is " + Shown(tasks) + ", must be a map");
  }
  for (const auto& field : tasks) {
    const std::string& name = field.first.Scalar();
    if (!stack->Find(name)) {
      Refuse(file, field.first, UnknownTask(name, *stack));
    }
    ApplyTask(name, field.second, file, stack);
  }
}

YAML::Node DescribeTasks(const Stack& stack) {
  YAML::Node tasks(YAML::NodeType::Map);
  for (int i = 0; i < stack.num_tasks(); ++i) {
    const Task& task = stack.task(i);
    const TaskSettings& settings = stack.settings(i);
    YAML::Node fields(YAML::NodeType::Map);
    fields.SetStyle(YAML::EmitterStyle::Flow);
    fields["on"] = settings.enabled;
    fields["level"] = settings.level;
    fields["weight"] = Shortest(settings.weight);
    for (const Parameter& each : task.parameters()) {
      fields[each.name] = Shortest(*each.value);
    }
    tasks[task.name()] = fields;
  }
  return tasks;
}

std::vector<std::string> FindTaskLinks(const YAML::Node& tasks,
                                       const Robot& robot) {
  std::vector<std::string> links;
  if (!tasks.IsMap()) return links;
  for (const auto& field : tasks) {
    AddLink(field.first.Scalar(), robot, &links);
  }
  return links;
}

std::vector<std::string> FindTaskLinks(const std::string& set,
                                       const std::vector<std::string>& tasks,
                                       const Robot& robot) {
  std::vector<std::string> links;
  if (IsFile(set)) links = FindTaskLinks(LoadTasks(set), robot);
  for (const std::string& task : tasks) AddLink(task, robot, &links);
  return links;
}

void ApplyTaskSet(const std::string& name, Stack* stack) {
  if (IsFile(name)) {
    ApplyTasks(LoadTasks(name), name, stack);
  } else if (name == "paper") {
    ApplyTasks(YAML::Load(kPaper), "task set 'paper'", stack);
  }
}

}  // namespace poise
