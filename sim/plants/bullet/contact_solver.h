// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include <Eigen/Core>
#include <vector>

namespace poise {

/// Bullet's sequential impulses, computed in contact space.
///
/// Bullet keeps the velocity of all n joints while it sweeps over its rows, at
/// 4 n flops a row. The rows interact by the matrix
///     A_ij = J_i M^-1 J_j',
/// which is computed once. A sweep over m rows then costs 2 m^2 flops, for two feet a
/// ninth. The sweeps, their order and their number are Bullet's, so the
/// impulses agree up to rounding. The sweeps end early if the impulses are constant.
///
/// For worlds whose only moving body is one multibody.
class ContactSolver final : public btMultiBodyConstraintSolver {
 protected:
  btScalar solveSingleIteration(
      int iteration, btCollisionObject** bodies, int num_bodies,
      btPersistentManifold** manifolds, int num_manifolds,
      btTypedConstraint** constraints, int num_constraints,
      const btContactSolverInfo& info, btIDebugDraw* debug_drawer) override;

 private:
  void Gather();
  double Sweep(bool forward);
  double Candidate(int row) const;
  double Set(int row, double impulse);
  void Apply();

  std::vector<btMultiBodySolverConstraint*> rows_;
  int num_limits_ = 0;   // Rows of joint limits come first,
  int num_normals_ = 0;  // then the normals, then friction in pairs.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> W_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd impulses_;
  Eigen::VectorXd velocities_;  // A times the impulses, kept up to date.
};

}  // namespace poise
