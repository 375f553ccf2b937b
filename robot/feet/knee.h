// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"

namespace poise {

/// A knee: the index of its joint, and the sign of its axis along the direction
/// to the left, 1 or -1.
struct Knee {
  int joint;
  int sign;
};

/// Finds the knee of the leg that ends in a foot. Of the joints that turn about
/// the lateral axis, the knee is the one nearest to half the leg's height. It
/// must be within a quarter of the leg's height of that.
///
/// @param foot  the index of a body of the tree.
/// @param X_WB  the pose of each body; the leg is about vertical.
/// @param left  the lateral axis in the world, a unit vector.
std::optional<Knee> FindKnee(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

/// Finds the ankle of the leg that ends in a foot. Of the joints that turn about
/// the lateral axis, the ankle is the lowest one, if that is not the knee. If a
/// roll joint follows, the foot's origin may be before or behind the ankle.
/// Parameters are those of FindKnee().
/// @return the joint's index.
std::optional<int> FindAnkle(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

}  // namespace poise
