// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// The end of a run, as its folder has it.
struct RunSummary {
  /// summary.json; null if it does not exist, cannot be read, or belongs to another
  /// log according to its log_sha256.
  nlohmann::json values;
  std::string note;  ///< A sentence: why it is null. Else empty.
  bool is_of_other_log = false;
};

/// Reads summary.json, and the whole log once. A summary without log_sha256 counts
/// as that of the log.
RunSummary ReadRunSummary(const std::filesystem::path& run);

}  // namespace poise
