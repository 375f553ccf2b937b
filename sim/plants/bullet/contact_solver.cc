// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/contact_solver.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <algorithm>
#include <cmath>

namespace poise {

namespace {

// Sweeps end when the largest change of an impulse is below this fraction of
// the sum of all impulses. The log has nine digits, so the error is not
// visible.
constexpr double kSettled = 1e-12;

}  // namespace

btScalar ContactSolver::solveSingleIteration(
    int /*iteration*/, btCollisionObject** /*bodies*/, int /*num_bodies*/,
    btPersistentManifold** /*manifolds*/, int /*num_manifolds*/,
    btTypedConstraint** /*constraints*/, int /*num_constraints*/,
    const btContactSolverInfo& info, btIDebugDraw* /*debug_drawer*/) {
  Gather();
  for (int i = 0; i < info.m_numIterations; ++i) {
    const double change = Sweep(i % 2 == 1);
    if (change <= kSettled * impulses_.cwiseAbs().sum()) break;
  }
  Apply();
  return 0;  // Bullet stops at a residual of 0.
}

void ContactSolver::Gather() {
  rows_.clear();
  const auto add = [this](btMultiBodyConstraintArray* rows) {
    for (int i = 0; i < rows->size(); ++i) rows_.push_back(&(*rows)[i]);
  };
  add(&m_multiBodyNonContactConstraints);
  num_limits_ = static_cast<int>(rows_.size());
  add(&m_multiBodyNormalContactConstraints);
  num_normals_ = static_cast<int>(rows_.size()) - num_limits_;
  add(&m_multiBodyFrictionContactConstraints);
  const int m = static_cast<int>(rows_.size());
  if (m == 0) {
    impulses_.resize(0);
    return;
  }
  const btMultiBody* body = rows_[0]->m_multiBodyA != nullptr
                                ? rows_[0]->m_multiBodyA
                                : rows_[0]->m_multiBodyB;
  const int n = body->getNumDofs() + 6;
  J_.setZero(m, n);
  W_.setZero(m, n);
  for (int i = 0; i < m; ++i) {
    // If two links of the robot touch, both sides are the same multibody.
    const auto take = [this, i, n](int index) {
      J_.row(i) +=
          Eigen::Map<const Eigen::RowVectorXd>(&m_data.m_jacobians[index], n);
      W_.row(i) += Eigen::Map<const Eigen::RowVectorXd>(
          &m_data.m_deltaVelocitiesUnitImpulse[index], n);
    };
    if (rows_[i]->m_multiBodyA != nullptr) take(rows_[i]->m_jacAindex);
    if (rows_[i]->m_multiBodyB != nullptr) take(rows_[i]->m_jacBindex);
  }
  A_.noalias() = J_ * W_.transpose();
  impulses_.setZero(m);
  velocities_.setZero(m);
}

double ContactSolver::Candidate(int row) const {
  const btMultiBodySolverConstraint& c = *rows_[row];
  return impulses_[row] + c.m_rhs - impulses_[row] * c.m_cfm -
         velocities_[row] * c.m_jacDiagABInv;
}

double ContactSolver::Set(int row, double impulse) {
  const double change = impulse - impulses_[row];
  if (change == 0) return 0;
  impulses_[row] = impulse;
  velocities_ += change * A_.col(row);
  return std::abs(change);
}

double ContactSolver::Sweep(bool forward) {
  double change = 0;
  for (int k = 0; k < num_limits_; ++k) {
    const int row = forward ? k : num_limits_ - 1 - k;
    const btMultiBodySolverConstraint& c = *rows_[row];
    const double impulse =
        std::clamp(Candidate(row), c.m_lowerLimit, c.m_upperLimit);
    change = std::max(change, Set(row, impulse));
  }
  for (int row = num_limits_; row < num_limits_ + num_normals_; ++row) {
    change = std::max(change, Set(row, std::max(Candidate(row), 0.0)));
  }
  const int m = static_cast<int>(rows_.size());
  int row = num_limits_ + num_normals_;
  while (row < m) {
    const btMultiBodySolverConstraint& c = *rows_[row];
    const double limit =
        c.m_friction * impulses_[num_limits_ + c.m_frictionIndex];
    const bool pair =
        row + 1 < m && rows_[row + 1]->m_frictionIndex == c.m_frictionIndex;
    if (!pair) {
      change =
          std::max(change, Set(row, std::clamp(Candidate(row), -limit, limit)));
      ++row;
      continue;
    }
    // Projects the pair radially onto the circle of the friction cone.
    const double first = Candidate(row), second = Candidate(row + 1);
    const double size = std::hypot(first, second);
    const double scale = size > limit ? limit / size : 1;
    change = std::max(change, Set(row, scale * first));
    change = std::max(change, Set(row + 1, scale * second));
    row += 2;
  }
  return change;
}

void ContactSolver::Apply() {
  if (rows_.empty()) return;
  for (size_t i = 0; i < rows_.size(); ++i) {
    rows_[i]->m_appliedImpulse = impulses_[static_cast<Eigen::Index>(i)];
  }
  const Eigen::VectorXd change = W_.transpose() * impulses_;
  btMultiBody* body = rows_[0]->m_multiBodyA != nullptr
                          ? rows_[0]->m_multiBodyA
                          : rows_[0]->m_multiBodyB;
  body->applyDeltaVeeMultiDof2(change.data(), 1);
}

}  // namespace poise
