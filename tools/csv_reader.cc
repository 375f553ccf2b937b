// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

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

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& file)
    : file_(file), stream_(file) {
  if (!stream_ || std::filesystem::is_directory(file)) {
    throw std::invalid_argument(file.string() + ": cannot be opened");
  }
  if (!std::getline(stream_, line_)) return;
  Split(line_, &cells_);
  columns_.assign(cells_.begin(), cells_.end());
}

bool CsvReader::Next() {
  if (columns_.empty() || cut_short_) return false;
  if (!std::getline(stream_, line_)) return false;
  Split(line_, &cells_);
  cut_short_ = stream_.eof() || cells_.size() != columns_.size();
  return !cut_short_;
}

double CsvReader::Number(int column) const {
  const std::string_view text = cells_[column];
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number =
      error == std::errc() && end == text.data() + text.size();
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
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
