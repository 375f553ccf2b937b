// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/plant_settings.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "poise/robot/input_error.h"

namespace poise {

namespace {

constexpr double kFar = 1e3;  // Largest coordinate and size of a board, m.
constexpr std::size_t kMostBoards = 100;
// Smallest torque_scale. It is positive because an effort limit of 0 means that
// a joint has no motor.
constexpr double kWeakest = 1e-6;

}  // namespace

Eigen::Vector3d GroundNormal(const Ground& ground) {
  return Eigen::AngleAxisd(ground.pitch, Eigen::Vector3d::UnitY()) *
         (Eigen::AngleAxisd(ground.roll, Eigen::Vector3d::UnitX()) *
          Eigen::Vector3d::UnitZ());
}

// The quaternion of the rotation from z to n is (1 + z.n, z x n), normalised.
// It is not zero, because roll and pitch are at most 1.5 rad.
Eigen::Quaterniond GroundRotation(const Ground& ground) {
  const Eigen::Vector3d n = GroundNormal(ground);
  return Eigen::Quaterniond(1 + n.z(), -n.y(), n.x(), 0).normalized();
}

std::vector<NumberField> Fields(PlantSettings* settings) {
  return {{"rate", &settings->dt, 10, 1e5, "Hz", 1, true},
          {"friction", &settings->friction, 0, 100},
          {"restitution", &settings->restitution, 0, 1},
          {"torque_scale", &settings->torque_scale, kWeakest, 100},
          {"roll", &settings->ground.roll, -1.5, 1.5, "rad"},
          {"pitch", &settings->ground.pitch, -1.5, 1.5, "rad"}};
}

std::vector<NumberField> Fields(Board* board) {
  return {{"center", board->center_W.data(), -kFar, kFar, "m", 3},
          {"size", board->size.data(), 1e-3, kFar, "m", 3},
          {"yaw", &board->yaw, -10, 10, "rad"}};
}

void Validate(const PlantSettings& settings) {
  PlantSettings copy = settings;
  Check("plant", Fields(&copy));
  for (std::size_t i = 0; i < copy.ground.boards.size(); ++i) {
    Check("plant.boards[" + std::to_string(i) + "]",
          Fields(&copy.ground.boards[i]));
  }
  if (copy.ground.boards.size() > kMostBoards) {
    throw InputError::OfValue(
        "plant.boards", " has " + std::to_string(copy.ground.boards.size()) +
                            " entries, must have at most " +
                            std::to_string(kMostBoards));
  }
}

}  // namespace poise
