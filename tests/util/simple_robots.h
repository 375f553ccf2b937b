// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tree.h"
#include "poise/robot/robot.h"

namespace poise {

/// Makes a robot from a tree, without limits, shapes or feet.
Robot MakeRobot(const Tree& tree);

/// Makes a homogeneous box as a robot without joints. Its frame is at its
/// center, and its underside is its only sole.
Robot MakeBlock(const Eigen::Vector3d& size, double mass);

/// Makes a homogeneous ball as a robot without joints and feet.
Robot MakeBall(double radius, double mass);

/// Makes a rod of 2 kg that hangs from a fixed base by a hinge along y. Its
/// center of mass is 0.3 m below the hinge, and its moment of inertia about the
/// hinge is 0.19 kg m2.
Robot MakePendulum();

}  // namespace poise
