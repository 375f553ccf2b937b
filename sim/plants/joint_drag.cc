// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/joint_drag.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace poise {

namespace {

// Dry friction holds a joint below this speed, rad/s or m/s. A held joint
// creeps at this speed times load / dry friction.
constexpr double kSlow = 1e-4;

// Most passes over the joints that slip.
constexpr int kPasses = 10;

std::vector<int> FootFrames(const Robot& robot) {
  std::vector<int> frames;
  for (const Foot& foot : robot.feet) frames.push_back(foot.frame);
  return frames;
}

}  // namespace

JointDrag::JointDrag(const Robot& robot, double dt)
    : robot_(robot),
      dt_(dt),
      tick_(robot.model.tree, FootFrames(robot)),
      drag_(Eigen::VectorXd::Zero(robot.model.tree.num_joints())) {
  for (const JointLimits& limits : robot.model.limits) {
    exists_ = exists_ || limits.damping > 0 || limits.friction > 0;
  }
}

const Eigen::VectorXd& JointDrag::Compute(const PlantState& state,
                                          const Eigen::VectorXd& tau) {
  const Tree& tree = robot_.model.tree;
  const int n = tree.num_joints();
  ComputeTick(tree, state.q, state.v, &tick_);
  Eigen::VectorXd force = -tick_.N;
  force.tail(n) += tau;
  for (size_t i = 0; i < robot_.feet.size(); ++i) {
    const FrameTick& frame = tick_.frames[i];
    const Pose X_WC = tick_.X_WB[robot_.feet[i].body] * robot_.feet[i].X_BC;
    const Eigen::Vector3d force_W = X_WC.R * state.F_Co_C[i].tail<3>();
    const Eigen::Vector3d p_FC_W = X_WC.p - frame.X_WF.p;
    Vector6d F_Fo_W;
    F_Fo_W << X_WC.R * state.F_Co_C[i].head<3>() + p_FC_W.cross(force_W),
        force_W;
    force += frame.J_WF_W.transpose() * F_Fo_W;
  }
  const Eigen::VectorXd v = state.v.tail(n);
  Eigen::VectorXd D(n), slip = Eigen::VectorXd::Zero(n);
  std::vector<bool> may_slip(n, true);
  for (int j = 0; j < n; ++j) {
    const JointLimits& limits = robot_.model.limits[j];
    D[j] = limits.damping + limits.friction / std::max(std::abs(v[j]), kSlow);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::MatrixXd M = tick_.M;
    M.diagonal().tail(n) += dt_ * D;
    Eigen::VectorXd load = force;
    load.tail(n) += slip - D.cwiseProduct(v);
    const Eigen::VectorXd next = v + dt_ * M.llt().solve(load).tail(n);
    drag_ = slip - D.cwiseProduct(next);
    // Decides again which joints slip. Without this, a joint of small inertia
    // between a motor and the ground would be held against any torque.
    bool changes = false;
    for (int j = 0; j < n; ++j) {
      const JointLimits& limits = robot_.model.limits[j];
      const double dry = (D[j] - limits.damping) * std::abs(next[j]);
      if (slip[j] == 0 && may_slip[j] && dry > limits.friction) {
        slip[j] = std::copysign(limits.friction, -next[j]);
        D[j] = limits.damping;
        changes = true;
      } else if (slip[j] * next[j] > 0) {  // The friction would reverse it.
        slip[j] = 0;
        D[j] = limits.damping + limits.friction / kSlow;
        may_slip[j] = false;
        changes = true;
      }
    }
    if (!changes) break;
  }
  return drag_;
}

}  // namespace poise
