// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/estimator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "poise/dynamics/integrate.h"
#include "poise/math/so3.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// A robot sways over the left foot, which does not move. The true motion of the
// base follows from this foot by forward kinematics and numerical
// differentiation.
class EstimatorTest : public testing::Test {
 protected:
  EstimatorTest() {
    measurement_.q_joints = robot_.q_nominal.tail(n_);
    measurement_.v_joints = Eigen::VectorXd::Zero(n_);
    measurement_.feet.resize(2);
    for (FootMeasurement& foot : measurement_.feet) {
      foot.F_Co_C << 0, 0, 0, 0, 0, 190;
    }
    left_ankle_ = *robot_.model.tree.FindJoint("l_ankle_roll");
    right_ankle_ = *robot_.model.tree.FindJoint("r_ankle_roll");
  }

  // Returns the pose of the base for an angle of the left ankle roll; the left
  // foot stays at its place.
  Pose BaseAt(double angle) {
    Eigen::VectorXd q = robot_.q_nominal;
    q[7 + left_ankle_] = angle;
    Tick tick(robot_.model.tree, {robot_.feet[0].frame});
    ComputeTick(robot_.model.tree, robot_.q_nominal,
                Eigen::VectorXd::Zero(n_ + 6), &tick);
    const Pose X_WF = tick.frames[0].X_WF;
    ComputeTick(robot_.model.tree, q, Eigen::VectorXd::Zero(n_ + 6), &tick);
    return X_WF * tick.frames[0].X_WF.Inverse() * tick.X_WB[0];
  }

  void MeasureAt(double t) {
    const double h = 1e-5;
    const auto angle = [](double at) { return 0.05 * std::sin(3 * at); };
    const Pose now = BaseAt(angle(t));
    const Pose next = BaseAt(angle(t + h)), last = BaseAt(angle(t - h));
    measurement_.time = t;
    measurement_.q_joints[left_ankle_] = angle(t);
    measurement_.v_joints[left_ankle_] = 0.15 * std::cos(3 * t);
    measurement_.X_WB = now;
    const Eigen::Vector3d w_W = LogSo3(next.R * last.R.transpose()) / (2 * h);
    measurement_.V_WB_W << w_W, (next.p - last.p) / (2 * h);
    measurement_.w_WB_B = now.R.transpose() * w_W;
    measurement_.R_WB_imu = now.R;
    const Eigen::Vector3d a_W = (next.p - 2 * now.p + last.p) / (h * h);
    measurement_.specific_force_Bo_B =
        now.R.transpose() * (a_W - robot_.model.tree.gravity_W());
    // The right foot is in the air.
    measurement_.feet[1].in_contact = false;
    measurement_.feet[1].F_Co_C.setZero();
  }

  Robot robot_ = LoadHumanoid();
  const int n_ = robot_.model.tree.num_joints();
  Measurement measurement_;
  int left_ankle_, right_ankle_;
};

TEST_F(EstimatorTest, FollowsBaseAboveFootInContact) {
  Estimator estimator(robot_);
  MeasureAt(0);
  estimator.Start(measurement_);
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  for (int i = 1; i <= 500; ++i) {
    MeasureAt(1e-3 * i);
    const Pose X_WB = measurement_.X_WB;
    const Eigen::Matrix<double, 6, 1> V_WB_W = measurement_.V_WB_W;
    measurement_.X_WB.p.setConstant(7);  // Must not be used.
    measurement_.V_WB_W.setConstant(7);
    estimator.Update(measurement_, &state);
    // The position follows from the foot; the velocity filter has 10 ms.
    ASSERT_LT((state.q.head<3>() - X_WB.p).norm(), 1e-9) << i;
    ASSERT_LT((state.v.segment<3>(3) - V_WB_W.tail<3>()).norm(), 2e-3) << i;
    ASSERT_LT((state.v.head<3>() - V_WB_W.head<3>()).norm(), 1e-6) << i;
  }
}

