// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>

#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/log/log_rows.h"
#include "poise/sim/run.h"
#include "poise/tools/commands/report/report_page.h"

namespace poise {

/// A run that has just been recorded.
struct RunRecord {
  RunResult result;
  RunFiles files;  ///< What WriteRunReport() needs, without reading it again.
};

/// Runs a new loop into a folder that holds all that a report is made of:
/// log.csv or log.bin, timing.csv, summary.json, robot.json. See Run() for
/// `progress` and `format`. What another run left there, its report.html too, is
/// removed.
///
/// Throws std::invalid_argument as Run() does, or if a file cannot be written.
RunRecord RecordRun(ClosedLoop* loop, const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress = {},
                    LogFormat format = LogFormat::kCsv);
RunRecord RecordRun(const Experiment& experiment,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress = {},
                    LogFormat format = LogFormat::kCsv);

}  // namespace poise
