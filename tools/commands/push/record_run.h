// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>

#include "poise/sim/experiment.h"
#include "poise/sim/log/log_rows.h"
#include "poise/sim/run.h"

namespace poise {

/// Runs an experiment into a folder that holds all that a report is made of:
/// log.csv or log.bin, timing.csv, summary.json, robot.json. See Run() for
/// `progress` and `format`. What another run left there, its report.html too, is
/// removed.
///
/// Throws std::invalid_argument as Run() does, or if a file cannot be written.
RunResult RecordRun(const Experiment& experiment,
                    const std::filesystem::path& folder,
                    const std::function<bool(double)>& progress = {},
                    LogFormat format = LogFormat::kCsv);

}  // namespace poise
