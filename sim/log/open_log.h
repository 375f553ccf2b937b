// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <memory>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// The log in a run's folder: log.csv, or log.bin where only that is there.
std::filesystem::path FindLog(const std::filesystem::path& run);

/// Opens a log, in whichever format its first bytes say it is. Throws
/// std::invalid_argument, naming the file.
std::unique_ptr<LogReader> OpenLog(const std::filesystem::path& file);

}  // namespace poise
