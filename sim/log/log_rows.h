// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// How a run's log is written: as text that every program reads, or, for runs
/// of many minutes, in a quarter of the bytes.
enum class LogFormat { kCsv, kBinary };

/// The name of the log in a run's folder: "log.csv" or "log.bin".
std::string_view LogFileName(LogFormat format);

struct LogColumn {
  enum class Kind {
    kTime,    ///< A number that keeps all its digits.
    kNumber,  ///< Kept to 9 digits as text, to 7 in binary.
    kText,
  };

  std::string name;  ///< With its unit: "com.x[m]".
  Kind kind = Kind::kNumber;
};

/// Turns the rows of a log into the bytes of its file; docs/log.md has both
/// formats. The same rows give the same bytes on any machine, in any locale.
class LogRows {
 public:
  virtual ~LogRows() = default;

  /// Returns the beginning of the file.
  virtual std::string Header() = 0;

  /// The next cell of the row that grows, as the column's kind wants it.
  virtual void Number(double value) = 0;
  virtual void Text(std::string_view text) = 0;

  /// Appends the row to `bytes`, whole, and begins the next one. There must
  /// have been a cell for each column.
  virtual void EndRow(std::string* bytes) = 0;
};

std::unique_ptr<LogRows> MakeLogRows(LogFormat format,
                                     const std::vector<LogColumn>& columns);

}  // namespace poise
