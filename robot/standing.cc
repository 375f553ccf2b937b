// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/standing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/finding.h"
#include "poise/robot/limits.h"
#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Tolerances on height [m] and tilt [rad]. Postures are measured by hand, and
// files round them.
constexpr double kHeight = 5e-3;
constexpr double kTilt = 0.02;

// Returns whether a point is inside a convex polygon. The corners are in
// counterclockwise order.
bool IsInside(const Vector2d& p, const std::vector<Vector2d>& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d side = polygon[(i + 1) % polygon.size()] - a;
    const Vector2d to_p = p - a;
    if (!(side.x() * to_p.y() - side.y() * to_p.x() >= 0)) return false;
  }
  return polygon.size() > 2;
}

Pose SoleIn(const Tick& tick, const Foot& foot) {
  return tick.X_WB[foot.body] * foot.X_BC;
}

}  // namespace

std::string WhyNoPairOfFeet(const Robot& robot) {
  const Tick tick = NominalTick(robot);
  const Pose X_WL = SoleIn(tick, robot.feet[0]);
  const Pose X_WR = SoleIn(tick, robot.feet[1]);
  if (!(X_WL.R.col(2).dot(X_WR.R.col(2)) > 0)) {
    return "the normals of the two soles point in opposite directions, both "
           "must point out of the ground";
  }
  if (!((X_WL.p - X_WR.p).dot(X_WL.R.col(1) + X_WR.R.col(1)) > 0)) {
    return "left_foot is to the right of right_foot when looking along the "
           "soles' x axes, must be to the left";
  }
  return "";
}

std::string WhyNotStanding(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const JointLimits& limits = robot.model.limits[j];
    const double q = robot.q_nominal[tree.q_start() + j];
    if (!IsWithin(limits, q)) {
      return SayOutside(tree.joints()[j].name, limits, q);
    }
  }
  for (const MimicCoupling& mimic : robot.model.mimics) {
    const double q = robot.q_nominal[tree.q_start() + mimic.joint];
    const double led =
        mimic.multiplier * robot.q_nominal[tree.q_start() + mimic.source] +
        mimic.offset;
    if (std::abs(q - led) <= kTilt) continue;
    return Quoted(tree.joints()[mimic.joint].name) + " is at " +
           PrintNumber(q) + ", must be at " + PrintNumber(led) +
           " because it is coupled to " +
           Quoted(tree.joints()[mimic.source].name);
  }
  const Tick tick = NominalTick(robot);
  std::vector<Vector2d> support;
  std::vector<Pose> X_WF;
  for (const Foot& foot : robot.feet) {
    const Pose& X_WC = X_WF.emplace_back(SoleIn(tick, foot));
    if (!(std::abs(X_WC.p.z()) <= kHeight)) {
      return foot.name + " is " + PrintNumber(X_WC.p.z()) +
             " m above the ground, must be on the ground (z = 0)";
    }
    const double tilt = std::acos(std::min(1.0, X_WC.R(2, 2)));
    if (!(tilt <= kTilt)) {
      return foot.name + " is tilted by " + PrintNumber(tilt) +
             " rad, must lie flat on the ground";
    }
    for (const Vector2d& corner : foot.polygon_C) {
      support.push_back((X_WC * Vector3d(corner.x(), corner.y(), 0)).head<2>());
    }
  }
  const std::string reason = WhyNoPairOfFeet(robot);
  if (!reason.empty()) return reason;
  const Vector3d p_WM = 0.5 * (X_WF[0].p + X_WF[1].p);
  const Vector3d forward = X_WF[0].R.col(0) + X_WF[1].R.col(0);
  if (!(p_WM.head<2>().norm() <= kHeight)) {
    return "the midpoint of the feet is at x = " + PrintNumber(p_WM.x()) +
           ", y = " + PrintNumber(p_WM.y()) + ", must be at the origin";
  }
  const double heading = std::atan2(forward.y(), forward.x());
  if (!(std::abs(heading) <= kTilt)) {
    return "the feet are turned by " + PrintNumber(heading) +
           " rad about z, must point along x";
  }
  if (!(tick.p_WG.z() > 0)) {
    return "the center of mass is " + PrintNumber(-tick.p_WG.z()) +
           " m below the soles, must be above: turn `base` over";
  }
  if (!IsInside(tick.p_WG.head<2>(), ConvexHull(std::move(support)))) {
    return "the center of mass is not over the soles: the robot would fall";
  }
  return "";
}

}  // namespace poise
