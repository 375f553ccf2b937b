// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/controller.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/integrate.h"
#include "math/so3.h"
#include "robot/control/conflict.h"
#include "robot/control/default_stack.h"
#include "robot/control/fail_safe.h"
#include "robot/control/task_set.h"
#include "robot/profile.h"
#include "tests/util/count_malloc.h"
#include "tests/util/decompositions.h"

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

Robot Humanoid() {
  return LoadRobot("robot/models/humanoid.urdf",
                   LoadProfile("robot/profiles/humanoid.yaml"));
}

// A robot whose feet are bolted to the floor: for v̇ and the floor's wrenches,
//     [ M  -J' ] [ v̇      ]   [ S' tau - N + f ]
//     [ J   0  ] [ lambda ] = [ -J̇ v           ].
// It knows nothing of how the controller found its torques.
class BoltedDown {
 public:
  explicit BoltedDown(const Controller& controller)
      : controller_(controller), tree_(controller.robot().model.tree) {}

  Eigen::VectorXd Solve(const Eigen::VectorXd& tau,
                        const Eigen::VectorXd& f) const {
    const Tick& tick = controller_.tick();
    const int nv = tree_.nv();
    const int feet = static_cast<int>(controller_.contacts().size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(nv + 6 * feet, nv + 6 * feet);
    Eigen::VectorXd k(nv + 6 * feet);
    K.topLeftCorner(nv, nv) = tick.M;
    k.head(nv) = f - tick.N;
    k.segment(tree_.v_start(), tree_.num_joints()) += tau;
    for (int i = 0; i < feet; ++i) {
      const ContactTick& contact = controller_.contacts()[i];
      K.block(0, nv + 6 * i, nv, 6) = -contact.J_WC_C.transpose();
      K.block(nv + 6 * i, 0, 6, nv) = contact.J_WC_C;
      k.segment<6>(nv + 6 * i) = -contact.Jdot_v_C;
    }
    return LeastSquaresSolution(K, k).x;
  }

 private:
  const Controller& controller_;
  const Tree& tree_;
};

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

  void ExpectInsideLimits() const {
    for (int j = 0; j < tree().num_joints(); ++j) {
      EXPECT_LE(std::abs(command_.tau[j]), robot_.model.limits[j].effort)
          << tree().joints()[j].name;
    }
  }

  Robot robot_ = Humanoid();
  Controller controller_{robot_};
  State state_;
  Command command_;
};

TEST_F(ControllerTest, ItsTorquesBringWhatItsSolutionSays) {
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
  // Newtons, of 380 that the robot weighs.
  EXPECT_LT(residual.norm(), 1e-9);
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
  // 1 N s on 38.6 kg is 26 mm/s: some millimeters away, and back again.
  EXPECT_GT(largest_error, 1e-3);
  EXPECT_LT(largest_error, 1e-2);
  EXPECT_LT((controller_.tick().p_WG - controller_.reference().p_WG).norm(),
            2e-3);
}

// What acts on an elbow that is near its stop, rad/s2, and how far it then gets,
// rad beyond the stop; the rest does what the solution says.
class PushedElbow : public ControllerTest {
 protected:
  PushedElbow() {
    state_.q[7 + elbow_] = stop_ - 0.02;
    controller_.reference().posture[elbow_] = stop_ + 0.1;
  }

  double Run(double push, double seconds) {
    double farthest = -1;
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) {
      Update();
      EXPECT_NE(command_.status, TickStatus::kFailSafe);
      state_.v += 1e-3 * controller_.report().y.head(tree().nv());
      state_.v[6 + elbow_] += 1e-3 * push;
      Integrate(tree(), state_.q, state_.v, 1e-3, state_.q);
      farthest = std::max(farthest, state_.q[7 + elbow_] - stop_);
    }
    return farthest;
  }

  const int elbow_ = *tree().FindJoint("l_elbow");
  const double stop_ = robot_.model.limits[elbow_].upper;
};

TEST_F(PushedElbow, StopsShortOfItsStop) {
  EXPECT_LT(Run(30, 1), -1e-3);
  // Where it would be without a push: a margin from the stop.
  EXPECT_NEAR(state_.q[7 + elbow_], stop_ - 0.008, 1e-4);
}

TEST_F(PushedElbow, IsHeldNoLongerThanThePush) {
  (void)Run(-30, 0.3);
  (void)Run(0, 1);
  EXPECT_NEAR(state_.q[7 + elbow_], stop_ - 0.008, 1e-4);
}

