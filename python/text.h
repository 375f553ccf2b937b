// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <string>

namespace poise {

/// Returns a number of things for a text: "1 level", "2 levels".
/// @param plural  of a word that takes no s: "equalities".
std::string Count(std::ptrdiff_t number, const std::string& singular,
                  const std::string& plural = "");

/// Returns a text as Python's repr() writes it, in one line: 'a\nb'.
std::string Repr(const std::string& text);

}  // namespace poise
