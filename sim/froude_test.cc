// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The humanoid, scaled by Froude's rule, moves as the humanoid does.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

#include "poise/sim/run.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Returns a geometry with all lengths multiplied.
Geometry Scaled(Geometry geometry, double s) {
  if (auto* sphere = std::get_if<Sphere>(&geometry)) sphere->radius *= s;
  if (auto* box = std::get_if<Box>(&geometry)) box->size *= s;
  if (auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    cylinder->radius *= s;
    cylinder->length *= s;
  }
  return geometry;
}

Pose Scaled(Pose X, double s) {
  X.p *= s;
  return X;
}

// Returns the tree with lengths times s and masses times s^3.
Tree Scaled(const Tree& tree, double s) {
  std::vector<std::string> names(tree.num_bodies());
  TreeBuilder builder;
  for (const Frame& frame : tree.frames()) {
    const bool is_body = names[frame.body].empty();
    if (is_body) names[frame.body] = frame.name;
    Inertia M;
    if (is_body) {
      M = tree.inertias()[frame.body];
      M.mass *= std::pow(s, 3);
      M.p_BoG_B *= s;
      M.I_G_B *= std::pow(s, 5);
    }
    builder.AddLink(frame.name, M);
    if (is_body) continue;
    JointSpec fixed;
    fixed.name = frame.name + "_fixed";
    fixed.parent = names[frame.body];
    fixed.child = frame.name;
    fixed.X_PF = Scaled(frame.X_BF, s);
    builder.AddJoint(fixed);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    builder.AddJoint({joint.name, joint.type, names[joint.parent], names[j + 1],
                      Scaled(joint.X_PF, s), joint.axis_F,
                      joint.armature * std::pow(s, 5)});
  }
  return builder.Build();
}

// Returns the robot with lengths times s, masses times s^3, and times, which
// the limits of the velocities have in their unit, times sqrt(s). All joints
// are revolute.
Robot Scaled(Robot robot, double s) {
  const Tree old = robot.model.tree;
  robot.model.tree = Scaled(old, s);
  const auto frame = [&](int i) {
    return robot.model.tree.FindFrame(old.frames()[i].name).value();
  };
  for (JointLimits& limits : robot.model.limits) {
    limits.velocity /= std::sqrt(s);
    limits.effort *= std::pow(s, 4);
    limits.damping *= std::pow(s, 4.5);
    limits.friction *= std::pow(s, 4);
  }
  for (Shape& shape : robot.model.collisions) {
    shape.frame = frame(shape.frame);
    shape.X_FS = Scaled(shape.X_FS, s);
    shape.geometry = Scaled(shape.geometry, s);
  }
  robot.model.visuals.clear();
  robot.model.root_frame = frame(robot.model.root_frame);
  for (Foot& foot : robot.feet) {
    foot.frame = frame(foot.frame);
    foot.X_BC = Scaled(foot.X_BC, s);
    foot.half_size *= s;
    for (Eigen::Vector2d& corner : foot.polygon_C) corner *= s;
  }
  robot.q_nominal.head<3>() *= s;
  return robot;
}

// Returns the scenario for the scaled robot. Control and simulation have the
// same number of ticks, so that their discretisation errors scale, too.
Scenario Scaled(Scenario scenario, double s) {
  const double time = std::sqrt(s);
  scenario.duration *= time;
  scenario.control.dt *= time;
  scenario.plant.dt *= time;
  scenario.start.drop *= s;
  for (Push& push : scenario.pushes) {
    push.force *= std::pow(s, 3);
    push.start *= time;
    push.duration *= time;
  }
  for (StanceEvent& event : scenario.stance) {
    event.at *= time;
    event.over *= time;
    event.height *= s;
  }
  return scenario;
}

Scenario Pushed(double x, double y, double at, double duration) {
  Scenario scenario;
  scenario.name = "pushed";
  scenario.duration = duration;
  scenario.start.drop = 0.002;
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {x, y, 0};
  scenario.pushes[0].start = at;
  return scenario;
}

// Expects that the CoM of the humanoid, scaled by some factors, moves as far as
// that of the humanoid, in units of their lengths.
void ExpectAlike(const Scenario& scenario, const std::vector<double>& scales) {
  const Robot robot = LoadHumanoid();
  const Eigen::Vector3d whole =
      poise::Run(robot, scenario).verdict.com_error_peak;
  for (const double s : scales) {
    SCOPED_TRACE(s);
    const RunResult result = poise::Run(Scaled(robot, s), Scaled(scenario, s));
    EXPECT_FALSE(result.verdict.fell_at);
    EXPECT_TRUE(result.commanded_done.value_or(true));
    const Eigen::Vector3d peak = result.verdict.com_error_peak / s;
    // 1 % of the largest peak: the simulator's contact margins do not scale.
    EXPECT_LT((peak - whole).norm(), 0.01 * whole.norm())
        << peak.transpose() << " m instead of " << whole.transpose();
  }
}

// The peaks occur within 0.5 s of the push.
TEST(Froude, AlikeRobotsCatchAPushForward) {
  // The capture blend is above 0.
  ExpectAlike(Pushed(60, 0, 0.15, 0.8), {0.3, 3});
}

TEST(Froude, AlikeRobotsCatchAStrongPushSideways) {
  ExpectAlike(Pushed(0, 100, 0.15, 0.8), {3});
}

TEST(Froude, AlikeRobotsStandOnOneLeg) {
  Scenario scenario = Pushed(0, 15, 1.2, 1.7);
  StanceEvent shift;
  shift.at = 0.1;
  shift.foot = "left_foot";
  shift.over = 0.5;
  StanceEvent lift = shift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.foot = "right_foot";
  lift.at = 0.7;
  scenario.stance = {shift, lift};
  ExpectAlike(scenario, {0.3});
}

}  // namespace
}  // namespace poise
