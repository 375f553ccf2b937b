// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/numbers.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace poise {
namespace {

// Returns infinity or zero for a number outside the range of a double. The
// power of ten of the first nonzero digit tells overflow from underflow.
double Extreme(std::string_view token) {
  const bool negative = token[0] == '-';
  if (negative) token.remove_prefix(1);
  const size_t e = std::min(token.find_first_of("eE"), token.size());
  const std::string_view digits = token.substr(0, e);
  const size_t point = std::min(digits.find('.'), digits.size());
  const size_t first = digits.find_first_of("123456789");
  // Larger than the number of digits in any file.
  constexpr long long kMost = 1LL << 60;
  long long exponent = 0;
  if (e < token.size()) {
    std::string_view text = token.substr(e + 1);
    if (text[0] == '+') text.remove_prefix(1);
    const auto [stop, error] =
        std::from_chars(text.data(), text.data() + text.size(), exponent);
    if (error != std::errc()) exponent = text[0] == '-' ? -kMost : kMost;
    exponent = std::max(-kMost, std::min(exponent, kMost));
  }
  const bool is_small =
      exponent + static_cast<long long>(point) < static_cast<long long>(first);
  const double size = is_small ? 0 : std::numeric_limits<double>::infinity();
  return negative ? -size : size;
}

}  // namespace

std::optional<std::vector<double>> ParseNumbers(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::vector<double> numbers;
  while (true) {
    const size_t start = text.find_first_not_of(kBlank);
    if (start == std::string_view::npos) return numbers;
    text.remove_prefix(start);
    std::string_view token = text.substr(0, text.find_first_of(kBlank));
    text.remove_prefix(token.size());
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') {
      token.remove_prefix(1);
    }
    double number = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, number);
    if (error == std::errc::invalid_argument || stop != end) {
      return std::nullopt;
    }
    if (error == std::errc::result_out_of_range) number = Extreme(token);
    numbers.push_back(number);
  }
}

}  // namespace poise
