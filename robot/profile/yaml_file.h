// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>

namespace poise {

/// Reads a YAML file that people write by hand, up to 1 MiB: one document, each
/// key a word that its map has once and with a value, no aliases. Throws
/// Refusal, with the line of what is otherwise.
YAML::Node LoadYaml(const std::filesystem::path& file);

/// The same from a text.
///
/// @param source  what to call it in a message.
YAML::Node ParseYaml(const std::string& text, const std::string& source);

/// The finite number that a value is, in whatever locale; nothing where it is
/// anything else.
std::optional<double> ToNumber(const YAML::Node& node);

/// What a message says of a value: 'abc', empty, a list, a map.
std::string Shown(const YAML::Node& node);

/// Throws Refusal about a node, in its line.
[[noreturn]] void Refuse(const std::string& file, const YAML::Node& at,
                         const std::string& what);

}  // namespace poise
