// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "poise/robot/control/controller.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {

/// Test fixture: the humanoid at rest in its nominal posture, and a controller
/// that was started in this state.
class ControllerTest : public testing::Test {
 protected:
  ControllerTest() {
    state_ = {0, robot_.q_nominal, Eigen::VectorXd::Zero(tree().nv())};
    controller_.Start(state_);
    command_.tau.setZero(tree().num_joints());
  }

  const Tree& tree() const { return robot_.model.tree; }

  void Update() {
    state_.time += 1e-3;
    controller_.Update(state_, &command_);
  }

  Robot robot_ = LoadHumanoid();
  Controller controller_{robot_};
  State state_;
  Command command_;
};

}  // namespace poise
