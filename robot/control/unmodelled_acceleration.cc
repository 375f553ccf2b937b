// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/unmodelled_acceleration.h"

#include <cmath>

namespace poise {
namespace {

// Time constant of the mean, s: longer than the delays of a robot, shorter than
// the time in which a joint reaches its limit.
constexpr double kMemory = 0.02;

constexpr double kLargest = 100;  // Clamp, rad/s2 or m/s2.

}  // namespace

UnmodelledAcceleration::UnmodelledAcceleration(int nv, const FroudeScale& scale)
    : memory_(kMemory * scale.time()),
      largest_(kLargest / scale.length),
      vdot_(Eigen::VectorXd::Zero(nv)),
      predicted_v_(Eigen::VectorXd::Zero(nv)) {}

void UnmodelledAcceleration::Reset() noexcept {
  vdot_.setZero();
  predicts_ = false;
}

void UnmodelledAcceleration::Update(double dt,
                                    const Eigen::VectorXd& v) noexcept {
  if (!predicts_) return;
  const double share = -std::expm1(-dt / memory_);
  vdot_ += share * ((v - predicted_v_) / dt - vdot_);
  vdot_ = vdot_.cwiseMax(-largest_).cwiseMin(largest_);
}

void UnmodelledAcceleration::Predict(
    double dt, const Eigen::VectorXd& v,
    const Eigen::Ref<const Eigen::VectorXd>& vdot) noexcept {
  predicted_v_ = v + dt * vdot;
  predicts_ = true;
}

}  // namespace poise
