// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The loops that the docstrings of Controller and Gait quote.
#include <gtest/gtest.h>

#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/robot/gait/gait.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

class LoopsTest : public testing::Test {
 protected:
  LoopsTest() {
    command.tau.setZero(robot.model.tree.num_joints());
    const Eigen::VectorXd v = Eigen::VectorXd::Zero(robot.model.tree.nv());
    for (int tick = 0; tick < 20; ++tick) {
      states.push_back({1e-3 * tick, robot.q_nominal, v});
    }
  }

  const Robot robot = LoadHumanoid();
  std::vector<State> states;
  Command command;
};

TEST_F(LoopsTest, OfAControllerMovesTheRobot) {
  Controller controller(robot);
  controller.Start(states[0]);
  for (const State& state : states) {
    controller.reference().p_WG.z() -= 1e-5;  // To move the robot.
    controller.Update(state, &command);
  }
  EXPECT_EQ(command.status, TickStatus::kOk);
  const Eigen::VectorXd moving = command.tau;
  controller.Start(states[0]);
  controller.Update(states[0], &command);
  EXPECT_GT((command.tau - moving).norm(), 0);
}

TEST_F(LoopsTest, OfAGaitKeepsBothFeetDownWithoutAPush) {
  const GaitSettings settings;
  Controller controller(robot);
  controller.Start(states[0]);
  Gait gait(robot, settings);
  gait.Start();
  for (const State& state : states) {
    gait.Update(&controller);
    controller.Update(state, &command);
  }
  EXPECT_EQ(command.status, TickStatus::kOk);
  EXPECT_EQ(gait.phase(), GaitPhase::kStand);
}

}  // namespace
}  // namespace poise
