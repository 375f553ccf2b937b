// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/feet/sole.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// The two legs of a biped, in no order. The entries are bodies of the tree.
struct Legs {
  std::array<int, 2> hips;  ///< The first body of each leg.
  std::array<int, 2> feet;  ///< The last body of each leg.
  Eigen::Vector3d up_B;     ///< Vertical: a coordinate axis of the root link.
  double length;            ///< Height of the hips above the feet's origins, m.
};

/// Returns the poses of the bodies relative to the root link, in the
/// configuration at rest.
std::vector<Pose> RestPoses(const RobotModel& model);

/// Finds the two legs of a biped from the configuration at rest.
///
/// A limb is a chain of joints that begins where a body carries several long
/// chains: longer than a quarter of the longest one. The legs are two limbs
/// that begin on the same body, have similar lengths and hang down along an
/// axis of the root link. They are not within the limbs of another such pair,
/// as two rods of an ankle drive are. They are not arms:
/// - most of the names of their links and joints name parts of a leg, or
/// - their names do not decide, they mirror each other, and the center of mass
///   of the trunk is not below their hips by more than 0.15 of their length.
///
/// Pairs with names of legs precede other pairs, then pairs along the root
/// link's z axis, then pairs that begin lower.
///
/// A foot is the last body of its leg. Among several ends, it is the heaviest
/// one within 0.05 of the leg's length above the lowest point. Bodies without
/// mass and shape are skipped. Toes that a joint moves belong to the body
/// behind them.
///
/// @param findings  if not null, receives a warning about toes and about a root
///                  link whose z axis does not point up.
///
/// Throws std::invalid_argument with the reason if there are not two legs, and
/// NoFeet if more than two limbs reach the ground. The cost is linear in the
/// number of bodies, corners and frames.
Legs FindLegs(const RobotModel& model, const std::vector<Outline>& outlines,
              std::vector<Finding>* findings = nullptr);

/// Returns the legs that end in two given bodies. The bodies differ and are
/// moved by joints. Throws std::invalid_argument if one carries the other, or
/// if they do not hang down along an axis of the root link.
Legs FindLegsOf(const RobotModel& model, const std::array<int, 2>& feet);

/// Returns the name of the link that a body's joint moves.
std::string LinkOf(const RobotModel& model, int body);

}  // namespace poise