TEST_F(PushedElbow, ForgetsWhereItStartsAnew) {
  (void)Run(30, 0.3);
  const State pushed = state_;
  controller_.Start(pushed);
  controller_.reference().posture[elbow_] = stop_ + 0.1;
  Update();
  const Eigen::VectorXd y = controller_.report().y;
  Controller other(robot_);
  other.Start(pushed);
  other.reference().posture[elbow_] = stop_ + 0.1;
  other.Update(state_, &command_);
  EXPECT_LT((other.report().y - y).norm(), 1e-9 * y.norm());
}

TEST_F(PushedElbow, LearnsNothingFromAClockThatStandsStill) {
  (void)Run(30, 0.3);
  const auto bound = [this] {
    return controller_.report().y[6 + elbow_] +
           40 * 40 * (state_.q[7 + elbow_] - stop_ + 0.008) +
           80 * state_.v[6 + elbow_];
  };
  const double before = bound();
  EXPECT_NEAR(before, -30, 0.1);
  for (int i = 0; i < 5; ++i) controller_.Update(state_, &command_);
  EXPECT_NEAR(bound(), before, 0.1);
  state_.v[6 + elbow_] -= 0.01;  // While it was not looked at.
  Update();
  EXPECT_NEAR(bound(), before, 0.1);
}

