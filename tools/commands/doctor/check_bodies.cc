// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/check_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "poise/dynamics/kinematics.h"
#include "poise/math/inertia.h"
#include "poise/robot/feet/legs.h"
#include "poise/robot/feet/outline.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// The measures of a leg.
struct Leg {
  int joints = 0;
  double length = 0;  // Sum of the distances between its joints, m.
  double mass = 0;    // kg.
};

Leg Measure(const Tree& tree, int foot) {
  Leg leg;
  for (int b = foot; b > 0; b = tree.joints()[b - 1].parent) {
    ++leg.joints;
    if (tree.joints()[b - 1].parent > 0) {
      leg.length += tree.joints()[b - 1].X_PF.p.norm();
    }
    leg.mass += tree.inertias()[b].mass;
  }
  return leg;
}

// A biped has at least as many joints.
constexpr int kFewestJoints = 8;

// Returns the diagonal of the box around the origins of all bodies at rest, m.
double ExtentAtRest(const RobotModel& model) {
  std::vector<Pose> X_WB(model.tree.num_bodies());
  ComputePoses(model.tree, RestConfiguration(model), &X_WB);
  Vector3d low = Vector3d::Zero(), high = low;
  for (const Pose& X : X_WB) {
    low = low.cwiseMin(X.p);
    high = high.cwiseMax(X.p);
  }
  return (high - low).norm();
}

bool Differ(double a, double b, double fraction) {
  return std::abs(a - b) > fraction * std::max(std::abs(a), std::abs(b));
}

}  // namespace

std::vector<Finding> CompareLegs(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  const Foot& left = robot.feet[0];
  const Foot& right = robot.feet[1];
  const Leg a = Measure(tree, left.body);
  const Leg b = Measure(tree, right.body);
  std::vector<Finding> findings;
  const auto add = [&](const std::string& what, const std::string& values) {
    findings.push_back({Severity::kWarn, "legs",
                        "left and right differ in " + what + ": " + values,
                        "control assumes what the file says", 0});
  };
  const auto compare = [&](const std::string& what, double x, double y,
                           const std::string& unit) {
    add(what, PrintNumber(x) + unit + " and " + PrintNumber(y) + unit);
  };
  if (a.joints != b.joints) {
    add("the number of joints", std::to_string(a.joints) + " to " +
                                    Quoted(tree.frames()[left.frame].name) +
                                    " and " + std::to_string(b.joints) +
                                    " to " +
                                    Quoted(tree.frames()[right.frame].name));
  }
  if (Differ(a.length, b.length, 0.01)) {
    compare("length", a.length, b.length, " m");
  }
  if (Differ(a.mass, b.mass, 0.02)) compare("mass", a.mass, b.mass, " kg");
  for (const int i : {0, 1}) {
    if (!Differ(left.half_size[i], right.half_size[i], 0.05)) continue;
    compare(i == 0 ? "the sole's length" : "the sole's width",
            2 * left.half_size[i], 2 * right.half_size[i], " m");
  }
  const double from_left = left.X_BC.p.norm();
  const double from_right = right.X_BC.p.norm();
  if (std::abs(from_left - from_right) > 0.02 * std::max(a.length, b.length)) {
    compare("the sole's distance from the foot's origin", from_left, from_right,
            " m");
  }
  return findings;
}

std::vector<Finding> FindWideInertias(const RobotModel& model) {
  constexpr double kTolerance = 1.5;
  constexpr int kNamed = 3;
  const Tree& tree = model.tree;
  const std::vector<Outline> outlines = MakeOutlines(model);
  const double extent = ExtentAtRest(model);
  // A mesh that was not opened may reach further than the other shapes.
  std::vector<bool> has_mesh(tree.num_bodies());
  for (const std::vector<Shape>* shapes : {&model.visuals, &model.collisions}) {
    for (const Shape& shape : *shapes) {
      if (!std::holds_alternative<Mesh>(shape.geometry)) continue;
      has_mesh[tree.frames()[shape.frame].body] = true;
    }
  }
  int count = 0;
  std::string names;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M = tree.inertias()[b];
    if (!(M.mass > 0) || !M.I_G_B.allFinite()) continue;
    // A part of a robot says nothing about the size of a body.
    const bool is_known = !outlines[b].corners.empty() && !has_mesh[b];
    if (!is_known && tree.num_joints() < kFewestJoints) continue;
    double reach = is_known ? 0 : extent;
    for (const Outline::Corner& corner : outlines[b].corners) {
      reach = std::max(reach, (corner.p_B - M.p_BoG_B).norm() + corner.radius);
    }
    const double largest = PrincipalMoments(M.I_G_B)[2];
    const double radius = std::sqrt(std::max(0., largest) / M.mass);
    if (!(reach > 0) || radius <= kTolerance * reach) continue;
    if (++count > kNamed) continue;
    names += (count > 1 ? ", " : "") + Quoted(LinkOf(model, b)) + " (" +
             PrintNumber(radius) + " m, its shapes reach " +
             PrintNumber(reach) + " m)";
  }
  if (count == 0) return {};
  if (count > kNamed) names += ", ...";
  return {{Severity::kWarn, "robot",
           "has " + std::to_string(count) + (count == 1 ? " body" : " bodies") +
               " with a radius of gyration beyond its shapes: " + names,
           "the inertia is too large for the mass: is it in another unit?", 0}};
}

std::optional<Finding> FindWrongUnits(const RobotModel& model) {
  constexpr double kThinnest = 0.3, kDensest = 3000;  // kg/m3.
  if (model.tree.num_joints() < kFewestJoints) return std::nullopt;
  const double mass = model.tree.total_mass();
  const double extent = ExtentAtRest(model);
  const double volume = extent * extent * extent;
  if (mass >= kThinnest * volume && mass <= kDensest * volume) {
    return std::nullopt;
  }
  return Finding{
      Severity::kWarn, "robot",
      "has a mass of " + PrintNumber(mass) + " kg, and its joints span " +
          PrintNumber(extent) + " m",
      "is the file in other units, such as grams or millimeters? URDF has kg "
      "and m",
      0};
}

std::vector<Finding> FindFarSoles(const Robot& robot) {
  constexpr double kFar = 0.5;
  std::vector<Finding> findings;
  for (const Foot& foot : robot.feet) {
    const double leg = Measure(robot.model.tree, foot.body).length;
    const double distance = foot.X_BC.p.norm();
    // A foot that is the base has no leg.
    if (leg == 0 || distance <= kFar * leg) continue;
    findings.push_back(
        {Severity::kWarn, foot.name,
         "has its sole " + PrintNumber(distance) +
             " m from the last joint of a leg of " + PrintNumber(leg) + " m",
         "is the sole in another unit, or its frame another link?", 0});
  }
  return findings;
}

}  // namespace poise
