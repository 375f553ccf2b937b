// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/math/pose.h"
#include "poise/robot/robot.h"

namespace poise {

/// The pose of a sole in the world, and its Jacobian by the variables of an
/// inverse-kinematics problem.
struct SoleState {
  Pose X_WC;
  Eigen::MatrixXd J_WC_W;  ///< 6 x variables, angular first.
};

/// Returns the state of a sole.
/// @param i        index of the foot's link in tick.frames.
/// @param columns  indices in v of the variables.
SoleState StateOf(const Foot& foot, const Tick& tick, int i,
                  const std::vector<int>& columns);

/// The functions below add rows of a step to level 1, and rows for differences
/// that matter less to level 3. They do not allocate.

/// Adds the rows that put both soles flat on the ground, facing +x, side by
/// side, with their middle at the origin: 11 equalities of level 1.
void AddSoleRows(const SoleState (&soles)[2], Hierarchy* hierarchy);

/// Adds rows that put both soles flat on the ground. Heading and position are
/// required of the mean only: 9 equalities of level 1. The differences of
/// heading and x are 2 equalities of level 3. An inequality of level 1 keeps
/// the left sole at least `apart` m to the left of the right one.
void AddMeanSoleRows(const SoleState (&soles)[2], double apart,
                     Hierarchy* hierarchy);

/// Adds rows that keep the sole `stance` at its wanted pose, and the other one
/// at its wanted height: 7 equalities of level 1. The rest of the other's pose
/// is 5 equalities of level 3, or of level 1 if `keeps_other` is true.
void AddSupportRows(const SoleState (&soles)[2], const Pose (&X_WC_wanted)[2],
                    int stance, bool keeps_other, Hierarchy* hierarchy);

}  // namespace poise
