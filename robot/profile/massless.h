// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "poise/math/inertia.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Joints that move no mass, and the mass that joints move.
struct MovedMass {
  /// For each joint, whether the joint moves no mass of its own. The bodies on
  /// one side of the joint are then without mass, or the diagonal of M is zero
  /// at the joint; or the body that carries the joint is without mass, and the
  /// joints before it can undo every motion that it causes at rest. A mass is
  /// zero below 1e-10 of the robot's mass: 6 ug of a robot of 60 kg. The
  /// diagonal is zero below 1e-14 of the moved mass times the squared distance
  /// of the robot's farthest joint.
  std::vector<bool> none;
  /// For each joint, the mass of the bodies beyond the joint relative to the
  /// mass of the robot.
  std::vector<double> fraction;
};

/// Finds the joints that move no mass. Evaluates the diagonal of M at rest and
/// with all joints moved by up to 1 rad or m, because the mass beyond a joint
/// may lie on the joint's axis in one configuration only. M is not evaluated
/// above 500 joints: a joint then moves no mass if the bodies on one side of it
/// have none.
///
/// The inertia of a body without mass does not count, because no body has one.
/// A locked joint adds this inertia to the body that carries the joint.
MovedMass FindMovedMass(const RobotModel& model);

/// Returns an inertia for one link of each body that is a point mass, if M is
/// singular at rest. A point mass has a radius of gyration below 1e-7 of the
/// distance of the robot's farthest joint from the base. The inertia has a
/// radius of gyration of 1 % of this distance, and no mass. It makes M regular
/// where a point mass lies on the axis of a joint in some configurations only.
std::map<std::string, Inertia> MakePointInertias(const RobotModel& model);

/// Returns an inertia for one link of each body without mass, if joints beyond
/// the body move mass. M is regular without this inertia, but a simulator needs
/// it. If M is singular, returns nothing. The mass is 1e-6 of the robot's mass,
/// the radius of gyration 1 % of the distance of the robot's farthest joint
/// from the base.
std::map<std::string, Inertia> MakeSmallInertias(const RobotModel& model);

/// Returns the warning about joints that are locked because they move no mass:
/// it counts them and names the first three. Returns nothing if there are none.
std::optional<Finding> WarnOfMassless(const std::vector<std::string>& joints);

}  // namespace poise
