// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/output_folder.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/user_path.h"
#include "poise/tools/studies/robot_trials.h"
#include "poise/tools/studies/robots_page.h"
#include "poise/tools/studies/run_in_order.h"
#include "poise/tools/studies/trials.h"

namespace poise {
namespace {

// Part of the trials with steps that may fail. Such a run has up to a dozen
// impacts and is chaotic: rounding decides one push in a hundred.
constexpr double kMissedSteps = 0.02;

// Runs all trials and prints their rows in order. Returns the number of trials
// that did not have the outcome that they must have.
int RunAll(const std::vector<Trial>& trials) {
  int missed = 0;
  RunInOrder(
      trials.size(), [&](std::size_t i) { return Try(trials[i]); },
      [&](std::size_t i, const TrialResult& result) {
        std::cout << ToRow(trials[i], result) << std::endl;
        if (!result.holds) ++missed;
      });
  return missed;
}

// Returns the trials that the options select. Throws std::invalid_argument if
// there are none, because an empty table must not count as success.
std::vector<Trial> MakeTrials(const std::string& only, bool steps) {
  std::vector<Trial> trials = steps ? StepTrials() : RobustnessTrials();
  const auto is_left_out = [&only](const Trial& trial) {
    return trial.what.find(only) == std::string::npos;
  };
  trials.erase(std::remove_if(trials.begin(), trials.end(), is_left_out),
               trials.end());
  if (!trials.empty()) return trials;
  throw std::invalid_argument("--only is " + Quoted(only) +
                              ", must be part of the name of a row");
}

int TryHumanoid(const std::string& only, bool steps) {
  const std::vector<Trial> trials = MakeTrials(only, steps);
  std::cout
      << "| what | `push` | it | CoM error, peak x, y, z [mm] | at the "
         "end [mm] | foot tilt [rad] | lean, peak and late [rad] | past "
         "joint limits [rad] | ticks with self-contact | as it must |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  const int missed = RunAll(trials);
  std::cout << '\n'
            << trials.size() - missed << " of " << trials.size()
            << " rows as they must be\n";
  const double most =
      steps ? kMissedSteps * static_cast<double>(trials.size()) : 0;
  return missed <= most ? 0 : 1;
}

// The options for the robots of a folder.
struct RobotOptions {
  std::string folder, out;
  std::vector<std::string> packages;
  bool json = false;
};

int TryRobots(const RobotOptions& options, const std::string& only) {
  std::filesystem::path page;
  if (!options.out.empty()) page = MakeOutputFolder(options.out);
  const RobotFolder robots{UserPath(options.folder),
                           PackageFolders(options.packages), only};
  // The head follows the first run, so that a refused folder prints nothing.
  bool has_head = false;
  const auto show = [&](const RobotTrial& trial) {
    if (options.json) return;
    if (!has_head) std::cout << RobotsHead(false) << '\n';
    has_head = true;
    std::cout << RobotRow(trial, false) << std::endl;
  };
  const std::vector<RobotTrial> trials = RunRobots(robots, show);
  if (!page.empty()) WriteRobotsPage(trials, page);
  const std::ptrdiff_t kept = std::count_if(
      trials.begin(), trials.end(),
      [](const RobotTrial& trial) { return trial.faults.empty(); });
  if (options.json) {
    std::cout << RobotsToJson(trials).dump(2) << '\n';
  } else {
    std::cout << '\n'
              << kept << " of " << trials.size() << " robots as expected\n";
  }
  return kept == static_cast<std::ptrdiff_t>(trials.size()) ? 0 : 1;
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Pushes the humanoid in all directions, and with wrong masses, delays, "
      "noise, slippery ground, weak motors and low control rates. With "
      "--robots, runs every URDF of a folder. Prints a table. Exit code 1 if a "
      "row is not as required.",
      "robustness");
  RobotOptions robots;
  std::string only;
  bool steps = false;
  CLI::Option* folder = app.add_option(
      "--robots", robots.folder,
      "run the robots of this folder of URDF files instead: each stands, is "
      "pushed to four sides, and stands on one leg. A robot uses the profile "
      "NAME.yaml beside it, or a profile of Poise, or the feet and posture "
      "that Poise finds. EXPECTED.json in the folder says what each must do");
  AddPackagePath(&app, &robots.packages);
  app.add_option("--out", robots.out,
                 "with --robots: write robots.md and pictures to this folder")
      ->needs(folder);
  app.add_flag("--json", robots.json,
               "with --robots: print one JSON document instead of the table")
      ->needs(folder);
  app.add_flag("--steps", steps,
               "push a robot that may take steps: 16 directions with each of "
               "12 errors")
      ->excludes(folder);
  app.add_option("--only", only,
                 "run only the rows whose name contains this text");
  ParseCommandLine(argc, argv, &app);
  return robots.folder.empty() ? TryHumanoid(only, steps)
                               : TryRobots(robots, only);
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("robustness", [=] { return poise::Main(argc, argv); });
}
