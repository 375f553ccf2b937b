// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/plant_settings.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

namespace poise {

namespace {

void Require(bool holds, const std::string& name, double value,
             const std::string& wanted) {
  if (holds) return;
  throw std::invalid_argument("plant: " + name + " is " +
                              std::to_string(value) + ", must be " + wanted);
}

}  // namespace

Eigen::Vector3d GroundNormal(const Ground& ground) {
  return Eigen::AngleAxisd(ground.pitch, Eigen::Vector3d::UnitY()) *
         (Eigen::AngleAxisd(ground.roll, Eigen::Vector3d::UnitX()) *
          Eigen::Vector3d::UnitZ());
}

void Validate(const PlantSettings& settings) {
  // A comparison with NaN is false, so each of these refuses it.
  Require(settings.dt > 0 && settings.dt <= 0.1, "dt", settings.dt,
          "in (0, 0.1] s");
  Require(settings.friction >= 0 && std::isfinite(settings.friction),
          "friction", settings.friction, "at least 0");
  Require(settings.restitution >= 0 && settings.restitution <= 1, "restitution",
          settings.restitution, "in [0, 1]");
  Require(settings.torque_scale >= 0 && std::isfinite(settings.torque_scale),
          "torque scale", settings.torque_scale, "at least 0");
  for (const double tilt : {settings.ground.roll, settings.ground.pitch}) {
    Require(std::abs(tilt) < 1.5, "ground tilt", tilt, "in (-1.5, 1.5) rad");
  }
  for (const Board& board : settings.ground.boards) {
    Require(board.size.allFinite() && board.size.minCoeff() > 0, "board size",
            board.size.minCoeff(), "positive");
  }
}

}  // namespace poise
