// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/controller.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/dynamics/integrate.h"
#include "poise/hqp/certificate.h"
#include "poise/math/so3.h"
#include "poise/robot/control/bolted_down_fixture.h"
#include "poise/robot/control/controller_fixture.h"
#include "poise/robot/control/torque.h"
#include "poise/tests/util/count_malloc.h"

namespace poise {
namespace {

TEST_F(ControllerTest, TorquesRealiseTheSolution) {
  state_.v.tail(tree().num_joints()).setConstant(0.02);
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const int n = tree().num_joints();

  const Eigen::VectorXd& y = controller_.report().y;
  const Tick& tick = controller_.tick();
  Eigen::VectorXd residual = tick.M * y.head(tree().nv()) + tick.N;
  residual.tail(n) -= command_.tau;
  for (int i = 0; i < 2; ++i) {
    residual -= controller_.contacts()[i].J_WC_C.transpose() *
                controller_.report().foot_wrench(tree().nv(), i);
  }
  // N; the weight of the robot is 380 N.
  EXPECT_LT(residual.norm(), 1e-9);
}

// Accelerates the base about z by a constant, rad/s2.
class TurnTask final : public Task {
 public:
  explicit TurnTask(double desired)
      : Task("turn", {{"turn.z", "rad/s2", "the rotation of the base"}}, {}),
        desired_(desired) {}
  void Write(const TaskInput&, EqualityBlock* equalities,
             InequalityBlock*) const noexcept override {
    equalities->SetSingle(0, 2, 1);
    equalities->b[0] = -desired_;
  }

 private:
  double desired_;
};

TEST_F(ControllerTest, AddsTasksOfTheCaller) {
  ControllerOptions options;
  double desired = 0.3;
  options.add_tasks = [&desired](Stack* stack) {
    // Level 3 is above the momentum, which would resist.
    stack->Add(std::make_unique<TurnTask>(desired), {true, 3, 1});
  };
  Controller turning(controller_.robot(), options);
  turning.Start(state_);
  turning.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kOk);
  // An answer without a certificate of 1e-9 would not be kOk.
  EXPECT_NEAR(turning.report().y[2], desired, Certifier::kCertified);

  // A row that is not finite ends the tick in the fail-safe command.
  desired = std::numeric_limits<double>::quiet_NaN();
  Controller failing(controller_.robot(), options);
  failing.Start(state_);
  failing.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  EXPECT_EQ(failing.report().fail_safe_reason, FailSafeReason::kNoAnswer);
  EXPECT_TRUE(command_.tau.allFinite());
}

TEST_F(ControllerTest, ComesToRestAfterAPush) {
  const int kPushTicks = 50;
  const Eigen::Vector3d kPush(0, 20, 0);  // N.
  const BoltedDown plant(controller_);
  double largest_error = 0;
  for (int i = 0; i < 800; ++i) {
    Update();
    ASSERT_NE(command_.status, TickStatus::kFailSafe);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(tree().nv());
    if (i < kPushTicks) f.segment<3>(3) = kPush;
    const Eigen::VectorXd vdot = plant.Solve(command_.tau, f).head(tree().nv());
    state_.v += 1e-3 * vdot;
    Integrate(tree(), state_.q, state_.v, 1e-3, state_.q);
    largest_error = std::max(
        largest_error,
        (controller_.tick().p_WG - controller_.reference().p_WG).norm());
  }
  // 1 N s on 38.6 kg gives 26 mm/s: the error is a few mm, then decays.
  EXPECT_GT(largest_error, 1e-3);
  EXPECT_LT(largest_error, 1e-2);
  EXPECT_LT((controller_.tick().p_WG - controller_.reference().p_WG).norm(),
            2e-3);
}

// Most of the memory is four matrices of all rows of the tasks by all
// variables, 506 by 68 for 50 joints: 1.1 MB. The bound is a requirement.
TEST_F(ControllerTest, NeedsLessThanTwoMegabytes) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  ASSERT_EQ(tree().num_joints(), 50);
  CountMalloc count;
  const Controller controller(robot_);
  EXPECT_LE(count.bytes(), 2 * 1024 * 1024);
}

TEST_F(ControllerTest, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  Update();
  ASSERT_TRUE(controller_.stance().Lift(0, 0.05));
  state_.v.segment<3>(3) << 0.1, 0.3, 0;
  ASSERT_TRUE(controller_.stack().set_ramp(0.004));
  CountMalloc count;
  for (int i = 0; i < 1000; ++i) {
    state_.v[3] = 1e-3 * i;
    state_.q[20] = i % 100 == 99 ? std::numeric_limits<double>::quiet_NaN() : 0;
    (void)controller_.stack().Enable("zmp", i % 7 == 0);
    (void)controller_.stack().SetLevel("posture", 5 + i % 2);
    (void)controller_.stack().SetWeight("momentum", 1 + i % 3);
    (void)controller_.stack().SetParameter("posture", "kp", 60 + i % 5);
    Update();
  }
  EXPECT_EQ(count.allocations(), 0);
}

