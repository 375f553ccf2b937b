// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>

namespace poise {

/// Reads a YAML file of at most 1 MiB that a person wrote. The file must be one
/// document without aliases. Each key must be a plain text, occur once in its
/// map and have a value. Throws Refusal with the line that breaks one of these
/// rules.
YAML::Node LoadYaml(const std::filesystem::path& file);

/// Reads YAML from a text, as LoadYaml() does from a file.
///
/// @param source  the name of the text in messages.
YAML::Node ParseYaml(const std::string& text, const std::string& source);

/// Returns a value as a number, or nothing if the value is not one finite
/// number. The result does not depend on the locale.
std::optional<double> ToNumber(const YAML::Node& node);

/// Returns a short description of a value for a message: "'abc'" (the text
/// itself), "empty", "a list" or "a map".
std::string Shown(const YAML::Node& node);

/// Throws Refusal about a node, with the line of the node.
[[noreturn]] void Refuse(const std::string& file, const YAML::Node& at,
                         const std::string& what);

}  // namespace poise
