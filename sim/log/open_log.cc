// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/open_log.h"

#include <stdexcept>

#include "poise/sim/log/binary_log_reader.h"
#include "poise/sim/log/csv_reader.h"

namespace poise {

std::filesystem::path FindLog(const std::filesystem::path& run) {
  if (!std::filesystem::is_directory(run)) {
    throw std::invalid_argument(
        run.string() + ": " +
        (std::filesystem::exists(run) ? "is a file" : "does not exist") +
        ", give the folder of a run, not its log");
  }
  const std::filesystem::path csv = run / "log.csv", binary = run / "log.bin";
  return !std::filesystem::exists(csv) && std::filesystem::exists(binary)
             ? binary
             : csv;
}

std::unique_ptr<LogReader> OpenLog(const std::filesystem::path& file) {
  std::unique_ptr<LogReader> log;
  if (BinaryLogReader::IsOne(file)) {
    log = std::make_unique<BinaryLogReader>(file);
  } else {
    log = std::make_unique<CsvReader>(file);
  }
  if (log->columns().empty()) {
    throw std::invalid_argument(
        file.string() +
        ": has no complete header, its run ended too early; run push again");
  }
  return log;
}

}  // namespace poise
