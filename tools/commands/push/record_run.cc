// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/record_run.h"

#include <fstream>
#include <stdexcept>
#include <system_error>

#include "poise/sim/log/summary.h"
#include "poise/tools/commands/report/robot_json.h"

namespace poise {

namespace {

// What another run left, and would be taken for this one's.
void RemoveOld(const std::filesystem::path& folder) {
  for (const char* name : {"summary.json", "robot.json", "report.html"}) {
    std::error_code ignored;
    std::filesystem::remove(folder / name, ignored);
  }
}

}  // namespace

RunResult RecordRun(const Experiment& experiment,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress,
                    LogFormat format) {
  const auto& [robot, scenario] = experiment;
  // Once there is a new log: a run that is refused leaves the old one whole.
  bool has_begun = false;
  const auto watch = [&](double fraction) {
    if (!has_begun) RemoveOld(folder);
    has_begun = true;
    return !progress || progress(fraction);
  };
  const RunResult result = Run(robot, scenario, folder, watch, format);
  RemoveOld(folder);
  const std::filesystem::path file = folder / "summary.json";
  std::ofstream stream(file);
  stream << ToJson(robot, scenario, result).dump(2) << '\n';
  if (!stream.flush()) {
    throw std::invalid_argument(file.string() + ": cannot be written");
  }
  WriteRobotJson(robot, folder / "robot.json");
  return result;
}

}  // namespace poise
