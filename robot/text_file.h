// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace poise {

/// Reads a text file of at most `most_mib` MiB. Throws Refusal if the file
/// cannot be read, with the system's reason, is larger, or is not a regular
/// file: a pipe might never end.
std::string ReadTextFile(const std::filesystem::path& file, size_t most_mib);

/// Throws Refusal if the text contains a zero byte, because the file is then
/// binary.
///
/// @param source  the name of the text in messages.
void ExpectText(std::string_view text, const std::string& source);

}  // namespace poise
