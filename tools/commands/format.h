// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace poise {

/// Returns the text that std::printf() would print.
__attribute__((format(printf, 1, 2))) std::string Format(const char* format,
                                                         ...);

}  // namespace poise