TEST_F(ControllerTest, FailsSafeOnANumberThatIsNone) {
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (double* entry : {&state_.q[10], &state_.v[20], &state_.v[0]}) {
      const double good = *entry;
      *entry = bad;
      Update();
      EXPECT_EQ(command_.status, TickStatus::kFailSafe);
      EXPECT_TRUE(command_.tau.allFinite());
      ExpectInsideLimits();
      *entry = good;
    }
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(ControllerTest, FailSafeHoldsTheRobotAgainstGravity) {
  Update();
  state_.q[10] = std::numeric_limits<double>::quiet_NaN();
  Update();
  const Eigen::VectorXd rest =
      BoltedDown(controller_)
          .Solve(command_.tau, Eigen::VectorXd::Zero(tree().nv()));
  // m/s2 and rad/s2: what is left is rounding, by the light fingers' inertia.
  EXPECT_LT(rest.head(tree().nv()).norm(), 1e-5);
}

// In motion: gravity's part alone is held, and the joints are braked by what
// they move; whatever was active is forgotten.
TEST_F(ControllerTest, FailSafeBrakesEachJoint) {
  Update();
  const double q = state_.q[10];
  const auto fail_safe = [&] {
    state_.q[10] = std::numeric_limits<double>::quiet_NaN();
    Update();
    state_.q[10] = q;
    EXPECT_EQ(command_.status, TickStatus::kFailSafe);
    EXPECT_TRUE(controller_.report().active.empty());
    return command_.tau;
  };
  const Eigen::VectorXd at_rest = fail_safe();
  const int n = tree().num_joints();
  for (int j = 0; j < n; ++j) state_.v[6 + j] = 0.02 * (j % 5 - 2);
  state_.v.head<3>() << 0.3, -0.4, 0.2;
  Update();
  const Eigen::VectorXd braked = fail_safe();
  for (int j = 0; j < n; ++j) {
    const double M = controller_.tick().M(6 + j, 6 + j);
    EXPECT_NEAR(braked[j], at_rest[j] - 10 * M * state_.v[6 + j], 1e-9) << j;
  }
}

TEST_F(ControllerTest, FailSafeStandsOnTheFootThatIsDown) {
  Update();
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[1].in_contact = false;
  const int n = tree().num_joints();
  const Tick& tick = controller_.tick();
  Eigen::VectorXd tau(n);
  ComputeFailSafeTorque(tick, contacts, Eigen::VectorXd::Zero(n), 10, &tau);
  // The leg in the air bears itself: gravity's torques, and no others.
  int joints = 0;
  for (int j = 0; j < n; ++j) {
    if (contacts[1].J_WC_C.col(6 + j).norm() < 1e-9) continue;
    EXPECT_NEAR(tau[j], tick.N[6 + j], 1e-9);
    ++joints;
  }
  EXPECT_EQ(joints, 6);
  // A joint whose speed is unknown is not braked.
  Eigen::VectorXd v = Eigen::VectorXd::Constant(n, 0.1);
  v[3] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd braked(n);
  ComputeFailSafeTorque(tick, contacts, v, 10, &braked);
  EXPECT_EQ(braked[3], tau[3]);
  EXPECT_NEAR(braked[4], tau[4] - tick.M(10, 10), 1e-9);
}

TEST_F(ControllerTest, FailsSafeWhileTheClockOfTheStateStandsStill) {
  Update();
  for (int i = 1; i <= 20; ++i) {
    controller_.Update(state_, &command_);
    EXPECT_EQ(command_.status == TickStatus::kFailSafe, i > 10) << i << " ms";
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(ControllerTest, FailsSafeWhereTheDynamicsWouldOverflow) {
  Update();
  state_.v.setConstant(1e200);
  Update();
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  EXPECT_TRUE(command_.tau.allFinite());
  ExpectInsideLimits();
}

TEST_F(ControllerTest, TruncatesWhereItsBudgetIsSpent) {
  ControllerOptions options;
  options.max_iterations = 1;
  Controller hasty(robot_, options);
  hasty.Start(state_);
  // A shove: rows come into play that were not so before.
  state_.v.segment<3>(3) << 0, 0.6, 0;
  state_.time = 1e-3;
  hasty.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kTruncated);
  EXPECT_GT(hasty.report().failed_rank, 1);
  ExpectInsideLimits();
  const int newton_euler = *hasty.stack().Find("newton_euler");
  EXPECT_LT(hasty.report().tasks[newton_euler].residual, 1e-9);
}

// A clock of the test's own, on which each look takes 0.4 ms: time for two
// factorisations.
TEST_F(ControllerTest, StopsWhereItsTimeIsSpent) {
  double seconds = 0;
  ControllerOptions options;
  options.max_seconds = 1e-3;
  options.now = [&seconds] { return seconds += 0.4e-3; };
  Controller hasty(robot_, options);
  hasty.Start(state_);
  state_.v.segment<3>(3) << 0, 0.6, 0;
  state_.time = 1e-3;
  hasty.Update(state_, &command_);
  EXPECT_TRUE(command_.status == TickStatus::kTruncated ||
              command_.status == TickStatus::kFailSafe);
  EXPECT_LE(hasty.report().iterations, 2);
  EXPECT_TRUE(command_.tau.allFinite());
  ExpectInsideLimits();
}

TEST_F(ControllerTest, FailsSafeWhereNotEvenTheFirstRankIsSolved) {
  double seconds = 0;
  ControllerOptions options;
  options.max_seconds = 1e-3;
  options.now = [&seconds] { return seconds += 1; };
  Controller late(robot_, options);
  late.Start(state_);
  state_.time = 1e-3;
  late.Update(state_, &command_);
  EXPECT_EQ(late.report().failed_rank, 1);
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  ExpectInsideLimits();
}

// All joints run into their stops: torques give way too, each named with the end
// that it is at.
TEST_F(ControllerTest, SaysThatATorqueLimitCannotBeMet) {
  constexpr double kEffort = 0.01;  // N m.
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = kEffort;
  }
  const auto slack = [&](const std::function<void(Stack*)>& change) {
    Controller weak(robot_);
    weak.Start(state_);
    change(&weak.stack());
    state_.time += 1e-3;
    weak.Update(state_, &command_);
    EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
    int named = 0;
    for (const ActiveRow& row : weak.report().active) {
      const std::string name = weak.stack().RowName(row);
      if (name.rfind("torque.", 0) != 0 || row.slack < 1e-3) continue;
      EXPECT_EQ(name, "torque." + tree().joints()[row.row].name +
                          (command_.tau[row.row] > 0 ? ".max" : ".min"));
      ++named;
    }
    const int limits = *weak.stack().Find("torque_limits");
    EXPECT_EQ(named > 0, weak.report().tasks[limits].slack > 1e-3);
    return weak.report().tasks[limits].slack;
  };
  const double plain = slack([](Stack*) {});
  EXPECT_GT(plain, 1e-3);
  // Where a whole rank weighs more it is all the same, and in the same unit.
  const double heavy = slack([](Stack* stack) {
    EXPECT_TRUE(stack->SetWeight("torque_limits", 4));
    EXPECT_TRUE(stack->SetWeight("joint_limits", 4));
  });
  EXPECT_NEAR(heavy, plain, 1e-6 * plain);
  // Without the rows, what the motors cannot give is cut off, and said.
  EXPECT_EQ(slack([](Stack* stack) {
              EXPECT_TRUE(stack->Enable("torque_limits", false));
              EXPECT_TRUE(stack->Enable("joint_limits", false));
              EXPECT_TRUE(stack->SetParameter("torque_limits", "scale", 0.5));
            }),
            0);
  EXPECT_NEAR(command_.tau.cwiseAbs().maxCoeff(), 0.5 * kEffort, 1e-15);
}

// Torques hold, as they are above: a joint passes its limit, and it is said.
TEST_F(ControllerTest, SaysThatAJointLimitCannotBeMet) {
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = 20;
  }
  Controller weak(robot_);
  weak.Start(state_);
  ASSERT_TRUE(weak.stack().SetRank("joint_limits", 3));
  state_.time = 1e-3;
  weak.Update(state_, &command_);
  EXPECT_LT(weak.report().tasks[*weak.stack().Find("torque_limits")].slack,
            1e-9);
  EXPECT_GT(weak.report().tasks[*weak.stack().Find("joint_limits")].slack,
            1e-3);
  EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
}

