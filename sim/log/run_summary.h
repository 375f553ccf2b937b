// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// Summary of a run, read from its folder.
struct RunSummary {
  /// Contents of summary.json. Null if the file is missing, or if its
  /// log_sha256 is not the hash of the log in the same folder.
  nlohmann::json values;
  std::string note;  ///< Why `values` is null, in a sentence; else empty.
};

/// Reads summary.json, and the whole log once. A summary without log_sha256 is
/// accepted. Throws std::invalid_argument with the name of the file if it is
/// not the summary of a run, or if a value in it cannot be true.
RunSummary ReadRunSummary(const std::filesystem::path& run);

}  // namespace poise
