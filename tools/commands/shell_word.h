// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace poise {

/// Returns a text as one word of a shell command, in quotes if it needs them.
std::string ShellWord(const std::string& text);

}  // namespace poise
