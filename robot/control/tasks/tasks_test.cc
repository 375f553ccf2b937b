// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// What the rows of each task mean, on the humanoid: against forces that a sole
// can and cannot give, and against the robot's own motion a moment later.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "dynamics/integrate.h"
#include "math/so3.h"
#include "robot/control/controller.h"
#include "robot/control/tasks/angular_momentum.h"
#include "robot/control/tasks/capture_point.h"
#include "robot/control/tasks/com.h"
#include "robot/control/tasks/contact.h"
#include "robot/control/tasks/cop.h"
#include "robot/control/tasks/force_regularizer.h"
#include "robot/control/tasks/frame.h"
#include "robot/control/tasks/friction.h"
#include "robot/control/tasks/joint_limits.h"
#include "robot/control/tasks/linear_momentum.h"
#include "robot/control/tasks/mimic.h"
#include "robot/control/tasks/momentum.h"
#include "robot/control/tasks/newton_euler.h"
#include "robot/control/tasks/posture.h"
#include "robot/control/tasks/support_box.h"
#include "robot/control/tasks/swing.h"
#include "robot/control/tasks/torque_limits.h"
#include "robot/control/tasks/torque_minimization.h"
#include "robot/control/tasks/unilateral.h"
#include "robot/control/tasks/yaw.h"
#include "robot/control/tasks/yaw_constant.h"
#include "robot/control/tasks/zmp.h"
#include "robot/control/tasks/zmp_literal.h"
#include "robot/control/torque.h"
#include "robot/profile.h"
#include "tests/util/decompositions.h"

namespace poise {
namespace {

class TaskTest : public testing::Test {
 protected:
  TaskTest() {
    state_ = {0, robot_.q_nominal, Eigen::VectorXd(nv_)};
    for (int i = 0; i < nv_; ++i) state_.v[i] = Uniform(-0.3, 0.3);
    Command command;
    command.tau.setZero(n_);
    controller_.Start(state_);
    state_.time = 1e-3;
    controller_.Update(state_, &command);
  }

  double Uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  TaskInput input() const {
    return {state_, controller_.tick(), controller_.contacts(),
            controller_.reference(), unexpected_};
  }

  // The rows of a task, read from a hierarchy of its own.
  const Hierarchy& Write(const Task& task) {
    const int equalities = static_cast<int>(task.equality_names().size());
    const int inequalities = static_cast<int>(task.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{equalities, inequalities}});
    hierarchy_.Clear(1);
    EqualityBlock equal = hierarchy_.AddEqualities(0, equalities);
    InequalityBlock unequal = hierarchy_.AddInequalities(0, inequalities);
    task.Write(input(), &equal, &unequal);
    return hierarchy_;
  }

  // By how much the worst row is violated; negative: the least gap.
  double Violation(const Task& task, const Eigen::VectorXd& y) {
    const Hierarchy& rows = Write(task);
    const Eigen::VectorXd value = rows.C(0) * y;
    return std::max((value - rows.upper(0)).maxCoeff(),
                    (rows.lower(0) - value).maxCoeff());
  }

  Eigen::VectorXd Residual(const Task& task, const Eigen::VectorXd& y) {
    const Hierarchy& rows = Write(task);
    return rows.B(0) * y + rows.b(0);
  }

  // y of foot 0 loaded by a force f at a point of its sole, C's axes.
  Eigen::VectorXd Loaded(const Eigen::Vector2d& at, const Eigen::Vector3d& f) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(nv_ + 12);
    const Eigen::Vector3d p(at.x(), at.y(), 0);
    y.segment<6>(nv_) << p.cross(f), f;
    return y;
  }

  // The tick after the motion has gone on along v̇ for so long.
  Tick After(double t, const Eigen::VectorXd& y) {
    State state{1, robot_.q_nominal, state_.v + t * y.head(nv_)};
    Integrate(tree_, state_.q, state_.v, t, state.q);
    Controller probe(robot_);
    probe.Start(state);
    return probe.tick();
  }

  Eigen::VectorXd RandomY() {
    Eigen::VectorXd y(nv_ + 12);
    for (int i = 0; i < y.size(); ++i) y[i] = Uniform(-1, 1);
    return y;
  }

  std::mt19937 random_{7};
  Robot robot_ = LoadRobot("robot/models/humanoid.urdf",
                           LoadProfile("robot/profiles/humanoid.yaml"));
  const Tree& tree_ = robot_.model.tree;
  const int nv_ = tree_.nv(), n_ = tree_.num_joints();
  const Eigen::Vector2d half_ = robot_.feet[0].half_size;
  Controller controller_{robot_};
  State state_;
  Eigen::VectorXd unexpected_ = Eigen::VectorXd::Zero(nv_);
  Hierarchy hierarchy_{1, {{1, 1}}};
};

TEST_F(TaskTest, CopIsInsideWhereTheForceIsOnTheSole) {
  const CopTask cop(tree_, robot_.feet);
  const double x = half_.x() - 0.005, y = half_.y() - 0.005;
  const Eigen::Vector3d f(20, -10, 300);
  EXPECT_LE(Violation(cop, Loaded({0.99 * x, 0.99 * y}, f)), 0);
  EXPECT_LE(Violation(cop, Loaded({-0.99 * x, -0.99 * y}, f)), 0);
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(1.01 * x, 0), Eigen::Vector2d(-1.01 * x, 0),
        Eigen::Vector2d(0, 1.01 * y), Eigen::Vector2d(0, -1.01 * y)}) {
    EXPECT_GT(Violation(cop, Loaded(at, f)), 0) << at.transpose();
  }
}

