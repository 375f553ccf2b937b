// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/inertia.h"
#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

/// CentroidalMomentum holds the matrix H_G and the bias of a robot's momentum
/// L_G about its center of mass G, in world axes, angular part first:
///     L_G = H_G v,     d/dt L_G = H_G v̇ + bias.
struct CentroidalMomentum {
  explicit CentroidalMomentum(const Tree& tree)
      : H_G(Matrix6Xd::Zero(6, tree.nv())), bias(Vector6d::Zero()) {}

  Matrix6Xd H_G;  ///< 6 x nv, the centroidal momentum matrix (CMM).
  Vector6d bias;  ///< Rate of L_G at v̇ = 0, without gravity.
};

/// Computes the centroidal momentum matrix H_G from the composite bodies,
/// without the joint-space inertia M. Let O be the base's origin, p = p_OG, and
/// m and I_G the mass and the inertia about G of the whole robot. Joint j at
/// unit rate gives its subtree the momentum [n_j; f_j] about the origin of the
/// body that joint j moves; p_Gj leads from G to that origin. Then
///     H_G = [   I_G      0   n_j + p_Gj x f_j ... ]
///           [ -m [p]x  m 1         f_j        ... ].
/// Only a floating base has the first six columns; its rates in v are V_WB_W.
///
/// @param q        nq, see Tree.
/// @param scratch  made for this tree.
/// @param H_G      6 x nv, world axes, about G, angular part first; SI units.
///                 Every entry is written. pre: it has nv columns (asserted).
/// Costs O(n), less than ComputeCrba(). Does not allocate, does not throw.
/// Source: the paper, eq. (19), with each column in closed form.
void ComputeCentroidalMomentumMatrix(const Tree& tree,
                                     const Eigen::Ref<const Eigen::VectorXd>& q,
                                     Recursion* scratch,
                                     Matrix6Xd* H_G) noexcept;

/// Computes H_G as ComputeCentroidalMomentumMatrix() does, and its bias from
/// the force [n; f] on all bodies at v̇ = 0 and g = 0, about O:
///     bias = [n - p_OG x f; f].
///
/// @param q        nq, see Tree.
/// @param v        nv, see Tree.
/// @param scratch  made for this tree.
/// @param out      sized for nv by its constructor. H_G as above; bias in N m
///                 and N, world axes, about G.
/// Costs O(n). Does not allocate, does not throw.
void ComputeCentroidalMomentum(const Tree& tree,
                               const Eigen::Ref<const Eigen::VectorXd>& q,
                               const Eigen::Ref<const Eigen::VectorXd>& v,
                               Recursion* scratch,
                               CentroidalMomentum* out) noexcept;

/// Computes the centroidal momentum matrix and its bias from the first six rows
/// of the joint-space dynamics. The floating base's equation of motion is
/// shifted to the center of mass, which saves a second recursion over the
/// bodies. The base's rates in v are V_WB_W, so Phi of (16) is the identity.
/// With p = p_BoG_W
///     H_G = X M_l,   bias = X c_l,   X = [ 1  -[p]x ]   (6 x 6).
///                                        [ 0    1   ]
/// The lower three rows of H_G are the mass times the Jacobian of G.
///
/// @param M        nv x nv joint-space inertia, from ComputeCrba(); rows 0-5
///                 are read.
/// @param c        nv bias forces *without gravity*, from ComputeCoriolis();
///                 entries 0-5 are read.
/// @param p_BoG_W  position of G from the base's origin, in m.
/// @param out      sized for nv by its constructor.
///
/// @pre The tree has a floating base; M and c belong to one state (q, v), and
/// p_BoG_W to its q.
/// Costs 18 (nv + 1) flops. Does not allocate, does not throw.
///
/// This function is for callers that have M. The controller runs step 3 of
/// ComputeTick(), ComputeCentroidalDynamics, instead; the test
/// Tick.HasTheCentroidalMomentum holds the two equal.
///
/// Source: the paper, eqs. (15)-(19); Wensing and Orin, "Improved computation
/// of the humanoid centroidal dynamics ...", IJHR 13(1), 2016.
void ComputeCentroidalMomentum(const Eigen::Ref<const Eigen::MatrixXd>& M,
                               const Eigen::Ref<const Eigen::VectorXd>& c,
                               const Eigen::Vector3d& p_BoG_W,
                               CentroidalMomentum* out) noexcept;

/// Computes the inertia of the whole robot with its joints locked, about its
/// center of mass and in world axes: mass, p_WoG_W and I_G_W.
/// @param X_WB  by body, from ComputePoses() or a Tick.
/// Costs O(n). Does not allocate, does not throw.
Inertia CompositeInertia(const Tree& tree,
                         const std::vector<Pose>& X_WB) noexcept;

}  // namespace poise
