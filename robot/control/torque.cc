// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/torque.h"

#include <algorithm>
#include <cmath>

#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

// The friction is fully compensated well above this acceleration, and the
// acceleration is filtered with this time. Both are multiplied by powers of
// PendulumRate(). Their product is a velocity that a standing robot does not
// have, so that the torque does not chatter.
constexpr double kSmallAcceleration = 0.02;
constexpr double kFilterTime = 2;

// Returns sqrt(g / h) of the robot's pendulum, 1/s.
double PendulumRate(const Robot& robot) {
  const Tick tick = NominalTick(robot);
  double height = 0;
  for (const Foot& foot : robot.feet) {
    const Eigen::Vector3d p_WC = tick.X_WB[foot.body] * foot.X_BC.p;
    height = std::max(height, tick.p_WG.z() - p_WC.z());
  }
  // Without a height, in the bolted-down robots of tests, a meter is assumed.
  return std::sqrt(robot.model.tree.gravity_W().norm() /
                   (height > 0 ? height : 1));
}

}  // namespace

void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept {
  const auto nv = tick.M.rows();
  const auto n = tau->size();
  tau->noalias() = tick.M.bottomRows(n) * y.head(nv);
  *tau += tick.N.tail(n);
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    if (!contacts[i].in_contact) continue;
    tau->noalias() -=
        contacts[i].J_WC_C.rightCols(n).transpose() * y.segment<6>(nv + 6 * i);
  }
}

DragCompensation::DragCompensation(const Robot& robot) {
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    const JointLimits& limits = robot.model.limits[j];
    if (!(limits.damping > 0 || limits.friction > 0)) continue;
    drags_.push_back({j, limits.damping, limits.friction, limits.effort});
  }
  const double rate = PendulumRate(robot);
  small_ = kSmallAcceleration * rate * rate;
  filter_time_ = kFilterTime / rate;
}

void DragCompensation::Reset() noexcept {
  for (Drag& drag : drags_) drag.acceleration = 0;
}

void DragCompensation::AddTo(double dt, double scale,
                             const Eigen::Ref<const Eigen::VectorXd>& v,
                             const Eigen::Ref<const Eigen::VectorXd>& vdot,
                             Eigen::VectorXd* tau) noexcept {
  const double share = dt / (filter_time_ + dt);
  for (Drag& drag : drags_) {
    drag.acceleration += share * (vdot[drag.joint] - drag.acceleration);
    const double added = drag.damping * v[drag.joint] +
                         drag.friction * std::tanh(drag.acceleration / small_);
    double& torque = (*tau)[drag.joint];
    // The motor's limit cuts the added torque, never the torque of (10).
    const double least = std::min(torque, -scale * drag.effort);
    const double most = std::max(torque, scale * drag.effort);
    torque = std::clamp(torque + added, least, most);
  }
}

double DynamicsResidual(const Tick& tick,
                        const std::vector<ContactTick>& contacts,
                        const Eigen::VectorXd& y, double scale) noexcept {
  const auto nv = tick.M.rows();
  double off = 0, terms = 0;
  for (int row = 0; row < 6; ++row) {
    double left = tick.N[row];
    terms += std::abs(left);
    const auto add = [&left, &terms](double term) {
      left += term;
      terms += std::abs(term);
    };
    for (Eigen::Index i = 0; i < nv; ++i) add(tick.M(i, row) * y[i]);
    for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
      if (!contacts[i].in_contact) continue;
      for (int k = 0; k < 6; ++k) {
        add(-contacts[i].J_WC_C(k, row) * y[nv + 6 * i + k]);
      }
    }
    off += std::abs(left);
  }
  return off / std::max(scale, terms);
}

}  // namespace poise