TEST_F(TaskTest, CopRowsAreNamedForTheirEdges) {
  const CopTask cop(tree_, robot_.feet);
  const char* edges[] = {"x_max", "x_min", "y_max", "y_min"};
  const Eigen::Vector2d at[] = {{0.2, 0}, {-0.2, 0}, {0, 0.2}, {0, -0.2}};
  for (int i = 0; i < 4; ++i) {
    const Hierarchy& rows = Write(cop);
    const Eigen::VectorXd value =
        rows.C(0) * Loaded(at[i], Eigen::Vector3d(0, 0, 100));
    for (int row = 0; row < 4; ++row) {
      EXPECT_EQ(value[row] > 0, row == i) << edges[i];
    }
    EXPECT_EQ(cop.inequality_names()[i],
              std::string("left_foot.cop.") + edges[i]);
  }
}

TEST_F(TaskTest, FrictionPyramidsTouchTheConeFromOutsideAndFromInside) {
  FrictionTask friction(tree_, robot_.feet);
  const double mu = 0.5, fz = 200;
  const auto pulled = [&](double share, double angle) {
    return Violation(
        friction,
        Loaded({0, 0}, Eigen::Vector3d(share * mu * fz * std::cos(angle),
                                       share * mu * fz * std::sin(angle), fz)));
  };
  for (const double axis : {0.0, 0.5, 1.0, 1.5}) {
    const double along = axis * 3.14159265358979, diagonal = along + 0.78539816;
    EXPECT_LE(pulled(0.99, along), 0);
    EXPECT_GT(pulled(1.01, along), 0);
    EXPECT_LE(pulled(1.40, diagonal), 0);
    EXPECT_GT(pulled(1.42, diagonal), 0);
  }
  *friction.parameters()[1].value = 1;
  for (const double axis : {0.0, 0.5, 1.0, 1.5}) {
    const double along = axis * 3.14159265358979, diagonal = along + 0.78539816;
    EXPECT_LE(pulled(0.70, along), 0);
    EXPECT_GT(pulled(0.72, along), 0);
    EXPECT_LE(pulled(0.99, diagonal), 0);
    EXPECT_GT(pulled(1.01, diagonal), 0);
  }
}

// Four corner forces inside their pyramids are what a rectangular sole can
// give: they meet all rows of the cone; and its corner cases meet one with
// equality.
TEST_F(TaskTest, YawConeHoldsWhatCornersCanGive) {
  const YawTask yaw(tree_, robot_.feet);
  const double mu = 0.5;
  double closest = -1e9;
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(nv_ + 12);
    const bool extreme = trial % 2 == 0;
    const double spin = trial % 4 == 0 ? 1 : -1;
    for (const int sx : {-1, 1}) {
      for (const int sy : {-1, 1}) {
        const double fz = Uniform(0, 100);
        // Extreme: all corners push around the same way.
        const double fx =
            extreme ? -spin * sy * mu * fz : Uniform(-mu, mu) * fz;
        const double fy = extreme ? spin * sx * mu * fz : Uniform(-mu, mu) * fz;
        y += Loaded({sx * half_.x(), sy * half_.y()},
                    Eigen::Vector3d(fx, fy, fz));
      }
    }
    const double violation = Violation(yaw, y);
    EXPECT_LT(violation, 1e-12);
    if (extreme) closest = std::max(closest, violation);
  }
  EXPECT_NEAR(closest, 0, 1e-12);
}

TEST_F(TaskTest, YawConeRefusesMoreThanFrictionGives) {
  const YawTask yaw(tree_, robot_.feet);
  const double most = 0.5 * (half_.x() + half_.y()) * 100;
  for (const double sign : {1.0, -1.0}) {
    Eigen::VectorXd y = Loaded({0, 0}, Eigen::Vector3d(0, 0, 100));
    y[nv_ + 2] = sign * 0.99 * most;
    EXPECT_LE(Violation(yaw, y), 0);
    y[nv_ + 2] = sign * 1.01 * most;
    EXPECT_GT(Violation(yaw, y), 0);
  }
}

TEST_F(TaskTest, YawConstantIsProportionalToTheLoad) {
  const YawConstantTask yaw(tree_, robot_.feet);
  for (const double sign : {1.0, -1.0}) {
    Eigen::VectorXd y = Loaded({0, 0}, Eigen::Vector3d(0, 0, 100));
    y[nv_ + 2] = sign * 4.9;
    EXPECT_LE(Violation(yaw, y), 0);
    y[nv_ + 2] = sign * 5.1;
    EXPECT_GT(Violation(yaw, y), 0);
  }
}

TEST_F(TaskTest, GroundDoesNotPull) {
  const UnilateralTask unilateral(tree_, robot_.feet);
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[0].max_normal_force = 30;  // It fades.
  hierarchy_ = Hierarchy(nv_ + 12, {{0, 2}});
  hierarchy_.Clear(1);
  EqualityBlock none = hierarchy_.AddEqualities(0, 0);
  InequalityBlock rows = hierarchy_.AddInequalities(0, 2);
  unilateral.Write({state_, controller_.tick(), contacts,
                    controller_.reference(), unexpected_},
                   &none, &rows);
  EXPECT_NEAR(rows.upper[0] / rows.C(0, nv_ + 5), 30, 1e-9);
  EXPECT_EQ(rows.lower[0], 0);
  EXPECT_LE(Violation(unilateral, Loaded({0, 0}, {0, 0, 1})), 0);
  EXPECT_GT(Violation(unilateral, Loaded({0, 0}, {0, 0, -1})), 0);
}

