// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Compares the left with the right leg. Returns a warning for each of these
/// that differs: the number of joints, by 1 % the length of the chain of
/// joints, by 2 % its mass, by 5 % the size of the sole, and by 2 % of the
/// chain's length the distance of the sole from the foot's origin.
/// @pre robot has two feet.
std::vector<Finding> CompareLegs(const Robot& robot);

/// Returns a warning about bodies with a radius of gyration beyond their
/// shapes: sqrt(I / m), with the largest principal moment I, is at most the
/// distance of the farthest point from the center of mass. The warning counts
/// the bodies and names the first three. Bodies without boxes, cylinders and
/// spheres are compared with the whole robot, if it has at least eight joints.
/// A tolerance of a factor 1.5 is for shapes that are smaller than the body.
std::vector<Finding> FindWideInertias(const RobotModel& model);

}  // namespace poise
