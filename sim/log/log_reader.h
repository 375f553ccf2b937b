// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Reads the log of a run row by row, in constant memory, because the log of
/// ten minutes is about a gigabyte. See docs/log.md for the formats.
class LogReader {
 public:
  LogReader() = default;
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  virtual ~LogReader() = default;

  /// The names of the columns, units included: "com.x[m]". An empty file has no
  /// columns and no rows.
  const std::vector<std::string>& columns() const { return columns_; }

  /// Returns the index of a column by its name, with or without the unit. Empty
  /// if the log has no such column.
  std::optional<int> Find(std::string_view name) const;

  /// Reads the next complete row. Returns false at the end of the log, or where
  /// the log was cut short. Throws std::invalid_argument about an invalid row.
  virtual bool Next() = 0;

  /// Returns a text cell of the current row. Valid until the next Next().
  virtual std::string_view cell(int column) const = 0;

  /// Returns a cell of the current row as a number; NaN for a text column.
  virtual double Number(int column) const = 0;

  /// Returns the file and the place of the current row in it, for messages:
  /// "FILE:LINE".
  virtual std::string place() const = 0;

  /// Returns about how many rows the whole file has, without parsing the cells.
  virtual long CountRows() const = 0;

  /// Returns whether Next() has reached an incomplete row.
  bool cut_short() const { return cut_short_; }

 protected:
  std::vector<std::string> columns_;
  bool cut_short_ = false;
};

/// Returns the name of a column without the unit: "com.x" for "com.x[m]".
std::string_view WithoutUnit(std::string_view column);

/// Returns the unit of a column: "m" for "com.x[m]", empty without a unit.
std::string_view UnitOf(std::string_view column);

}  // namespace poise
