// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace poise {

/// What a row's name means: "left_foot.cop.y_max" is "the CoP of the left foot
/// at its outer edge". A name that means nothing here is given back.
std::string DescribeRow(const std::string& name);

/// A name as words: "left_foot" is "left foot".
std::string Spaced(std::string text);

}  // namespace poise
