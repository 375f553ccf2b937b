// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"

namespace poise {

/// A knee: the index of its joint, and the sign of its axis, 1 or -1. The sign
/// is 1 if the axis points to the left.
struct Knee {
  int joint;
  int sign;
};

/// Finds the knee of the leg that ends in a foot. Among the joints that rotate
/// about the lateral axis, the knee is the joint nearest to half the leg's
/// height. The distance from half height must be below a quarter of the leg's
/// height.
///
/// @param foot  the index of a body of the tree.
/// @param X_WB  the pose of each body. The leg must be about vertical.
/// @param left  the lateral axis in the world, a unit vector to the left.
/// @return the knee, or nothing if there is no such joint.
std::optional<Knee> FindKnee(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

/// Finds the ankle of the leg that ends in a foot. Among the joints that rotate
/// about the lateral axis, the ankle is the last one before the foot, unless
/// this joint is the knee. If a roll joint follows, the foot's origin may lie
/// in front of or behind the ankle. The parameters are those of FindKnee().
/// @return the joint's index, or nothing if there is no ankle.
std::optional<int> FindAnkle(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

/// Returns the position of the ankle of FindAnkle() in the world, m. If there
/// is no ankle, returns the position of the foot's origin.
Eigen::Vector3d AnklePosition(const Tree& tree, int foot,
                              const std::vector<Pose>& X_WB,
                              const Eigen::Vector3d& left);

}  // namespace poise
