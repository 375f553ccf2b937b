// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/dump_solve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "poise/robot/control/controller.h"
#include "poise/robot/finding.h"
#include "poise/robot/output_file.h"
#include "poise/sim/closed_loop.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/shell_word.h"

namespace poise {
namespace {

// Returns a time for the name of a file, with as many digits as tell two ticks
// apart.
std::string Text(double time, double dt, int width = 0) {
  const int digits =
      std::max(3, static_cast<int>(std::ceil(-std::log10(dt) - 1e-9)));
  char text[64];
  std::snprintf(text, sizeof text, "%0*.*f", width, digits, time);
  return text;
}

void Check(const DumpedTicks& ticks, double dt, double duration) {
  if (!(ticks.last >= 0 && ticks.last < duration &&
        std::lround(ticks.last / dt) < std::lround(duration / dt))) {
    throw std::invalid_argument("the solve at " + std::to_string(ticks.last) +
                                " s is outside the scenario, which ends at " +
                                std::to_string(duration) + " s");
  }
  if (!(ticks.first >= 0 && ticks.first <= ticks.last)) {
    throw std::invalid_argument("--dump-from is " +
                                std::to_string(ticks.first) +
                                " s, must not be after --dump-solve, " +
                                std::to_string(ticks.last) + " s");
  }
}

void Write(const Hierarchy& hierarchy, const std::filesystem::path& file) {
  WriteFile(file, WriteHqp(hierarchy) + '\n');
}

// Makes a folder without files of another dump.
void MakeEmpty(const std::filesystem::path& folder) {
  MakeFolder(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("solve_", 0) == 0) std::filesystem::remove(entry.path());
  }
}

}  // namespace

std::filesystem::path DumpSolve(const Experiment& experiment,
                                const DumpedTicks& ticks,
                                const std::filesystem::path& folder) {
  const auto& [robot, scenario] = experiment;
  const double dt = scenario.control.dt;
  Check(ticks, dt, scenario.duration);
  const long first = std::lround(ticks.first / dt);
  const long last = std::lround(ticks.last / dt);
  const std::string last_text = Text(ticks.last, dt);
  const bool is_one = first == last;
  const std::filesystem::path to =
      is_one ? folder
             : folder / ("solves_" + Text(ticks.first, dt) + "_" + last_text);
  if (is_one) {
    MakeFolder(to);
  } else {
    MakeEmpty(to);
  }
  ClosedLoop loop(robot, scenario);
  for (long tick = 0; tick <= last; ++tick) {
    loop.Tick();
    if (tick < first) continue;
    const std::string time = is_one ? last_text
                                    : Text(static_cast<double>(tick) * dt, dt,
                                           static_cast<int>(last_text.size()));
    Write(loop.controller().hierarchy(), to / ("solve_" + time + ".json"));
  }
  return to / ("solve_" + (is_one ? last_text : "*") + ".json");
}

std::string SolveAgain(const ControlSettings& control, const DumpedTicks& ticks,
                       const std::filesystem::path& dumped) {
  std::string command = "bazel run //tools:hqp -- --max-iterations " +
                        std::to_string(ControllerOptions().max_iterations);
  const bool has_budget = control.budget_us > 0 && !control.budget_clock;
  if (has_budget && std::lround(ticks.first / control.dt) == 0) {
    command += " --budget-us " + PrintNumber(control.budget_us);
  }
  // The name of the file may have a '*' for the shell.
  return command + " " + ShellWord(dumped.parent_path().string()) + "/" +
         dumped.filename().string();
}

}  // namespace poise
