// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Reads the log of a run row by row, in constant memory. The log of ten minutes has
/// a gigabyte. docs/log.md describes the formats.
class LogReader {
 public:
  LogReader() = default;
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  virtual ~LogReader() = default;

  /// Returns the names of the columns with units: "com.x[m]". An empty file has
  /// neither columns nor rows.
  const std::vector<std::string>& columns() const { return columns_; }

  /// Returns the column of this name, with or without unit.
  std::optional<int> Find(std::string_view name) const;

  /// Reads the next complete row. Returns false at the end or if the log was cut
  /// short. Throws std::invalid_argument about an invalid row.
  virtual bool Next() = 0;

  /// Returns a text cell of this row, valid until the next row.
  virtual std::string_view cell(int column) const = 0;

  /// Returns a cell as a number; NaN for a text.
  virtual double Number(int column) const = 0;

  /// Returns the file and the line that was read last: "FILE:LINE".
  virtual std::string place() const = 0;

  /// Returns about the number of rows of the file, by a quick pass.
  virtual long CountRows() const = 0;

  /// Returns whether Next() found an incomplete row.
  bool cut_short() const { return cut_short_; }

 protected:
  std::vector<std::string> columns_;
  bool cut_short_ = false;
};

/// Returns "com.x" for "com.x[m]".
std::string_view WithoutUnit(std::string_view column);

/// Returns "m" for "com.x[m]"; empty without a unit.
std::string_view UnitOf(std::string_view column);

}  // namespace poise
