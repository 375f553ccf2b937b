// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <random>

#include "poise/dynamics/tree.h"

namespace poise {

/// Makes a tree of random shape. Every joint has a random pose, axis and body;
/// one joint in five is prismatic. Inertias are physically possible, and their
/// principal axes are not the axes of their frames.
Tree MakeRandomTree(int num_joints, std::mt19937* draw,
                    BaseType base = BaseType::kFloating,
                    const Eigen::Vector3d& gravity_W = {0, 0, -9.81});

/// Returns a configuration of the tree with entries in [-1, 1] and a unit
/// quaternion.
Eigen::VectorXd MakeRandomConfiguration(const Tree& tree, std::mt19937* draw);

/// Returns a vector with entries in [-1, 1].
Eigen::VectorXd MakeRandomVector(int size, std::mt19937* draw);

}  // namespace poise
