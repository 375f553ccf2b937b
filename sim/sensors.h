// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "robot/control/measurement.h"
#include "robot/robot.h"
#include "sim/plant.h"
#include "sim/sensor_settings.h"

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

/// The robot's sensors, as bad as their settings say. Each instance draws its
/// own errors from its seed: the same for the same calls.
class Sensors {
 public:
  Sensors(const Robot& robot, const SensorSettings& settings, unsigned seed);

  /// What the sensors say of a state; in a drop-out, what they said last.
  const Measurement& Measure(const PlantState& state);
  const Measurement& measurement() const { return measurement_; }

 private:
  double Noise(double deviation);

  Robot robot_;
  SensorSettings settings_;
  RandomStream random_;
  Eigen::VectorXd joint_bias_;
  Eigen::Vector3d gyroscope_bias_;
  std::vector<Eigen::Vector3d> force_bias_;
  Measurement measurement_;
  bool first_ = true;
};

}  // namespace poise
