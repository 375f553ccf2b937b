// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/numbers.h"

#include <charconv>
#include <limits>

namespace poise {
namespace {

// A number beyond what a double holds, on either side: its exponent says, or
// the digits before its point do.
double Extreme(std::string_view token) {
  const bool negative = token[0] == '-';
  if (negative) token.remove_prefix(1);
  const size_t exponent = token.find_first_of("eE");
  const bool small = exponent < token.size() ? token[exponent + 1] == '-'
                                             : token.find('.') <= 1;
  const double size = small ? 0 : std::numeric_limits<double>::infinity();
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
