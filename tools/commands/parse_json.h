// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace poise {

/// Parses a JSON document from outside. Throws std::invalid_argument with one
/// line if:
/// - the text is not JSON, or has a NUL character;
/// - an object has a key twice, because one of the values would be lost;
/// - the nesting is deeper than 100 levels, because to copy or to write such a
///   document would exhaust the stack.
nlohmann::json ParseJson(std::string_view text);

}  // namespace poise
