// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "poise/sim/number_field.h"

namespace poise {

/// Reads the fields of one YAML map by key. Every member rejects invalid
/// values: it throws std::invalid_argument("FILE:LINE: ...") with the key, its
/// value and the allowed values.
class YamlFields {
 public:
  /// Throws if the node is not a map.
  YamlFields(const YAML::Node& node, std::string file);

  /// Sets the fields that the map contains; the others keep their values.
  void Read(const std::vector<NumberField>& fields);

  /// Returns the value of a key, or `otherwise` if the map does not have the
  /// key.
  double Number(const std::string& key, double otherwise);
  bool Flag(const std::string& key, bool otherwise);
  std::string Text(const std::string& key, const std::string& otherwise);
  std::vector<std::string> Words(const std::string& key);
  std::vector<double> Numbers(const std::string& key);

  /// Returns the map, or the list of maps, that is the value of a key.
  std::optional<YamlFields> Map(const std::string& key);
  std::vector<YamlFields> Maps(const std::string& key);

  bool Has(const std::string& key);

  /// Throws if the map has a key that no other member has looked up.
  void Finish() const;

  /// Throws an error about a key.
  [[noreturn]] void Refuse(const std::string& key,
                           const std::string& why) const;

 private:
  YAML::Node Find(const std::string& key);

  YAML::Node node_;
  std::string file_;
  std::vector<std::string> known_;
};

/// Reads a file. Throws std::invalid_argument with the file's name and, if the
/// text is not valid YAML, the line.
YamlFields ReadYaml(const std::string& file);

/// Returns the line of a field in a YAML file, or 0 if the file does not have
/// the field. Throws as ReadYaml().
///
/// @param field  the path of the field: "pushes[2].link", see InputError.
int LineOf(const std::string& file, const std::string& field);

}  // namespace poise
