// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>

namespace poise {

/// Reads a YAML file of at most 1 MiB that people write by hand. The file must be
/// one document without aliases. Each key must be a word, occur once in its map
/// and have a value. Throws Refusal with the line that breaks these rules.
YAML::Node LoadYaml(const std::filesystem::path& file);

/// Reads YAML from a text, as LoadYaml() does from a file.
///
/// @param source  the name of the text in messages.
YAML::Node ParseYaml(const std::string& text, const std::string& source);

/// Returns a value as a finite number, or nothing if it is anything else. The
/// locale does not matter.
std::optional<double> ToNumber(const YAML::Node& node);

/// Returns the words for a value in a message: 'abc', empty, a list, a map.
std::string Shown(const YAML::Node& node);

/// Throws Refusal about a node, with the line of the node.
[[noreturn]] void Refuse(const std::string& file, const YAML::Node& at,
                         const std::string& what);

}  // namespace poise
