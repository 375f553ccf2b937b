// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/log/log_rows.h"

namespace poise {

/// What `push` was told.
struct PushOptions {
  std::unique_ptr<ClosedLoop> loop;  ///< At its start.
  std::filesystem::path robot_file;
  std::filesystem::path out;
  LogFormat log = LogFormat::kCsv;
  std::optional<double> dump_solve;  ///< When to dump a hierarchy, s.
  bool report = true;
  bool json = false;
  std::vector<Finding> findings;  ///< About the robot's file.
};

/// Reads the command line of `push`, the robot and the scenario.
///
/// Throws as ParseCommandLine(), and std::invalid_argument about what it names.
PushOptions ReadPushOptions(int argc, char** argv);

}  // namespace poise
