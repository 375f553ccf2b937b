// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace poise {

/// Reads a whole file, up to 256 MiB. Throws std::invalid_argument that names
/// it where it cannot be read, or is longer.
std::string ReadFile(const std::filesystem::path& file);

/// Parses XML from anyone: at most 16 MiB of it beside comments, at most 100
/// elements deep, without a document type, so that no entity expands. A file
/// of 100 MB takes less than 1 GiB and a few seconds.
///
/// @param source  what to call it in a message.
///
/// Throws std::invalid_argument with one line: source, line, what was wanted.
std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source);

}  // namespace poise
