// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace poise {

/// Returns the numbers in a text, separated by white space, or nothing if the
/// text holds anything else. "inf" and "nan" count as numbers. A number too
/// large for a double becomes inf, one too small becomes 0. The locale does not
/// matter.
std::optional<std::vector<double>> ParseNumbers(std::string_view text);

}  // namespace poise
