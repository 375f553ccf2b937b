// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/sensors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "poise/math/so3.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

Robot MakeArmOnABlock() {
  std::mt19937 draw(1);
  Robot robot = MakeRobot(MakeRandomTree(2, &draw));
  robot.feet = MakeBlock({1, 1, 1}, 1).feet;
  return robot;
}

PlantState MakeState() {
  PlantState state;
  state.time = 3;
  state.q.resize(9);
  state.q << 1, 2, 3,
      Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()))
          .coeffs(),
      0.123, -0.456;
  state.v.resize(8);
  state.v << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8;
  state.vdot = Eigen::VectorXd::Zero(8);
  state.vdot.segment<3>(3) << 1, 2, 3;
  state.F_Co_C.resize(1);
  state.F_Co_C[0] << 1, 2, 3, 4, 5, 60;
  return state;
}

TEST(Sensors, ReturnTheTruthWithoutErrors) {
  const Robot robot = MakeArmOnABlock();
  Sensors sensors(robot, {}, 1);
  const Measurement& m = sensors.Measure(MakeState());
  EXPECT_EQ(m.time, 3);
  EXPECT_EQ(m.q_joints, Eigen::Vector2d(0.123, -0.456));
  EXPECT_EQ(m.v_joints, Eigen::Vector2d(0.7, 0.8));
  EXPECT_EQ(m.X_WB.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(m.X_WB.R.isApprox(ExpSo3({0, 0, M_PI / 2})));
  EXPECT_TRUE(m.R_WB_imu.isApprox(m.X_WB.R));
  EXPECT_TRUE(m.V_WB_W.isApprox(MakeState().v.head<6>()));
  // The base is turned by 90 degrees: x_B is y_W, and y_B is -x_W.
  EXPECT_TRUE(m.w_WB_B.isApprox(Eigen::Vector3d(0.2, -0.1, 0.3)));
  EXPECT_TRUE(m.specific_force_Bo_B.isApprox(Eigen::Vector3d(2, -1, 3 + 9.81)));
  EXPECT_EQ(m.feet[0].F_Co_C, MakeState().F_Co_C[0]);
  EXPECT_TRUE(m.feet[0].in_contact);
}

TEST(Sensors, ReportContactAboveTheThreshold) {
  const Robot robot = MakeArmOnABlock();
  Sensors sensors(robot, {}, 1);
  PlantState state = MakeState();
  state.F_Co_C[0][5] = 4.9;
  EXPECT_FALSE(sensors.Measure(state).feet[0].in_contact);
  state.F_Co_C[0][5] = 5.1;
  EXPECT_TRUE(sensors.Measure(state).feet[0].in_contact);
}

// Mean and standard deviation of numbers whose expected value is 0.
struct Spread {
  double sum = 0, squares = 0;
  int n = 0;
  void Add(double x) {
    sum += x;
    squares += x * x;
    ++n;
  }
  double mean() const { return sum / n; }
  double deviation() const { return std::sqrt(squares / n); }
};

TEST(Sensors, NoiseHasTheDeviationsOfTheSettings) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.noise = 2;
  settings.base_position = 3e-3;
  settings.base_velocity = 0.03;
  Sensors sensors(robot, settings, 1);
  const PlantState state = MakeState();
  const Eigen::Matrix3d R_WB = ExpSo3({0, 0, M_PI / 2});
  Spread position, rate, orientation, base_rate, force, moment, gyro, acc;
  Spread base_position, base_velocity;
  for (int i = 0; i < 20000; ++i) {
    const Measurement& m = sensors.Measure(state);
    position.Add(m.q_joints[1] + 0.456);
    rate.Add(m.v_joints[0] - 0.7);
    orientation.Add(LogSo3(R_WB.transpose() * m.X_WB.R).x());
    base_rate.Add(m.V_WB_W[2] - 0.3);
    base_position.Add(m.X_WB.p[1] - 2);
    base_velocity.Add(m.V_WB_W[3] - 0.4);
    force.Add(m.feet[0].F_Co_C[4] - 5);
    moment.Add(m.feet[0].F_Co_C[2] - 3);
    gyro.Add(m.w_WB_B[0] - 0.2);
    acc.Add(m.specific_force_Bo_B[1] + 1);
  }
  // With 20000 draws the standard error of a deviation is 0.5 %, and that of a
  // mean 0.7 % of the deviation. The tolerances are four times as large.
  const auto expect = [](const Spread& spread, double deviation) {
    EXPECT_NEAR(spread.deviation(), deviation, 0.02 * deviation);
    EXPECT_NEAR(spread.mean(), 0, 0.03 * deviation);
  };
  expect(position, 4e-3);
  expect(rate, 0.2);
  expect(orientation, 8e-3);
  expect(base_rate, 0.04);
  expect(base_position, 6e-3);
  expect(base_velocity, 0.06);
  expect(force, 4);
  expect(moment, 0.2);
  expect(gyro, 0.01);
  expect(acc, 0.1);
}

