// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tree.h"
#include "poise/robot/robot.h"

namespace poise {

/// A robot of a tree alone: no limits, no shapes, no feet.
Robot MakeRobot(const Tree& tree);

/// A homogeneous box as a robot without joints, its frame at its center; its
/// underside is its one sole.
Robot MakeBlock(const Eigen::Vector3d& size, double mass);

/// A homogeneous ball as a robot without joints and without feet.
Robot MakeBall(double radius, double mass);

/// A rod of 2 kg that hangs from a fixed base by a hinge along y: its mass
/// center 0.3 m below, its moment of inertia about the hinge 0.19 kg m2.
Robot MakePendulum();

}  // namespace poise
