// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that the torques do not jump if tasks are switched, moved to another
// level or tuned between two ticks.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

TEST_F(ControllerTest, KeepsTorqueWhenInactiveRowsAreSwitched) {
  Update();
  const Eigen::VectorXd before = command_.tau;
  ASSERT_TRUE(controller_.stack().Enable("zmp", true));
  ASSERT_TRUE(controller_.stack().Enable("cop", false));
  ASSERT_TRUE(controller_.stack().SetWeight("momentum", 7));
  Update();
  // N m: rounding, and the integral action of one tick.
  EXPECT_LT((command_.tau - before).norm(), 1e-6);
}

// Compares the torques after a change of the stack, tick by tick in a constant
// state: once with the change eased in, and once with the change at once.
class RampTest : public ControllerTest {
 protected:
  RampTest() {
    // The state is off its reference, so that each gain and weight matters.
    controller_.reference().p_WG += Eigen::Vector3d(0.01, 0.01, 0.005);
    for (const char* joint : {"chest_pitch", "l_shoulder_pitch", "r_elbow"}) {
      state_.q[tree().q_start() + *tree().FindJoint(joint)] += 0.1;
    }
    DoNotIntegrate(&controller_.stack());
  }

  // Without this, the integral action grows with the constant error.
  static void DoNotIntegrate(Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("momentum", "ki", 0));
    EXPECT_TRUE(stack->SetParameter("momentum", "ki_height", 0));
  }

  void Try(const std::function<void(Stack*)>& change,
           const std::function<void(Stack*)>& prepare = {}) {
    if (prepare) prepare(&controller_.stack());
    Update();
    const Eigen::VectorXd before = command_.tau;
    ASSERT_TRUE(controller_.stack().set_ramp(kSeconds));
    change(&controller_.stack());
    Eigen::VectorXd last = before;
    std::vector<double> steps;
    for (int i = 0; i <= kTicks; ++i) {
      Update();
      ASSERT_EQ(command_.status, TickStatus::kOk);
      steps.push_back((command_.tau - last).norm());
      last = command_.tau;
    }
    Controller at_once(robot_);
    at_once.Start({0, robot_.q_nominal, Eigen::VectorXd::Zero(tree().nv())});
    at_once.reference() = controller_.reference();
    DoNotIntegrate(&at_once.stack());
    if (prepare) prepare(&at_once.stack());
    change(&at_once.stack());
    Command command = command_;
    at_once.Update(state_, &command);
    const double jump = (command.tau - before).norm();
    // N m: rounding of torques of 100 N m.
    EXPECT_LT((command_.tau - command.tau).norm(), 1e-7);
    ASSERT_GT(jump, 0.5);
    // The largest rate of a minimum-jerk curve is 15/8 of the mean rate; at the
    // start, the rate is 0.
    const double largest = *std::max_element(steps.begin(), steps.end());
    EXPECT_LT(largest, 1.9 * jump / kTicks)
        << "for a total change of " << jump << " N m";
    EXPECT_LT(steps.front(), 1e-4 * jump);
  }

  static constexpr int kTicks = 200;
  static constexpr double kSeconds = 0.2;
};

TEST_F(RampTest, EasesInChangeOfGain) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("momentum", "kp", 60));
  });
}

TEST_F(RampTest, EasesOutTaskSwitchedOff) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->Enable("posture", false)); });
}

TEST_F(RampTest, EasesInTaskSwitchedOn) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->Enable("torque_minimization", true));
  });
}

TEST_F(RampTest, EasesInTighterLimit) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("cop", "margin", 0.05));
  });
}

TEST_F(RampTest, EasesInChangeOfLevel) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetLevel("posture", 4)); });
}

TEST_F(RampTest, EasesInChangeOfWeight) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetWeight("posture", 100)); },
      [](Stack* stack) { EXPECT_TRUE(stack->SetLevel("posture", 4)); });
}

