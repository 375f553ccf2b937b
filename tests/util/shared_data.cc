// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/shared_data.h"

#include <cstdlib>
#include <iostream>

namespace poise {

std::optional<std::filesystem::path> SharedData(std::string_view sub) {
  const char* shared = std::getenv("POISE_SHARED");
  if (shared != nullptr && *shared != '\0') {
    const std::filesystem::path path = std::filesystem::path(shared) / sub;
    if (std::filesystem::exists(path)) return path;
  }
  std::cout << "Runs without " << sub
            << ": POISE_SHARED does not name a folder that contains it.\n";
  return std::nullopt;
}

}  // namespace poise
