// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Reads the folder of a run. Returns the data of a report:
///     name     name of the folder.
///     summary  summary.json, or null, see ReadRunSummary().
///     robot    robot.json, see MakeRobotJson(). If null, no robot is drawn.
///     log      see ReadRunLog().
///     timing   see ReadTiming(), or null.
///     notes    [sentence, ...]: missing files and errors in the log.
/// Only the log is required. Throws std::invalid_argument with the name of the
/// file if the folder or its log is missing, or if a file is invalid.
nlohmann::json ReadRun(const std::filesystem::path& run_dir);

/// A run that this process has recorded, with the data that need not be read
/// again.
struct RunFiles {
  std::filesystem::path folder;
  nlohmann::json summary;  ///< See ToJson().
  nlohmann::json robot;    ///< See MakeRobotJson().
  long num_rows = 0;       ///< Number of rows of the log.
};

/// Reads the log of a recorded run once. Returns the same as
/// ReadRun(run.folder).
nlohmann::json ReadRun(const RunFiles& run);

/// Inserts a document into a page of tools/viewer/dist as its block of data.
/// Text in the document is escaped, so that no text can end the block.
std::string FillPage(std::string_view page, const nlohmann::json& document);

/// Writes a self-contained page that shows one run, or compares two runs at the
/// same time. Returns the notes about the runs, each with the folder before it.
/// Throws std::invalid_argument if the number of runs is not one or
/// two, if a run cannot be read, or if the page cannot be written.
///
/// @param packages  if not empty, meshes that a run did not find are searched
///                  again, see AddMeshes().
std::vector<std::string> WriteReport(
    const std::vector<std::filesystem::path>& run_dirs,
    const std::filesystem::path& html,
    const std::vector<std::filesystem::path>& packages = {});

/// Writes the same page for one run that this process has recorded.
void WriteRunReport(const RunFiles& run, const std::filesystem::path& html);

}  // namespace poise