TEST_F(TaskTest, ZmpIsTheCopOfBothFeetInTheirMiddle) {
  const ZmpTask zmp(tree_, robot_.feet);
  const double foot_y = controller_.contacts()[0].X_WC.p.y();
  // All weight on the left foot, at 0.099 and 0.101 m from the middle.
  const Eigen::Vector3d f(0, 0, 300);
  EXPECT_LE(Violation(zmp, Loaded({0, 0.099 - foot_y}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({0, 0.101 - foot_y}, f)), 0);
  EXPECT_LE(Violation(zmp, Loaded({0.99 * half_.x(), 0}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({1.01 * half_.x(), 0}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({-1.01 * half_.x(), 0}, f)), 0);
}

TEST_F(TaskTest, ZmpReadLiterallyLetsFeetCancel) {
  const ZmpLiteralTask literal(tree_, robot_.feet);
  Eigen::VectorXd y = Loaded({0.3, 0}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  y.tail<6>() = Loaded({-0.3, 0}, Eigen::Vector3d(0, 0, 100)).segment<6>(nv_);
  EXPECT_LE(Violation(literal, y), 0);
  y = Loaded({0, 0.3}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  y = Loaded({0, -0.3}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  // Of the box, each side by itself.
  const Eigen::Vector3d up(0, 0, 100);
  for (const Eigen::Vector2d& side :
       {Eigen::Vector2d(half_.x(), 0), Eigen::Vector2d(-half_.x(), 0),
        Eigen::Vector2d(0, half_.y()), Eigen::Vector2d(0, -half_.y())}) {
    EXPECT_LE(Violation(literal, Loaded(0.99 * side, up)), 0);
    EXPECT_GT(Violation(literal, Loaded(1.01 * side, up)), 0);
  }
}

TEST_F(TaskTest, JointLimitsBringAJointToRestAtItsStop) {
  const JointLimitsTask task(robot_.model);
  const int j = *tree_.FindJoint("l_elbow");
  for (const auto& [side, push] : {std::pair(1., 0.), std::pair(-1., 0.),
                                   std::pair(1., 30.), std::pair(-1., 30.)}) {
    unexpected_[6 + j] = push;  // Of which the solution knows nothing, rad/s2.
    const JointLimits& limits = robot_.model.limits[j];
    constexpr double kMargin = 0.008;  // rad.
    const double stop =
        side > 0 ? limits.upper - kMargin : limits.lower + kMargin;
    state_.q[7 + j] = stop - side * 0.2;
    state_.v[6 + j] = side * 7.9;  // Just slow enough: w 0.2 rad.
    double nearest = 1;
    for (int i = 0; i < 1000; ++i) {
      const Hierarchy& rows = Write(task);
      const double bound = (side > 0 ? rows.upper(0)[j] : rows.lower(0)[j]) /
                           rows.C(0)(j, 6 + j);
      state_.v[6 + j] += 1e-3 * (bound + push);
      state_.q[7 + j] += 1e-3 * state_.v[6 + j];
      nearest = std::min(nearest, side * (stop - state_.q[7 + j]));
    }
    EXPECT_GE(nearest, -1e-9);
    EXPECT_LT(nearest, 1e-3);
    EXPECT_LT(std::abs(state_.v[6 + j]), 1e-3);
  }
}

TEST_F(TaskTest, JointLimitsHoldTheSpeed) {
  const JointLimitsTask task(robot_.model);
  const int j = *tree_.FindJoint("l_elbow");
  const double fastest = robot_.model.limits[j].velocity;
  state_.q[7 + j] = robot_.q_nominal[7 + j];
  state_.v[6 + j] = fastest;
  EXPECT_LE(Write(task).upper(0)[j], 1e-12);
  state_.v[6 + j] = -fastest;
  EXPECT_GE(Write(task).lower(0)[j], -1e-12);
  // Not beyond what it is: at rest it may still speed up, as much either way.
  state_.v[6 + j] = 0;
  EXPECT_GT(Write(task).upper(0)[j], 0);
  EXPECT_LT(Write(task).lower(0)[j], 0);
}

TEST_F(TaskTest, TorqueRowsAreThoseOfTheSolution) {
  const Eigen::VectorXd y = RandomY();
  Eigen::VectorXd tau(n_);
  ComputeTorque(controller_.tick(), controller_.contacts(), y, &tau);
  const TorqueLimitsTask limits(robot_.model);
  const Hierarchy& rows = Write(limits);
  const Eigen::VectorXd value = rows.C(0) * y;
  for (int j = 0; j < n_; ++j) {
    const double effort = robot_.model.limits[j].effort;
    // Where C y is at its upper bound, the torque is at the limit.
    EXPECT_NEAR(1 - (rows.upper(0)[j] - value[j]), tau[j] / effort, 1e-9);
    EXPECT_NEAR((value[j] - rows.lower(0)[j]) - 1, tau[j] / effort, 1e-9);
  }
  const Eigen::VectorXd small =
      Residual(TorqueMinimizationTask(robot_.model), y);
  for (int j = 0; j < n_; ++j) {
    EXPECT_NEAR(small[j], tau[j] / robot_.model.limits[j].effort, 1e-9);
  }
}

TEST_F(TaskTest, NewtonEulerIsTheBaseOfTheEquationOfMotion) {
  const Eigen::VectorXd y = RandomY();
  const Tick& tick = controller_.tick();
  Eigen::VectorXd wanted = tick.M * y.head(nv_) + tick.N;
  for (int i = 0; i < 2; ++i) {
    wanted -= controller_.contacts()[i].J_WC_C.transpose() *
              y.segment<6>(nv_ + 6 * i);
  }
  const Eigen::VectorXd residual = Residual(NewtonEulerTask(tree_), y);
  const double weight = tree_.total_mass() * 9.81;
  EXPECT_LT((residual * weight / 4 - wanted.head<6>()).norm(), 1e-9);
}

// Along v̇ the robot's own momentum, center of mass and feet change as the rows
// say: by differences of the same state a moment later.
TEST_F(TaskTest, RatesOfMomentumAndFeetAreThoseOfTheMotion) {
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const Tick before = After(-h, y), after = After(h, y);
  const double m = tree_.total_mass();
  const Vector6d rate = (after.L_G - before.L_G) / (2 * h);
  const Reference& reference = controller_.reference();
  const Eigen::Vector3d e = reference.p_WG - controller_.tick().p_WG;
  const Eigen::Vector3d v_G = controller_.tick().v_WG;
  const Vector6d L = controller_.tick().L_G;
  // Central differences over 1e-6 s: good to 1e-5 of the rates.
  const double tolerance = 1e-4;

  const Eigen::VectorXd momentum =
      Residual(MomentumTask(tree_, robot_.feet), y);
  const Eigen::Vector3d linear = rate.tail<3>() / m - 30 * e + 10 * v_G;
  EXPECT_LT((momentum.tail<3>() - linear).norm(), tolerance);
  // The base is where it should be: no rotation to correct.
  EXPECT_LT(
      (momentum.head<3>() - (rate.head<3>() + 10 * L.head<3>()) / m).norm(),
      tolerance);
  EXPECT_LT((Residual(ComTask(tree_), y) - linear).norm(), tolerance);
  EXPECT_LT(
      (Residual(LinearMomentumTask(tree_), y) - (rate.tail<3>() / m + 10 * v_G))
          .norm(),
      tolerance);
  EXPECT_LT(
      (Residual(AngularMomentumTask(tree_), y) - momentum.head<3>()).norm(),
      1e-12);
}

// What a task asks of y, less what it asks where nothing is to be done: here by
// a reference that moves, feed-forward, and a base that is turned.
TEST_F(TaskTest, MomentumGoesWhereItsReferenceGoes) {
  MomentumTask momentum(tree_, robot_.feet);
  ComTask com(tree_);
  LinearMomentumTask linear(tree_);
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd before = Residual(momentum, y);
  const Eigen::VectorXd com_before = Residual(com, y);
  const Eigen::VectorXd linear_before = Residual(linear, y);

  Reference& reference = controller_.reference();
  const Eigen::Vector3d p(0.01, -0.02, 0.03), v(0.1, 0.2, -0.3), a(1, 2, 3);
  const Eigen::Vector3d turn(0.02, -0.03, 0.05);  // rad, in world axes.
  reference.p_WG += p;
  reference.v_WG = v;
  reference.a_WG = a;
  const Eigen::Matrix3d R_WB = controller_.tick().X_WB[0].R;
  reference.R_WB = ExpSo3(turn) * R_WB;
  Eigen::VectorXd asked = before - Residual(momentum, y);
  EXPECT_LT((asked.head<3>() - 200 / tree_.total_mass() * turn).norm(), 1e-9);
  EXPECT_LT((asked.tail<3>() - 30 * p).norm(), 1e-9);
  EXPECT_LT((com_before - Residual(com, y) - (30 * p + 10 * v + a)).norm(),
            1e-9);
  EXPECT_LT((linear_before - Residual(linear, y) - (10 * v + a)).norm(), 1e-9);

  for (const Parameter& each : momentum.parameters()) {
    if (each.name == "feedforward") *each.value = 1;
  }
  asked = before - Residual(momentum, y);
  EXPECT_LT((asked.tail<3>() - (30 * p + 10 * v + a)).norm(), 1e-9);
}

// The height has its own gains always: it does not fall over.
TEST_F(TaskTest, MomentumIsStifferInTheLargestPushesButNotInItsHeight) {
  MomentumTask momentum(tree_, robot_.feet);
  for (const Parameter& each : momentum.parameters()) {
    if (each.name == "angular_weight") *each.value = 2;
  }
  const Eigen::Vector3d p(0.01, -0.02, 0.03);
  const auto write = [&](double capture) {
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    TaskInput now = input();
    now.capture = capture;
    now.correction_W = Eigen::Vector3d(0.1, 0.2, 0.3);
    momentum.Write(now, &rows, &none);
    return Eigen::Vector3d(rows.b.tail<3>());
  };
  for (const double capture : {0.0, 0.5, 1.0}) {
    const Eigen::Vector3d before = write(capture);
    EXPECT_NEAR(hierarchy_.weight(0)[0], 2 * std::pow(0.3 / 2, capture), 1e-12);
    controller_.reference().p_WG += p;
    const Eigen::Vector3d asked = before - write(capture);
    controller_.reference().p_WG -= p;
    const double kp = 30 + 30 * capture;
    EXPECT_LT((asked - Eigen::Vector3d(kp, kp, 30).cwiseProduct(p)).norm(),
              1e-9);
  }
  // A correction is an acceleration like any other.
  const Eigen::Vector3d corrected = write(0);
  const Eigen::VectorXd plain = Write(momentum).b(0);
  EXPECT_LT(
      (plain.tail<3>() - corrected - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(),
      1e-12);
}

// The sole's frame, anywhere on the foot's link, moves as its Jacobian says.
TEST_F(TaskTest, AContactMovesAsItsLinkDoes) {
  const Pose X_FC{ExpSo3({0.3, -0.2, 0.5}), Eigen::Vector3d(0.05, -0.03, -0.4)};
  const auto at = [&](const Tick& tick) {
    ContactTick contact;
    contact.J_WC_C.setZero(6, nv_);
    ComputeContact(tick.frames[0], X_FC, &contact);
    return contact;
  };
  const auto twist_W = [](const ContactTick& contact) {
    Vector6d V_W;
    V_W << contact.X_WC.R * contact.V_WC_C.head<3>(),
        contact.X_WC.R * contact.V_WC_C.tail<3>();
    return V_W;
  };
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const ContactTick now = at(controller_.tick());
  const ContactTick before = at(After(-h, y)), after = at(After(h, y));
  EXPECT_LT((now.J_WC_C * state_.v - now.V_WC_C).norm(), 1e-12);
  Vector6d moved;
  moved << LogSo3(after.X_WC.R * before.X_WC.R.transpose()),
      after.X_WC.p - before.X_WC.p;
  // Central differences over 1e-6 s: good to 1e-5 of the rates.
  EXPECT_LT((moved / (2 * h) - twist_W(now)).norm(), 1e-5);
  const Vector6d rate = (twist_W(after) - twist_W(before)) / (2 * h);
  const Vector6d A_C = now.J_WC_C * y.head(nv_) + now.Jdot_v_C;
  EXPECT_LT((now.X_WC.R.transpose() * rate.head<3>() - A_C.head<3>()).norm(),
            1e-4);
  EXPECT_LT((now.X_WC.R.transpose() * rate.tail<3>() - A_C.tail<3>()).norm(),
            1e-4);
}

TEST_F(TaskTest, AFootInTheAirFollowsItsReference) {
  SwingTask task(robot_.feet[0], 0);
  for (const Parameter& each : task.parameters()) {
    *each.value = each.name == "kp" ? 7 : 3;
  }
  std::vector<ContactTick> contacts = controller_.contacts();
  const TaskInput now{state_, controller_.tick(), contacts,
                      controller_.reference(), unexpected_};
  EXPECT_FALSE(task.HasRows(now));
  contacts[0].in_contact = false;
  EXPECT_TRUE(task.HasRows(now));
  contacts[0].is_guided = false;
  EXPECT_FALSE(task.HasRows(now));

  const ContactTick& foot = controller_.contacts()[0];
  Vector6d e;
  e << 0.3, -0.2, 0.1, 0.04, -0.05, 0.06;
  FrameReference& reference = controller_.reference().feet[0];
  reference.X_WF = {ExpSo3(e.head<3>()) * foot.X_WC.R,
                    foot.X_WC.p + e.tail<3>()};
  reference.V_WF_W << 1, 2, 3, 4, 5, 6;
  reference.A_WF_W << 9, 8, 7, 6, 5, 4;
  const Vector6d wanted_W = reference.A_WF_W + 3 * reference.V_WF_W + 7 * e;
  const Eigen::VectorXd y = RandomY();
  Vector6d expected =
      foot.J_WC_C * y.head(nv_) + foot.Jdot_v_C + 3 * foot.V_WC_C;
  expected.head<3>() -= foot.X_WC.R.transpose() * wanted_W.head<3>();
  expected.tail<3>() -= foot.X_WC.R.transpose() * wanted_W.tail<3>();
  EXPECT_LT((Residual(task, y) - expected).norm(), 1e-9);
}

TEST_F(TaskTest, TheBoxAroundTheSolesHoldsTheirCorners) {
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[0].X_WC.p << 0.02, 0.1, 0;
  contacts[1].X_WC.p << -0.03, -0.2, 0;
  contacts[0].X_WC.R = ExpSo3({0, 0, 0.3});
  contacts[1].X_WC.R = ExpSo3({0, 0, -2});
  for (const bool both : {true, false}) {
    contacts[1].in_contact = both;
    Eigen::Vector2d most(-1, -1), least(1, 1);
    for (int i = 0; i < (both ? 2 : 1); ++i) {
      for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
          const Eigen::Vector3d corner =
              contacts[i].X_WC *
              Eigen::Vector3d(x * half_.x(), y * half_.y(), 0);
          most = most.cwiseMax(corner.head<2>());
          least = least.cwiseMin(corner.head<2>());
        }
      }
    }
    const auto reach = [&](SupportSide side) {
      return SupportReach(robot_.feet, contacts, Pose(), side);
    };
    EXPECT_NEAR(reach(kFront), most.x(), 1e-12);
    EXPECT_NEAR(reach(kBack), -least.x(), 1e-12);
    EXPECT_NEAR(reach(kLeft), most.y(), 1e-12);
    EXPECT_NEAR(reach(kRight), -least.y(), 1e-12);
  }
}

TEST_F(TaskTest, ContactPullsASoleUprightAndToTheGround) {
  const ContactTask task(robot_.feet);
  const ContactTick& contact = controller_.contacts()[0];
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd at_ground = Residual(task, y);
  const Eigen::VectorXd expected =
      (contact.J_WC_C * y.head(nv_) + contact.Jdot_v_C + 30 * contact.V_WC_C);
  EXPECT_LT((at_ground.head<6>() - expected).norm(), 1e-9);
  // A floor 1 cm lower: the foot shall accelerate down by kp 1 cm.
  controller_.reference().ground_z -= 0.01;
  const Eigen::VectorXd above = Residual(task, y);
  EXPECT_NEAR((above - at_ground)[5], 100 * 0.01, 1e-9);

  // A tilted sole turns back the way that it tilted; of a turned one only that.
  std::vector<ContactTick> contacts = controller_.contacts();
  const Eigen::Matrix3d heading = ExpSo3({0, 0, 0.7});
  const Eigen::Vector3d tilt(0.03, -0.02, 0);  // rad, in the foot's axes.
  contacts[0].X_WC = {heading * ExpSo3(tilt), Eigen::Vector3d::Zero()};
  controller_.reference().ground_z = 0;
  hierarchy_ = Hierarchy(nv_ + 12, {{12, 0}});
  hierarchy_.Clear(1);
  EqualityBlock rows = hierarchy_.AddEqualities(0, 12);
  InequalityBlock none = hierarchy_.AddInequalities(0, 0);
  task.Write({state_, controller_.tick(), contacts, controller_.reference(),
              unexpected_},
             &rows, &none);
  const Eigen::VectorXd asked =
      contacts[0].Jdot_v_C + 30 * contacts[0].V_WC_C - rows.b.head<6>();
  EXPECT_LT((asked.head<3>() + 100 * tilt).norm(), 2e-3);  // sin(x) for x.
  EXPECT_LT(asked.tail<3>().norm(), 1e-12);
}

TEST_F(TaskTest, FrameFollowsItsReference) {
  FrameTask task("l_foot", 0, 0);
  EXPECT_EQ(task.name(), "frame.l_foot");
  EXPECT_EQ(task.equality_names()[5], "frame.l_foot.vz");
  const double kp = 7, kd = 3;
  for (const Parameter& each : task.parameters()) {
    if (each.name == "kp") *each.value = kp;
    if (each.name == "kd") *each.value = kd;
  }
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const Vector6d rate =
      (After(h, y).frames[0].V_WF_W - After(-h, y).frames[0].V_WF_W) / (2 * h);

  const FrameTick frame = controller_.tick().frames[0];
  Vector6d e;
  e << 0.3, -0.2, 0.1, 0.04, -0.05, 0.06;
  FrameReference reference;
  reference.X_WF = {ExpSo3(e.head<3>()) * frame.X_WF.R,
                    frame.X_WF.p + e.tail<3>()};
  reference.V_WF_W << 1, 2, 3, 4, 5, 6;
  reference.A_WF_W << 9, 8, 7, 6, 5, 4;
  controller_.reference().frames = {reference};
  const Vector6d wanted =
      reference.A_WF_W + kd * (reference.V_WF_W - frame.V_WF_W) + kp * e;
  // Central differences over 1e-6 s: good to 1e-5 of the rates.
  EXPECT_LT((Residual(task, y) - (rate - wanted)).norm(), 1e-4);
}

TEST_F(TaskTest, FrameLeavesOutWhatIsNotAsked) {
  FrameTask task("l_foot", 0, 0);
  controller_.reference().frames.resize(1);
  const Eigen::VectorXd y = RandomY();
  const Vector6d both = Residual(task, y);
  for (const std::string half : {"orientation", "position"}) {
    for (const Parameter& each : task.parameters()) {
      if (each.name == "orientation" || each.name == "position") {
        *each.value = each.name == half ? 1 : 0;
      }
    }
    Vector6d wanted = both;
    wanted.segment<3>(half == "position" ? 0 : 3).setZero();
    EXPECT_EQ(Residual(task, y), wanted) << half;
  }
}

// What a coupling is off by comes to rest at 0 as a damped spring does.
TEST_F(TaskTest, MimicIsASpringOnWhatACouplingIsOffBy) {
  const int joint = *tree_.FindJoint("l_index_2");
  const int source = *tree_.FindJoint("l_index_1");
  const int other = *tree_.FindJoint("l_middle_2");
  robot_.model.mimics = {{joint, source, -1.5, 0.3}, {other, source, 2, 0}};
  MimicTask task(robot_.model);
  EXPECT_EQ(task.equality_names()[0], "mimic.l_index_2");
  const double kp = 7, kd = 3;
  for (const Parameter& each : task.parameters()) {
    *each.value = each.name == "kp" ? kp : kd;
  }
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd residual = Residual(task, y);
  for (int i = 0; i < 2; ++i) {
    const MimicCoupling& c = robot_.model.mimics[i];
    const double off = state_.q[7 + c.joint] -
                       (c.multiplier * state_.q[7 + c.source] + c.offset);
    const double rate =
        state_.v[6 + c.joint] - c.multiplier * state_.v[6 + c.source];
    const double acceleration = y[6 + c.joint] - c.multiplier * y[6 + c.source];
    EXPECT_NEAR(residual[i], acceleration + kd * rate + kp * off, 1e-12);
  }
}

TEST_F(TaskTest, PostureIsAPdOnEachJoint) {
  const Eigen::VectorXd y = RandomY();
  controller_.reference().posture[3] += 0.1;
  const Eigen::VectorXd residual = Residual(PostureTask(tree_), y);
  for (int j = 0; j < n_; ++j) {
    const double e = j == 3 ? 0.1 : 0;
    EXPECT_NEAR(residual[j], y[6 + j] - 60 * e + 15 * state_.v[6 + j], 1e-12);
  }
}

TEST_F(TaskTest, PostureWeighsAJointByWhatItMoves) {
  const Eigen::VectorXd weight = Write(PostureTask(tree_)).weight(0);
  for (int j = 0; j < n_; ++j) {
    const double moved = controller_.tick().M(6 + j, 6 + j);
    EXPECT_NEAR(std::pow(weight[j], 2), std::clamp(moved, 0.01, 10.0), 1e-12);
  }
  EXPECT_LT(weight[*tree_.FindJoint("l_elbow")],
            weight[*tree_.FindJoint("chest_pitch")]);
}

TEST_F(TaskTest, TakesTheLastMillimetersAndTheArmsForTheLargestPushes) {
  const auto write = [this](const Task& task, double capture) {
    const int equalities = static_cast<int>(task.equality_names().size());
    const int inequalities = static_cast<int>(task.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{equalities, inequalities}});
    hierarchy_.Clear(1);
    EqualityBlock equal = hierarchy_.AddEqualities(0, equalities);
    InequalityBlock unequal = hierarchy_.AddInequalities(0, inequalities);
    TaskInput now = input();
    now.capture = capture;
    task.Write(now, &equal, &unequal);
  };
  const CopTask cop(tree_, robot_.feet);
  const PostureTask posture(tree_);
  const int chest = *tree_.FindJoint("chest_pitch");
  const double M =
      controller_.tick().M(tree_.v_start() + chest, tree_.v_start() + chest);
  for (const double capture : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    write(cop, capture);
    const double margin = 0.005 - 0.004 * std::max(0.0, 2 * capture - 1);
    const double scale = 4 / (9.81 * tree_.total_mass());
    EXPECT_NEAR(hierarchy_.C(0)(0, nv_ + 5), -scale * (half_.x() - margin),
                1e-15);
    EXPECT_NEAR(hierarchy_.C(0)(2, nv_ + 5), -scale * (half_.y() - margin),
                1e-15);
    write(posture, capture);
    EXPECT_NEAR(hierarchy_.weight(0)[chest], std::pow(M, 0.5 + 0.5 * capture),
                1e-12);
  }
}

// Pushed along u, m/s of the center of mass alone: by how much the momentum task
// answers as in a capture, from 0 to 1; its gains say the same.
class CaptureTest : public TaskTest {
 protected:
  CaptureTest() { state_.v.setZero(); }

  double Share(const Vector6d& momentum_over_mass) {
    // A motion of all joints that has this momentum, and no other.
    const Tick& rest = controller_.tick();
    const Eigen::MatrixXd H = rest.H_G / tree_.total_mass();
    state_.v = LeastSquaresSolution(H, momentum_over_mass).x;
    ComputeTick(tree_, state_.q, state_.v, &tick_);
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    TaskInput now{state_, tick_, controller_.contacts(),
                  controller_.reference(), unexpected_};
    const MomentumTask::CaptureShares shares = task_.FindCapture(now);
    left_ = shares.left;
    right_ = shares.right;
    now.capture = shares.all;
    task_.Write(now, &rows, &none);
    // b = bias - wanted, and of what is wanted only -kd v_G is not zero.
    const Eigen::Vector3d v = momentum_over_mass.tail<3>();
    const Eigen::Vector3d wanted =
        tick_.H_G_bias.tail<3>() / tree_.total_mass() - rows.b.tail<3>();
    EXPECT_NEAR(wanted.z(), -10 * v.z(), 1e-6);
    const double share = shares.all;
    for (const int row : {0, 1, 2, 5}) {
      EXPECT_NEAR(rows.weight[row], std::pow(0.3, share), 1e-12);
    }
    EXPECT_EQ(rows.weight[3], 1);
    EXPECT_EQ(rows.weight[4], 1);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(wanted[axis], -(10 + 20 * share) * v[axis], 1e-6);
    }
    return share;
  }

  // What brings the capture point so far along an axis, as speed.
  Vector6d Fast(int axis, double way) const {
    Vector6d momentum = Vector6d::Zero();
    momentum[3 + axis] = way * w_;
    return momentum;
  }

  MomentumTask task_{tree_, robot_.feet};
  Tick tick_{tree_, {}};
  double left_ = 0, right_ = 0;  // Of the last Share().
  const double height_ = controller_.tick().p_WG.z();
  const double w_ = std::sqrt(9.81 / height_);
  const double front_ = half_.x();
  const double edge_ = controller_.contacts()[0].X_WC.p.y() + half_.y();
};

TEST_F(CaptureTest, BeginsShortOfTheEdgeAndIsWholeAtIt) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_EQ(Share(Fast(0, 0.64 * side * front_)), 0);
    EXPECT_NEAR(Share(Fast(0, 0.825 * side * front_)), 0.5, 0.01);
    EXPECT_NEAR(Share(Fast(0, 1.1 * side * front_)), 1, 1e-12);
    EXPECT_EQ(left_ + right_, 0);
    // A quarter farther sideways.
    EXPECT_EQ(Share(Fast(1, 0.8 * side * edge_)), 0);
    EXPECT_NEAR(Share(Fast(1, 1.031 * side * edge_)), 0.5, 0.01);
    EXPECT_NEAR(side > 0 ? left_ : right_, 0.5, 0.01);
    EXPECT_EQ(side > 0 ? right_ : left_, 0);
    EXPECT_NEAR(Share(Fast(1, 1.3 * side * edge_)), 1, 1e-12);
  }
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "capture") *each.value = 0;
  }
  EXPECT_EQ(Share(Fast(0, 1.1 * front_)), 0);
}

