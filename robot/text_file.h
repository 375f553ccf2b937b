// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace poise {

/// Reads a whole file of text, up to so many MiB. Throws Refusal where it
/// cannot be read, is longer, or is no regular file: a pipe might never end.
std::string ReadTextFile(const std::filesystem::path& file, size_t most_mib);

/// Throws Refusal about a zero byte, which no text has.
///
/// @param source  what to call it in a message.
void ExpectText(std::string_view text, const std::string& source);

}  // namespace poise
