// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/tree.h"
#include "robot/robot.h"

namespace poise {

/// Row names "left_foot.cop.x_max", ...: each suffix for each foot.
inline std::vector<std::string> FootRowNames(
    const std::vector<Foot>& feet, std::string_view what,
    std::initializer_list<std::string_view> suffixes) {
  std::vector<std::string> names;
  for (const Foot& foot : feet) {
    for (const std::string_view suffix : suffixes) {
      names.push_back(foot.name + "." + std::string(what) + "." +
                      std::string(suffix));
    }
  }
  return names;
}

/// Row names "torque.l_knee", ...: one for each joint.
inline std::vector<std::string> JointRowNames(const Tree& tree,
                                              std::string_view what) {
  std::vector<std::string> names;
  for (const Joint& joint : tree.joints()) {
    names.push_back(std::string(what) + "." + joint.name);
  }
  return names;
}

/// Row names "momentum.x", ...
inline std::vector<std::string> AxisRowNames(
    std::string_view what, std::initializer_list<std::string_view> axes) {
  std::vector<std::string> names;
  for (const std::string_view axis : axes) {
    names.push_back(std::string(what) + "." + std::string(axis));
  }
  return names;
}

}  // namespace poise
