// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/log_rows.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <system_error>

namespace poise {

namespace {

constexpr std::string_view kMagic = "POISELOG";
constexpr uint32_t kVersion = 1;

class CsvRows final : public LogRows {
 public:
  explicit CsvRows(const std::vector<LogColumn>& columns) : columns_(columns) {}

  std::string Header() override {
    for (const LogColumn& column : columns_) Text(column.name);
    std::string header;
    EndRow(&header);
    return header;
  }

  void Number(double value) override {
    BeginCell();
    if (std::isnan(value)) {  // Also a negative NaN.
      row_ += "nan";
      return;
    }
    // Nine digits resolve 1 nm at 1 m, and about 1 uN at the robot's weight.
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value,
                                   std::chars_format::general, 9);
    row_.append(digits, end.ptr);
  }

  void Text(std::string_view text) override {
    BeginCell();
    // Names of joints may have commas or line ends, which would break the
    // table.
    for (const char c : text) {
      row_ += c == ',' || c == '\n' || c == '\r' ? '_' : c;
    }
  }

  void EndRow(std::string* bytes) override {
    assert(cells_ == columns_.size());
    *bytes += row_;
    *bytes += '\n';
    row_.clear();
    cells_ = 0;
  }

 private:
  void BeginCell() {
    if (cells_++ > 0) row_ += ',';
  }

  std::vector<LogColumn> columns_;
  std::string row_;
  size_t cells_ = 0;
};

// Appends bytes in little-endian order on any machine.
template <typename T>
void Append(T value, int bytes, std::string* out) {
  for (int i = 0; i < bytes; ++i) {
    out->push_back(static_cast<char>(value & 0xff));
    value = static_cast<T>(value >> 8);
  }
}

// Writes each number as the exclusive or of its bits with those of the row
// before. A slowly changing quantity keeps its sign, exponent and leading
// digits, so the difference is short.
class BinaryRows final : public LogRows {
 public:
  explicit BinaryRows(const std::vector<LogColumn>& columns)
      : columns_(columns), bits_(columns.size(), 0), texts_(columns.size()) {
    lengths_.reserve(columns.size());
  }

  std::string Header() override;

  void Number(double value) override;

  void Text(std::string_view text) override;

  void EndRow(std::string* bytes) override;

 private:
  static char KindLetter(LogColumn::Kind kind);

  std::vector<LogColumn> columns_;
  std::vector<uint64_t> bits_;  // Bits of each number in the last row.
  std::vector<std::string> texts_;
  std::string lengths_;  // Lengths of the cells of this row.
  std::string data_;
};

std::string BinaryRows::Header() {
  std::string header(kMagic);
  Append(kVersion, 4, &header);
  Append(static_cast<uint32_t>(columns_.size()), 4, &header);
  for (const LogColumn& column : columns_) {
    header += KindLetter(column.kind);
    Append(static_cast<uint16_t>(column.name.size()), 2, &header);
    header += column.name;
  }
  return header;
}

void BinaryRows::Number(double value) {
  const size_t i = lengths_.size();
  assert(columns_[i].kind != LogColumn::Kind::kText);
  uint64_t now = 0;
  if (columns_[i].kind == LogColumn::Kind::kTime) {
    std::memcpy(&now, &value, sizeof(value));
  } else {
    // Every NaN has the same bits.
    const float single = std::isnan(value)
                             ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>(value);
    std::memcpy(&now, &single, sizeof(single));
  }
  const uint64_t change = now ^ bits_[i];
  bits_[i] = now;
  int length = 0;
  while (length < 8 && (change >> (8 * length)) != 0) ++length;
  lengths_.push_back(static_cast<char>(length));
  Append(change, length, &data_);
}

void BinaryRows::Text(std::string_view text) {
  const size_t i = lengths_.size();
  assert(columns_[i].kind == LogColumn::Kind::kText);
  const bool same = text == texts_[i];
  lengths_.push_back(same ? 0 : 1);
  if (same) return;
  texts_[i] = text;
  Append(static_cast<uint32_t>(text.size()), 4, &data_);
  data_ += text;
}

void BinaryRows::EndRow(std::string* bytes) {
  assert(lengths_.size() == columns_.size());
  const size_t packed = (lengths_.size() + 1) / 2;
  Append(static_cast<uint32_t>(packed + data_.size()), 4, bytes);
  for (size_t i = 0; i < lengths_.size(); i += 2) {
    const char high = i + 1 < lengths_.size() ? lengths_[i + 1] : '\0';
    bytes->push_back(static_cast<char>(lengths_[i] | high << 4));
  }
  *bytes += data_;
  lengths_.clear();
  data_.clear();
}

char BinaryRows::KindLetter(LogColumn::Kind kind) {
  switch (kind) {
    case LogColumn::Kind::kTime:
      return 'd';
    case LogColumn::Kind::kNumber:
      return 'f';
    case LogColumn::Kind::kText:
      return 't';
  }
  return '\0';
}

}  // namespace

std::string_view LogFileName(LogFormat format) {
  return format == LogFormat::kBinary ? "log.bin" : "log.csv";
}

std::unique_ptr<LogRows> MakeLogRows(LogFormat format,
                                     const std::vector<LogColumn>& columns) {
  if (format == LogFormat::kBinary)
    return std::make_unique<BinaryRows>(columns);
  return std::make_unique<CsvRows>(columns);
}

}  // namespace poise
