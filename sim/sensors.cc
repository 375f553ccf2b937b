// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/sensors.h"

#include <Eigen/Geometry>
#include <cmath>

#include "math/so3.h"

namespace poise {

namespace {

// To the nearest multiple of a step; a step of 0 leaves x alone.
double Quantise(double x, double step) {
  return step > 0 ? step * std::round(x / step) : x;
}

}  // namespace

// SplitMix64, public domain: Steele, Lea and Flood, "Fast splittable
// pseudorandom number generators", OOPSLA 2014.
std::uint64_t RandomStream::Next() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double RandomStream::Uniform() {
  // 53 bits, as many as a double holds.
  return static_cast<double>(Next() >> 11) * 0x1p-53;
}

// The sum of twelve uniform numbers: no logarithm or cosine, whose last bit is
// the library's affair; its tails end at 6 deviations.
double RandomStream::Gaussian() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += Uniform();
  return sum;
}

Sensors::Sensors(const Robot& robot, const SensorSettings& settings,
                 unsigned seed)
    : robot_(robot), settings_(settings), random_(seed) {
  const int n = robot.model.tree.num_joints();
  const auto bias = [this](int size, double largest) {
    Eigen::VectorXd values(size);
    for (double& value : values) value = largest * (2 * random_.Uniform() - 1);
    return values;
  };
  joint_bias_ = bias(n, settings.joint_bias);
  gyroscope_bias_ = bias(3, settings.gyroscope_bias);
  for (size_t i = 0; i < robot.feet.size(); ++i) {
    force_bias_.push_back(bias(3, settings.force_bias));
  }
  measurement_.q_joints.resize(n);
  measurement_.v_joints.resize(n);
  measurement_.feet.resize(robot.feet.size());
}

double Sensors::Noise(double deviation) {
  return settings_.noise > 0 ? settings_.noise * deviation * random_.Gaussian()
                             : 0;
}

const Measurement& Sensors::Measure(const PlantState& state) {
  const bool lost =
      settings_.dropout > 0 && random_.Uniform() < settings_.dropout;
  // Half a microsecond early, so that rounding does not delay it by a tick.
  const double frozen_for = state.time - settings_.freeze_at + 5e-7;
  const bool frozen = frozen_for > 0 && frozen_for < settings_.freeze_for;
  if ((lost || frozen) && !first_) return measurement_;
  first_ = false;
  const SensorSettings& s = settings_;
  const auto noise = [this](double deviation) {
    const double x = Noise(deviation), y = Noise(deviation);
    return Eigen::Vector3d(x, y, Noise(deviation));
  };
  Measurement& out = measurement_;
  out.time = state.time;
  const int n = static_cast<int>(out.q_joints.size());
  for (int j = 0; j < n; ++j) {
    out.q_joints[j] =
        Quantise(state.q[7 + j] + joint_bias_[j] + Noise(s.joint_position),
                 s.joint_resolution);
    out.v_joints[j] = state.v[6 + j] + Noise(s.joint_velocity);
  }
  const Eigen::Matrix3d R_WB =
      Eigen::Quaterniond(state.q.segment<4>(3)).normalized().toRotationMatrix();
  const Eigen::Vector3d w_WB_W = state.v.head<3>();
  out.X_WB.p = state.q.head<3>();
  out.X_WB.R = s.noise > 0
                   ? Eigen::Matrix3d(R_WB * ExpSo3(noise(s.base_orientation)))
                   : R_WB;
  out.V_WB_W << w_WB_W + noise(s.base_rate), state.v.segment<3>(3);
  out.R_WB_imu = out.X_WB.R;
  out.w_WB_B = R_WB.transpose() * w_WB_W + gyroscope_bias_ + noise(s.gyroscope);
  out.specific_force_Bo_B = R_WB.transpose() * (state.vdot.segment<3>(3) -
                                                robot_.model.tree.gravity_W()) +
                            noise(s.accelerometer);
  for (size_t i = 0; i < out.feet.size(); ++i) {
    FootMeasurement& foot = out.feet[i];
    foot.F_Co_C << state.F_Co_C[i].head<3>() + noise(s.foot_moment),
        state.F_Co_C[i].tail<3>() + force_bias_[i] + noise(s.foot_force);
    for (double& f : foot.F_Co_C.tail<3>()) f = Quantise(f, s.force_resolution);
    foot.in_contact = foot.F_Co_C[5] > s.contact_threshold;
  }
  return out;
}

}  // namespace poise
