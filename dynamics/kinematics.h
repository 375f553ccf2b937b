// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/tree.h"
#include "math/pose.h"
#include "math/vector6.h"

namespace poise {

/// Computes the pose of every body,
///     X_WB = X_WP X_PF X_FB(q_j).
/// @param q     nq, see Tree; its quaternion need not be unit.
/// @param X_WB  by body, sized.
/// Does not allocate, does not throw.
void ComputePoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                  std::vector<Pose>* X_WB) noexcept;

/// Computes the velocity of every body, [w; v of its origin], world axes.
/// @param X_WB    from ComputePoses().
/// @param v       nv, see Tree.
/// @param V_WB_W  by body, sized.
/// Does not allocate, does not throw.
void ComputeVelocities(const Tree& tree, const std::vector<Pose>& X_WB,
                       const Eigen::Ref<const Eigen::VectorXd>& v,
                       std::vector<Vector6d>* V_WB_W) noexcept;

/// Computes the acceleration of every body, [alpha; a of its origin], world
/// axes: classical, the derivative of V_WB_W, and without gravity. At v̇ = 0 it
/// is the bias J̇v of the body.
/// @param X_WB    from ComputePoses().
/// @param V_WB_W  from ComputeVelocities() at v.
/// @param vdot    nv, the derivative of v.
/// @param A_WB_W  by body, sized.
/// Does not allocate, does not throw.
void ComputeAccelerations(const Tree& tree, const std::vector<Pose>& X_WB,
                          const std::vector<Vector6d>& V_WB_W,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Eigen::Ref<const Eigen::VectorXd>& vdot,
                          std::vector<Vector6d>* A_WB_W) noexcept;

/// The pose of a frame, an index into Tree::frames().
Pose FramePose(const Tree& tree, const std::vector<Pose>& X_WB,
               int frame) noexcept;

/// Its velocity, [w; v of its origin], world axes.
Vector6d FrameVelocity(const Tree& tree, const std::vector<Pose>& X_WB,
                       const std::vector<Vector6d>& V_WB_W, int frame) noexcept;

/// Its classical acceleration, world axes; J̇v of the frame if A_WB_W is that at
/// v̇ = 0.
Vector6d FrameAcceleration(const Tree& tree, const std::vector<Pose>& X_WB,
                           const std::vector<Vector6d>& V_WB_W,
                           const std::vector<Vector6d>& A_WB_W,
                           int frame) noexcept;

}  // namespace poise
