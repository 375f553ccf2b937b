// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/yaml_fields.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "poise/robot/finding.h"
#include "poise/robot/profile/yaml_file.h"

namespace poise {

namespace {

[[noreturn]] void Throw(const std::string& file, const YAML::Mark& mark,
                        const std::string& what) {
  throw Refusal(file, mark.line + 1, what);
}

}  // namespace

YamlFields::YamlFields(const YAML::Node& node, std::string file)
    : node_(node), file_(std::move(file)) {
  if (!node_.IsMap()) {
    Throw(file_, node_.Mark(), "is " + Shown(node_) + ", must be a map");
  }
}

bool YamlFields::Has(const std::string& key) {
  return static_cast<bool>(Find(key));
}

YAML::Node YamlFields::Find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
    known_.push_back(key);
  }
  return node_[key];
}

void YamlFields::Refuse(const std::string& key, const std::string& why) const {
  const YAML::Node value = node_[key];
  if (!value) Throw(file_, node_.Mark(), "'" + key + "' is missing, " + why);
  Throw(file_, value.Mark(), "'" + key + "' is " + Shown(value) + ", " + why);
}

void YamlFields::Read(const std::vector<NumberField>& fields) {
  for (const NumberField& field : fields) {
    if (!Has(field.key)) continue;
    const std::vector<double> numbers =
        field.size == 1 ? std::vector<double>{Number(field.key, 0)}
                        : Numbers(field.key);
    if (static_cast<int>(numbers.size()) != field.size) {
      Refuse(field.key,
             "must be a list of " + std::to_string(field.size) + " numbers");
    }
    for (int i = 0; i < field.size; ++i) {
      if (!IsWithin(field, numbers[i])) Refuse(field.key, Wanted(field));
      field.value[i] = field.inverse ? 1 / numbers[i] : numbers[i];
    }
  }
}

double YamlFields::Number(const std::string& key, double otherwise) {
  const YAML::Node value = Find(key);
  if (!value) return otherwise;
  const auto number = ToNumber(value);
  if (!number) Refuse(key, "must be a number");
  return *number;
}

bool YamlFields::Flag(const std::string& key, bool otherwise) {
  const YAML::Node value = Find(key);
  if (!value) return otherwise;
  bool flag;
  if (!value.IsScalar() || !YAML::convert<bool>::decode(value, flag)) {
    Refuse(key, "must be true or false, or on or off");
  }
  return flag;
}

std::string YamlFields::Text(const std::string& key,
                             const std::string& otherwise) {
  const YAML::Node value = Find(key);
  if (!value) return otherwise;
  if (!value.IsScalar()) Refuse(key, "must be a word");
  return value.Scalar();
}

std::vector<std::string> YamlFields::Words(const std::string& key) {
  const YAML::Node value = Find(key);
  std::vector<std::string> words;
  if (!value) return words;
  if (!value.IsSequence()) Refuse(key, "must be a list of words");
  for (const YAML::Node& word : value) {
    if (!word.IsScalar()) Refuse(key, "must be a list of words");
    words.push_back(word.Scalar());
  }
  return words;
}

std::vector<double> YamlFields::Numbers(const std::string& key) {
  const YAML::Node value = Find(key);
  std::vector<double> numbers;
  if (!value) return numbers;
  if (!value.IsSequence()) Refuse(key, "must be a list of finite numbers");
  for (const YAML::Node& item : value) {
    const auto number = ToNumber(item);
    if (!number) Refuse(key, "must be a list of finite numbers");
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<YamlFields> YamlFields::Map(const std::string& key) {
  const YAML::Node value = Find(key);
  if (!value) return std::nullopt;
  if (!value.IsMap()) Refuse(key, "must be a map");
  return YamlFields(value, file_);
}

std::vector<YamlFields> YamlFields::Maps(const std::string& key) {
  const YAML::Node value = Find(key);
  std::vector<YamlFields> maps;
  if (!value) return maps;
  if (!value.IsSequence()) Refuse(key, "must be a list of maps");
  for (const YAML::Node& item : value) {
    if (!item.IsMap()) Refuse(key, "must be a list of maps");
    maps.emplace_back(item, file_);
  }
  return maps;
}

void YamlFields::Finish() const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::string known;
    for (const std::string& name : known_) {
      known += (known.empty() ? "" : ", ") + name;
    }
    Throw(file_, entry.first.Mark(),
          "key " + Quoted(key) + " is unknown, must be one of " + known);
  }
}

YamlFields ReadYaml(const std::string& file) {
  return YamlFields(LoadYaml(file), file);
}

int LineOf(const std::string& file, const std::string& field) {
  YAML::Node node = LoadYaml(file);
  for (std::size_t at = 0; at < field.size();) {
    const bool is_index = field[at] == '[';
    const std::size_t start = at + (is_index || field[at] == '.' ? 1 : 0);
    const std::size_t end = std::min(
        field.find_first_of(is_index ? "]" : ".[", start), field.size());
    const std::string part = field.substr(start, end - start);
    at = end + (is_index ? 1 : 0);
    if (is_index ? !node.IsSequence() : !node.IsMap()) return 0;
    const YAML::Node child = is_index ? node[std::stoul(part)] : node[part];
    if (!child) return 0;
    node.reset(child);
  }
  return node.Mark().line + 1;
}

}  // namespace poise
