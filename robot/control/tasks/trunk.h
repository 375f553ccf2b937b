// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the trunk T: the base, or the body outside the legs with the largest
/// moment of inertia if that is more than six times the base's. A moment of
/// inertia is here the trace of I_G_B.
///
/// MomentumTask keeps T upright by angular momentum. Most of the angular
/// momentum belongs to the body with the largest moment of inertia: a light
/// pelvis below a heavy torso could turn while the torso moves the other way,
/// and the robot would swing.
int FindTrunk(const Tree& tree, const std::vector<Foot>& feet);

/// The orientation of a body T that the base and the posture of a reference
/// imply.
class TrunkReference {
 public:
  TrunkReference(const Tree& tree, int body);

  /// Returns R_WT = R_WB R_BT(posture). Costs a sine and a cosine for each
  /// joint between base and trunk.
  Eigen::Matrix3d Orientation(const Reference& reference) const noexcept;

 private:
  struct RotatingJoint {
    int joint;
    Eigen::Matrix3d R_PF;
    Eigen::Vector3d axis_F;  // Zero for a prismatic joint.
  };
  std::vector<RotatingJoint> joints_;  // From the base to the trunk.
};

}  // namespace poise
