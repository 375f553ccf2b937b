// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Format of a log. CSV is text that every program reads. Binary takes a quarter of
/// the bytes, for runs of many minutes.
enum class LogFormat { kCsv, kBinary };

/// Returns the name of the log in a run's folder: "log.csv" or "log.bin".
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

/// Converts the rows of a log to the bytes of its file; docs/log.md has both formats.
/// The bytes are the same on any machine and in any locale.
class LogRows {
 public:
  virtual ~LogRows() = default;

  /// Returns the beginning of the file.
  virtual std::string Header() = 0;

  /// Adds the next cell of the present row; the type must be that of its column.
  virtual void Number(double value) = 0;
  virtual void Text(std::string_view text) = 0;

  /// Appends the row to `bytes` and begins the next one. pre: the row has a cell for
  /// each column.
  virtual void EndRow(std::string* bytes) = 0;
};

std::unique_ptr<LogRows> MakeLogRows(LogFormat format,
                                     const std::vector<LogColumn>& columns);

}  // namespace poise