TEST(Sensors, BiasIsConstantAndWithinItsBounds) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.joint_bias = 0.01;
  settings.gyroscope_bias = 0.02;
  settings.force_bias = 3;
  Sensors sensors(robot, settings, 1);
  const Measurement first = sensors.Measure(MakeState());
  const Measurement second = sensors.Measure(MakeState());
  EXPECT_EQ(first.q_joints, second.q_joints);
  EXPECT_EQ(first.w_WB_B, second.w_WB_B);
  const double joint = first.q_joints[0] - 0.123;
  const double gyro = first.w_WB_B[2] - 0.3;
  const double force = first.feet[0].F_Co_C[5] - 60;
  EXPECT_NE(joint, 0);
  EXPECT_LE(std::abs(joint), 0.01);
  EXPECT_NE(gyro, 0);
  EXPECT_LE(std::abs(gyro), 0.02);
  EXPECT_NE(force, 0);
  EXPECT_LE(std::abs(force), 3);
}

TEST(Sensors, QuantiseToTheNearestStep) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.joint_resolution = 0.1;
  settings.force_resolution = 7;
  Sensors sensors(robot, settings, 1);
  const Measurement& m = sensors.Measure(MakeState());
  EXPECT_DOUBLE_EQ(m.q_joints[0], 0.1);
  EXPECT_DOUBLE_EQ(m.q_joints[1], -0.5);
  EXPECT_DOUBLE_EQ(m.feet[0].F_Co_C[3], 7);
  EXPECT_DOUBLE_EQ(m.feet[0].F_Co_C[5], 63);
}

// Returns all that a controller receives, as one vector. The orientation is a
// rotation vector relative to R.
Eigen::VectorXd Everything(
    const Measurement& m,
    const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) {
  Eigen::VectorXd all(2 + 2 + 3 + 3 + 6 + 3 + 3 + 6);
  all << m.q_joints, m.v_joints, m.X_WB.p, LogSo3(R.transpose() * m.X_WB.R),
      m.V_WB_W, m.w_WB_B, m.specific_force_Bo_B, m.feet[0].F_Co_C;
  return all;
}

// Returns the standard deviation of each entry of Everything() in WithABase().
Eigen::VectorXd Deviations() {
  const Eigen::Vector3d one = Eigen::Vector3d::Ones();
  Eigen::VectorXd all(28);
  all << 2e-3, 2e-3, 0.1, 0.1, 3e-3 * one, 4e-3 * one, 0.02 * one, 0.03 * one,
      5e-3 * one, 0.05 * one, 0.1 * one, 2 * one;
  return all;
}

SensorSettings WithABase() {
  SensorSettings settings;
  settings.base_position = 3e-3;
  settings.base_velocity = 0.03;
  return settings;
}

TEST(Sensors, EachReadingHasItsOwnConstantBias) {
  const Robot robot = MakeArmOnABlock();
  const Eigen::Matrix3d R_WB = ExpSo3({0, 0, M_PI / 2});
  const Eigen::VectorXd truth =
      Everything(Sensors(robot, {}, 1).Measure(MakeState()), R_WB);
  SensorSettings settings = WithABase();
  settings.bias = 3;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(28);
  constexpr int kRobots = 2000;
  for (int seed = 0; seed < kRobots; ++seed) {
    Sensors sensors(robot, settings, seed);
    const Eigen::VectorXd off =
        Everything(sensors.Measure(MakeState()), R_WB) - truth;
    ASSERT_EQ(Everything(sensors.Measure(MakeState()), R_WB) - truth, off);
    squares += off.cwiseAbs2();
  }
  // With 2000 draws the standard error of a deviation is 1.6 %. The tolerance
  // is four times as large.
  const Eigen::VectorXd spread = (squares / kRobots).cwiseSqrt();
  for (int i = 0; i < 28; ++i) {
    EXPECT_NEAR(spread[i] / Deviations()[i], 3, 0.2) << i;
  }
}

