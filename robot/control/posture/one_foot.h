// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the torques at rest of a robot that stands on one foot at q, N m or
/// N, by joint:
///     tau = N_j - J_j' lambda,   J_b' lambda = N_b,
/// with the rows b of the base and j of the joints, the Jacobian J of the sole,
/// and the ground's wrench lambda on it.
/// @param foot  index into robot.feet.
Eigen::VectorXd TorquesOnOneFoot(const Robot& robot, int foot,
                                 const Eigen::VectorXd& q);

/// Returns, by joint, whether it is in no leg.
std::vector<bool> IsInNoLeg(const Robot& robot);

/// A posture at rest on one foot.
struct OneFootPosture {
  double lean = 0;  ///< Wanted lean of the base, rad, see SingleSupport.
  /// Rotation vector from the base's orientation in robot.q_nominal to that in
  /// the posture, in the plane, rad. It is not 0 at `lean` 0 if the ranges of
  /// the joints force the base to lean.
  Eigen::Vector3d lean_W = Eigen::Vector3d::Zero();
  Posture posture;
  /// Largest ratio of a torque to its limit. Infinite if posture.lack is not
  /// empty.
  double load = 0;
};

/// Returns where a shift to one foot moves the center of mass, m: by the
/// horizontal way from the middle of the soles to the foot, less a quarter of
/// the sole's half width, or less if half of the torque of the ankle's roll
/// joint could not hold the robot there, see AnkleReach(). So the center of
/// mass stays as far in front of the ankles as on both feet. It ends on the
/// inner side of the sole, because hips and ankles come to their limits during
/// such a shift and have to move less then.
/// @param X_WC  poses of the soles, by foot.
/// @param p_WG  the center of mass on both feet, m.
Eigen::Vector3d ShiftedCenterOfMass(const Robot& robot, int foot,
                                    const std::vector<Pose>& X_WC,
                                    const Eigen::Vector3d& p_WG);

/// Returns the posture on one foot, the other sole lifted by 3 % of the height
/// of the center of mass, with the smallest lean of the base at which no motor
/// is loaded by more than 0.8 of its limit. The lean is to the side of the
/// foot: the trunk then needs a smaller torque at the hip, and the hip a
/// smaller angle. If no lean up to 0.45 rad is enough, returns the posture with
/// the smallest load; if an upright trunk would need more than 1.5 of a limit,
/// the upright one. The joints in no leg stay where they are in
/// robot.q_nominal.
/// @param foot  index into robot.feet.
/// @param G     target of the center of mass in the sole's frame, m.
/// @pre The robot has two feet, the left one first.
/// Costs one search of a posture, see FindPosture(); up to ten if the motors
/// are weak.
OneFootPosture FindOneFootPosture(const Robot& robot, int foot,
                                  const Eigen::Vector2d& G);

}  // namespace poise
