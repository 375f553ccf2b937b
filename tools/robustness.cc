// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <future>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/user_path.h"
#include "poise/tools/studies/trials.h"

namespace poise {
namespace {

// Part of the trials with steps that may fail. Such a run has up to a dozen
// impacts and is chaotic: rounding decides one push in a hundred.
constexpr double kMissedSteps = 0.02;

// Runs all trials, one per core at a time, and prints their rows in order.
// Returns the number of trials that did not have the outcome that they must
// have.
int RunAll(const std::vector<Trial>& trials) {
  const size_t cores = std::max(1u, std::thread::hardware_concurrency());
  std::deque<std::future<TrialResult>> running;
  int missed = 0;
  for (size_t i = 0, started = 0; i < trials.size(); ++i) {
    for (; started < std::min(i + cores, trials.size()); ++started) {
      running.push_back(
          std::async(std::launch::async, Try, std::cref(trials[started])));
    }
    const TrialResult result = running.front().get();
    running.pop_front();
    std::cout << ToRow(trials[i], result) << std::endl;
    if (!result.holds) ++missed;
  }
  return missed;
}

// Returns the trials that the options select. Throws std::invalid_argument if
// there are none, because an empty table must not count as success.
std::vector<Trial> MakeTrials(const std::string& robots,
                              const std::vector<std::string>& packages,
                              const std::string& only, bool steps) {
  std::vector<std::string> skipped;
  std::vector<Trial> trials =
      !robots.empty() ? RobotTrials(UserPath(robots), only, &skipped,
                                    PackageFolders(packages))
      : steps         ? StepTrials()
                      : RobustnessTrials();
  for (const std::string& line : skipped) {
    std::cerr << "robustness: " << line << std::endl;
  }
  const auto is_left_out = [&only](const Trial& trial) {
    return trial.what.find(only) == std::string::npos;
  };
  trials.erase(std::remove_if(trials.begin(), trials.end(), is_left_out),
               trials.end());
  if (!trials.empty()) return trials;
  if (!skipped.empty()) {
    throw std::invalid_argument(UserPath(robots).string() +
                                ": has no robot with feet");
  }
  throw std::invalid_argument("--only is " + Quoted(only) +
                              ", must be part of the name of a row");
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Pushes the humanoid in all directions, and with wrong masses, delays, "
      "noise, slippery ground, weak motors and low control rates. With "
      "--robots, runs every URDF of a folder. Prints a table. Exit code 1 if a "
      "row is not as required.",
      "robustness");
  std::string robots, only;
  std::vector<std::string> packages;
  bool steps = false;
  app.add_option(
      "--robots", robots,
      "push the robots of this folder of URDF files instead. A robot "
      "uses the profile NAME.yaml beside it, or a profile of Poise, or "
      "the feet and posture that Poise finds");
  AddPackagePath(&app, &packages);
  app.add_flag("--steps", steps,
               "push a robot that may take steps: 16 directions with each of "
               "12 errors");
  app.add_option("--only", only,
                 "run only the rows whose name contains this text");
  ParseCommandLine(argc, argv, &app);
  const std::vector<Trial> trials = MakeTrials(robots, packages, only, steps);
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

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("robustness", [=] { return poise::Main(argc, argv); });
}
