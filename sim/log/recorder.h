// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/log/log_rows.h"
#include "poise/sim/log/sha256.h"
#include "poise/sim/log/tick_record.h"

namespace poise {

/// Writes a run into a folder:
///
///     log.csv     one row per tick: the plant's true state, then the output of
///                 the controller. Equal runs give equal bytes, in any locale.
///                 With LogFormat::kBinary the file is log.bin, see LogRows.
///     timing.csv  tick, us, iterations, modelled_us. `us` is not reproducible.
///
/// Only complete rows are written, every 50 ticks. So a run that crashes or is
/// killed leaves files that can be read.
class Recorder {
 public:
  /// Creates the folder and overwrites an older log in it. Throws
  /// std::invalid_argument if the folder or a file cannot be written; the older
  /// files then remain.
  Recorder(const std::filesystem::path& folder, const Robot& robot,
           const Stack& stack, LogFormat format = LogFormat::kCsv);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Throws as Flush() does.
  void Record(const TickRecord& record);

  /// Writes all waiting rows to the files. Throws std::invalid_argument if a
  /// file cannot be written, for example because the disk is full.
  void Flush();

  /// Returns the SHA-256 of the log up to now.
  std::string log_sha256() const { return hash_.Digest(); }

 private:
  std::filesystem::path TimingFile() const;
  void Entry(std::string_view name, double value);
  void EndEntries();
  void ConflictCell(const TickRecord& record);
  void PlanCells(const TickRecord& record);
  void TextCells(const TickRecord& record);

  std::vector<std::string> body_names_;
  int num_levels_;  // Number of columns for gaps.
  std::ofstream log_;
  std::ofstream timing_;
  std::unique_ptr<LogRows> rows_;
  std::string entries_;   // List in the current cell: "a=1;b=2".
  std::string log_rows_;  // Rows that are not yet in the file.
  std::string timing_rows_;
  int rows_waiting_ = 0;
  double next_conflict_ = 0;  // Earliest time of the next search, s.
  Sha256 hash_;
  std::filesystem::path log_file_;
};

/// Returns "ok", "limit_relaxed", "truncated" or "fail_safe".
std::string_view StatusName(TickStatus status);

/// Returns "", "state", "clock" or "no_answer".
std::string_view ReasonName(FailSafeReason reason);

/// Returns "down", "unloading", "up", "landing", "loading", "lost", "free",
/// "returning" or "stepping".
std::string_view PhaseName(ContactPhase phase);

}  // namespace poise
