// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/observation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Rounding of a few multiplications of numbers near 1. For an angle near 0 that
// comes from a difference, the tolerance is its square root.
constexpr double kRounding = 1e-14;

// Returns the state at rest of a block whose underside is its sole.
PlantState StateAt(const Vector3d& p_WB, const Quaterniond& R_WB,
                   double time = 0) {
  PlantState state;
  state.time = time;
  state.q.resize(7);
  state.q << p_WB, R_WB.coeffs();
  state.v.setZero(6);
  return state;
}

const Vector3d kUp = Vector3d::UnitZ();

Quaterniond Turn(double angle, const Vector3d& axis) {
  return Quaterniond(AngleAxisd(angle, axis));
}

TEST(Observer, ReportsThePoseOfTheRobot) {
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), {});
  observer.ObserveState(StateAt({0.1, 0.2, 0.05}, Turn(0.3, kUp), 1.5), {},
                        {0.1, 0.2, 0.04});
  const Observation& now = observer.observation();
  EXPECT_EQ(now.time, 1.5);
  EXPECT_TRUE(now.com.isApprox(Vector3d(0.1, 0.2, 0.05)));
  EXPECT_TRUE(now.com_ref.isApprox(Vector3d(0.1, 0.2, 0.04)));
  EXPECT_NEAR(now.com_height, 0.05, kRounding);
  EXPECT_NEAR(now.base_tilt, 0, kRounding);
  EXPECT_TRUE(now.feet[0].X_WC.p.isApprox(Vector3d(0.1, 0.2, 0)));
  EXPECT_TRUE(observer.R_WB(0).isApprox(Turn(0.3, kUp).toRotationMatrix()));
}

// A robot that stands upright on a slope has tilt 0. Its height is measured
// from the plane.
TEST(Observer, MeasuresTiltAndHeightFromTheGroundTheRobotStandsOn) {
  Ground slope;
  slope.pitch = 0.2;
  const Quaterniond R_WG = Turn(0.2, Vector3d::UnitY());
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), slope);
  observer.ObserveState(StateAt(R_WG * Vector3d(1, 0, 0.05), R_WG), {},
                        Vector3d::Zero());
  EXPECT_NEAR(observer.observation().com_height, 0.05, kRounding);
  EXPECT_NEAR(observer.observation().base_tilt, 0, kRounding);
  observer.ObserveState(
      StateAt(R_WG * Vector3d(1, 0, 0.07), R_WG * Turn(0.1, Vector3d::UnitX())),
      {}, Vector3d::Zero());
  EXPECT_NEAR(observer.observation().com_height, 0.07, kRounding);
  EXPECT_NEAR(observer.observation().base_tilt, 0.1, kRounding);
}

// The base frame of a robot may be tilted when the robot stands upright.
TEST(Observer, MeasuresTiltFromTheStart) {
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), {});
  const Quaterniond askew = Turn(1.2, Vector3d::UnitX());
  observer.ObserveState(StateAt({0, 0, 1}, askew), {}, Vector3d::Zero());
  EXPECT_NEAR(observer.observation().base_tilt, 0, kRounding);
  observer.ObserveState(
      StateAt({0, 0, 1}, Turn(0.4, Vector3d::UnitY()) * askew), {},
      Vector3d::Zero());
  EXPECT_NEAR(observer.observation().base_tilt, 0.4, kRounding);
}

// A root frame on the floor below the robot must not count as a fallen robot.
TEST(Observer, MeasuresHeightByTheCenterOfMass) {
  Robot robot{
      ParseUrdf(
          "<robot name='r'><link name='world'/><link name='pelvis'>"
          "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
          "iyz='0' izz='1'/></inertial></link>"
          "<joint name='j' type='fixed'><parent link='world'/>"
          "<child link='pelvis'/><origin xyz='0 0 0.9'/></joint></robot>",
          "robot"),
      {},
      {}};
  robot.q_nominal = StateAt({0, 0, 0.1}, Turn(0, kUp)).q;
  EXPECT_NEAR(StandingHeight(robot), 1, kRounding);
  Observer observer(robot, {});
  observer.ObserveState(
      StateAt(Vector3d::Zero(), Turn(M_PI / 3, Vector3d::UnitY())), {},
      Vector3d::Zero());
  EXPECT_NEAR(observer.observation().com_height, 0.45, kRounding);
}

