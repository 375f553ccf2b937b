// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "poise/robot/finding.h"
#include "poise/sim/log/columns.h"

namespace poise {
namespace {

void Split(std::string_view line, std::vector<std::string_view>* cells) {
  cells->clear();
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  for (;;) {
    const std::size_t comma = line.find(',');
    cells->push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

// Returns false if the text is not a number. An empty text is NaN.
bool ParseNumber(std::string_view text, double* value) {
  *value = std::numeric_limits<double>::quiet_NaN();
  if (text.empty()) return true;
  const char* text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, *value);
  return error == std::errc() && end == text_end;
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& file)
    : file_(file), stream_(file) {
  if (!stream_ || std::filesystem::is_directory(file)) {
    throw std::invalid_argument(file.string() + ": cannot be opened");
  }
  if (!std::getline(stream_, line_)) return;
  cut_short_ = stream_.eof();
  if (cut_short_) return;
  Split(line_, &cells_);
  columns_.assign(cells_.begin(), cells_.end());
  for (const std::string& column : columns_) {
    has_words_.push_back(GroupOf(column) == ColumnGroup::kText);
  }
  numbers_.assign(columns_.size(), std::numeric_limits<double>::quiet_NaN());
}

bool CsvReader::Next() {
  if (columns_.empty() || cut_short_) return false;
  if (!std::getline(stream_, line_)) return false;
  ++line_number_;
  Split(line_, &cells_);
  cut_short_ = stream_.eof();
  if (cut_short_) return false;
  if (cells_.size() != columns_.size()) {
    throw std::invalid_argument(
        place() + ": has " + std::to_string(cells_.size()) +
        " cells, must have " + std::to_string(columns_.size()) +
        " as in the header");
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (has_words_[i] || ParseNumber(cells_[i], &numbers_[i])) continue;
    throw std::invalid_argument(place() + ": column " + Quoted(columns_[i]) +
                                " is " + Quoted(cells_[i]) +
                                ", must be a number");
  }
  return true;
}

std::string CsvReader::place() const {
  return file_.string() + ":" + std::to_string(line_number_);
}

long CsvReader::CountRows() const {
  std::ifstream stream(file_, std::ios::binary);
  std::vector<char> block(1 << 20);
  long lines = 0;
  do {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    lines += std::count(block.begin(), block.begin() + stream.gcount(), '\n');
  } while (stream);
  return std::max(0l, lines - 1);
}

}  // namespace poise
