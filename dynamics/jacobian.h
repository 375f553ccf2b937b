// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"
#include "poise/math/vector6.h"

namespace poise {

/// The axes in which the velocity of a frame is expressed; it is that of the
/// frame's own origin in either.
enum class Axes {
  kWorld,  ///< [w_WF_W; v_WF_W].
  kFrame   ///< [w_WF_F; v_WF_F].
};

/// Computes the Jacobian of a frame,
///     V_WF = J_WF v,   [w; v of its origin],
/// of a foot in contact J_c of the paper's (7) and (11).
/// In world axes the column of a revolute joint about a at p is [a; a x (p_WF -
/// p)], of a prismatic one [0; a], of the base [1 0; -[p_BF]x 1]; those of joints
/// that do not carry the frame are zero.
///
/// The controller runs ComputeTick()'s step 4, ComputeFrameTick, instead; the test
/// Tick.HasTheMotionOfFrames holds the two equal.
///
/// @param X_WB   by body, from ComputePoses() or a Tick.
/// @param frame  index into Tree::frames().
/// @param J_WF   6 x nv. All of it is written.
/// Costs O(depth), and 6 nv zeros to write. Does not allocate, does not throw.
void ComputeFrameJacobian(const Tree& tree, const std::vector<Pose>& X_WB,
                          int frame, Axes axes,
                          Eigen::Ref<Matrix6Xd> J_WF) noexcept;

/// The bias J̇v of a frame, the rate of [w; v] at v̇ = 0 (rad/s2, m/s2). In the
/// frame's axes these turn with it: d/dt (R' V) = R' (V̇ - [w x w; w x v]).
///
/// @param A_WF_W  its classical acceleration at v̇ = 0, from FrameAcceleration().
/// @param V_WF_W  its velocity, from FrameVelocity().
/// @param R_WF    its orientation, from FramePose().
/// The controller runs ComputeTick()'s step 4 instead; the test
/// Tick.HasTheMotionOfFrames holds its bias equal to FrameAcceleration(), which
/// is the bias in world axes.
/// Six plain numbers, to be added to J_WF v̇ as in (11) of the paper. Costs two
/// rotations of a vector. Does not allocate, does not throw.
Vector6d FrameBias(const SpatialAcceleration& A_WF_W,
                   const SpatialMotion& V_WF_W, const Eigen::Matrix3d& R_WF,
                   Axes axes) noexcept;

}  // namespace poise
