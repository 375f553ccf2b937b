// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/estimator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// A foot with a smaller normal force is not used to locate the base.
constexpr double kLeastForce = 5;  // N.

// Longest time over which the accelerometer is integrated in one update. After
// a longer gap, the measurements between are unknown.
constexpr double kLongestStep = 0.05;  // s.

// Whether all values that determine the base are valid. The forces of the feet
// do not matter: a foot whose force is not finite counts as unloaded.
bool IsUsable(const Measurement& measurement) {
  return std::isfinite(measurement.time) &&
         IsBelievable(measurement.R_WB_imu) &&
         IsBelievable(measurement.w_WB_B) &&
         IsBelievable(measurement.specific_force_Bo_B) &&
         IsBelievable(measurement.q_joints) &&
         IsBelievable(measurement.v_joints);
}

std::vector<int> FootFrames(const Robot& robot) {
  std::vector<int> frames;
  for (const Foot& foot : robot.feet) frames.push_back(foot.frame);
  return frames;
}

}  // namespace

Estimator::Estimator(const Robot& robot, double velocity_time)
    : robot_(robot),
      velocity_time_(velocity_time),
      tick_(robot.model.tree, FootFrames(robot)),
      feet_(robot.feet.size()),
      p_WB_(Eigen::Vector3d::Zero()),
      v_WB_(Eigen::Vector3d::Zero()) {}

void Estimator::ComputeFeet(const Measurement& measurement,
                            State* state) noexcept {
  const Eigen::Matrix3d& R_WB = measurement.R_WB_imu;
  const int n = robot_.model.tree.num_joints();
  state->q << Eigen::Vector3d::Zero(), Eigen::Quaterniond(R_WB).coeffs(),
      measurement.q_joints;
  state->v.head<3>() = R_WB * measurement.w_WB_B;
  state->v.segment<3>(3).setZero();
  state->v.tail(n) = measurement.v_joints;
  ComputeTick(robot_.model.tree, state->q, state->v, &tick_);
  for (int i = 0; i < static_cast<int>(feet_.size()); ++i) {
    const Foot& foot = robot_.feet[i];
    const FrameTick& frame = tick_.frames[i];
    const Pose& X_BF = robot_.model.tree.frames()[foot.frame].X_BF;
    const Pose X_FC = X_BF.Inverse() * foot.X_BC;
    const Eigen::Vector3d p_FC_W = frame.X_WF.R * X_FC.p;
    const Eigen::Vector3d w = frame.V_WF_W.head<3>();
    feet_[i].p_BC_W = frame.X_WF.p + p_FC_W;
    feet_[i].v_BC_W = frame.V_WF_W.tail<3>() + w.cross(p_FC_W);
  }
}

void Estimator::Start(const Measurement& measurement) {
  const int n = robot_.model.tree.num_joints();
  State state{0, Eigen::VectorXd(n + 7), Eigen::VectorXd(n + 6)};
  ComputeFeet(measurement, &state);
  p_WB_ = measurement.X_WB.p;
  v_WB_ = measurement.V_WB_W.tail<3>();
  time_ = measurement.time;
  q_base_ << p_WB_, state.q.segment<4>(3);
  v_base_ << state.v.head<3>(), v_WB_;
  for (FootState& foot : feet_) {
    foot.in_contact = true;
    foot.p_WC = p_WB_ + foot.p_BC_W;
  }
}

void Estimator::Update(const Measurement& measurement, State* state) noexcept {
  if (!IsUsable(measurement)) {
    state->time = time_;
    state->q << q_base_, measurement.q_joints;
    state->v << v_base_, measurement.v_joints;
    return;
  }
  ComputeFeet(measurement, state);
  const double dt = std::clamp(measurement.time - time_, 0.0, kLongestStep);
  time_ = measurement.time;

  // Integrates the accelerometer.
  const Eigen::Vector3d a_W =
      measurement.R_WB_imu * measurement.specific_force_Bo_B +
      robot_.model.tree.gravity_W();
  v_WB_ += dt * a_W;
  p_WB_ += dt * v_WB_;

  // Corrects by the legs, weighted by the normal forces of their feet.
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  double load = 0;
  for (int i = 0; i < static_cast<int>(feet_.size()); ++i) {
    const FootMeasurement& sensed = measurement.feet[i];
    const double force = sensed.F_Co_C[5];
    const bool in_contact = sensed.in_contact && force > kLeastForce;
    if (!in_contact || !feet_[i].in_contact) continue;
    p += force * (feet_[i].p_WC - feet_[i].p_BC_W);
    v -= force * feet_[i].v_BC_W;
    load += force;
  }
  if (load > 0) {
    p_WB_ = p / load;
    v_WB_ += std::min(1.0, dt / velocity_time_) * (v / load - v_WB_);
  }

  // Renews the touchdown position of a foot that just touched down or is
  // unloaded.
  for (int i = 0; i < static_cast<int>(feet_.size()); ++i) {
    const FootMeasurement& sensed = measurement.feet[i];
    const bool in_contact = sensed.in_contact && sensed.F_Co_C[5] > kLeastForce;
    if (!(in_contact && feet_[i].in_contact)) {
      feet_[i].p_WC = p_WB_ + feet_[i].p_BC_W;
    }
    feet_[i].in_contact = in_contact;
  }

  state->time = measurement.time;
  state->q.head<3>() = p_WB_;
  state->v.segment<3>(3) = v_WB_;
  q_base_ = state->q.head<7>();
  v_base_ = state->v.head<6>();
}

}  // namespace poise
