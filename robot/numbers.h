// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace poise {

/// Returns the numbers in a text, separated by white space, or nothing if the
/// text contains anything else. "inf" and "nan" are numbers. A number too large
/// for a double becomes inf, and a number too small for a double becomes 0. The
/// result does not depend on the locale.
std::optional<std::vector<double>> ParseNumbers(std::string_view text);

}  // namespace poise
