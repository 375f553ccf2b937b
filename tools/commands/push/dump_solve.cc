// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/dump_solve.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "poise/sim/closed_loop.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {

std::filesystem::path DumpSolve(const Experiment& experiment, double time,
                                const std::filesystem::path& folder) {
  const auto& [robot, scenario] = experiment;
  char name[32];
  std::snprintf(name, sizeof name, "solve_%.3f.json", time);
  if (!(time >= 0 && time < scenario.duration)) {
    throw std::invalid_argument("the solve at " + std::to_string(time) +
                                " s is outside the scenario, which ends at " +
                                std::to_string(scenario.duration) + " s");
  }
  ClosedLoop loop(robot, scenario);
  const long ticks = std::lround(time / scenario.control.dt);
  for (long tick = 0; tick <= ticks; ++tick) loop.Tick();
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / name;
  std::ofstream stream(file);
  stream << WriteHqp(loop.controller().hierarchy()) << '\n';
  if (!stream.flush()) {
    throw std::invalid_argument(file.string() + ": cannot be written");
  }
  return file;
}

}  // namespace poise