// In one weighted QP, a level that is added changes the weights of all levels
// above it.
TEST_F(RampTest, EasesInTaskOfWeightedQp) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->Enable("momentum", true)); },
      [](Stack* stack) {
        EXPECT_TRUE(stack->set_weighted(true));
        EXPECT_TRUE(stack->Enable("momentum", false));
      });
}

TEST_F(RampTest, DoesNotEaseTuningOfDisabledTask) {
  Update();
  const int levels = controller_.hierarchy().num_levels();
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.set_ramp(kSeconds));
  ASSERT_TRUE(stack.SetParameter("zmp", "dx", 0.01));
  Update();
  EXPECT_FALSE(stack.is_eased());
  EXPECT_EQ(controller_.hierarchy().num_levels(), levels);
}

TEST_F(RampTest, EndsWhenDurationIsSetToZero) {
  Update();
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.set_ramp(kSeconds));
  ASSERT_TRUE(stack.SetParameter("momentum", "kp", 60));
  Update();
  ASSERT_TRUE(stack.is_eased());
  ASSERT_TRUE(stack.set_ramp(0));
  EXPECT_FALSE(stack.is_eased());
}

// A reference that changes during a ramp acts as without a ramp.
TEST_F(RampTest, DoesNotEaseChangeOfReference) {
  const auto change = [](Stack* stack, bool eases) {
    DoNotIntegrate(stack);
    if (eases) {
      EXPECT_TRUE(stack->set_ramp(kSeconds));
    }
    EXPECT_TRUE(stack->SetParameter("momentum", "kp", 60));
    EXPECT_TRUE(stack->Enable("force_regularizer", false));
    EXPECT_TRUE(stack->Enable("torque_minimization", true));
    EXPECT_TRUE(stack->SetWeight("posture", 3));
  };
  // Returns the torques at half of the ramp. If `moves`, the reference changes
  // in the last tick.
  const auto torques = [&](bool eases, bool moves) {
    Controller controller(robot_);
    controller.Start(state_);
    controller.reference() = controller_.reference();
    Command command = command_;
    State state = state_;
    for (int i = 0; i <= kTicks / 2; ++i) {
      if (i == 1) change(&controller.stack(), eases);
      if (i == kTicks / 2 && moves) {
        controller.reference().p_WG += Eigen::Vector3d(-0.003, 0.002, 0.004);
        controller.reference().posture.array() += 0.01;
      }
      state.time += 1e-3;
      controller.Update(state, &command);
      EXPECT_EQ(command.status, TickStatus::kOk);
    }
    return command.tau;
  };
  const Eigen::VectorXd at_once = torques(false, true) - torques(false, false);
  const Eigen::VectorXd eased = torques(true, true) - torques(true, false);
  ASSERT_GT(at_once.norm(), 1);
  // N m: rounding of torques of 100 N m.
  EXPECT_LT((eased - at_once).norm(), 1e-7);
  EXPECT_GT((torques(true, true) - torques(false, true)).norm(), 0.5);
}

TEST_F(RampTest, RejectsInvalidDuration) {
  EXPECT_FALSE(controller_.stack().set_ramp(-1));
  EXPECT_FALSE(
      controller_.stack().set_ramp(std::numeric_limits<double>::quiet_NaN()));
}

TEST_F(RampTest, DoesNotEaseAfterFailSafe) {
  Update();
  ASSERT_TRUE(controller_.stack().set_ramp(kSeconds));
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "kp", 120));
  const double q = state_.q[20];
  state_.q[20] = std::numeric_limits<double>::quiet_NaN();
  Update();
  ASSERT_EQ(command_.status, TickStatus::kFailSafe);
  state_.q[20] = q;
  Update();
  const Eigen::VectorXd tau = command_.tau;
  Update();
  EXPECT_LT((command_.tau - tau).norm(), 1e-7);  // N m: the change is complete.
}

}  // namespace
}  // namespace poise
