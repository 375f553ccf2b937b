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
/// Semi-implicit Euler: v' = v + dt a(q, v), contact impulses on v', then q
/// moves with v'. Under gravity it loses m g^2 dt / 2 of energy a second. A
/// foot stands on small spheres at the corners of its sole polygon; the
/// collision shapes of all other links touch the ground too. Links touch each
/// other, feet with all their shapes, except those that already do when Reset()
/// puts the robot down, and neighbors: links that one joint parts, or several
/// that are as one, or that share a parent.
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
