// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
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

/// Returns a warning if mass and size do not fit, as in a file in grams or
/// millimeters: mass over the cube of the diagonal that the joints span at rest
/// is 5 to 130 kg/m3 for public humanoids, and suspect below 0.3 or above 3000.
/// A robot with fewer than eight joints is not judged.
std::optional<Finding> FindWrongUnits(const RobotModel& model);

/// Returns a warning for each sole whose center is farther from the origin of
/// the foot's body than half the leg's chain of joints.
std::vector<Finding> FindFarSoles(const Robot& robot);

}  // namespace poise
