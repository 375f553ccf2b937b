// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "poise/math/eigen_alignment.h"
#include "poise/sim/number_field.h"

namespace poise {

/// A box that is part of the ground.
struct Board {
  Eigen::Vector3d center_W;  ///< m.
  Eigen::Vector3d size;      ///< Full edge lengths, m.
  double yaw = 0;            ///< Rotation about z, rad.
};

/// The ground: a plane through the world's origin, and boards.
struct Ground {
  double roll = 0;   ///< Rotation of the plane about x, rad.
  double pitch = 0;  ///< Then its rotation about y, rad.
  std::vector<Board> boards;
};

/// Settings that every plant has.
struct PlantSettings {
  double dt = 1e-3;         ///< s.
  double friction = 0.8;    ///< Coefficient of robot on ground.
  double restitution = 0;   ///< Coefficient of robot on ground; 1: no loss.
  double torque_scale = 1;  ///< Factor on the effort limits.
  bool joint_limits = true;
  bool joint_damping = true;   ///< The model's damping and friction.
  bool self_collision = true;  ///< Links collide with each other.
  Ground ground;
};

/// Returns the plane's normal, which points out of the ground.
Eigen::Vector3d GroundNormal(const Ground& ground);
/// Returns R_WG, the smallest rotation from the world's z axis to the normal.
Eigen::Quaterniond GroundRotation(const Ground& ground);

/// Return the numeric fields of settings, to read or check them.
std::vector<NumberField> Fields(PlantSettings* settings);
std::vector<NumberField> Fields(Board* board);

/// Throws std::invalid_argument about the first invalid setting, with its name,
/// its value and the allowed values.
void Validate(const PlantSettings& settings);

}  // namespace poise