TEST_F(ControllerTest, IsDeterministicToTheBit) {
  Controller other(robot_);
  other.Start(state_);
  Command command = command_;
  for (int i = 0; i < 50; ++i) {
    state_.time += 1e-3;
    state_.v.segment<3>(3) << 0.01 * i, 0.2, 0;
    controller_.Update(state_, &command_);
    other.Update(state_, &command);
    ASSERT_EQ(command.tau, command_.tau) << i;
  }
}

TEST_F(ControllerTest, RepeatsToTheBitAfterRestart) {
  const State start = state_;
  const auto run = [&] {
    state_ = start;
    controller_.Start(state_);
    Eigen::MatrixXd tau(tree().num_joints(), 60);
    for (int i = 0; i < tau.cols(); ++i) {
      // A push that makes many rows active, until a foot is released.
      state_.v.segment<3>(3) << 0.005 * i, 0.01 * i, 0;
      Update();
      tau.col(i) = command_.tau;
    }
    return tau;
  };
  const Eigen::MatrixXd first = run();
  EXPECT_EQ(controller_.stance().phase(1), ContactPhase::kFree);
  ASSERT_TRUE(controller_.stance().Lift(1, 0.05));
  state_.v.segment<3>(3) << -0.3, 0.2, 0.1;
  for (int i = 0; i < 20; ++i) Update();
  const Eigen::MatrixXd second = run();
  for (int i = 0; i < first.cols(); ++i) {
    ASSERT_EQ(second.col(i), first.col(i)) << i;
  }
}

TEST_F(ControllerTest, StartSetsReferencesToPresentState) {
  ControllerOptions options;
  options.frames = {"l_hand"};
  Controller controller(robot_, options);
  controller.Start(state_);
  const Reference fresh = controller.reference();
  EXPECT_LT(
      (fresh.frames[0].X_WF.p - controller.tick().frames[2].X_WF.p).norm(),
      1e-15);
  controller.reference().v_WG << 1, 2, 3;
  controller.reference().a_WG << 1, 2, 3;
  controller.reference().posture.setZero();
  FrameReference moving{{ExpSo3({0.1, 0, 0}), {1, 2, 3}}};
  moving.V_WF_W.setOnes();
  moving.A_WF_W.setOnes();
  controller.reference().frames[0] = moving;
  controller.reference().feet.assign(2, moving);
  controller.Start(state_);
  EXPECT_TRUE(controller.reference().v_WG.isZero(0));
  EXPECT_TRUE(controller.reference().a_WG.isZero(0));
  EXPECT_EQ(controller.reference().posture, fresh.posture);
  const auto expect_rest = [](const FrameReference& reference, const Pose& at) {
    EXPECT_EQ(reference.X_WF.R, at.R);
    EXPECT_EQ(reference.X_WF.p, at.p);
    EXPECT_TRUE(reference.V_WF_W.isZero(0));
    EXPECT_TRUE(reference.A_WF_W.isZero(0));
  };
  expect_rest(controller.reference().frames[0], fresh.frames[0].X_WF);
  for (int i = 0; i < 2; ++i) {
    expect_rest(controller.reference().feet[i], controller.contacts()[i].X_WC);
  }
}

TEST_F(ControllerTest, AppliesItsOptions) {
  ControllerOptions options;
  options.feedforward = options.inscribed = options.weighted = true;
  options.friction = 0.3;
  Controller controller(robot_, options);
  const Stack& stack = controller.stack();
  EXPECT_EQ(stack.GetParameter("momentum", "feedforward"), 1);
  EXPECT_EQ(stack.GetParameter("friction", "inscribed"), 1);
  EXPECT_EQ(stack.GetParameter("friction", "mu"), 0.3);
  EXPECT_EQ(stack.GetParameter("yaw", "mu"), 0.3);
  controller.Start(state_);
  Update();
  controller.Update(state_, &command_);
  EXPECT_EQ(controller_.hierarchy().num_levels(), 5);
  EXPECT_EQ(controller.hierarchy().num_levels(), 2);
  // In one weighted QP, each level has a larger weight than the next.
  const auto residual = [&](const char* task) {
    return controller.report().tasks[*stack.Find(task)].residual;
  };
  state_.v.segment<3>(3) << 0, 0.3, 0;
  state_.time += 1e-3;
  controller.Update(state_, &command_);
  EXPECT_LT(residual("contact"), 0.1 * residual("momentum"));
  EXPECT_LT(residual("momentum"), 0.1 * residual("posture"));
}

