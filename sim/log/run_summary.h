// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// The end of a run, as its folder has it.
struct RunSummary {
  /// summary.json; null if it is not there, cannot be read, or is not of the
  /// log beside it, by its log_sha256.
  nlohmann::json values;
  std::string note;  ///< A sentence: why it is null. Else empty.
  bool is_of_other_log = false;
};

/// Reads summary.json, and the whole log once. A summary without log_sha256 is
/// taken for the log's.
RunSummary ReadRunSummary(const std::filesystem::path& run);

}  // namespace poise