TEST(Sensors, EachReadingIsRoundedToItsResolution) {
  const Robot robot = MakeArmOnABlock();
  const Eigen::VectorXd truth =
      Everything(Sensors(robot, {}, 1).Measure(MakeState()));
  SensorSettings settings = WithABase();
  settings.resolution = 0.7;
  const Eigen::VectorXd read =
      Everything(Sensors(robot, settings, 1).Measure(MakeState()));
  for (int i = 0; i < 28; ++i) {
    const double step = 0.7 * Deviations()[i];
    const double steps = read[i] / step;
    EXPECT_NEAR(steps, std::round(steps), 1e-9) << i;
    EXPECT_LE(std::abs(read[i] - truth[i]), 0.5 * step + 1e-12) << i;
  }
  EXPECT_NE(read, truth);
}

TEST(Sensors, EachReadingHasItsDelay) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.joint_delay = 0.002;
  settings.base_delay = 0.005;
  settings.foot_delay = 0.001;
  Sensors sensors(robot, settings, 1);
  for (int k = 0; k < 20; ++k) {
    PlantState state = MakeState();
    state.time = 1e-3 * k;
    state.q[1] = state.q[8] = state.v[3] = state.v[6] = k;
    state.vdot[5] = state.F_Co_C[0][2] = k;
    state.F_Co_C[0][5] = k < 10 ? 60 : 0;
    const Measurement& m = sensors.Measure(state);
    EXPECT_EQ(m.time, state.time);
    EXPECT_EQ(m.q_joints[1], std::max(0, k - 2));
    EXPECT_EQ(m.v_joints[0], std::max(0, k - 2));
    EXPECT_EQ(m.X_WB.p[1], std::max(0, k - 5));
    EXPECT_EQ(m.V_WB_W[3], std::max(0, k - 5));
    EXPECT_NEAR(m.specific_force_Bo_B[2], std::max(0, k - 5) + 9.81, 1e-12);
    EXPECT_EQ(m.feet[0].F_Co_C[2], std::max(0, k - 1));
    EXPECT_EQ(m.feet[0].in_contact, k < 11);
  }
}

TEST(Sensors, DropoutsRepeatTheLastMeasurement) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.dropout = 0.25;
  Sensors sensors(robot, settings, 1);
  PlantState state = MakeState();
  int lost = 0;
  for (int k = 0; k < 4000; ++k) {
    state.time = k;
    if (sensors.Measure(state).time != k) ++lost;
  }
  EXPECT_NEAR(lost, 1000, 110);  // Four deviations of the binomial.
}

TEST(Sensors, RepeatTheLastMeasurementWhileFrozen) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.freeze_at = 0.005;
  settings.freeze_for = 0.003;
  Sensors sensors(robot, settings, 1);
  PlantState state = MakeState();
  for (int k = 0; k < 20; ++k) {
    state.time = 1e-3 * k;
    const bool frozen = k >= 5 && k < 8;
    EXPECT_EQ(sensors.Measure(state).time, frozen ? 0.004 : state.time) << k;
  }
}

TEST(Sensors, SameSeedGivesTheSameErrors) {
  const Robot robot = MakeArmOnABlock();
  SensorSettings settings;
  settings.noise = 1;
  Sensors a(robot, settings, 7), b(robot, settings, 7), c(robot, settings, 8);
  EXPECT_EQ(a.Measure(MakeState()).q_joints, b.Measure(MakeState()).q_joints);
  EXPECT_NE(a.Measure(MakeState()).q_joints, c.Measure(MakeState()).q_joints);
}

// First numbers of the stream for the seed 0, computed by hand with the
// recursion of the reference implementation: 0xe220a8397b1dcdaf,
// 0x6e789e6aa1b965f4.
TEST(RandomStream, IsSplitMix64) {
  RandomStream stream(0);
  EXPECT_EQ(stream.Uniform(),
            static_cast<double>(0xe220a8397b1dcdafULL >> 11) * 0x1p-53);
  EXPECT_EQ(stream.Uniform(),
            static_cast<double>(0x6e789e6aa1b965f4ULL >> 11) * 0x1p-53);
}

}  // namespace
}  // namespace poise
