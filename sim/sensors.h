// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/sensor_settings.h"

namespace poise {

/// A stream of random numbers that is the same on every machine.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}

  double Uniform();   ///< In [0, 1).
  double Gaussian();  ///< Mean 0, standard deviation 1.

 private:
  std::uint64_t Next();
  std::uint64_t state_;
};

/// The robot's sensors, with the errors of their settings. Each instance draws
/// its errors from its own seed, so that equal calls give equal measurements.
class Sensors {
 public:
  Sensors(const Robot& robot, const SensorSettings& settings, unsigned seed);

  /// Returns the measurement of a state; during a dropout the last measurement.
  const Measurement& Measure(const PlantState& state);
  const Measurement& measurement() const { return measurement_; }

 private:
  struct Bias {
    Eigen::VectorXd joint_position, joint_velocity;
    Eigen::Vector3d base_position, base_orientation, base_rate, base_velocity;
    Eigen::Vector3d accelerometer, gyroscope;
    std::vector<Eigen::Vector3d> foot_force, foot_moment;  // By foot.
  };

  void DrawBiases();
  void Remember(const PlantState& state);
  const PlantState& Before(double delay) const;
  double Noise(double deviation);
  double Read(double truth, double bias, double deviation);
  Eigen::Vector3d Read(const Eigen::Vector3d& truth,
                       const Eigen::Vector3d& bias, double deviation);
  Eigen::Matrix3d ReadOrientation(const Eigen::Matrix3d& R);

  Robot robot_;
  SensorSettings settings_;
  RandomStream random_;
  Bias bias_;
  std::deque<PlantState>
      past_;  // As far back as the longest delay; newest last.
  Measurement measurement_;
  bool first_ = true;
};

}  // namespace poise
