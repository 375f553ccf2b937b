// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/binary_log_reader.h"

#include <cstring>
#include <limits>
#include <stdexcept>

namespace poise {
namespace {

constexpr std::string_view kMagic = "POISELOG";
constexpr uint64_t kVersion = 1;
// No log has more columns. A larger number means that the file is damaged.
constexpr uint64_t kMostColumns = 1 << 20;

uint64_t LittleEndian(std::string_view bytes) {
  uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= static_cast<uint64_t>(static_cast<unsigned char>(bytes[i]))
             << (8 * i);
  }
  return value;
}

// Moves `count` bytes from the front of `from` to `taken`. Returns false if
// there are fewer.
bool Take(std::size_t count, std::string_view* from, std::string_view* taken) {
  if (from->size() < count) return false;
  *taken = from->substr(0, count);
  from->remove_prefix(count);
  return true;
}

bool Read(std::size_t count, std::istream* stream, std::string* bytes) {
  bytes->resize(count);
  return static_cast<bool>(
      stream->read(bytes->data(), static_cast<std::streamsize>(count)));
}

bool ReadNumber(int bytes, std::istream* stream, uint64_t* value) {
  std::string read;
  if (!Read(bytes, stream, &read)) return false;
  *value = LittleEndian(read);
  return true;
}

double ToDouble(uint64_t bits, char kind) {
  if (kind == 'd') {
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  const auto half = static_cast<uint32_t>(bits);
  float value;
  std::memcpy(&value, &half, sizeof(value));
  return value;
}

}  // namespace

bool BinaryLogReader::IsOne(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string magic;
  return Read(kMagic.size(), &stream, &magic) && magic == kMagic;
}

BinaryLogReader::BinaryLogReader(const std::filesystem::path& file)
    : file_(file), stream_(file, std::ios::binary) {
  if (!stream_ || std::filesystem::is_directory(file)) {
    throw std::invalid_argument(file.string() + ": cannot be opened");
  }
  stream_.seekg(0, std::ios::end);
  size_ = stream_.tellg();
  stream_.seekg(0);
  if (!ReadHeader()) {
    columns_.clear();
    kinds_.clear();
    cut_short_ = true;
  }
  rows_begin_ = stream_.tellg();
  bits_.assign(columns_.size(), 0);
  numbers_.assign(columns_.size(), std::numeric_limits<double>::quiet_NaN());
  texts_.resize(columns_.size());
}

bool BinaryLogReader::ReadHeader() {
  std::string magic;
  uint64_t version, columns;
  if (!Read(kMagic.size(), &stream_, &magic)) return false;
  if (magic != kMagic) {
    throw std::invalid_argument(file_.string() +
                                ": is not a binary log of Poise");
  }
  if (!ReadNumber(4, &stream_, &version)) return false;
  if (version != kVersion) {
    throw std::invalid_argument(file_.string() + ": has log format version " +
                                std::to_string(version) + ", must be " +
                                std::to_string(kVersion));
  }
  if (!ReadNumber(4, &stream_, &columns)) return false;
  if (columns > kMostColumns) {
    throw std::invalid_argument(
        file_.string() + ": has " + std::to_string(columns) +
        " columns, must have at most " + std::to_string(kMostColumns) +
        "; the file is damaged");
  }
  for (uint64_t i = 0; i < columns; ++i) {
    std::string kind, name;
    uint64_t length;
    if (!Read(1, &stream_, &kind) || !ReadNumber(2, &stream_, &length) ||
        !Read(length, &stream_, &name)) {
      return false;
    }
    if (kind != "d" && kind != "f" && kind != "t") {
      throw std::invalid_argument(file_.string() + ": column '" + name +
                                  "' has kind '" + kind +
                                  "', must be d, f or t; the file is damaged");
    }
    kinds_ += kind;
    columns_.push_back(name);
  }
  return true;
}

bool BinaryLogReader::Next() {
  if (columns_.empty() || cut_short_) return false;
  if (stream_.peek() == std::ifstream::traits_type::eof()) return false;
  ++rows_read_;
  cut_short_ = !ReadRow();
  if (cut_short_) return false;
  if (!ParseRow()) throw std::invalid_argument(place() + ": is damaged");
  return true;
}

uint64_t BinaryLogReader::BytesLeft() {
  const std::streamoff at = stream_.tellg();
  return at < 0 || at > size_ ? 0 : static_cast<uint64_t>(size_ - at);
}

bool BinaryLogReader::ReadRow() {
  uint64_t size;
  return ReadNumber(4, &stream_, &size) && size <= BytesLeft() &&
         Read(size, &stream_, &row_);
}

bool BinaryLogReader::ParseRow() {
  std::string_view rest = row_, lengths, bytes;
  if (!Take((columns_.size() + 1) / 2, &rest, &lengths)) return false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const auto pair = static_cast<unsigned char>(lengths[i / 2]);
    const std::size_t length = i % 2 == 0 ? pair & 15 : pair >> 4;
    if (length == 0) {
      if (kinds_[i] != 't') numbers_[i] = ToDouble(bits_[i], kinds_[i]);
      continue;
    }
    if (kinds_[i] == 't') {
      if (!Take(4, &rest, &bytes)) return false;
      if (!Take(LittleEndian(bytes), &rest, &bytes)) return false;
      texts_[i] = bytes;
      continue;
    }
    if (length > 8 || !Take(length, &rest, &bytes)) return false;
    bits_[i] ^= LittleEndian(bytes);
    numbers_[i] = ToDouble(bits_[i], kinds_[i]);
  }
  return rest.empty();
}

std::string BinaryLogReader::place() const {
  return file_.string() + ": row " + std::to_string(rows_read_);
}

long BinaryLogReader::CountRows() const {
  std::ifstream stream(file_, std::ios::binary);
  stream.seekg(rows_begin_);
  long rows = 0;
  uint64_t size;
  while (!columns_.empty() && ReadNumber(4, &stream, &size)) {
    if (!stream.seekg(static_cast<std::streamoff>(size), std::ios::cur)) break;
    ++rows;
  }
  return rows;
}

}  // namespace poise
