// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/mesh_words.h"

#include <charconv>
#include <cmath>

#include "poise/robot/finding.h"
#include "poise/robot/numbers.h"

namespace poise {
namespace {

bool IsBreak(char c) { return c == '\n' || c == '\r'; }

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

std::optional<std::string_view> MeshWords::Next() {
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '\n') ++line_;
    if (!IsBreak(text_[at_]) && !IsBlank(text_[at_])) return NextOfLine();
  }
  return std::nullopt;
}

std::optional<std::string_view> MeshWords::NextOfLine() {
  while (at_ < text_.size() && IsBlank(text_[at_])) ++at_;
  const size_t start = at_;
  while (at_ < text_.size() && !IsBlank(text_[at_]) && !IsBreak(text_[at_])) {
    ++at_;
  }
  if (at_ == start) return std::nullopt;
  return text_.substr(start, at_ - start);
}

float MeshWords::NextNumber() {
  const auto word = NextOfLine();
  if (!word) Refuse("a coordinate is missing");
  std::string_view digits = *word;
  if (digits[0] == '+') digits.remove_prefix(1);
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) {
    Refuse("coordinate is " + Quoted(*word) + ", must be a number");
  }
  if (error == std::errc::result_out_of_range) {
    value = ParseNumbers(digits).value()[0];  // Infinite or 0.
  }
  const auto number = static_cast<float>(value);
  if (std::isfinite(number)) return number;
  Refuse("coordinate is " + Quoted(*word) + ", must be finite");
}

void MeshWords::SkipLine() {
  while (at_ < text_.size() && !IsBreak(text_[at_])) ++at_;
}

void MeshWords::Refuse(const std::string& what) const {
  throw Refusal(source_, line_, what);
}

}  // namespace poise
