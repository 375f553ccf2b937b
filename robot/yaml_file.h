// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

namespace poise {

/// Reads a YAML file that people write by hand, up to 1 MiB: one document, each
/// key a word that its map has once, no aliases. Throws Refusal, with the line
/// of what is otherwise.
YAML::Node LoadYaml(const std::filesystem::path& file);

/// The same from a text.
///
/// @param source  what to call it in a message.
YAML::Node ParseYaml(const std::string& text, const std::string& source);

/// What a message says of a value: 'abc', empty, a list, a map.
std::string Shown(const YAML::Node& node);

/// Throws Refusal about a node, in its line.
[[noreturn]] void Refuse(const std::string& file, const YAML::Node& at,
                         const std::string& what);

}  // namespace poise
