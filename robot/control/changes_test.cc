// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// What is switched, moved or tuned between two ticks does not make the torques
// jump.
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

TEST_F(ControllerTest, DoesNotJumpWhereWhatIsSwitchedDoesNotAct) {
  Update();
  const Eigen::VectorXd before = command_.tau;
  ASSERT_TRUE(controller_.stack().Enable("zmp", true));
  ASSERT_TRUE(controller_.stack().Enable("cop", false));
  ASSERT_TRUE(controller_.stack().SetWeight("momentum", 7));
  Update();
  // N m: rounding, and what the ground's height is corrected by in a tick.
  EXPECT_LT((command_.tau - before).norm(), 1e-6);
}

// Measures the change of the torques from tick to tick while the state is
// constant, with and without a ramp.
class RampTest : public ControllerTest {
 protected:
  RampTest() {
    // Off its reference, so that each gain and weight matters.
    controller_.reference().p_WG += Eigen::Vector3d(0.01, 0.01, 0.005);
    for (const char* joint : {"chest_pitch", "l_shoulder_pitch", "r_elbow"}) {
      state_.q[tree().q_start() + *tree().FindJoint(joint)] += 0.1;
    }
    DoNotIntegrate(&controller_.stack());
  }

  // Or an error that stays is corrected ever more.
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
    // A curve of minimum jerk goes 15/8 as fast as a line, and begins at rest.
    const double largest = *std::max_element(steps.begin(), steps.end());
    EXPECT_LT(largest, 1.9 * jump / kTicks) << "of " << jump << " N m";
    EXPECT_LT(steps.front(), 1e-4 * jump);
  }

  static constexpr int kTicks = 200;
  static constexpr double kSeconds = 0.2;
};

TEST_F(RampTest, EasesAGainIn) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("momentum", "kp", 60));
  });
}

TEST_F(RampTest, EasesATaskOut) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->Enable("posture", false)); });
}

TEST_F(RampTest, EasesATaskIn) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->Enable("torque_minimization", true));
  });
}

TEST_F(RampTest, EasesALimitIn) {
  Try([](Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("cop", "margin", 0.05));
  });
}

TEST_F(RampTest, EasesALevelIn) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetLevel("posture", 4)); });
}

TEST_F(RampTest, EasesAWeightIn) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetWeight("posture", 100)); },
      [](Stack* stack) { EXPECT_TRUE(stack->SetLevel("posture", 4)); });
}

// As one weighted QP a level that comes weighs all above it anew.
TEST_F(RampTest, EasesATaskIntoAWeightedProblem) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->Enable("momentum", true)); },
      [](Stack* stack) {
        EXPECT_TRUE(stack->set_weighted(true));
        EXPECT_TRUE(stack->Enable("momentum", false));
      });
}

TEST_F(RampTest, HoldsNothingForATaskThatIsOff) {
  Update();
  const int levels = controller_.hierarchy().num_levels();
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.set_ramp(kSeconds));
  ASSERT_TRUE(stack.SetParameter("zmp", "dx", 0.01));
  Update();
  EXPECT_FALSE(stack.is_eased());
  EXPECT_EQ(controller_.hierarchy().num_levels(), levels);
}

TEST_F(RampTest, EndsWhereItsDurationBecomesNone) {
  Update();
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.set_ramp(kSeconds));
  ASSERT_TRUE(stack.SetParameter("momentum", "kp", 60));
  Update();
  ASSERT_TRUE(stack.is_eased());
  ASSERT_TRUE(stack.set_ramp(0));
  EXPECT_FALSE(stack.is_eased());
}

// During a ramp, a moving reference acts as it would without the ramp.
TEST_F(RampTest, HoldsBackNothingElse) {
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
  // The torques half way, where the reference moves in the last tick.
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

TEST_F(RampTest, RejectsNegativeAndNaNDurations) {
  EXPECT_FALSE(controller_.stack().set_ramp(-1));
  EXPECT_FALSE(
      controller_.stack().set_ramp(std::numeric_limits<double>::quiet_NaN()));
}

TEST_F(RampTest, EasesNothingAfterAFailure) {
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
  EXPECT_LT((command_.tau - tau).norm(), 1e-7);  // N m: it is all there.
}

}  // namespace
}  // namespace poise