TEST_F(CaptureTest, CountsTheAngularMomentumThatIsToBeGivenBack) {
  // Bent forward at such a rate that to stop it moves the capture point so far;
  // bent to the left is about -x.
  Vector6d forward = Vector6d::Zero(), left = Vector6d::Zero();
  forward[1] = 0.825 * front_ * w_ * height_;
  left[0] = -1.031 * edge_ * w_ * height_;
  EXPECT_NEAR(Share(forward), 0.5, 0.01);
  EXPECT_NEAR(Share(left), 0.5, 0.01);
  // Moving forward and bending back: there is nothing to do.
  EXPECT_EQ(Share(Fast(0, 0.825 * front_) - forward), 0);
}

// In the middle half of the sole that stands, or where it shall be, if that is
// there.
TEST_F(CaptureTest, StandsOverTheFootThatIsLeft) {
  std::vector<ContactTick> contacts = controller_.contacts();
  Reference reference = controller_.reference();
  const auto pull = [&](const Eigen::Vector2d& at) {
    reference.p_WG.head<2>() = at;
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    task_.Write({state_, controller_.tick(), contacts, reference, unexpected_},
                &rows, &none);
    const Vector6d wanted =
        controller_.tick().H_G_bias / tree_.total_mass() - rows.b;
    return Eigen::Vector2d(
        (wanted.segment<2>(3) + 10 * controller_.tick().v_WG.head<2>()) / 30 +
        controller_.tick().p_WG.head<2>());
  };
  const Eigen::Vector2d foot = contacts[0].X_WC.p.head<2>();
  const Eigen::Vector2d there = foot + Eigen::Vector2d(0.01, -0.02);
  EXPECT_LT((pull({0.5, -0.3}) - Eigen::Vector2d(0.5, -0.3)).norm(), 1e-9);
  contacts[1].in_contact = false;
  EXPECT_LT((pull(there) - there).norm(), 1e-9);
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      const Eigen::Vector2d corner =
          foot + 0.5 * Eigen::Vector2d(x * half_.x(), y * half_.y());
      EXPECT_LT((pull({x, y}) - corner).norm(), 1e-6);
    }
  }
  contacts[0].in_contact = false;  // Nothing stands: as it is told.
  EXPECT_LT((pull(there) - there).norm(), 1e-9);
}

