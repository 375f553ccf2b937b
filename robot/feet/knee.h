// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/tree.h"
#include "math/pose.h"

namespace poise {

/// The knee of the leg that ends in a foot: of the joints that turn about the
/// lateral axis, the one nearest to halfway down, if it is within a quarter of
/// the leg's height of it.
///
/// @param foot  a body of the tree.
/// @param X_WB  of each body, the leg about vertical.
/// @param left  the lateral axis in the world, a unit vector.
/// @return the joint's index, and its axis along left: 1, or -1.
struct Knee {
  int joint;
  int sign;
};
std::optional<Knee> FindKnee(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

/// The ankle of that leg: of the joints that turn about the lateral axis, the
/// lowest one, if that is not the knee. Where a roll comes after it, the foot's
/// origin may be anywhere before or behind it.
/// @return the joint's index.
std::optional<int> FindAnkle(const Tree& tree, int foot,
                             const std::vector<Pose>& X_WB,
                             const Eigen::Vector3d& left);

}  // namespace poise
