// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/sensors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "poise/math/so3.h"

namespace poise {

namespace {

// Tolerance of times, s. Rounding must not make a reading one tick older.
constexpr double kEarly = 5e-7;

// Rounds x to the nearest multiple of a step. A step of 0 does not change x.
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
  // A double has 53 significant bits.
  return static_cast<double>(Next() >> 11) * 0x1p-53;
}

// Returns the sum of twelve uniform numbers, minus 6. A logarithm or cosine
// would depend on the math library in the last bit. The tails end at 6
// deviations.
double RandomStream::Gaussian() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += Uniform();
  return sum;
}

Sensors::Sensors(const Robot& robot, const SensorSettings& settings,
                 unsigned seed)
    : robot_(robot), settings_(settings), random_(seed) {
  const int n = robot.model.tree.num_joints();
  DrawBiases();
  measurement_.q_joints.resize(n);
  measurement_.v_joints.resize(n);
  measurement_.feet.resize(robot.feet.size());
}

void Sensors::DrawBiases() {
  const SensorSettings& s = settings_;
  const int n = robot_.model.tree.num_joints();
  const auto within = [this](int size, double largest) {
    Eigen::VectorXd values(size);
    for (double& value : values) value = largest * (2 * random_.Uniform() - 1);
    return values;
  };
  bias_.joint_position = within(n, s.joint_bias);
  bias_.gyroscope = within(3, s.gyroscope_bias);
  for (size_t i = 0; i < robot_.feet.size(); ++i) {
    bias_.foot_force.push_back(within(3, s.force_bias));
  }
  bias_.joint_velocity = Eigen::VectorXd::Zero(n);
  bias_.foot_moment.resize(robot_.feet.size(), Eigen::Vector3d::Zero());
  for (Eigen::Vector3d* bias :
       {&bias_.base_position, &bias_.base_orientation, &bias_.base_rate,
        &bias_.base_velocity, &bias_.accelerometer}) {
    bias->setZero();
  }
  if (!(s.bias > 0)) return;
  const auto add = [this](auto* values, double deviation) {
    for (double& value : *values) {
      value += settings_.bias * deviation * random_.Gaussian();
    }
  };
  add(&bias_.joint_position, s.joint_position);
  add(&bias_.joint_velocity, s.joint_velocity);
  add(&bias_.base_position, s.base_position);
  add(&bias_.base_orientation, s.base_orientation);
  add(&bias_.base_rate, s.base_rate);
  add(&bias_.base_velocity, s.base_velocity);
  add(&bias_.accelerometer, s.accelerometer);
  add(&bias_.gyroscope, s.gyroscope);
  for (auto& bias : bias_.foot_force) add(&bias, s.foot_force);
  for (auto& bias : bias_.foot_moment) add(&bias, s.foot_moment);
}

void Sensors::Remember(const PlantState& state) {
  const double longest = std::max(
      {settings_.joint_delay, settings_.base_delay, settings_.foot_delay});
  past_.push_back(state);
  const double oldest = state.time - longest + kEarly;
  while (past_.size() > 1 && past_[1].time <= oldest) past_.pop_front();
}

// Returns the newest state that is old enough, or the oldest state if none is.
const PlantState& Sensors::Before(double delay) const {
  const double latest = past_.back().time - delay + kEarly;
  size_t i = past_.size() - 1;
  while (i > 0 && past_[i].time > latest) --i;
  return past_[i];
}

double Sensors::Noise(double deviation) {
  return settings_.noise > 0 && deviation > 0
             ? settings_.noise * deviation * random_.Gaussian()
             : 0;
}

double Sensors::Read(double truth, double bias, double deviation) {
  return Quantise(truth + bias + Noise(deviation),
                  settings_.resolution * deviation);
}

Eigen::Vector3d Sensors::Read(const Eigen::Vector3d& truth,
                              const Eigen::Vector3d& bias, double deviation) {
  Eigen::Vector3d read;
  for (int i = 0; i < 3; ++i) read[i] = Read(truth[i], bias[i], deviation);
  return read;
}

// Adds bias and noise as a rotation vector relative to the true orientation.
// Rounds the rotation vector relative to the world.
Eigen::Matrix3d Sensors::ReadOrientation(const Eigen::Matrix3d& R) {
  const double deviation = settings_.base_orientation;
  Eigen::Vector3d off = bias_.base_orientation;
  for (double& x : off) x += Noise(deviation);
  const Eigen::Matrix3d read = off.isZero(0) ? R : R * ExpSo3(off);
  const double step = settings_.resolution * deviation;
  if (!(step > 0)) return read;
  return ExpSo3(
      LogSo3(read).unaryExpr([step](double x) { return Quantise(x, step); }));
}

const Measurement& Sensors::Measure(const PlantState& state) {
  Remember(state);
  const bool lost =
      settings_.dropout > 0 && random_.Uniform() < settings_.dropout;
  const double frozen_for = state.time - settings_.freeze_at + kEarly;
  const bool frozen = frozen_for > 0 && frozen_for < settings_.freeze_for;
  if ((lost || frozen) && !first_) return measurement_;
  first_ = false;
  const SensorSettings& s = settings_;
  Measurement& out = measurement_;
  out.time = state.time;

  const PlantState& joints = Before(s.joint_delay);
  for (int j = 0; j < static_cast<int>(out.q_joints.size()); ++j) {
    out.q_joints[j] = Quantise(
        Read(joints.q[7 + j], bias_.joint_position[j], s.joint_position),
        s.joint_resolution);
    out.v_joints[j] =
        Read(joints.v[6 + j], bias_.joint_velocity[j], s.joint_velocity);
  }

  const PlantState& base = Before(s.base_delay);
  const Eigen::Matrix3d R_WB =
      Eigen::Quaterniond(base.q.segment<4>(3)).normalized().toRotationMatrix();
  const Eigen::Vector3d w_WB_W = base.v.head<3>();
  out.X_WB.R = ReadOrientation(R_WB);
  out.X_WB.p = Read(base.q.head<3>(), bias_.base_position, s.base_position);
  const Eigen::Vector3d w_W = Read(w_WB_W, bias_.base_rate, s.base_rate);
  out.V_WB_W << w_W,
      Read(base.v.segment<3>(3), bias_.base_velocity, s.base_velocity);
  out.R_WB_imu = out.X_WB.R;
  out.w_WB_B = Read(R_WB.transpose() * w_WB_W, bias_.gyroscope, s.gyroscope);
  out.specific_force_Bo_B =
      Read(R_WB.transpose() *
               (base.vdot.segment<3>(3) - robot_.model.tree.gravity_W()),
           bias_.accelerometer, s.accelerometer);

  const PlantState& feet = Before(s.foot_delay);
  for (size_t i = 0; i < out.feet.size(); ++i) {
    FootMeasurement& foot = out.feet[i];
    const auto& F = feet.F_Co_C[i];
    const Eigen::Vector3d moment =
        Read(F.head<3>(), bias_.foot_moment[i], s.foot_moment);
    foot.F_Co_C << moment, Read(F.tail<3>(), bias_.foot_force[i], s.foot_force);
    for (double& f : foot.F_Co_C.tail<3>()) f = Quantise(f, s.force_resolution);
    foot.in_contact = foot.F_Co_C[5] > s.contact_threshold;
  }
  return out;
}

}  // namespace poise
