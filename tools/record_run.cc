// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/record_run.h"

#include <fstream>
#include <stdexcept>

#include "sim/summary.h"
#include "tools/robot_json.h"

namespace poise {

RunResult RecordRun(const Robot& robot, const Scenario& scenario,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress,
                    LogFormat format) {
  const RunResult result = Run(robot, scenario, folder, progress, format);
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
