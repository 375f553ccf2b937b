// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <memory>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// Returns the path of the log in a run's folder: log.bin if only that file
/// exists, else log.csv. Throws std::invalid_argument if `run` is not a folder.
std::filesystem::path FindLog(const std::filesystem::path& run);

/// Opens a log. Its first bytes tell the format. Throws std::invalid_argument
/// with the file's name if the file cannot be opened or has no header.
std::unique_ptr<LogReader> OpenLog(const std::filesystem::path& file);

}  // namespace poise