TEST_F(CaptureTest, SeesAReferenceThatMoves) {
  controller_.reference().v_WG.x() = 0.5 * front_ * w_;
  EXPECT_NEAR(Share(Fast(0, (0.5 + 0.4125) * front_)), 0.5, 0.02);
}

// Nothing is left of the way but a centimeter, and 8.25 mm of that gone.
TEST_F(CaptureTest, SeesAReferenceBeyondTheEdge) {
  controller_.reference().p_WG.x() += front_ + 0.02;
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "kp" || each.name == "capture_kp") *each.value = 0;
  }
  EXPECT_NEAR(Share(Fast(0, front_ + 0.02 + 0.00825)), 0.5, 0.02);
}

TEST_F(CaptureTest, SeesAReferenceNearTheEdge) {
  // Half of the way is left, and 82.5 % of that gone.
  controller_.reference().p_WG.x() += 0.5 * front_;
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "kp" || each.name == "capture_kp") *each.value = 0;
  }
  EXPECT_NEAR(Share(Fast(0, (0.5 + 0.4125) * front_)), 0.5, 0.02);
}

TEST_F(TaskTest, ForceRegularizerIsTheForceItself) {
  const Eigen::VectorXd y = RandomY();
  const double scale = tree_.total_mass() * 9.81 / 4;
  const Eigen::VectorXd residual =
      Residual(ForceRegularizerTask(tree_, robot_.feet), y);
  EXPECT_LT((residual - y.tail<12>() / scale).norm(), 1e-12);
}

