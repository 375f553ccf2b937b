// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// A run's folder as the report shows it:
///     name     the folder's.
///     summary  summary.json, or null, see ReadRunSummary().
///     robot    robot.json (see MakeRobotJson()), or null: nothing to draw.
///     log      see ReadRunLog().
///     timing   see ReadTiming(), or null.
///     notes    [sentence, ...]: what is missing or broken.
/// A log is needed; the rest may be missing. Throws std::invalid_argument,
/// naming the file, if the folder or its log is not there, or that is no log.
nlohmann::json ReadRun(const std::filesystem::path& run_dir);

/// A run that was recorded by this process, with what need not be read again.
struct RunFiles {
  std::filesystem::path folder;
  nlohmann::json summary;  ///< See ToJson().
  nlohmann::json robot;    ///< See MakeRobotJson().
  long num_rows = 0;       ///< Of the log.
};

/// Reads the log of a recorded run, once. Returns the same as ReadRun(folder).
nlohmann::json ReadRun(const RunFiles& run);

/// Puts a document into a page of tools/viewer/dist as its block of data.
/// Nothing in the document can end that block.
std::string FillPage(std::string_view page, const nlohmann::json& document);

/// Writes one self-contained page that shows a run, or compares two on one
/// clock. Throws std::invalid_argument if there is not one run or two, if one
/// cannot be read, or if the page cannot be written.
void WriteReport(const std::vector<std::filesystem::path>& run_dirs,
                 const std::filesystem::path& html);

/// Writes the same page for one run that was recorded by this process.
void WriteRunReport(const RunFiles& run, const std::filesystem::path& html);

}  // namespace poise
