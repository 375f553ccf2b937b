// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/record_run.h"

#include <string>
#include <system_error>

#include "poise/robot/output_file.h"
#include "poise/sim/log/summary.h"
#include "poise/sim/push.h"
#include "poise/sim/step_yardstick.h"
#include "poise/tools/commands/report/robot_json.h"

namespace poise {

namespace {

constexpr const char* kAfterTheRun[] = {"summary.json", "robot.json",
                                        "report.html"};

// Removes the files of an earlier run, because they would seem to belong to the
// new log.
void RemoveOld(const std::filesystem::path& folder) {
  for (const char* name : kAfterTheRun) {
    std::error_code ignored;
    std::filesystem::remove(folder / name, ignored);
  }
}

// Returns the pendulum's bound for one step and the largest push; nothing for a
// push without a direction in the world.
std::optional<double> StepYardstick(const Robot& robot,
                                    const Scenario& scenario) {
  const Push* push = LargestPush(scenario.pushes, scenario.duration);
  const bool has_direction = push != nullptr &&
                             push->frame == PushFrame::kWorld &&
                             !push->force.head<2>().isZero();
  if (!has_direction) return std::nullopt;
  return ComputeStepYardstick(robot, push->force.head<2>(), push->duration);
}

void Write(const std::string& text, const std::filesystem::path& file) {
  WriteFile(file, text + '\n');
}

}  // namespace

RunRecord RecordRun(ClosedLoop* loop, const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress,
                    LogFormat format) {
  for (const char* name : kAfterTheRun) RequireWritable(folder / name);
  // Old files are removed only after the new log has begun. So a run that is
  // rejected does not damage the earlier run.
  bool has_begun = false;
  const auto watch = [&](double fraction) {
    if (!has_begun) RemoveOld(folder);
    has_begun = true;
    return !progress || progress(fraction);
  };
  RunRecord record{Run(loop, folder, watch, format), {}, {}};
  record.step_Ns = StepYardstick(loop->robot(), loop->scenario());
  RemoveOld(folder);
  const auto summary =
      ToJson(loop->robot(), loop->scenario(), record.result, record.step_Ns);
  record.files = {folder, summary, MakeRobotJson(loop->robot()),
                  record.result.ticks};
  Write(summary.dump(2), folder / "summary.json");
  Write(record.files.robot.dump(1), folder / "robot.json");
  return record;
}

RunRecord RecordRun(const Experiment& experiment,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress,
                    LogFormat format) {
  ClosedLoop loop(experiment.robot, experiment.scenario);
  return RecordRun(&loop, folder, progress, format);
}

}  // namespace poise
