// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/knee.h"

#include <algorithm>
#include <cmath>

namespace poise {

std::optional<Knee> FindKnee(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left) {
  // Joints that turn about an axis this near to the lateral one bend the leg.
  constexpr double kAlong = 0.8;
  const double ankle = X_WB[foot].p.z();
  double hip = ankle;
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    hip = std::max(hip, X_WB[b].p.z());
  }
  std::optional<Knee> knee;
  double nearest = 0.25 * (hip - ankle);
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    const Joint& joint = tree.joints()[b - 1];
    const double along = (X_WB[b].R * joint.axis_F).dot(left);
    const double off = std::abs(X_WB[b].p.z() - 0.5 * (hip + ankle));
    if (joint.type == JointType::kPrismatic || std::abs(along) < kAlong ||
        off >= nearest) {
      continue;
    }
    nearest = off;
    knee = Knee{b - 1, along > 0 ? 1 : -1};
  }
  return knee;
}

}  // namespace poise
