// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/bullet/bullet_settings.h"
#include "poise/sim/plants/bullet/bullet_world.h"
#include "poise/sim/plants/joint_drag.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// A plant with Bullet's Featherstone multibody, built from the robot's model.
///
/// The integrator is semi-implicit Euler: v' = v + dt a(q, v), contact impulses
/// act on v', then q moves with v'. Under gravity the plant loses m g^2 dt / 2
/// of energy per second.
///
/// A foot stands on small spheres at the corners of its sole polygon. All other
/// links touch the ground with their collision shapes. Links also collide with
/// each other; feet do so with all their shapes. Exceptions are neighbors, see
/// FindNeighbors(), and links that already touch when Reset() places the robot.
class BulletPlant final : public Plant {
 public:
  /// Throws std::invalid_argument if Bullet cannot represent the model, see
  /// BulletBody, or a setting is out of range.
  BulletPlant(const Robot& robot, const PlantSettings& settings = {},
              const BulletSettings& bullet = {});

  void Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override;
  void Apply(const AppliedForce& force) override;
  void Step(const Eigen::VectorXd& tau) override;
  const PlantState& Sense() const override { return state_; }
  double dt() const override { return settings_.dt; }

 private:
  void ReadContacts();

  Robot robot_;
  PlantSettings settings_;
  BulletSettings bullet_;
  JointDrag drag_;
  PlantState state_;
  std::vector<Pose> X_WC_;  // Per foot, when the last step began.
  int steps_ = 0;
  std::unique_ptr<BulletWorld> world_;
};

}  // namespace poise
