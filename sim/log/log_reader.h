// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Reads the log of a run row by row, in constant memory: ten minutes of it
/// have a gigabyte. See docs/log.md for the formats.
class LogReader {
 public:
  LogReader() = default;
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  virtual ~LogReader() = default;

  /// The names of the columns, units included: "com.x[m]". An empty file has no
  /// columns and no rows.
  const std::vector<std::string>& columns() const { return columns_; }

  /// The column of this name, with or without its unit.
  std::optional<int> Find(std::string_view name) const;

  /// Reads the next whole row; false at the end, or where the log was cut
  /// short. Throws std::invalid_argument about one that holds what it must not.
  virtual bool Next() = 0;

  /// A cell of text of this row, valid until the next one.
  virtual std::string_view cell(int column) const = 0;

  /// A cell as a number; NaN if it is none.
  virtual double Number(int column) const = 0;

  /// The file and, in it, the row that was read last: "FILE:LINE".
  virtual std::string place() const = 0;

  /// About how many rows the whole file has, from a quick look at it.
  virtual long CountRows() const = 0;

  /// Next() came to a row that is not whole.
  bool cut_short() const { return cut_short_; }

 protected:
  std::vector<std::string> columns_;
  bool cut_short_ = false;
};

/// "com.x[m]" without its unit: "com.x".
std::string_view WithoutUnit(std::string_view column);

/// The unit of "com.x[m]": "m"; empty if there is none.
std::string_view UnitOf(std::string_view column);

}  // namespace poise
