// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// Reads log.bin, which LogRows writes as LogFormat::kBinary.
class BinaryLogReader final : public LogReader {
 public:
  /// Returns whether a file begins with the magic bytes of a binary log.
  static bool IsOne(const std::filesystem::path& file);

  /// Reads the header. An incomplete header counts as a log that was cut short.
  /// Throws std::invalid_argument with the file's name if the file cannot be
  /// opened or is not a binary log.
  explicit BinaryLogReader(const std::filesystem::path& file);

  bool Next() override;
  std::string_view cell(int column) const override {
    return texts_[static_cast<size_t>(column)];
  }
  double Number(int column) const override {
    return numbers_[static_cast<size_t>(column)];
  }
  std::string place() const override;
  long CountRows() const override;

 private:
  bool ReadHeader();
  // Returns false if the row is incomplete.
  bool ReadRow();
  // Returns false if the bytes of the row contradict each other.
  bool ParseRow();
  uint64_t BytesLeft();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::streamoff size_ = 0;  // Size of the file when it was opened.
  std::streamoff rows_begin_ = 0;
  std::string kinds_;  // By column: d, f or t.
  std::string row_;
  long rows_read_ = 0;
  std::vector<uint64_t> bits_;
  std::vector<double> numbers_;
  std::vector<std::string> texts_;
};

}  // namespace poise
