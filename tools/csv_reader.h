// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Reads a log row by row, in constant memory: a log of ten minutes has a
/// gigabyte. No quotes; a cell does not hold a comma.
class CsvReader {
 public:
  /// Reads the header. Throws std::invalid_argument, naming the file, if it
  /// cannot be opened. An empty file has no columns and no rows.
  explicit CsvReader(const std::filesystem::path& file);

  /// The header, units included: "com.x[m]".
  const std::vector<std::string>& columns() const { return columns_; }

  /// The column of this name, with or without its unit.
  std::optional<int> Find(std::string_view name) const;

  /// Reads the next whole row; false at the end, or at a row that has not as
  /// many cells as the header, or no line end: there the log was cut short.
  bool Next();

  /// A cell of the row, valid until the next one.
  std::string_view cell(int column) const { return cells_[column]; }

  /// The same as a number; NaN if it is none.
  double Number(int column) const;

  bool cut_short() const { return cut_short_; }

 private:
  std::ifstream stream_;
  std::vector<std::string> columns_;
  std::string line_;
  std::vector<std::string_view> cells_;
  bool cut_short_ = false;
};

/// "com.x[m]" without its unit: "com.x".
std::string_view WithoutUnit(std::string_view column);

/// The unit of "com.x[m]": "m"; empty if there is none.
std::string_view UnitOf(std::string_view column);

}  // namespace poise
