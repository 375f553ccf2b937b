// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "poise/sim/closed_loop.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kEnd = 1.2;          // s; the push begins at 0.2 s.
constexpr double kSameWithin = 1e-3;  // m; measured: 4e-6.
constexpr double kFarthest = 0.035;   // m; the push moves the CoM farther.

Scenario Pushed(const Eigen::Vector3d& force) {
  Scenario scenario = LoadScenario("sim/scenarios/strong_push.yaml");
  scenario.start.joints = 0;  // Random offsets would differ between both sides.
  scenario.pushes[0].start = 0.2;
  scenario.pushes[0].force = force;
  return scenario;
}

// Returns the path of the center of mass, relative to its start.
std::vector<Eigen::Vector3d> Path(const Scenario& scenario) {
  static const Robot robot = LoadHumanoid();
  ClosedLoop loop(robot, scenario);
  std::vector<Eigen::Vector3d> path;
  while (loop.time() < kEnd) {
    loop.Tick();
    path.push_back(loop.observation().com);
  }
  const Eigen::Vector3d start = path[0];
  for (Eigen::Vector3d& point : path) point -= start;
  return path;
}

// Returns the reference path: pushed to the left, at the origin, heading 0.
const std::vector<Eigen::Vector3d>& Plain() {
  static const auto path = Path(Pushed({20, 100, 0}));
  return path;
}

// Expects that a path, transformed by `back`, is the reference path.
void ExpectSame(const std::vector<Eigen::Vector3d>& path,
                const Eigen::Matrix3d& back) {
  ASSERT_EQ(path.size(), Plain().size());
  double worst = 0, farthest = 0;
  for (size_t k = 0; k < path.size(); ++k) {
    worst = std::max(worst, (back * path[k] - Plain()[k]).norm());
    farthest = std::max(farthest, Plain()[k].norm());
  }
  EXPECT_LT(worst, kSameWithin);
  EXPECT_GT(farthest, kFarthest);
  testing::Test::RecordProperty("worst_um", std::to_string(1e6 * worst));
}

TEST(Invariance, MirroredPushGivesTheMirroredPath) {
  ExpectSame(Path(Pushed({20, -100, 0})),
             Eigen::Vector3d(1, -1, 1).asDiagonal());
}

TEST(Invariance, PathDoesNotDependOnTheHeading) {
  for (const double heading : {M_PI / 6, M_PI / 2}) {
    SCOPED_TRACE(heading);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Scenario turned = Pushed(R * Eigen::Vector3d(20, 100, 0));
    turned.start.heading = heading;
    ExpectSame(Path(turned), R.transpose());
  }
}

TEST(Invariance, PathDoesNotChangeAKilometerAway) {
  Scenario away = Pushed({20, 100, 0});
  away.start.place = {800, -600};
  ExpectSame(Path(away), Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace poise