TEST(StandingHeight, CountsFromTheSole) {
  Robot block = MakeBlock({0.2, 0.2, 0.1}, 5);
  block.q_nominal.z() += 2;
  EXPECT_NEAR(StandingHeight(block), 0.05, kRounding);
}

TEST(Observer, CountsTiltAndSlideFromWhereAFootWasPutDown) {
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), {});
  const FootObservation& foot = observer.observation().feet[0];
  const auto see = [&observer](const Vector3d& p_WB, const Quaterniond& R_WB,
                               bool down) {
    observer.ObserveState(StateAt(p_WB, R_WB), {down}, Vector3d::Zero());
  };
  see({0, 0, 0.05}, Turn(0, kUp), true);
  EXPECT_EQ(foot.slide, 0);
  // The slide is the hypotenuse of 3 and 4 mm. A change of height does not
  // count as a slide, and a rotation about z does not count as a tilt.
  see({0.003, 0.004, 0.06}, Turn(0.5, kUp), true);
  EXPECT_NEAR(foot.slide, 0.005, kRounding);
  EXPECT_NEAR(foot.tilt, 0, kRounding);
  see({0, 0, 0.05}, Turn(0.01, Vector3d::UnitX()), true);
  EXPECT_NEAR(foot.tilt, 0.01, kRounding);
  // A foot in the air has neither tilt nor slide. When the foot is put down,
  // here tilted and at another place, both start at 0.
  see({1, 1, 0.3}, Turn(0.2, Vector3d::UnitX()), false);
  EXPECT_FALSE(foot.down);
  EXPECT_EQ(foot.slide, 0);
  EXPECT_EQ(foot.tilt, 0);
  see({2, 1, 0.05}, Turn(0.2, Vector3d::UnitX()), true);
  EXPECT_TRUE(foot.down);
  EXPECT_EQ(foot.slide, 0);
  EXPECT_NEAR(foot.tilt, 0, kRounding);
  see({2.01, 1, 0.05}, Turn(0.23, Vector3d::UnitX()), true);
  EXPECT_NEAR(foot.slide, 0.01,
              1e-3);  // The tilt moves the sole's center, too.
  EXPECT_NEAR(foot.tilt, 0.03, kRounding);
}

// Returns a block with two soles side by side, both turned outwards by 0.2 rad.
Robot MakeTwoSoles() {
  Robot robot = MakeBlock({0.2, 0.4, 0.1}, 5);
  robot.feet.push_back(robot.feet[0]);
  for (const double side : {1, -1}) {
    Pose& X_BC = robot.feet[side > 0 ? 0 : 1].X_BC;
    X_BC.p = {0.01, 0.1 * side, -0.05};
    X_BC.R = Turn(0.2 * side, kUp).toRotationMatrix();
  }
  return robot;
}

TEST(Observer, FindsTheCenterOfPressureBetweenTheFeet) {
  Observer observer(MakeTwoSoles(), {});
  observer.ObserveState(StateAt({0.5, 0.6, 0.05}, Turn(0.7, kUp)), {},
                        Vector3d::Zero());
  const auto cop = [&observer](const Vector6d& left, const Vector6d& right) {
    observer.ObserveForces({left, right});
    return observer.observation().cop;
  };
  Vector6d none = Vector6d::Zero(), weight = none;
  weight[5] = 30;
  EXPECT_TRUE(cop(weight, weight).isMuchSmallerThan(1, kRounding));
  EXPECT_TRUE(cop(weight, 3 * weight).isApprox(Eigen::Vector2d(0, -0.05)));
  // 30 N act at (0.02, -0.01) m in the left sole, which is turned by 0.2 rad.
  Vector6d off = weight;
  off.head<3>() = Vector3d(0.02, -0.01, 0).cross(off.tail<3>());
  const Eigen::Vector2d at(0.02 * std::cos(0.2) + 0.01 * std::sin(0.2),
                           0.1 + 0.02 * std::sin(0.2) - 0.01 * std::cos(0.2));
  EXPECT_TRUE(cop(off, weight).isApprox((at + Eigen::Vector2d(0, -0.1)) / 2));
  EXPECT_EQ(observer.observation().feet[0].F_Co_C, off);
  EXPECT_EQ(observer.observation().feet[1].F_Co_C, weight);
  // Horizontal forces at the height of the soles do not move the CoP.
  weight[3] = 10;
  EXPECT_TRUE(cop(weight, 3 * weight).isApprox(Eigen::Vector2d(0, -0.05)));
  // A load below 1 N gives no CoP.
  weight[5] = 0.99;
  EXPECT_TRUE(cop(weight, none).array().isNaN().all());
}

