// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Computes the dynamics of a robot: bazel run //tools:dynamics -- --urdf ...

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/finding.h"
#include "poise/robot/text_file.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/log/parse_json.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/doctor/check_inertia.h"
#include "poise/tools/commands/dynamics/dynamics_file.h"
#include "poise/tools/commands/dynamics/dynamics_table.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1024;  // Largest states file, MiB.

// Warns if M cannot be inverted. M is printed anyway, so without the warning a
// user might invert it.
void WarnOfInertia(const std::string& urdf, const RobotModel& robot) {
  std::vector<Finding> findings;
  CheckInertia(robot, &findings);
  for (const Finding& finding : findings) {
    if (finding.severity != Severity::kWarn) continue;
    std::cerr << "dynamics: warning: " << Message(urdf, finding) << "\n";
  }
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Computes mass matrix, bias forces, inverse dynamics, centroidal "
      "momentum and frame Jacobians of a robot in given states.",
      "dynamics");
  std::string urdf, states;
  std::vector<std::string> frames;
  bool json = false;
  app.add_option("--urdf", urdf, "The robot, a URDF file")->required();
  app.add_option("--states", states, "The states, a JSON file")->required();
  app.add_option("--frames", frames,
                 "Links a,b,... to compute frames of; default: the keys of "
                 "'frames' in each state")
      ->delimiter(',');
  app.add_flag("--json", json, "Print one JSON document");
  ParseCommandLine(argc, argv, &app);
  const RobotModel robot = LoadUrdf(UserPath(urdf));
  CheckFrames(robot.tree, frames);
  const std::string text = ReadTextFile(UserPath(states), kMostMib);
  try {
    const nlohmann::json result =
        ComputeDynamics(robot.tree, ParseJson(text, states), frames);
    std::cout << (json ? result.dump() + "\n"
                       : FormatDynamics(robot.tree, result));
  } catch (const Refusal&) {  // Already names the file.
    throw;
  } catch (const std::exception& error) {
    throw std::invalid_argument(states + ": " + error.what());
  }
  WarnOfInertia(urdf, robot);
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("dynamics", [=] { return poise::Main(argc, argv); });
}
