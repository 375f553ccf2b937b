// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/input_error.h"

namespace poise {

InputError InputError::OfValue(const std::string& field,
                               const std::string& text,
                               const std::string& other,
                               const std::string& rest) {
  InputError error(field, field + text + other + rest);
  error.text_ = text;
  error.other_ = other;
  error.rest_ = rest;
  return error;
}

std::string EntryPath(const std::string& list, std::size_t entry) {
  return list + "[" + std::to_string(entry) + "]";
}

std::string InputError::Say(
    const std::function<std::string(const std::string& field)>& name) const {
  if (text_.empty()) return what();
  return name(field_) + text_ + (other_.empty() ? "" : name(other_)) + rest_;
}

}  // namespace poise
