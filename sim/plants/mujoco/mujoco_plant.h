// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/mujoco/load_mujoco.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// MuJoCo as a plant. Its dynamics and contact model are independent of
/// Bullet's, so a result in both plants is a property of the robot and not of
/// Bullet.
///
/// MuJoCo's contacts are soft (a time constant of 4 ms) and a convex problem.
/// Bullet's are hard and solved sequentially. MuJoCo's joints have armature,
/// implicit damping and dry friction. This plant has no restitution.
class MujocoPlant final : public Plant {
 public:
  /// Throws std::invalid_argument if MuJoCo rejects the model, a setting is out
  /// of range, or restitution is not 0.
  MujocoPlant(const Robot& robot, const PlantSettings& settings = {});

  void Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override;
  void Apply(const AppliedForce& force) override;
  void Step(const Eigen::VectorXd& tau) override;
  const PlantState& Sense() const override { return state_; }
  double dt() const override { return settings_.dt; }

 private:
  void Load(const std::vector<std::pair<int, int>>& excluded);
  void Place(const Eigen::VectorXd& q, const Eigen::VectorXd& v);
  std::vector<std::pair<int, int>> FindTouching() const;
  Pose X_WB(int body) const;
  void ReadState();
  void ReadContacts();

  Robot robot_;
  PlantSettings settings_;
  PlantState state_;
  MujocoModel model_;
  MujocoData data_;
  Eigen::VectorXd pushes_;  // Generalized forces for the next step.
  int steps_ = 0;
};

}  // namespace poise