TEST_F(EstimatorTest, IntegratesAccelerometerWithoutContact) {
  Estimator estimator(robot_);
  MeasureAt(0);
  measurement_.V_WB_W.setZero();
  for (FootMeasurement& foot : measurement_.feet) foot.in_contact = false;
  estimator.Start(measurement_);
  measurement_.specific_force_Bo_B.setZero();
  measurement_.R_WB_imu.setIdentity();
  const Eigen::Vector3d start = measurement_.X_WB.p;
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  for (int i = 1; i <= 100; ++i) {
    measurement_.time = 1e-3 * i;
    estimator.Update(measurement_, &state);
  }
  EXPECT_NEAR(state.v[5], -0.981, 1e-9);
  // g t^2 / 2, up to half a step of integration.
  EXPECT_NEAR(state.q[2] - start.z(), -0.5 * 9.81 * 0.01, 1e-3);
}

// The right foot touches down, then the left foot is lifted. The estimate
// continues from the touchdown position of the right foot without a jump.
TEST_F(EstimatorTest, ContinuesWhenFeetChange) {
  Estimator estimator(robot_);
  MeasureAt(0);
  estimator.Start(measurement_);
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  const auto touch = [this](int foot, bool down) {
    measurement_.feet[foot].in_contact = down;
    measurement_.feet[foot].F_Co_C << 0, 0, 0, 0, 0, down ? 190 : 0;
  };
  for (int i = 1; i <= 100; ++i) {
    MeasureAt(1e-3 * i);
    estimator.Update(measurement_, &state);
  }
  // From here on, nothing moves.
  measurement_.v_joints.setZero();
  measurement_.w_WB_B.setZero();
  measurement_.specific_force_Bo_B =
      -measurement_.R_WB_imu.transpose() * robot_.model.tree.gravity_W();
  const Eigen::Vector3d there = measurement_.X_WB.p;
  for (int i = 1; i <= 300; ++i) {
    measurement_.time = 0.1 + 1e-3 * i;
    touch(1, i > 100);
    touch(0, i < 200);
    estimator.Update(measurement_, &state);
    ASSERT_LT((state.q.head<3>() - there).norm(), 1e-9) << i;
  }
  // A foot in contact with less than 5 N is not used.
  touch(1, true);
  measurement_.feet[1].F_Co_C[5] = 4;
  const Eigen::Vector3d v = state.v.segment<3>(3);
  measurement_.specific_force_Bo_B.setZero();
  measurement_.time += 1e-3;
  estimator.Update(measurement_, &state);
  EXPECT_NEAR(state.v[5] - v.z(), -9.81e-3, 1e-12);
}

// After a jump of the clock, the accelerometer is integrated for 50 ms only.
TEST_F(EstimatorTest, LimitsIntegrationOverGapInMeasurements) {
  Estimator estimator(robot_);
  MeasureAt(0);
  measurement_.V_WB_W << 0, 0, 0, 0.3, 0, 0;
  for (FootMeasurement& foot : measurement_.feet) foot.in_contact = false;
  estimator.Start(measurement_);
  measurement_.specific_force_Bo_B.setZero();
  measurement_.time = 2;
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  estimator.Update(measurement_, &state);
  EXPECT_NEAR(state.v[5], -9.81 * 0.05, 1e-9);
  EXPECT_NEAR(state.v[3], 0.3, 1e-9);
}

