// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/log/log_rows.h"
#include "poise/sim/run.h"
#include "poise/tools/commands/report/report_page.h"

namespace poise {

/// A run that has just been recorded.
struct RunRecord {
  RunResult result;
  std::optional<double> step_Ns;  ///< See ComputeStepYardstick(), N s.
  /// Input of WriteRunReport(), so that no file is read again.
  RunFiles files;
};

/// Runs a new loop and writes all files of a report into a folder: log.csv or
/// log.bin, timing.csv, summary.json and robot.json. See Run() for `progress`
/// and `format`. Removes these files of an earlier run, and its report.html,
/// from the folder.
///
/// Throws std::invalid_argument as Run() does, or if a file cannot be written.
/// If Run() rejects the scenario, or if one of the files cannot be written
/// before the first tick, the files of the earlier run remain.
RunRecord RecordRun(ClosedLoop* loop, const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress = {},
                    LogFormat format = LogFormat::kCsv);
RunRecord RecordRun(const Experiment& experiment,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress = {},
                    LogFormat format = LogFormat::kCsv);

}  // namespace poise
