// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tree.h"
#include "poise/math/vector6.h"

namespace poise {

/// Library selects the conventions of another library. TSID has those of
/// Pinocchio. Let B be the floating base, with all linear velocities at its
/// origin. A fixed base has joints only.
///
/// | | q of the base | v of the base |
/// | Poise | p_WB; x, y, z, w | w_WB_W; v_WB_W |
/// | Pinocchio | p_WB; x, y, z, w | v_WB_B; w_WB_B |
/// | Drake | w, x, y, z; p_WB | w_WB_W; v_WB_W |
/// | MuJoCo | p_WB; w, x, y, z | v_WB_W; w_WB_B |
///
/// Their velocity is v_theirs = X v, where X permutes and rotates the first
/// six entries and is orthogonal. So forces and the mass matrix are
///     tau_theirs = X tau,   M_theirs = X M X'.
///
/// Export...() converts from Poise, Import...() to Poise. All of these
/// functions keep the order of the joints: look up the other library's joints
/// by name first. They receive Poise's q where they need the rotation of the
/// base. They do not allocate and do not throw; an output must not overlap an
/// input, and has the size of the other library.
enum class Library { kPinocchio, kDrake, kMujoco };

/// Returns the number of entries of the other library's q. Only Pinocchio's
/// differs from nq: a continuous joint has two entries there, the cosine and
/// the sine of its angle.
int ConfigurationSize(Library library, const Tree& tree) noexcept;

/// Converts q. The quaternion may have any norm but 0; the result has a unit
/// quaternion.
void ExportConfiguration(Library library, const Tree& tree,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         Eigen::Ref<Eigen::VectorXd> q_theirs) noexcept;

/// Converts to q. The quaternion is copied. A continuous joint of Pinocchio
/// gets an angle in [-pi, pi] rad.
void ImportConfiguration(Library library, const Tree& tree,
                         const Eigen::Ref<const Eigen::VectorXd>& q_theirs,
                         Eigen::Ref<Eigen::VectorXd> q) noexcept;

/// Converts the velocity, v_theirs = X v.
void ExportVelocity(Library library, const Tree& tree,
                    const Eigen::Ref<const Eigen::VectorXd>& q,
                    const Eigen::Ref<const Eigen::VectorXd>& v,
                    Eigen::Ref<Eigen::VectorXd> v_theirs) noexcept;

/// Converts to the velocity, v = X' v_theirs.
void ImportVelocity(Library library, const Tree& tree,
                    const Eigen::Ref<const Eigen::VectorXd>& q,
                    const Eigen::Ref<const Eigen::VectorXd>& v_theirs,
                    Eigen::Ref<Eigen::VectorXd> v) noexcept;

/// Converts the derivative of v to the derivative of v_theirs,
///     X v̇ + Ẋ v.
/// Only Pinocchio has a term Ẋ v: its linear acceleration is spatial, the
/// classical one minus w x v, in the axes of B. In Drake and MuJoCo the linear
/// acceleration is classical.
void ExportAcceleration(Library library, const Tree& tree,
                        const Eigen::Ref<const Eigen::VectorXd>& q,
                        const Eigen::Ref<const Eigen::VectorXd>& v,
                        const Eigen::Ref<const Eigen::VectorXd>& vdot,
                        Eigen::Ref<Eigen::VectorXd> vdot_theirs) noexcept;

/// Converts to the derivative of v, the inverse of ExportAcceleration().
/// @param v  velocity of Poise.
void ImportAcceleration(Library library, const Tree& tree,
                        const Eigen::Ref<const Eigen::VectorXd>& q,
                        const Eigen::Ref<const Eigen::VectorXd>& v,
                        const Eigen::Ref<const Eigen::VectorXd>& vdot_theirs,
                        Eigen::Ref<Eigen::VectorXd> vdot) noexcept;

/// Converts generalized forces, tau_theirs = X tau: the power tau' v does not
/// change.
void ExportForces(Library library, const Tree& tree,
                  const Eigen::Ref<const Eigen::VectorXd>& q,
                  const Eigen::Ref<const Eigen::VectorXd>& tau,
                  Eigen::Ref<Eigen::VectorXd> tau_theirs) noexcept;

/// Converts to generalized forces, tau = X' tau_theirs.
void ImportForces(Library library, const Tree& tree,
                  const Eigen::Ref<const Eigen::VectorXd>& q,
                  const Eigen::Ref<const Eigen::VectorXd>& tau_theirs,
                  Eigen::Ref<Eigen::VectorXd> tau) noexcept;

/// Converts the joint-space inertia, M_theirs = X M X': the kinetic energy
/// v' M v / 2 does not change. All entries are written, also those below the
/// diagonal that Pinocchio's crba() may leave out.
void ExportMassMatrix(Library library, const Tree& tree,
                      const Eigen::Ref<const Eigen::VectorXd>& q,
                      const Eigen::Ref<const Eigen::MatrixXd>& M,
                      Eigen::Ref<Eigen::MatrixXd> M_theirs) noexcept;

/// Converts to the joint-space inertia, M = X' M_theirs X.
/// @param M_theirs  nv x nv, both triangles filled.
void ImportMassMatrix(Library library, const Tree& tree,
                      const Eigen::Ref<const Eigen::VectorXd>& q,
                      const Eigen::Ref<const Eigen::MatrixXd>& M_theirs,
                      Eigen::Ref<Eigen::MatrixXd> M) noexcept;

/// Converts the bias forces N of M v̇ + N = tau. N is the force at v̇ = 0, and
/// N_theirs is the force where the derivative of v_theirs is zero, so
///     N_theirs = X N - M_theirs Ẋ v.
/// N_theirs is nle of Pinocchio, qfrc_bias of MuJoCo, and CalcBiasTerm() minus
/// CalcGravityGeneralizedForces() of Drake. The formula is the same without
/// gravity, for c instead of N.
/// @param M  joint-space inertia of Poise, from ComputeCrba().
void ExportBias(Library library, const Tree& tree,
                const Eigen::Ref<const Eigen::VectorXd>& q,
                const Eigen::Ref<const Eigen::VectorXd>& v,
                const Eigen::Ref<const Eigen::MatrixXd>& M,
                const Eigen::Ref<const Eigen::VectorXd>& N,
                Eigen::Ref<Eigen::VectorXd> N_theirs) noexcept;

/// Converts to the bias forces, the inverse of ExportBias().
/// @param v, M  velocity and joint-space inertia of Poise.
void ImportBias(Library library, const Tree& tree,
                const Eigen::Ref<const Eigen::VectorXd>& q,
                const Eigen::Ref<const Eigen::VectorXd>& v,
                const Eigen::Ref<const Eigen::MatrixXd>& M,
                const Eigen::Ref<const Eigen::VectorXd>& N_theirs,
                Eigen::Ref<Eigen::VectorXd> N) noexcept;

/// Converts a Jacobian or momentum matrix of six rows, J_theirs = P J X'. The
/// rows keep their axes and their point; P puts the linear rows first. It is
/// the identity for Drake, whose rows are angular first.
///
/// Axes::kWorld is LOCAL_WORLD_ALIGNED of Pinocchio, and jacp above jacr of
/// MuJoCo. Axes::kFrame is LOCAL of Pinocchio. Both are
/// CalcJacobianSpatialVelocity() of Drake. H_G is Ag of Pinocchio.
/// @param J  6 x nv, rows angular first.
void ExportJacobian(Library library, const Tree& tree,
                    const Eigen::Ref<const Eigen::VectorXd>& q,
                    const Eigen::Ref<const Matrix6Xd>& J,
                    Eigen::Ref<Matrix6Xd> J_theirs) noexcept;

/// Converts to a Jacobian or momentum matrix, J = P' J_theirs X.
void ImportJacobian(Library library, const Tree& tree,
                    const Eigen::Ref<const Eigen::VectorXd>& q,
                    const Eigen::Ref<const Matrix6Xd>& J_theirs,
                    Eigen::Ref<Matrix6Xd> J) noexcept;

}  // namespace poise
