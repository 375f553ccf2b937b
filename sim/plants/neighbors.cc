// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/neighbors.h"

#include <algorithm>

#include "poise/robot/collision/body_capsules.h"

namespace poise {

namespace {

// Consecutive joints within this distance count as one joint, as a fraction of
// the robot's reach, and at least in m: motors of small robots are relatively
// large.
constexpr double kOneJoint = 0.055;
constexpr double kMotors = 0.05;

}  // namespace

std::vector<std::pair<int, int>> FindNeighbors(const Tree& tree) {
  const double close = std::max(kMotors, kOneJoint * Reach(tree));
  std::vector<std::pair<int, int>> pairs;
  const auto joint_of = [&tree](int body) -> const Joint& {
    return tree.joints()[body - 1];
  };
  for (int i = 1; i < tree.num_bodies(); ++i) {
    double way = 0;
    for (int k = i; k != 0 && way <= close; k = joint_of(k).parent) {
      pairs.emplace_back(joint_of(k).parent, i);
      way += joint_of(k).X_PF.p.norm();
    }
    for (int k = 1; k < i; ++k) {
      if (joint_of(k).parent == joint_of(i).parent) pairs.emplace_back(k, i);
    }
  }
  return pairs;
}

}  // namespace poise
