// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace poise {

/// The numbers in a text, apart by white space; inf and nan are numbers here,
/// and one too large for a double is inf, one too small 0. Nothing where the
/// text is anything else, in whatever locale.
std::optional<std::vector<double>> ParseNumbers(std::string_view text);

}  // namespace poise
