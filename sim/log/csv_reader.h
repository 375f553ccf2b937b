// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// Reads log.csv, or another table of numbers. Only the text columns of a log
/// (docs/log.md) have words. An empty cell is NaN. Cells have neither quotes
/// nor commas. A last row without line end counts as cut short.
///
/// This reader is our own because fast-cpp-csv-parser cannot read a log:
/// - The parser fixes the number of columns at compile time. A log has about
///   300, and their number depends on the robot.
/// - The parser does not round correctly: most numbers of full precision change
///   in their last bits.
/// - The parser rejects nan and inf, and reads an empty cell as 0.
/// - The parser accepts a last row without line end, which may be cut short.
class CsvReader final : public LogReader {
 public:
  /// Reads the header. Throws std::invalid_argument with the file's name if the
  /// file cannot be opened.
  explicit CsvReader(const std::filesystem::path& file);

  /// Throws std::invalid_argument with file and line if the number of cells of
  /// a complete row differs from the header. Throws it also, with column and
  /// cell, if a cell in a column of numbers is not a number.
  bool Next() override;
  std::string_view cell(int column) const override {
    return cells_[static_cast<size_t>(column)];
  }
  double Number(int column) const override {
    return numbers_[static_cast<size_t>(column)];
  }
  std::string place() const override;
  long CountRows() const override;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string line_;
  long line_number_ = 1;
  std::vector<std::string_view> cells_;
  std::vector<bool> has_words_;  // By column.
  std::vector<double> numbers_;  // NaN in columns of words.
};

}  // namespace poise
