// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile_reader.h"

#include "poise/robot/finding.h"
#include "poise/robot/profile/yaml_file.h"

namespace poise {

void ProfileReader::ExpectMap(const YAML::Node& node, const std::string& thing,
                              const std::set<std::string>& keys) const {
  if (!node.IsMap()) Refuse(node, thing, "a map");
  for (const auto& item : node) {
    if (keys.empty() || keys.count(item.first.Scalar()) != 0) continue;
    std::string known;
    for (const std::string& key : keys) known += " " + key;
    Refuse(item.first, thing + ": unknown key " + Shown(item.first) +
                           ", must be one of" + known);
  }
}

Eigen::Vector3d ProfileReader::Angles(const YAML::Node& node,
                                      const std::string& thing) const {
  const Eigen::Vector3d rpy = Numbers<3>(node, thing);
  constexpr double kTurn = 6.3;
  if (rpy.cwiseAbs().maxCoeff() > kTurn) {
    Refuse(node, thing +
                     " is more than one turn, must be in rad: is it in "
                     "degrees?");
  }
  return rpy;
}

std::map<std::string, JointValue> ProfileReader::Joints(
    const YAML::Node& node, const std::string& thing) const {
  ExpectMap(node, thing, {});
  std::map<std::string, JointValue> values;
  for (const auto& item : node) {
    const std::string& name = item.first.Scalar();
    values[name] = {Number(item.second, thing + ": " + Quoted(name)),
                    item.first.Mark().line + 1};
  }
  return values;
}

}  // namespace poise
