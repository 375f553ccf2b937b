// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/scenario_files.h"

#include <algorithm>
#include <filesystem>

namespace poise {

std::vector<std::string> ScenarioFiles() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator("sim/scenarios")) {
    files.push_back(entry.path().string());
  }
  // A folder lists its files in no fixed order, but all shards must use the
  // same.
  std::sort(files.begin(), files.end());
  return files;
}

std::string ScenarioTestName(const testing::TestParamInfo<std::string>& file) {
  return std::filesystem::path(file.param).stem().string();
}

}  // namespace poise
