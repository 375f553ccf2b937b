// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"

namespace poise {

/// How far the hips can move the centroidal moment pivot (CMP) beyond the CoP,
/// as a multiple of the distance from the middle of the feet to the edge of the
/// soles. A torque about G moves the CMP away from the CoP by torque / (m g).
/// The value says how much the robot can rely on turning its trunk in a push,
/// Koolen et al. 2012.
struct TurnStrength {
  double sagittal = 0;  ///< Torque about y, with the front edge.
  double lateral = 0;   ///< Torque about x, with the left edge.
};

/// Computes the strength in the nominal posture. The torque about an axis is
/// the sum of the effort limits of the hips: in each leg, of the first revolute
/// joint below the body that carries both legs whose axis is within 45 degrees.
/// A joint between this body and the heavier part of the rest of the robot,
/// such as a waist, bounds the torque by its own effort limit. A joint without
/// a limit gives an infinite strength.
/// @pre the robot has two feet, and q_nominal is a posture.
/// Allocates.
TurnStrength ComputeTurnStrength(const Robot& robot);

}  // namespace poise
