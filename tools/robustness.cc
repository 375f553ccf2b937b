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
#include "poise/tools/commands/user_path.h"
#include "poise/tools/studies/trials.h"

namespace poise {
namespace {

// Runs all trials, one per core at a time, and prints their rows in order.
// Returns true if each trial had the outcome that it must have.
bool RunAll(const std::vector<Trial>& trials) {
  const size_t cores = std::max(1u, std::thread::hardware_concurrency());
  std::deque<std::future<TrialResult>> running;
  bool all_hold = true;
  for (size_t i = 0, started = 0; i < trials.size(); ++i) {
    for (; started < std::min(i + cores, trials.size()); ++started) {
      running.push_back(
          std::async(std::launch::async, Try, std::cref(trials[started])));
    }
    const TrialResult result = running.front().get();
    running.pop_front();
    std::cout << ToRow(trials[i], result) << std::endl;
    all_hold = all_hold && result.holds;
  }
  return all_hold;
}

// Returns the trials that the options select. Throws std::invalid_argument if
// there are none, because an empty table must not count as success.
std::vector<Trial> MakeTrials(const std::string& robots,
                              const std::string& only) {
  std::vector<std::string> skipped;
  std::vector<Trial> trials =
      robots.empty() ? RobustnessTrials()
                     : RobotTrials(UserPath(robots), only, &skipped);
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
      "Pushes the humanoid in all directions, with wrong masses, delays, "
      "noise, "
      "slippery ground, weak motors and slow clocks, and prints a table of the "
      "results. With --robots, pushes other robots. Exit code 1 if a result is "
      "not the expected one.",
      "robustness");
  std::string robots, only;
  app.add_option(
      "--robots", robots,
      "push the robots of this folder of URDF files instead. A robot "
      "uses the profile NAME.yaml beside it, or a profile of Poise, or "
      "the feet and posture that Poise finds");
  app.add_option("--only", only,
                 "run only the rows whose name contains this text");
  ParseCommandLine(argc, argv, &app);
  const std::vector<Trial> trials = MakeTrials(robots, only);
  std::cout
      << "| what | `push` | it | CoM error, peak x, y, z [mm] | at the "
         "end [mm] | foot tilt [rad] | lean, peak and late [rad] | past "
         "joint limits [rad] | ticks with self-contact | as it must |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  return RunAll(trials) ? 0 : 1;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("robustness", [=] { return poise::Main(argc, argv); });
}
