// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/default_stack.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

// Returns a robot with a body of 1 kg, a foot FOOT, a joint that moves 2 mg,
// and a joint that mimics it.
Robot MakeRobotWithAllTasks() {
  std::string text = "<robot name='r'>";
  for (const std::string link : {"body", "light", "coupled"}) {
    text += "<link name='" + link + "'><inertial><mass value='" +
            (link == "body" ? "1" : "2e-6") +
            "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
            "</inertial></link>";
  }
  for (const std::string child : {"light", "coupled"}) {
    text += "<joint name='" + child + "' type='continuous'>" +
            "<parent link='body'/><child link='" + child + "'/></joint>";
  }
  Robot robot{ParseUrdf(text + "</robot>", "robot"), {}, {}};
  const Tree& tree = robot.model.tree;
  robot.model.mimics = {
      {*tree.FindJoint("coupled"), *tree.FindJoint("light"), 1, 0}};
  robot.feet.resize(1);
  robot.feet[0].name = "FOOT";
  return robot;
}

// Reads the table in controller.h: name of a task to level, "3", or "(3)" for a
// task that is off.
std::map<std::string, std::string> ReadTable() {
  std::ifstream file("robot/control/controller.h");
  std::string text(std::istreambuf_iterator<char>(file), {});
  // A line without a level continues the one above it.
  text = std::regex_replace(text, std::regex("\n/// {12}"), " ");
  std::map<std::string, std::string> table;
  const std::regex row(R"(/// {5}(\d) {6}([^\n]*))"), name(R"([(]|[\w.]+|[)])");
  for (std::sregex_iterator r(text.begin(), text.end(), row), end; r != end;
       ++r) {
    const std::string level = r->str(1), tasks = r->str(2);
    bool is_off = false;
    for (std::sregex_iterator n(tasks.begin(), tasks.end(), name); n != end;
         ++n) {
      if (n->str() == "(" || n->str() == ")") {
        is_off = n->str() == "(";
      } else {
        table[n->str()] = is_off ? "(" + level + ")" : level;
      }
    }
  }
  return table;
}

TEST(MakeDefaultStack, MatchesTableInControllerHeader) {
  const Stack stack = MakeDefaultStack(MakeRobotWithAllTasks(), {"LINK"});
  std::map<std::string, std::string> made;
  for (int i = 0; i < stack.num_tasks(); ++i) {
    const TaskSettings& settings = stack.settings(i);
    const std::string level = std::to_string(settings.level);
    made[stack.task(i).name()] = settings.enabled ? level : "(" + level + ")";
  }
  EXPECT_EQ(made, ReadTable());
}

}  // namespace
}  // namespace poise
