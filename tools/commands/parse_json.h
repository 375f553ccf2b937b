// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace poise {

/// A JSON document from outside. Throws std::invalid_argument with one line
/// where the text is none, where an object has a key twice, of which one would be
/// lost, or where it is nested over 100 deep: to copy or to write such a one would
/// exhaust the stack.
nlohmann::json ParseJson(std::string_view text);

}  // namespace poise
