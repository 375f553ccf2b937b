// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// A capsule: all points within `radius` of a segment. A sphere is a capsule
/// whose ends coincide. The frame of the points is said where a capsule is
/// stored; CollisionModel::capsules has the frames of the bodies.
struct Capsule {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< m.
  Eigen::Vector3d end = Eigen::Vector3d::Zero();    ///< m.
  double radius = 0;                                ///< m.
};

}  // namespace poise