// The center of mass is to go to the left faster than the feet allow.
TEST_F(ControllerTest, SaysWhatGaveWayAndToWhat) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "capture", 0));
  controller_.reference().p_WG.y() += 0.2;
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const Tick& tick = controller_.tick();
  const double mass = tree().total_mass();
  const double got =
      (tick.H_G.row(4).dot(controller_.report().y.head(tree().nv())) +
       tick.H_G_bias[4]) /
      mass;
  const int momentum = *controller_.stack().Find("momentum");
  double lost = 0;
  for (const LostRow& row : controller_.report().lost) {
    if (row.task == momentum && row.row == 4) lost = row.amount;
  }
  // In N, of the 0.2 m times kp.
  EXPECT_NEAR(lost, mass * (got - 30 * 0.2), 1e-6);
  EXPECT_LT(lost, -10);
  bool is_at_its_edge = false;
  for (const ActiveRow& row : controller_.report().active) {
    if (controller_.stack().RowName(row) != "right_foot.cop.y_min") continue;
    is_at_its_edge = row.pressing_rank == 4 && row.multiplier > 0.01 &&
                     row.side == Side::kUpper && row.slack < 1e-9;
  }
  EXPECT_TRUE(is_at_its_edge);
}

// All joints run into their stops, with motors too weak to hold them.
TEST_F(ControllerTest, NamesALimitThatCannotBeMetAndWhatItContradicts) {
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = 0.01;
  }
  Controller weak(robot_);
  weak.Start(state_);
  state_.time = 1e-3;
  weak.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
  bool is_named = false;
  for (const ActiveRow& row : weak.report().active) {
    is_named |=
        row.slack > 1e-3 && weak.stack().RowName(row).rfind("joint.", 0) == 0;
  }
  EXPECT_TRUE(is_named);

  // Rank 2 is the second level: what it contradicts is of rank 2 or 1.
  int joints = 0, torques = 0;
  for (const HierarchyRow& row : FindConflict(weak.hierarchy(), 1)) {
    const std::string name =
        weak.stack().RowName(row.level, row.row, row.equality);
    joints += name.rfind("joint.", 0) == 0;
    torques += name.rfind("torque.", 0) == 0;
  }
  EXPECT_GT(joints, 0);
  EXPECT_GT(torques, 0);
  EXPECT_LT(joints + torques, 2 * tree().num_joints());
}

TEST_F(ControllerTest, NamesTheRowsOfAContradiction) {
  // x <= -1 and x >= 1; y <= 5 has no part in it.
  Hierarchy hierarchy(2, {{1, 3}});
  hierarchy.Clear(1);
  InequalityBlock rows = hierarchy.AddInequalities(0, 3);
  rows.C << 1, 0, 1, 0, 0, 1;
  rows.upper[0] = -1;
  rows.lower[1] = 1;
  rows.upper[2] = 5;
  const std::vector<HierarchyRow> conflict = FindConflict(hierarchy, 0);
  ASSERT_EQ(conflict.size(), 2u);
  EXPECT_EQ(conflict[0].row, 0);
  EXPECT_EQ(conflict[1].row, 1);
}

TEST_F(ControllerTest, FindsNoConflictWhereThereIsNone) {
  Update();
  EXPECT_TRUE(FindConflict(controller_.hierarchy(), 2).empty());
}