TEST_F(ControllerTest, LargerPostureWeightIncreasesMomentumResidual) {
  const auto residual = [&](double weight) {
    EXPECT_TRUE(controller_.stack().SetLevel("posture", 4));
    EXPECT_TRUE(controller_.stack().SetWeight("posture", weight));
    state_.v.segment<3>(3) << 0, 0.3, 0;
    Update();
    const int momentum = *controller_.stack().Find("momentum");
    return controller_.report().tasks[momentum].residual;
  };
  const double light = residual(0.01), heavy = residual(100);
  EXPECT_GT(heavy, 1.02 * light);
}

TEST_F(ControllerTest, SolutionHasOptimalCertificate) {
  state_.v.segment<3>(3) << 0.05, 0.1, 0;
  Update();
  // The tolerances of hqp/certificate.h for an optimal solution.
  const Certificate& certificate = controller_.report().certificate;
  EXPECT_LT(certificate.stationarity, 1e-9);
  EXPECT_LT(certificate.feasibility, 1e-9);
  EXPECT_LT(certificate.priority, 1e-9);
}

TEST_F(ControllerTest, ReportsTheGapOfEachPriorityLevel) {
  const std::vector<double>& gap = controller_.report().gap;
  ASSERT_EQ(gap.size(), static_cast<size_t>(Stack::kMaxLevel));
  EXPECT_TRUE(std::isnan(gap[0]));  // No tick was solved yet.
  ASSERT_TRUE(controller_.stack().SetLevel("posture", 7));
  Update();
  // Level 1 is met to rounding, and the gap is at most the cost: the square of
  // residuals that are far below 1e-4.
  EXPECT_LT(gap[0], 1e-9);
  EXPECT_TRUE(std::isfinite(gap[6]));
  EXPECT_TRUE(std::isnan(gap[7]));
  state_.v[0] = std::numeric_limits<double>::quiet_NaN();
  Update();
  EXPECT_TRUE(std::isnan(gap[6]));  // The solver did not run.
}

// Reports a solution whose gaps are 1, 2, ... on the levels of the hierarchy of
// the last tick. Returns TickReport::gap, with 0 for NaN.
std::vector<double> ReportGaps(const Controller& controller) {
  const Stack& stack = controller.stack();
  Solution solution(controller.hierarchy().num_variables(), stack.capacity());
  for (size_t k = 0; k < solution.levels.size(); ++k) {
    solution.levels[k].gap = static_cast<double>(k + 1);
  }
  TickReport report;
  stack.Resize(&report);
  stack.Report(solution, &report);
  for (double& gap : report.gap) gap = std::isnan(gap) ? 0 : gap;
  return report.gap;
}

