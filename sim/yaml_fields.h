// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "poise/sim/number_field.h"

namespace poise {

/// The fields of one YAML map, read by key. Whatever is not as wanted is
/// refused: all members throw std::invalid_argument("FILE:LINE: ...") that
/// names the key, its value and what was wanted.
class YamlFields {
 public:
  /// Throws if the node is not a map.
  YamlFields(const YAML::Node& node, std::string file);

  /// Sets those fields that are there.
  void Read(const std::vector<NumberField>& fields);

  /// The value of a key, or what stands in for it where there is none.
  double Number(const std::string& key, double otherwise);
  bool Flag(const std::string& key, bool otherwise);
  std::string Text(const std::string& key, const std::string& otherwise);
  std::vector<std::string> Words(const std::string& key);
  std::vector<double> Numbers(const std::string& key);

  /// The maps inside: one, or a list of them.
  std::optional<YamlFields> Map(const std::string& key);
  std::vector<YamlFields> Maps(const std::string& key);

  bool Has(const std::string& key);

  /// Throws if there is a key that was not asked for.
  void Finish() const;

  /// Throws about a key.
  [[noreturn]] void Refuse(const std::string& key,
                           const std::string& why) const;

 private:
  YAML::Node Find(const std::string& key);

  YAML::Node node_;
  std::string file_;
  std::vector<std::string> known_;
};

/// Reads a file; throws std::invalid_argument with its name, and the line where
/// it is no YAML.
YamlFields ReadYaml(const std::string& file);

}  // namespace poise
