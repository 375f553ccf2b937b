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
  /// For a foot in the air: it follows Reference::feet; if false, the body.
  bool is_guided = true;
  /// Upper bound of the normal force, N. Finite only while the contact force
  /// fades in or out.
  double max_normal_force = std::numeric_limits<double>::infinity();
};

/// Moves the motion of the foot's link, frame F, to its contact frame C:
///     V_WC_C = [  R'       0  ] V_WF_W,   p = p_FC_W,  R = R_WC,
///              [ -R' [p]x  R' ]
/// and likewise its Jacobian. The classical acceleration is
///     a_C = a_F + alpha x p + w x (w x p).
/// Does not change in_contact and max_normal_force. pre: out->J_WC_C has the size
/// of the frame's Jacobian.
/// Does not allocate.
void ComputeContact(const FrameTick& frame, const Pose& X_FC,
                    ContactTick* out) noexcept;

/// Returns the mid-feet frame of the feet in contact, or of all feet if none is in
/// contact: mean origin, z up, x along the mean heading. Does not allocate.
Pose MidFeet(const std::vector<ContactTick>& contacts) noexcept;

}  // namespace poise
