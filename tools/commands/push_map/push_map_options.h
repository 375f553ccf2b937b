// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tools/commands/push_map/push_map_run.h"

namespace poise {

/// The options of `push_map`.
struct PushMapOptions {
  PushMapPlan plan;
  std::string settings;  ///< See PushMapFiles.
  bool header = true;
  bool json = false;
};

/// Reads the command line of `push_map`. Options that `push_map` does not have
/// are options of `push`.
///
/// Throws as ParseCommandLine() and ReadPushOptions() do. Also throws
/// std::invalid_argument if a shard is invalid, or if an option of `push`
/// cannot be used in a map.
PushMapOptions ReadPushMapOptions(int argc, char** argv);

}  // namespace poise
