// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tools/commands/push_map/push_map_run.h"

namespace poise {

/// What `push_map` was told.
struct PushMapOptions {
  PushMapPlan plan;
  std::string settings;  ///< See PushMapFiles.
  bool header = true;
  bool json = false;
};

/// Reads the command line of `push_map`: its own options and, for the rest,
/// those of `push`.
///
/// Throws as ParseCommandLine(), and std::invalid_argument about what it names.
PushMapOptions ReadPushMapOptions(int argc, char** argv);

}  // namespace poise
