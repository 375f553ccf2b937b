// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/robot.h"

namespace poise {

/// Data of one foot in a tick, in the axes of its contact frame C.
struct ContactTick {
  Pose X_WC;
  Vector6d V_WC_C;                                  ///< [w; v of C's origin].
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_WC_C;  ///< V_WC_C = J_WC_C v.
  Vector6d Jdot_v_C;  ///< Classical acceleration of C at v̇ = 0.

  bool in_contact = true;  ///< If false, λ of this foot is zero.
  /// For a foot in the air. True: the foot follows Reference::feet. False: the
  /// foot moves with the body.
  bool is_guided = true;
  /// For a foot in the air: it makes a step, see Stance::Step().
  bool is_stepping = false;
  /// Upper bound of the normal force, N. Finite only while the contact force
  /// fades in or out.
  double max_normal_force = std::numeric_limits<double>::infinity();
  /// The bounds on CoP, friction and yaw moment are those of a sole that is
  /// this many times as long and wide, with this many times the friction. Below
  /// 1 while the controller expects contact forces before the first touch.
  double wrench_share = 1;
};

/// Transforms the motion of the foot's link, frame F, to the contact frame C:
///     V_WC_C = [  R'       0  ] V_WF_W,   p = p_FC_W,  R = R_WC,
///              [ -R' [p]x  R' ]
/// The Jacobian transforms in the same way; the classical acceleration is
///     a_C = a_F + alpha x p + w x (w x p).
/// Changes only X_WC, V_WC_C, J_WC_C and Jdot_v_C.
/// pre: out->J_WC_C has the size of frame.J_WF_W.
/// Does not allocate.
void ComputeContact(const FrameTick& frame, const Pose& X_FC,
                    ContactTick* out) noexcept;

/// Returns the mid-feet frame: its origin is the mean of the contact frames'
/// origins, z is up, and x is along the mean heading of the feet. Uses the feet
/// in contact, or all feet if none is in contact. Without a heading (soles
/// vertical), the axes are those of the world. Does not allocate.
Pose MidFeet(const std::vector<ContactTick>& contacts) noexcept;

}  // namespace poise