TEST_F(TaskTest, CapturePointStopsShortOfTheEdge) {
  const CapturePointTask task(tree_, robot_.feet);
  // Under the greatest acceleration that the row of the left allows, the
  // capture point decays toward the bound with the horizon's time constant.
  const Eigen::Vector3d p = controller_.tick().p_WG;
  const Eigen::Vector3d v = controller_.tick().v_WG;
  const double w = std::sqrt(9.81 / p.z());
  const double edge = controller_.contacts()[0].X_WC.p.y() + half_.y() - 0.02;
  const Hierarchy& rows = Write(task);
  const Eigen::VectorXd y = RandomY();
  const Tick& tick = controller_.tick();
  const double a = (tick.H_G.row(4).dot(y.head(nv_)) + tick.H_G_bias[4]) /
                   tree_.total_mass();
  const double xi = p.y() + v.y() / w, rate = v.y() + a / w;
  EXPECT_NEAR(rows.C(0).row(2).dot(y) - rows.upper(0)[2],
              xi + 0.1 * rate - edge, 1e-6);
  EXPECT_NEAR(rows.C(0).row(3).dot(y) - rows.upper(0)[3],
              -xi - 0.1 * rate - edge, 1e-6);
  const double a_x = (tick.H_G.row(3).dot(y.head(nv_)) + tick.H_G_bias[3]) /
                     tree_.total_mass();
  const double ahead = p.x() - controller_.contacts()[0].X_WC.p.x() +
                       v.x() / w + 0.1 * (v.x() + a_x / w);
  const double front = half_.x() - 0.02;
  EXPECT_NEAR(rows.C(0).row(0).dot(y) - rows.upper(0)[0], ahead - front, 1e-6);
  EXPECT_NEAR(rows.C(0).row(1).dot(y) - rows.upper(0)[1], -ahead - front, 1e-6);
}

}  // namespace
}  // namespace poise
