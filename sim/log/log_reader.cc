// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/log_reader.h"

namespace poise {

std::optional<int> LogReader::Find(std::string_view name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] == name || WithoutUnit(columns_[i]) == name) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

std::string_view WithoutUnit(std::string_view column) {
  return column.substr(0, column.find('['));
}

std::string_view UnitOf(std::string_view column) {
  const std::size_t open = column.find('[');
  const std::size_t close = column.rfind(']');
  if (open == std::string_view::npos || close == std::string_view::npos ||
      close < open) {
    return {};
  }
  return column.substr(open + 1, close - open - 1);
}

}  // namespace poise
