// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace poise {

/// Parses a JSON document from outside. Throws Refusal if:
/// - the text is empty or not JSON, has a NUL character, or a number beyond the
///   range of double: the message begins with SOURCE:LINE:COLUMN;
/// - an object has a key twice, because one of the values would be lost;
/// - the nesting is deeper than 100 levels, because to copy or to write such a
///   document would exhaust the stack.
///
/// @param source  the name of the text in messages.
nlohmann::json ParseJson(std::string_view text, const std::string& source);

/// Reads a file of a run, a JSON object. Throws std::invalid_argument with the
/// messages of ReadTextFile() and ParseJson(), or if there is no object.
///
/// @param remedy  what the user can do: the end of every message.
nlohmann::json ReadJsonOfRun(const std::filesystem::path& file,
                             const std::string& remedy);

/// Returns "1 entry" or "2 entries", for a message.
std::string Entries(std::size_t n);

/// Returns a value for a message of one line. A long one is cut.
std::string ShowJson(const nlohmann::json& value);

}  // namespace poise
