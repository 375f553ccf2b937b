// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/side_defects.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/feet/leg_names.h"
#include "poise/robot/feet/legs.h"

namespace poise {
namespace {

using Eigen::Vector3d;

constexpr double kLargestAngle = 15;  // Degrees.

// Returns the two legs: they begin where the chains to the feet part.
Legs LegsOf(const Robot& robot) {
  const std::array<int, 2> feet = {robot.feet[0].body, robot.feet[1].body};
  Legs legs{feet, feet, Vector3d::UnitZ(), 0};
  std::array<int, 2> at = feet;
  while (at[0] != at[1]) {
    const int i = at[0] > at[1] ? 0 : 1;  // A parent has a smaller index.
    legs.hips[i] = at[i];
    at[i] = robot.model.tree.joints()[at[i] - 1].parent;
  }
  return legs;
}

// Returns the angle between the line from the right to the left sole and the y
// axis of the soles, at rest, in degrees.
double AngleOfFeet(const Robot& robot) {
  const std::vector<Pose> X_BB = RestPoses(robot.model);
  const Pose X_BL = X_BB[robot.feet[0].body] * robot.feet[0].X_BC;
  const Pose X_BR = X_BB[robot.feet[1].body] * robot.feet[1].X_BC;
  const Vector3d apart = X_BL.p - X_BR.p;
  const Vector3d left = X_BL.R.col(1) + X_BR.R.col(1);
  const Vector3d forward = X_BL.R.col(0) + X_BR.R.col(0);
  return std::atan2(std::abs(apart.dot(forward.normalized())),
                    apart.dot(left.normalized())) *
         180 / M_PI;
}

// Returns whether most names between a hip and a foot name parts of an arm.
bool IsArm(const RobotModel& model, int hip, int foot) {
  const Tree& tree = model.tree;
  int words = 0;
  for (int b = foot; b >= hip && b > 0; b = tree.joints()[b - 1].parent) {
    words += LegOrArm(tree.joints()[b - 1].name) + LegOrArm(LinkOf(model, b));
  }
  return words < 0;
}

}  // namespace

std::vector<Finding> FindSideDefects(const Robot& robot, const Sides& sides,
                                     bool gives_feet) {
  std::vector<Finding> findings;
  const auto warn = [&](const std::string& where, const std::string& what,
                        const std::string& why) {
    findings.push_back({Severity::kWarn, where, what, why, 0});
  };
  const RobotModel& model = robot.model;
  const double angle = AngleOfFeet(robot);
  if (sides.forward.text.empty() && !(angle <= kLargestAngle)) {
    const std::string axis = ForwardAxis(robot);
    warn("forward direction",
         "is taken as " + (axis.empty() ? "no axis" : axis) + " of link " +
             Quoted(model.tree.frames()[model.root_frame].name) +
             ", but the line between the feet is " +
             std::to_string(std::lround(angle)) +
             " degrees off the left of this direction",
         "write 'forward: " + (axis.empty() ? "+x" : axis) +
             "' in the profile to confirm, or another axis; if the robot "
             "faces along no axis, give `feet` with their rpy");
  }
  const bool gives_sides = gives_feet || !sides.left.text.empty();
  if (!gives_sides && sides.forward.text.empty()) return findings;
  const Legs legs = LegsOf(robot);
  bool contradict = false;
  if (LeftByNames(model, legs, &contradict) < 0) {
    warn("left and right",
         "are swapped in the profile: left_foot is " +
             Quoted(LinkOf(model, legs.feet[0])) + ", right_foot is " +
             Quoted(LinkOf(model, legs.feet[1])),
         gives_sides ? "by the names of the legs: exchange them if the names "
                       "are right"
                     : "by the names of the legs: give the opposite forward "
                       "if the names are right");
  }
  for (const int i : {0, 1}) {
    if (!gives_sides || !IsArm(model, legs.hips[i], legs.feet[i])) continue;
    warn(robot.feet[i].name,
         "is at the end of an arm, by the names from link " +
             Quoted(LinkOf(model, legs.hips[i])) + " to link " +
             Quoted(LinkOf(model, legs.feet[i])),
         "give the feet of the legs in the profile");
  }
  return findings;
}

}  // namespace poise
