// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "poise/math/eigen_alignment.h"
#include "poise/robot/profile/joint_value.h"
#include "poise/robot/profile/yaml_file.h"

namespace poise {

/// Reads values of a profile. Throws Refusal with the file, and the line of an
/// invalid value.
struct ProfileReader {
  const std::string file;

  [[noreturn]] void Refuse(const YAML::Node& at,
                           const std::string& what) const {
    poise::Refuse(file, at, what);
  }

  // Throws Refusal about a value, with the description of valid values.
  [[noreturn]] void Refuse(const YAML::Node& value, const std::string& thing,
                           const std::string& wanted) const {
    Refuse(value, thing + " is " + Shown(value) + ", must be " + wanted);
  }

  double Number(const YAML::Node& node, const std::string& thing) const {
    const auto value = ToNumber(node);
    if (!value) Refuse(node, thing, "a finite number");
    constexpr double kLargest = 1e6;  // m or rad.
    if (std::abs(*value) > kLargest)
      Refuse(node, thing, "between -1e6 and 1e6");
    return *value;
  }

  std::string Text(const YAML::Node& node, const std::string& thing) const {
    if (!node.IsScalar() || node.Scalar().empty()) {
      Refuse(node, thing, "a name");
    }
    return node.Scalar();
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> Numbers(const YAML::Node& node,
                                          const std::string& thing) const {
    if (!node.IsSequence() || node.size() != kSize) {
      Refuse(node, thing, std::to_string(kSize) + " numbers");
    }
    Eigen::Matrix<double, kSize, 1> values;
    for (int i = 0; i < kSize; ++i) values[i] = Number(node[i], thing);
    return values;
  }

  void ExpectMap(const YAML::Node& node, const std::string& thing,
                 const std::set<std::string>& keys) const;

  // Reads roll, pitch and yaw, in rad.
  Eigen::Vector3d Angles(const YAML::Node& node,
                         const std::string& thing) const;

  std::map<std::string, JointValue> Joints(const YAML::Node& node,
                                           const std::string& thing) const;
};

}  // namespace poise