// Two tasks share priority level 6, no task is on levels 4, 5 and 7.
TEST_F(ControllerTest, ReportsGapsAtTheirPriorityLevels) {
  using Gaps = std::vector<double>;
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.SetLevel("momentum", 6));
  ASSERT_TRUE(stack.SetLevel("posture", 6));
  ASSERT_TRUE(stack.SetWeight("posture", 0.1));
  ASSERT_TRUE(stack.SetLevel("force_regularizer", 8));
  state_.v[3] = 0.1;
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  EXPECT_EQ(ReportGaps(controller_), (Gaps{1, 2, 3, 0, 0, 4, 0, 5}));
  for (int i : {0, 1, 2, 5, 7}) {
    EXPECT_TRUE(std::isfinite(controller_.report().gap[i])) << i;
  }
  ASSERT_TRUE(stack.set_weighted(true));
  Update();
  EXPECT_EQ(ReportGaps(controller_), (Gaps{1, 2, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(std::isnan(controller_.report().gap[5]));
  // Without rows on level 2, the weighted QP counts as level 3.
  ASSERT_TRUE(stack.SetLevel("torque_limits", 3));
  ASSERT_TRUE(stack.SetLevel("joint_limits", 3));
  Update();
  EXPECT_EQ(ReportGaps(controller_), (Gaps{1, 0, 2, 0, 0, 0, 0, 0}));
}

TEST_F(ControllerTest, MeetsDynamicsInWeightedQp) {
  ControllerOptions options;
  options.weighted = true;
  Controller weighted(robot_, options);
  weighted.Start(state_);
  state_.time = 1e-3;
  weighted.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kOk);
  const int newton_euler = *weighted.stack().Find("newton_euler");
  EXPECT_LT(weighted.report().tasks[newton_euler].residual, 1e-9);
}

TEST_F(ControllerTest, LinkFollowsItsReference) {
  ControllerOptions options;
  options.frames = {"l_hand"};
  Controller controller(robot_, options);
  controller.Start(state_);
  ASSERT_TRUE(controller.stack().Enable("frame.l_hand", true));
  state_.time = 1e-3;
  controller.Update(state_, &command_);
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const auto acceleration = [&]() -> Eigen::VectorXd {
    const FrameTick& hand = controller.tick().frames[2];
    return hand.J_WF_W * controller.report().y.head(tree().nv()) + hand.Jdot_v;
  };
  // The link is at its reference from Start(), so it does not accelerate.
  EXPECT_LT(acceleration().norm(), 1e-6);
  const double kp = *controller.stack().GetParameter("frame.l_hand", "kp");
  controller.reference().frames[0].X_WF.p.z() += 0.01;
  state_.time = 2e-3;
  controller.Update(state_, &command_);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(6);
  up[5] = kp * 0.01;
  EXPECT_LT((acceleration() - up).norm(), 1e-6);
}

TEST_F(ControllerTest, KeepsMimicCoupling) {
  const int joint = *tree().FindJoint("neck_yaw");
  const int source = *tree().FindJoint("chest_yaw");
  robot_.model.mimics = {{joint, source, -2, 0.1}};
  Controller controller(robot_);
  controller.Start(state_);
  ASSERT_TRUE(controller.stack().Find("mimic").has_value());
  state_.v[6 + source] = 0.2;
  state_.time = 1e-3;
  controller.Update(state_, &command_);
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const double kp = *controller.stack().GetParameter("mimic", "kp");
  const double kd = *controller.stack().GetParameter("mimic", "kd");
  const Eigen::VectorXd& y = controller.report().y;
  // The position error of the joint is 0.1 rad, the velocity error -0.4 rad/s.
  EXPECT_NEAR(y[6 + joint] + 2 * y[6 + source], 0.1 * kp - 0.4 * kd, 1e-6);
}

TEST_F(ControllerTest, RejectsInvalidOptionsAndRobots) {
  const auto message = [&](const ControllerOptions& options) -> std::string {
    try {
      const Controller controller(robot_, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  ControllerOptions options;
  options.dt = 0;
  EXPECT_EQ(message(options),
            "control period is 0.000000 s, must be above 0 and below 1");
  options.dt = 1;
  EXPECT_EQ(message(options),
            "control period is 1.000000 s, must be above 0 and below 1");
  options = {};
  options.max_modelled_seconds = -1e-3;
  EXPECT_EQ(message(options),
            "max_modelled_seconds is -0.001 s, must be 0 or more");
  options = {};
  options.max_seconds = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(options), "max_seconds is nan s, must be 0 or more");
  options = {};
  options.friction = -0.1;
  EXPECT_EQ(message(options), "friction is -0.100000, must be 0 to 10");
  options = {};
  options.max_iterations = 0;
  EXPECT_EQ(message(options), "max_iterations is 0, must be positive");
  options = {};
  options.frames = {"tail"};
  EXPECT_EQ(message(options),
            "frame 'tail': robot 'humanoid' has no such link");
  robot_.q_nominal.conservativeResize(tree().nq() - 1);
  EXPECT_EQ(message({}).find("robot 'humanoid': nominal posture has size"), 0u);
  robot_.feet.clear();
  EXPECT_EQ(message({}),
            "robot 'humanoid': has no foot, must have one or more");
}

// An effort of 0 means: no motor. The torque of this joint is 0, and its limits
// are not enforced, or the whole robot would be used to enforce them.
TEST_F(ControllerTest, SendsNoTorqueToJointWithoutMotor) {
  const int j = *tree().FindJoint("l_elbow");
  robot_.model.limits[j].effort = 0;
  for (const double beyond : {-0.3, 0.2}) {
    state_.q[7 + j] = robot_.model.limits[j].upper + beyond;
    Controller controller(robot_);
    controller.Start(state_);
    controller.Update(state_, &command_);
    EXPECT_EQ(command_.status, TickStatus::kOk) << beyond;
    EXPECT_EQ(command_.tau[j], 0);
    Eigen::VectorXd tau(tree().num_joints());
    ComputeTorque(controller.tick(), controller.contacts(),
                  controller.report().y, &tau);
    EXPECT_NEAR(tau[j], 0, 1e-9);  // In the solution too, before the clamp.
    for (const ActiveRow& row : controller.report().active) {
      EXPECT_NE(controller.stack().RowName(row).substr(0, 13), "joint.l_elbow");
    }
  }
}

TEST_F(ControllerTest, SwitchesTaskByName) {
  EXPECT_FALSE(controller_.stack().Enable("posturing", false));
  ASSERT_TRUE(controller_.stack().Enable("posture", false));
  Update();
  const int posture = *controller_.stack().Find("posture");
  EXPECT_FALSE(controller_.report().tasks[posture].enabled);
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

}  // namespace
}  // namespace poise
