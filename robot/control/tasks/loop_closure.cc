// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/loop_closure.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "poise/math/pose.h"
#include "poise/math/so3.h"

namespace poise {
namespace {

// Fraction of kLeast below which a motion counts as locked altogether.
constexpr double kLocked = 1.0 / 3;

// Returns X_BA, V_WA at B's origin in B's axes = X_BA V_WA_A, for feet that
// move as one body.
Matrix6d TwistTransform(const Pose& X_WA, const Pose& X_WB) {
  const Eigen::Matrix3d R_BA = X_WB.R.transpose() * X_WA.R;
  const Eigen::Vector3d p_AB_A = X_WA.R.transpose() * (X_WB.p - X_WA.p);
  Matrix6d X;
  X.topLeftCorner<3, 3>() = R_BA;
  X.topRightCorner<3, 3>().setZero();
  X.bottomLeftCorner<3, 3>().noalias() = -R_BA * Hat(p_AB_A);
  X.bottomRightCorner<3, 3>() = R_BA;
  return X;
}

// Follows couplings from a joint to the joint that moves it, and multiplies
// their factors. The bound stops at couplings that form a circle.
int Source(const std::vector<MimicCoupling>& mimics, int joint,
           double* factor) {
  for (size_t step = 0; step < mimics.size(); ++step) {
    const auto coupling =
        std::find_if(mimics.begin(), mimics.end(),
                     [&](const MimicCoupling& c) { return c.joint == joint; });
    if (coupling == mimics.end()) break;
    *factor *= coupling->multiplier;
    joint = coupling->source;
  }
  return joint;
}

}  // namespace

std::vector<int> JointsTo(const Tree& tree, int body) {
  std::vector<int> joints;
  for (; body > 0; body = tree.joints()[body - 1].parent) {
    joints.push_back(body - 1);
  }
  return joints;
}

LoopClosure::LoopClosure(const RobotModel& model, int a, int b) {
  const Tree& tree = model.tree;
  const std::vector<int> to_a = JointsTo(tree, a), to_b = JointsTo(tree, b);
  std::vector<int> sources;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const bool moves_a = std::count(to_a.begin(), to_a.end(), j) > 0;
    const bool moves_b = std::count(to_b.begin(), to_b.end(), j) > 0;
    if (moves_a == moves_b) continue;
    double factor = 1;
    const int source = Source(model.mimics, j, &factor);
    const auto at = std::find(sources.begin(), sources.end(), source);
    const size_t column = at - sources.begin();
    if (at == sources.end()) {
      sources.push_back(source);
      columns_.emplace_back();
    }
    columns_[column].joints.push_back(tree.v_start() + j);
    columns_[column].factors.push_back(factor);
  }
}

void LoopClosure::FindLocked(const ContactTick& a, const ContactTick& b,
                             LockedMotions* locked) const noexcept {
  locked->count = 0;
  const Matrix6d X_BA = TwistTransform(a.X_WC, b.X_WC);
  Matrix6d RRt = Matrix6d::Zero();
  for (const Column& column : columns_) {
    Vector6d r = Vector6d::Zero();
    for (size_t i = 0; i < column.joints.size(); ++i) {
      const int j = column.joints[i];
      r.noalias() +=
          column.factors[i] * (X_BA * a.J_WC_C.col(j) - b.J_WC_C.col(j)).eval();
    }
    RRt.noalias() += r * r.transpose();
  }
  const double rotations = RRt.diagonal().head<3>().sum();
  const double translations = RRt.diagonal().tail<3>().sum();
  const bool has_both = rotations > 0 && translations > 0;
  const double L = has_both ? std::sqrt(translations / rotations) : 1;
  RRt.topRows<3>() *= L;
  RRt.leftCols<3>() *= L;

  // A Cholesky factor of the difference exists if no singular value is small.
  const double least = kLeast * std::sqrt(RRt.trace());
  Matrix6d shifted = RRt;
  shifted.diagonal().array() -= least * least;
  if (Eigen::LLT<Matrix6d>(shifted).info() == Eigen::Success) return;

  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(RRt);
  locked->metric << Eigen::Vector3d::Constant(1 / (L * L)),
      Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1 / (L * L)),
      Eigen::Vector3d::Ones();
  for (int k = 0; k < 6; ++k) {  // Eigenvalues in increasing order.
    const double sigma = std::sqrt(std::max(0.0, solver.eigenvalues()[k]));
    if (sigma >= least && least > 0) break;
    Vector6d n_B = solver.eigenvectors().col(k);
    n_B.head<3>() *= L;
    auto n = locked->n.col(locked->count);
    n << X_BA.transpose() * n_B, -n_B;
    for (int i = 0; i < locked->count; ++i) {
      const auto other = locked->n.col(i);
      n -= other * other.dot(locked->metric.cwiseProduct(n));
    }
    n /= std::sqrt(n.dot(locked->metric.cwiseProduct(n)));
    locked->share[locked->count++] =
        least > 0 ? std::min(1.0, (least - sigma) / ((1 - kLocked) * least))
                  : 1;
  }
}

}  // namespace poise
