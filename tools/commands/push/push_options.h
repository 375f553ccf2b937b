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
#include "poise/tools/commands/push/dump_solve.h"

namespace poise {

/// The options of `push`, with the robot and the scenario that they select.
struct PushOptions {
  std::unique_ptr<ClosedLoop> loop;  ///< Before its first tick.
  std::filesystem::path robot_file;
  std::filesystem::path out;
  LogFormat log = LogFormat::kCsv;
  std::optional<DumpedTicks> dumped;  ///< Hierarchies to write, if any.
  bool report = true;
  bool json = false;
  std::vector<Finding> findings;  ///< Findings about the robot file.
};

/// Reads the command line of `push`, the robot and the scenario.
///
/// Throws as ParseCommandLine() does. Throws std::invalid_argument if an
/// option, the robot, its profile or the scenario is invalid; the message names
/// the option or the file.
PushOptions ReadPushOptions(int argc, char** argv);

}  // namespace poise
