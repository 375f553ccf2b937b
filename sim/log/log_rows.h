// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Format of a run's log. kCsv is text that every program reads. kBinary needs
/// a quarter of the bytes, for runs of many minutes.
enum class LogFormat { kCsv, kBinary };

/// Returns the name of the log in a run's folder: "log.csv" or "log.bin".
std::string_view LogFileName(LogFormat format);

/// One column of a log.
struct LogColumn {
  enum class Kind {
    kTime,    ///< A number; the binary log keeps all digits.
    kNumber,  ///< 9 digits as text, 7 digits in binary.
    kText,
  };

  std::string name;  ///< With its unit: "com.x[m]".
  Kind kind = Kind::kNumber;
};

/// Converts the rows of a log into the bytes of its file. docs/log.md has both
/// formats. The same rows give the same bytes on any machine, in any locale.
class LogRows {
 public:
  virtual ~LogRows() = default;

  /// Returns the beginning of the file.
  virtual std::string Header() = 0;

  /// Appends the next cell to the current row. The column's kind determines
  /// which of the two functions must be called.
  virtual void Number(double value) = 0;
  virtual void Text(std::string_view text) = 0;

  /// Appends the complete row to `bytes` and begins the next row. pre: every
  /// column has a cell.
  virtual void EndRow(std::string* bytes) = 0;
};

std::unique_ptr<LogRows> MakeLogRows(LogFormat format,
                                     const std::vector<LogColumn>& columns);

}  // namespace poise