TEST_F(ControllerTest, SeesThatAFootHasLostTheGround) {
  Update();
  ASSERT_EQ(controller_.stance().phase(0), ContactPhase::kDown);
  const double ground = controller_.reference().ground_z;
  controller_.reference().ground_z = ground - 0.03;
  Update();
  EXPECT_EQ(controller_.stance().phase(0), ContactPhase::kLost);
  EXPECT_FALSE(controller_.contacts()[0].in_contact);
  EXPECT_NE(command_.status, TickStatus::kFailSafe);
  EXPECT_LT(controller_.report().foot_wrench(tree().nv(), 0).norm(), 1e-9);
  controller_.reference().ground_z = ground;
  Update();
  EXPECT_EQ(controller_.stance().phase(0), ContactPhase::kLoading);
}

// Falling to the left, or to the right: the other foot, which bears nothing, is
// let go. It comes back when the robot is slow and faces where it should, or
// falls to its side; on the ground it is at once, as it never left it.
TEST_F(ControllerTest, LetsTheFootGoThatAFallUnloads) {
  for (const int side : {1, -1}) {
    const int away = side > 0 ? 1 : 0;
    const auto phase_at = [&](double speed, double yaw) {
      state_.v[4] = speed * side;
      state_.q.segment<4>(3) << 0, 0, std::sin(yaw / 2), std::cos(yaw / 2);
      Update();
      return controller_.stance().phase(away);
    };
    controller_.Start(state_);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_LT(controller_.report().foot_wrench(tree().nv(), away)[5], 1);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_EQ(phase_at(0.6, 0), ContactPhase::kFree);
    EXPECT_EQ(controller_.stance().phase(1 - away), ContactPhase::kDown);
    EXPECT_FALSE(controller_.contacts()[away].in_contact);
    EXPECT_LT(controller_.report().foot_wrench(tree().nv(), away).norm(), 1e-9);
    EXPECT_EQ(command_.status, TickStatus::kOk);
    const int swing =
        *controller_.stack().Find("frame." + robot_.feet[away].name);
    EXPECT_EQ(controller_.report().tasks[swing].residual, 0);

    EXPECT_EQ(phase_at(0.35, 0), ContactPhase::kFree);
    EXPECT_EQ(phase_at(0.25, 0.45), ContactPhase::kFree);
    EXPECT_EQ(phase_at(0.25, 0), ContactPhase::kLoading);

    controller_.Start(state_);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_EQ(phase_at(0.6, 0), ContactPhase::kFree);
    EXPECT_EQ(phase_at(-0.4, 0), ContactPhase::kLoading);
    state_.v.setZero();
  }
}

TEST_F(ControllerTest, LetsNoFootGoWithoutCapture) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "capture", 0));
  state_.v[4] = 0.6;
  for (int i = 0; i < 3; ++i) Update();
  EXPECT_EQ(controller_.stance().phase(1), ContactPhase::kDown);
}

TEST_F(ControllerTest, FadesAForceOutBeforeAFootIsLifted) {
  Update();
  controller_.stance().Lift(1, 0.05);
  double last = std::numeric_limits<double>::infinity();
  while (controller_.stance().phase(1) != ContactPhase::kUp) {
    Update();
    const double limit = controller_.contacts()[1].max_normal_force;
    if (controller_.stance().phase(1) == ContactPhase::kUnloading) {
      EXPECT_LT(limit, last);
      last = limit;
    }
    ASSERT_LT(state_.time, 1);
  }
  EXPECT_LT(controller_.report().foot_wrench(tree().nv(), 1).norm(), 1e-9);
}

TEST_F(ControllerTest, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  Update();
  controller_.stance().Lift(0, 0.05);
  state_.v.segment<3>(3) << 0.1, 0.3, 0;
  ASSERT_TRUE(controller_.stack().set_ramp(0.004));
  CountMalloc count;
  for (int i = 0; i < 1000; ++i) {
    state_.v[3] = 1e-3 * i;
    state_.q[20] = i % 100 == 99 ? std::numeric_limits<double>::quiet_NaN() : 0;
    (void)controller_.stack().Enable("zmp", i % 7 == 0);
    (void)controller_.stack().SetRank("posture", 5 + i % 2);
    (void)controller_.stack().SetWeight("momentum", 1 + i % 3);
    (void)controller_.stack().SetParameter("posture", "kp", 60 + i % 5);
    Update();
  }
  EXPECT_EQ(count.allocations(), 0);
}

