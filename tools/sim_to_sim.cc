// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <future>
#include <iostream>
#include <set>
#include <string>

#include "poise/robot/profile/profile.h"
#include "poise/sim/experiment.h"
#include "poise/sim/outcome.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/command_line.h"

namespace poise {
namespace {

constexpr const char* kScenarios = "sim/scenarios";

// Returns the files of Poise's scenarios in alphabetical order.
std::set<std::filesystem::path> ScenarioFiles() {
  return {std::filesystem::directory_iterator(kScenarios),
          std::filesystem::directory_iterator()};
}

// Prints a row of the table. An interrupted program keeps the rows before.
void PrintRow(const std::string& name, const Verdict& bullet,
              const Verdict& mujoco) {
  std::printf("| `%s` | %s | %s |", name.c_str(), Outcome(bullet).c_str(),
              Outcome(mujoco).c_str());
  for (int i = 0; i < 3; ++i) {
    std::printf(" %.1f / %.1f |", 1e3 * bullet.com_error_peak[i],
                1e3 * mujoco.com_error_peak[i]);
  }
  std::printf(" %.4f / %.4f | %.2f / %.2f |\n", bullet.foot_tilt_peak,
              mujoco.foot_tilt_peak, 1e3 * bullet.foot_slide_peak,
              1e3 * mujoco.foot_slide_peak);
  std::fflush(stdout);
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Runs each scenario in Bullet and in MuJoCo, and prints a table of both "
      "results, see docs/plants.md. Exit code 1 if the robot recovers in only "
      "one of them.",
      "sim_to_sim");
  ParseCommandLine(argc, argv, &app);
  const Robot robot = LoadRobot("robot/models/humanoid.urdf",
                                LoadProfile("robot/profiles/humanoid.yaml"));
  bool agree = true;
  std::cout << "| scenario | Bullet | MuJoCo | CoM error, peak x [mm] | y "
               "[mm] | z [mm] | foot tilt [rad] | foot slide [mm] |\n"
               "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::filesystem::path& file : ScenarioFiles()) {
    std::array<std::future<Verdict>, 2> verdicts;
    for (const int i : {0, 1}) {
      Experiment experiment{robot, LoadScenario(file)};
      experiment.scenario.plant_kind = i == 0 ? "bullet" : "mujoco";
      verdicts[i] = std::async(std::launch::async, [experiment] {
        return Run(experiment.robot, experiment.scenario).verdict;
      });
    }
    const Verdict bullet = verdicts[0].get();
    const Verdict mujoco = verdicts[1].get();
    PrintRow(file.stem().string(), bullet, mujoco);
    agree = agree && bullet.recovered == mujoco.recovered;
  }
  return agree ? 0 : 1;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("sim_to_sim", [=] { return poise::Main(argc, argv); });
}
