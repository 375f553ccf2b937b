// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/knee.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// Returns the sign of a joint's axis along the lateral axis, 1 or -1. Returns 0
// if the joint does not rotate about an axis near the lateral axis.
int Turns(const Tree& tree, int joint, const std::vector<Pose>& X_WB,
          const Eigen::Vector3d& left) {
  constexpr double kAlong = 0.8;
  const Joint& of = tree.joints()[joint];
  const double along = (X_WB[joint + 1].R * of.axis_F).dot(left);
  if (of.type == JointType::kPrismatic || std::abs(along) < kAlong) return 0;
  return along > 0 ? 1 : -1;
}

}  // namespace

std::optional<Knee> FindKnee(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left) {
  const double ankle = X_WB[foot].p.z();
  double hip = ankle;
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    hip = std::max(hip, X_WB[b].p.z());
  }
  std::optional<Knee> knee;
  double nearest = 0.25 * (hip - ankle);
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    const int turns = Turns(tree, b - 1, X_WB, left);
    const double off = std::abs(X_WB[b].p.z() - 0.5 * (hip + ankle));
    if (turns == 0 || off >= nearest) continue;
    nearest = off;
    knee = Knee{b - 1, turns};
  }
  return knee;
}

std::optional<int> FindAnkle(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left) {
  const auto knee = FindKnee(tree, foot, X_WB, left);
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    if (Turns(tree, b - 1, X_WB, left) == 0) continue;
    if (knee && knee->joint == b - 1) return std::nullopt;
    return b - 1;
  }
  return std::nullopt;
}

Eigen::Vector3d AnklePosition(const Tree& tree, int foot,
                              const std::vector<Pose>& X_WB,
                              const Eigen::Vector3d& left) {
  const auto ankle = FindAnkle(tree, foot, X_WB, left);
  return X_WB[ankle ? *ankle + 1 : foot].p;
}

}  // namespace poise