TEST_F(ControllerTest, SaysTheSameTwiceToTheBit) {
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

// The controller as a function, at work: joints moving, feet not flat, pushed so
// hard that the robot is captured and a foot let go.
class InvarianceTest : public ControllerTest {
 protected:
  InvarianceTest() {
    for (int j = 0; j < tree().num_joints(); ++j) {
      state_.q[7 + j] += 0.01 * std::sin(1.3 * j);
      state_.v[6 + j] = 0.1 * std::sin(1.7 * j);
    }
    state_.v.head<6>() << 0.1, -0.05, 0.02, 0.2, 0.6, 0;
  }

  // A few ticks in one state: what came before matters too.
  Command Answer(const State& state) {
    Controller controller(robot_);
    EXPECT_TRUE(controller.stack().Enable("capture_point", with_boxes_));
    EXPECT_TRUE(controller.stack().Enable("zmp", with_boxes_));
    State now = state;
    controller.Start(now);
    Command command;
    command.tau.setZero(tree().num_joints());
    for (int i = 1; i <= 5; ++i) {
      now.time = 1e-3 * i;
      controller.Update(now, &command);
      EXPECT_EQ(command.status, TickStatus::kOk);
    }
    let_go_ = 0;
    for (const int foot : {0, 1}) {
      let_go_ += controller.stance().phase(foot) == ContactPhase::kFree;
    }
    return command;
  }

  bool with_boxes_ = true;
  int let_go_ = 0;
  const double kSame = 1e-9;  // Of the torques.
};

TEST_F(InvarianceTest, TurnedAndMovedInputGivesTheSameTorques) {
  const Eigen::VectorXd tau = Answer(state_).tau;
  for (const double turn : {0.5, kPi / 2, 3.0}) {
    SCOPED_TRACE(turn);
    const Eigen::Matrix3d R = ExpSo3(Eigen::Vector3d(0, 0, turn));
    State moved = state_;
    const Eigen::Vector3d p(20, -30, 3);
    moved.q.head<3>() = p + R * state_.q.head<3>();
    const Eigen::Quaterniond q_WB(state_.q[6], state_.q[3], state_.q[4],
                                  state_.q[5]);
    moved.q.segment<4>(3) =
        Eigen::Quaterniond(R * q_WB.toRotationMatrix()).coeffs();
    moved.v.segment<3>(0) = R * state_.v.segment<3>(0);
    moved.v.segment<3>(3) = R * state_.v.segment<3>(3);
    EXPECT_LT((Answer(moved).tau - tau).norm(), kSame * tau.norm());
    moved.q[0] += 1000;  // There places are known to 1e-13 m, a thousandth.
    EXPECT_LT((Answer(moved).tau - tau).norm(), 100 * kSame * tau.norm());
  }
}

TEST_F(InvarianceTest, MirroredInputGivesMirroredTorques) {
  const int n = tree().num_joints();
  State mirrored = state_;
  mirrored.q[1] *= -1;
  mirrored.q[3] *= -1;
  mirrored.q[5] *= -1;
  for (const int i : {0, 2, 4}) mirrored.v[i] *= -1;
  std::vector<int> twin(n);
  Eigen::VectorXd sign(n);
  for (int j = 0; j < n; ++j) {
    const Joint& joint = tree().joints()[j];
    std::string name = joint.name;
    if (name[1] == '_') name[0] = name[0] == 'l' ? 'r' : 'l';
    twin[j] = *tree().FindJoint(name);
    // A mirror turns the axes of roll and yaw over, not that of pitch.
    sign[j] = std::abs(joint.axis_F.y()) > 0.5 ? 1 : -1;
    mirrored.q[7 + twin[j]] = sign[j] * state_.q[7 + j];
    mirrored.v[6 + twin[j]] = sign[j] * state_.v[6 + j];
  }
  for (const bool with_boxes : {true, false}) {
    with_boxes_ = with_boxes;
    const Eigen::VectorXd tau = Answer(state_).tau;
    const Eigen::VectorXd answer = Answer(mirrored).tau;
    EXPECT_EQ(let_go_, with_boxes ? 0 : 1);
    for (int j = 0; j < n; ++j) {
      EXPECT_NEAR(answer[twin[j]], sign[j] * tau[j], kSame * tau.norm())
          << tree().joints()[j].name;
    }
  }
}

// What is wrong with the model, as the controller has found it: what it asks of
// the center of mass beyond its gains.
class CorrectionTest : public ControllerTest {
 protected:
  Eigen::Vector3d Correction() {
    const Tick& tick = controller_.tick();
    const Eigen::Vector3d a_W =
        (tick.H_G.bottomRows<3>() * controller_.report().y.head(tree().nv()) +
         tick.H_G_bias.tail<3>()) /
        tree().total_mass();
    return a_W - 30 * (controller_.reference().p_WG - tick.p_WG) +
           10 * tick.v_WG;
  }

  // How much of it comes in so many ticks.
  Eigen::Vector3d Gained(int ticks) {
    Update();
    const Eigen::Vector3d before = Correction();
    for (int i = 0; i < ticks; ++i) Update();
    return Correction() - before;
  }

  void ExpectGains(const Eigen::Vector3d& a_second) {
    EXPECT_LT((Gained(20) - 0.02 * a_second).norm(), 1e-7);
  }
};

TEST_F(CorrectionTest, FindsWhatTheGainsDoNotExplain) {
  controller_.reference().p_WG += Eigen::Vector3d(0.004, -0.003, 0.005);
  const double kx = 15 * 0.004, ky = -15 * 0.003, kz = 60 * 0.005;
  ExpectGains({kx, ky, kz});
  controller_.reference().v_WG.x() = 0.01;  // The plane waits: a lag is none.
  ExpectGains({0, 0, kz});
  controller_.reference().v_WG.setZero();
  state_.v.segment<3>(3) << 0.03, 0, 0;  // Or as the robot moves.
  ExpectGains({0, 0, kz});
  // On its way back as its gains have it: kd v = kp e.
  state_.v.segment<3>(3) << 0, 0, 3 * 0.005;
  ExpectGains({kx, ky, 0});
  state_.v.setZero();
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki", 0));
  Update();
  Update();
  EXPECT_LT(Correction().head<2>().norm(), 1e-7);
  EXPECT_GT(Correction().z(), 0.015);
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki_height", 0));
  Update();
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

TEST_F(CorrectionTest, WaitsWhileTheMomentumCannotFollow) {
  controller_.reference().p_WG += Eigen::Vector3d(0, 0.5, 0.01);
  for (int i = 0; i < 5; ++i) Update();
  controller_.reference().p_WG -= Eigen::Vector3d(0, 0.5, 0.01);
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

TEST_F(CorrectionTest, IsBoundedAndForgottenWithItsTask) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki", 100));
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki_height", 100));
  for (const double side : {1.0, -1.0}) {
    controller_.Start(state_);
    const Eigen::Vector3d e = side * Eigen::Vector3d(0.012, 0.016, 0.03);
    controller_.reference().p_WG += e;
    Update();
    EXPECT_LT(Correction().norm(), 1e-7);  // Start() forgets it.
    Gained(600);
    EXPECT_LT(
        (Correction().head<2>() - side * Eigen::Vector2d(0.3, 0.4)).norm(),
        1e-6);
    EXPECT_NEAR(Correction().z(), side * 1.6, 1e-6);
  }
  ASSERT_TRUE(controller_.stack().Enable("momentum", false));
  Update();
  ASSERT_TRUE(controller_.stack().Enable("momentum", true));
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

TEST_F(ControllerTest, StartsFromWhereItIs) {
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
  controller.Start(state_);
  EXPECT_TRUE(controller.reference().v_WG.isZero(0));
  EXPECT_TRUE(controller.reference().a_WG.isZero(0));
  EXPECT_EQ(controller.reference().posture, fresh.posture);
}

TEST_F(ControllerTest, DoesAsItsOptionsSay) {
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
  // Of the ranks in one QP, each weighs more than the next.
  const auto residual = [&](const char* task) {
    return controller.report().tasks[*stack.Find(task)].residual;
  };
  state_.v.segment<3>(3) << 0, 0.3, 0;
  state_.time += 1e-3;
  controller.Update(state_, &command_);
  EXPECT_LT(residual("contact"), 0.1 * residual("momentum"));
  EXPECT_LT(residual("momentum"), 0.1 * residual("posture"));
}

TEST_F(ControllerTest, GivesMoreToWhatWeighsMoreInOneRank) {
  const auto residual = [&](double weight) {
    EXPECT_TRUE(controller_.stack().SetRank("posture", 4));
    EXPECT_TRUE(controller_.stack().SetWeight("posture", weight));
    state_.v.segment<3>(3) << 0, 0.3, 0;
    Update();
    const int momentum = *controller_.stack().Find("momentum");
    return controller_.report().tasks[momentum].residual;
  };
  const double light = residual(0.01), heavy = residual(100);
  EXPECT_GT(heavy, 1.02 * light);
}

TEST_F(ControllerTest, IsCertified) {
  state_.v.segment<3>(3) << 0.05, 0.1, 0;
  Update();
  // What hqp/certificate.h asks of an optimal answer.
  const Certificate& certificate = controller_.report().certificate;
  EXPECT_LT(certificate.stationarity, 1e-9);
  EXPECT_LT(certificate.feasibility, 1e-9);
  EXPECT_LT(certificate.priority, 1e-9);
}

TEST_F(ControllerTest, MeetsTheDynamicsAsOneWeightedQpToo) {
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

TEST(TaskSet, RefusesWhatIsNotThereByLine) {
  Stack stack = MakeDefaultStack(Humanoid(), {});
  const auto message = [&](const char* yaml) -> std::string {
    try {
      ApplyTasks(YAML::Load(yaml), "x.yaml", &stack);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("yaw: off\ncop: {margin: 0.01, rank: 4}"), "");
  EXPECT_FALSE(stack.settings(*stack.Find("yaw")).enabled);
  EXPECT_EQ(stack.settings(*stack.Find("cop")).rank, 4);
  EXPECT_EQ(*stack.GetParameter("cop", "margin"), 0.01);
  EXPECT_EQ(message("yaw: off\nposturing: {kp: 1}").substr(0, 32),
            "x.yaml:2: task 'posturing' is un");
  EXPECT_EQ(message("cop: {kp: 1}").substr(0, 34),
            "x.yaml:1: task 'cop' has no 'kp', ");
  EXPECT_EQ(message("cop:\n  rank: 9"),
            "x.yaml:2: task 'cop': 'rank' is '9', must be 1 to 8");
  EXPECT_EQ(message("cop: {margin: -1}"),
            "x.yaml:1: task 'cop': 'margin' is '-1', which is out of its "
            "range");
}

TEST(TaskSet, KnowsThatOfThePaper) {
  Stack stack = MakeDefaultStack(Humanoid(), {});
  ApplyTaskSet("paper", &stack);
  EXPECT_FALSE(stack.settings(*stack.Find("joint_limits")).enabled);
  EXPECT_EQ(stack.GetParameter("momentum", "capture"), 0);
  EXPECT_EQ(stack.settings(*stack.Find("posture")).rank, 4);
  EXPECT_THROW(ApplyTaskSet("papers", &stack), std::invalid_argument);
}

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

// What a change does to the torques, from tick to tick, the state being the
// same: at once, or eased in.
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
    for (int i = 0; i < kTicks; ++i) {
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
    // A curve of least jerk goes 15/8 as fast as a line, and begins at rest.
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

TEST_F(RampTest, EasesARankIn) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetRank("posture", 4)); });
}

TEST_F(RampTest, EasesAWeightIn) {
  Try([](Stack* stack) { EXPECT_TRUE(stack->SetWeight("posture", 100)); },
      [](Stack* stack) { EXPECT_TRUE(stack->SetRank("posture", 4)); });
}

TEST_F(RampTest, RefusesADurationThatIsNone) {
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

TEST_F(ControllerTest, MovesALinkAsItIsTold) {
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
  // It is where it was when it was started, and stays.
  EXPECT_LT(acceleration().norm(), 1e-6);
  const double kp = *controller.stack().GetParameter("frame.l_hand", "kp");
  controller.reference().frames[0].X_WF.p.z() += 0.01;
  state_.time = 2e-3;
  controller.Update(state_, &command_);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(6);
  up[5] = kp * 0.01;
  EXPECT_LT((acceleration() - up).norm(), 1e-6);
}

TEST_F(ControllerTest, KeepsACoupling) {
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
  // The joint is 0.1 rad short of where it should be, and -0.4 rad/s slow.
  EXPECT_NEAR(y[6 + joint] + 2 * y[6 + source], 0.1 * kp - 0.4 * kd, 1e-6);
}

TEST_F(ControllerTest, RefusesWhatItCannotDo) {
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

TEST_F(ControllerTest, SwitchesATaskByName) {
  EXPECT_FALSE(controller_.stack().Enable("posturing", false));
  ASSERT_TRUE(controller_.stack().Enable("posture", false));
  Update();
  const int posture = *controller_.stack().Find("posture");
  EXPECT_FALSE(controller_.report().tasks[posture].enabled);
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

}  // namespace
}  // namespace poise
