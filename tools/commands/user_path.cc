// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/user_path.h"

#include <cstdlib>

namespace poise {

std::filesystem::path UserPath(const std::string& typed) {
  const char* start = std::getenv("BUILD_WORKING_DIRECTORY");
  // If `typed` is absolute, operator/ ignores `start`.
  return start ? std::filesystem::path(start) / typed
               : std::filesystem::path(typed);
}

}  // namespace poise