// After one invalid sample, the base and its time stamp stay unchanged for one
// tick. The next sample bridges the gap. Joint values are passed on unchanged.
TEST_F(EstimatorTest, SkipsInvalidMeasurement) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {none, infinity, -infinity, 1e300}) {
    for (double* sensor :
         {&measurement_.specific_force_Bo_B[1], &measurement_.w_WB_B[0],
          &measurement_.R_WB_imu(2, 1), &measurement_.time,
          &measurement_.q_joints[left_ankle_],
          &measurement_.v_joints[left_ankle_],
          &measurement_.q_joints[right_ankle_]}) {
      SCOPED_TRACE(bad);
      // Any finite time is valid: a clock may be set.
      if (sensor == &measurement_.time && std::isfinite(bad)) continue;
      Estimator estimator(robot_);
      MeasureAt(0);
      estimator.Start(measurement_);
      State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
      State last = state;
      for (int i = 1; i <= 60; ++i) {
        MeasureAt(1e-3 * i);
        if (i == 30) *sensor = bad;
        estimator.Update(measurement_, &state);
        if (i == 30) {
          EXPECT_EQ(state.time, last.time);
          EXPECT_EQ(state.q.head<7>(), last.q.head<7>());
          EXPECT_EQ(state.v.head<6>(), last.v.head<6>());
          // Invalid joint values are passed on, so that the controller fails
          // safe.
          EXPECT_EQ(state.q.tail(n_).allFinite(),
                    measurement_.q_joints.allFinite());
          EXPECT_EQ(state.v.tail(n_).allFinite(),
                    measurement_.v_joints.allFinite());
          measurement_.q_joints[right_ankle_] =
              robot_.q_nominal[7 + right_ankle_];
          continue;
        }
        ASSERT_LT((state.q.head<3>() - measurement_.X_WB.p).norm(), 1e-9) << i;
        ASSERT_LT((state.v.head<6>() - measurement_.V_WB_W).norm(), 2e-3) << i;
        last = state;
      }
    }
  }
}

// In flight, only the accelerometer is used. The next valid sample covers the
// gap: no part of the fall is lost.
TEST_F(EstimatorTest, BridgesInvalidMeasurementsInFlight) {
  Estimator estimator(robot_);
  MeasureAt(0);
  measurement_.V_WB_W.setZero();
  for (FootMeasurement& foot : measurement_.feet) foot.in_contact = false;
  estimator.Start(measurement_);
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  for (int i = 1; i <= 100; ++i) {
    measurement_.time = 1e-3 * i;
    measurement_.specific_force_Bo_B.setConstant(
        i % 3 == 1 ? std::numeric_limits<double>::quiet_NaN() : 0);
    if (i == 100) measurement_.specific_force_Bo_B.setZero();
    estimator.Update(measurement_, &state);
  }
  EXPECT_NEAR(state.v[5], -0.981, 1e-9);
}

// A foot whose force is NaN is not used; the other foot still is.
TEST_F(EstimatorTest, UsesOtherFootWhenForceIsNaN) {
  Estimator estimator(robot_);
  MeasureAt(0);
  measurement_.v_joints.setZero();
  measurement_.w_WB_B.setZero();
  measurement_.V_WB_W.setZero();
  measurement_.specific_force_Bo_B =
      -measurement_.R_WB_imu.transpose() * robot_.model.tree.gravity_W();
  measurement_.feet[1] = measurement_.feet[0];
  estimator.Start(measurement_);
  const Eigen::Vector3d there = measurement_.X_WB.p;
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  for (int i = 1; i <= 100; ++i) {
    measurement_.time = 1e-3 * i;
    const bool unknown = i > 20 && i <= 50;
    measurement_.feet[1].F_Co_C[5] =
        unknown ? std::numeric_limits<double>::quiet_NaN() : 190;
    estimator.Update(measurement_, &state);
    ASSERT_EQ(state.time, measurement_.time);
    ASSERT_LT((state.q.head<3>() - there).norm(), 1e-9) << i;
    ASSERT_LT(state.v.head<6>().norm(), 1e-9) << i;
  }
}

TEST_F(EstimatorTest, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  Estimator estimator(robot_);
  MeasureAt(0);
  estimator.Start(measurement_);
  State state{0, Eigen::VectorXd(n_ + 7), Eigen::VectorXd(n_ + 6)};
  estimator.Update(measurement_, &state);
  CountMalloc count;
  estimator.Update(measurement_, &state);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
