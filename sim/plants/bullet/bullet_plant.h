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

/// Bullet's Featherstone multibody, built from our own model, as a plant.
///
/// Integration is semi-implicit Euler: v' = v + dt a(q, v), contact impulses change
/// v', then q moves with v'. A free fall loses m g^2 dt / 2 of energy a second. A foot
/// stands on small spheres at the corners of its sole polygon. The collision shapes
/// of all other links collide with the ground too. Links collide with each other,
/// except links that overlap at Reset() and the pairs of FindNeighbors().
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