// The box of the task zmp is about the feet in contact. A foot in the air must
// not move the frame in which the CoP is compared with that box.
TEST(Observer, TakesTheCenterOfPressureFromTheFeetInContact) {
  Observer observer(MakeTwoSoles(), {});
  observer.ObserveState(StateAt({0.5, 0.6, 0.05}, Turn(0.7, kUp)), {},
                        Vector3d::Zero());
  Vector6d none = Vector6d::Zero(), off = none;
  off[5] = 30;
  off.head<3>() = Vector3d(0.02, -0.01, 0).cross(off.tail<3>());
  const Observation& now = observer.observation();
  for (const int foot : {0, 1}) {
    observer.ObserveForces({foot == 0 ? off : none, foot == 0 ? none : off});
    EXPECT_TRUE(now.cop.isApprox(Eigen::Vector2d(0.02, -0.01)));
    EXPECT_TRUE(now.feet[foot].in_contact);
    EXPECT_FALSE(now.feet[1 - foot].in_contact);
  }
}

// The box of the task zmp is level, on a slope too.
TEST(Observer, TakesTheCenterOfPressureInALevelFrame) {
  Ground slope;
  slope.roll = 0.2;
  const Quaterniond R_WG = Turn(0.2, Vector3d::UnitX());
  Observer observer(MakeTwoSoles(), slope);
  observer.ObserveState(StateAt(R_WG * Vector3d(0, 0, 0.05), R_WG), {},
                        Vector3d::Zero());
  const Observation& now = observer.observation();
  // Vertical forces, three times as much on the right sole.
  std::vector<Vector6d> F_Co_C(2, Vector6d::Zero());
  for (const int foot : {0, 1}) {
    F_Co_C[foot].tail<3>() =
        now.feet[foot].X_WC.R.transpose() * (foot == 0 ? 30 : 90) * kUp;
  }
  observer.ObserveForces(F_Co_C);
  EXPECT_NEAR(now.cop.x(), 0, kRounding);
  EXPECT_NEAR(now.cop.y(), -0.05 * std::cos(0.2), kRounding);
}

// xi = c + v / omega for a body that does not turn; a turn about y moves it
// forward.
TEST(Observer, ReportsTheCapturePoint) {
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), {});
  PlantState state = StateAt({0.1, 0.2, 0.9}, Turn(0, kUp));
  state.v[3] = 0.3;
  observer.ObserveState(state, {}, {0, 0, 0});
  const double omega = std::sqrt(9.81 / 0.9);
  EXPECT_NEAR(observer.observation().xi.x(), 0.1 + 0.3 / omega, 1e-12);
  EXPECT_NEAR(observer.observation().xi.y(), 0.2, 1e-12);
  EXPECT_NEAR(observer.observation().com_velocity.x(), 0.3, 1e-12);
  state.v[1] = 2;
  observer.ObserveState(state, {}, {0, 0, 0});
  EXPECT_GT(observer.observation().xi.x(), 0.1 + 0.3 / omega + 1e-4);
}

// The reference keeps its place amid the feet.
TEST(Observer, MovesTheComReferenceWithTheFeet) {
  Observer observer(MakeBlock({0.2, 0.2, 0.1}, 5), {});
  observer.ObserveState(StateAt({0.1, 0.2, 0.05}, Turn(0, kUp)), {},
                        {0.5, 0.6, 0.04});
  std::vector<ContactTick> believed(1);
  believed[0].X_WC.p = Vector3d(0.07, 0.25, 0.3);
  observer.MoveComReference(believed);
  EXPECT_TRUE(observer.observation().com_ref.isApprox(
      Vector3d(0.53, 0.55, 0.04), kRounding));
}
}  // namespace
}  // namespace poise
