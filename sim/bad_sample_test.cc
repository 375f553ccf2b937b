// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that the robot stays standing when a sensor is wrong for a tick, or
// noisy.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>

#include "poise/robot/control/controller.h"
#include "poise/robot/control/estimator.h"
#include "poise/robot/control/measurement.h"
#include "poise/sim/plants/make_plant.h"
#include "poise/sim/scenario.h"
#include "poise/sim/sensors.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

struct Stand {
  int failed = 0;    // Ticks that failed safe.
  int in_air = 0;    // Ticks in which the controller had lost a contact.
  double moved = 0;  // Largest distance of the base from its start, m.
};

// Stands for a number of ticks of 1 ms. `spoil` changes each measurement. The
// base is the measured one or, with `estimates`, the estimated one.
Stand StandOn(const std::function<void(int, Measurement*)>& spoil, int ticks,
              bool estimates, const SensorSettings& settings = {}) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  const int n = tree.num_joints();
  const auto plant = MakePlant(robot, "bullet", {});
  State state{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  plant->Reset(state.q, state.v);
  Controller controller(robot);
  controller.Start(state);
  Sensors sensors(robot, settings, 1);
  Estimator estimator(robot);
  estimator.Start(sensors.Measure(plant->Sense()));
  Command command;
  command.tau.setZero(n);
  Stand stand;
  for (int i = 0; i < ticks; ++i) {
    Measurement measurement = sensors.Measure(plant->Sense());
    spoil(i, &measurement);
    if (estimates) {
      estimator.Update(measurement, &state);
    } else {
      state.time = measurement.time;
      state.q << measurement.X_WB.p,
          Eigen::Quaterniond(measurement.X_WB.R).coeffs(), measurement.q_joints;
      state.v << measurement.V_WB_W, measurement.v_joints;
    }
    controller.Update(state, &command);
    stand.failed += command.status == TickStatus::kFailSafe;
    const auto& contacts = controller.contacts();
    stand.in_air += !(contacts[0].in_contact && contacts[1].in_contact);
    plant->Step(command.tau);
    stand.moved = std::max(
        stand.moved, (plant->Sense().q - robot.q_nominal).head<3>().norm());
  }
  return stand;
}

// An estimator can be wrong by this much for a tick. No foot rises so fast, so
// the controller must keep the contact.
TEST(BadSample, KeepsContactAfterASpikeOfTheHeight) {
  for (const double spike : {0.03, 0.1, -0.03}) {
    const Stand stand = StandOn(
        [spike](int i, Measurement* measurement) {
          if (i % 200 == 100) measurement->X_WB.p.z() += spike;
        },
        1000, false);
    EXPECT_EQ(stand.failed, 0) << spike;
    EXPECT_EQ(stand.in_air, 0) << spike;
    EXPECT_LT(stand.moved, 2e-3) << spike;
  }
}

// The error of the height is sometimes above the threshold at which a foot is
// lost, but never for the whole debounce time. All other noise is on too, also
// that of the velocities.
TEST(BadSample, KeepsContactWithNoiseOfTheHeight) {
  SensorSettings settings;
  settings.noise = 1;
  settings.base_position = 6e-3;
  const Stand stand = StandOn([](int, Measurement*) {}, 4000, false, settings);
  EXPECT_EQ(stand.failed, 0);
  EXPECT_EQ(stand.in_air, 0);
  EXPECT_LT(stand.moved, 5e-3);
}

// Ten times a second one sensor returns NaN.
TEST(BadSample, KeepsTheEstimateForOneTickOnNaN) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  int spoilt = 0, joints = 0;
  const Stand stand = StandOn(
      [&](int i, Measurement* measurement) {
        if (i % 100 != 50) return;
        const int sensor = spoilt++ % 5;
        if (sensor == 0) measurement->specific_force_Bo_B.x() = none;
        if (sensor == 1) measurement->w_WB_B.y() = none;
        if (sensor == 2) measurement->R_WB_imu(0, 0) = none;
        if (sensor == 3) measurement->feet[0].F_Co_C[5] = none;
        if (sensor == 4) {
          measurement->q_joints[10] = none;
          ++joints;
        }
      },
      2000, true);
  EXPECT_EQ(joints, 4);
  EXPECT_EQ(stand.failed, joints);
  EXPECT_EQ(stand.in_air, 0);
  EXPECT_LT(stand.moved, 2e-3);
}

}  // namespace
}  // namespace poise
