// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

/// Computes the pose of every body,
///     X_WB = X_WP X_PF X_FB(q_j).
/// @param q     nq, see Tree. The quaternion may have any norm but 0, which
///              gives NaN in all poses.
/// @param X_WB  by body, sized.
/// Costs O(n), a sine and a cosine a body. Does not allocate, does not throw.
void ComputePoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                  std::vector<Pose>* X_WB) noexcept;

/// Computes the velocity of every body, at its origin and in world axes,
///     V_WB = Shift(V_WP) + [a v_j; 0]   for a revolute joint about axis a,
///     V_WB = Shift(V_WP) + [0; a v_j]   for a prismatic joint along a.
/// @param X_WB    from ComputePoses().
/// @param v       nv, see Tree.
/// @param V_WB_W  by body, sized.
/// Costs O(n). Does not allocate, does not throw.
void ComputeVelocities(const Tree& tree, const std::vector<Pose>& X_WB,
                       const Eigen::Ref<const Eigen::VectorXd>& v,
                       std::vector<SpatialMotion>* V_WB_W) noexcept;

/// Computes the classical acceleration of every body, at its origin and in
/// world axes: the rate of V_WB_W, without gravity. At v̇ = 0 it is the bias
/// J̇v of the body.
///     A_WB = Shift(A_WP) + [a v̇_j + w_WP x a v_j; 0], or for a prismatic joint
///            Shift(A_WP) + [0; a v̇_j + 2 w_WP x a v_j].
/// @param X_WB    from ComputePoses().
/// @param V_WB_W  from ComputeVelocities() at v.
/// @param vdot    nv, the derivative of v.
/// @param A_WB_W  by body, sized.
/// Costs O(n). Does not allocate, does not throw.
void ComputeAccelerations(const Tree& tree, const std::vector<Pose>& X_WB,
                          const std::vector<SpatialMotion>& V_WB_W,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Eigen::Ref<const Eigen::VectorXd>& vdot,
                          std::vector<SpatialAcceleration>* A_WB_W) noexcept;

/// Computes the pose X_WB X_BF of a frame, an index into Tree::frames(). This
/// function costs one product of poses, the next two one shift each. None of
/// them allocates or throws.
Pose FramePose(const Tree& tree, const std::vector<Pose>& X_WB,
               int frame) noexcept;

/// Computes the velocity of a frame, at its origin and in world axes: J_WF_W v.
SpatialMotion FrameVelocity(const Tree& tree, const std::vector<Pose>& X_WB,
                            const std::vector<SpatialMotion>& V_WB_W,
                            int frame) noexcept;

/// Computes the acceleration of a frame, at its origin and in world axes:
/// J_WF_W v̇ + J̇v. With A_WB_W at v̇ = 0 it is J̇v of (11) of the paper.
SpatialAcceleration FrameAcceleration(
    const Tree& tree, const std::vector<Pose>& X_WB,
    const std::vector<SpatialMotion>& V_WB_W,
    const std::vector<SpatialAcceleration>& A_WB_W, int frame) noexcept;

}  // namespace poise
