// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/simple_robots.h"

#include <limits>

namespace poise {

Robot MakeRobot(const Tree& tree) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Robot robot{{"simple", tree, {}, {}, {}, {}, 0}, {}, tree.MakeNeutral()};
  robot.model.limits.assign(
      tree.num_joints(),
      JointLimits{-kInfinity, kInfinity, kInfinity, kInfinity});
  return robot;
}

Robot MakeBlock(const Eigen::Vector3d& size, double mass) {
  const Eigen::Vector3d squares = size.cwiseProduct(size);
  Inertia M;
  M.mass = mass;
  M.I_G_B =
      (mass / 12 * (squares.sum() - squares.array())).matrix().asDiagonal();
  Robot robot = MakeRobot(TreeBuilder().AddLink("block", M).Build());
  const double x = size.x() / 2, y = size.y() / 2;
  Foot foot{"foot", 0, 0, {}, {x, y}, {{x, y}, {-x, y}, {-x, -y}, {x, -y}}};
  foot.X_BC.p.z() = -size.z() / 2;
  robot.feet.push_back(foot);
  return robot;
}

Robot MakeBall(double radius, double mass) {
  Inertia M;
  M.mass = mass;
  M.I_G_B = 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity();
  Robot robot = MakeRobot(TreeBuilder().AddLink("ball", M).Build());
  robot.model.collisions.push_back({0, {}, Sphere{radius}, {1, 1, 1, 1}});
  return robot;
}

Robot MakePendulum() {
  Inertia M;
  M.mass = 2;
  M.p_BoG_B = {0, 0, -0.3};
  M.I_G_B = 0.01 * Eigen::Matrix3d::Identity();
  JointSpec hinge;
  hinge.name = "hinge";
  hinge.type = JointType::kRevolute;
  hinge.parent = "base";
  hinge.child = "rod";
  hinge.axis_F = Eigen::Vector3d::UnitY();
  Inertia base;
  base.mass = 1;
  base.I_G_B = Eigen::Matrix3d::Identity();
  return MakeRobot(TreeBuilder()
                       .AddLink("base", base)
                       .AddLink("rod", M)
                       .AddJoint(hinge)
                       .Build(BaseType::kFixed));
}

}  // namespace poise
