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
  Vector6d Jdot_v_C;  ///< Its classical acceleration at v̇ = 0.

  bool in_contact = true;  ///< If not, its λ is zero.
  /// In the air: on the way that Reference::feet gives, or with the body.
  bool is_guided = true;
  /// Upper bound of the normal force, N. Finite only while the contact force
  /// fades in or out.
  double max_normal_force = std::numeric_limits<double>::infinity();
};

/// Moves the motion of the foot's link, frame F, to its contact frame C:
///     V_WC_C = [  R'       0  ] V_WF_W,   p = p_FC_W,  R = R_WC,
///              [ -R' [p]x  R' ]
/// likewise its Jacobian; and the classical acceleration
///     a_C = a_F + alpha x p + w x (w x p).
/// Leaves in_contact and max_normal_force. pre: out->J_WC_C has frame's size.
/// Does not allocate.
void ComputeContact(const FrameTick& frame, const Pose& X_FC,
                    ContactTick* out) noexcept;

/// The frame amid the feet in contact (all, if none is): its origin the mean of
/// theirs, z up, x along their mean heading. Does not allocate.
Pose MidFeet(const std::vector<ContactTick>& contacts) noexcept;

}  // namespace poise
