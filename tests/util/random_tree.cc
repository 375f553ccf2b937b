// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/random_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace poise {

namespace {

double Uniform(std::mt19937* draw) {
  // Scales 32 bits itself, because the standard does not specify which numbers
  // its distributions return.
  return 2 * static_cast<double>((*draw)()) / 4294967295.0 - 1;
}

Inertia MakeRandomInertia(std::mt19937* draw) {
  Inertia M;
  M.mass = 1 + 0.9 * Uniform(draw);
  M.p_BoG_B = 0.1 * MakeRandomVector(3, draw);
  // This is the inertia of a cloud of points with the second moments S.
  Eigen::Matrix3d points;
  for (int i = 0; i < 3; ++i) points.col(i) = MakeRandomVector(3, draw);
  const Eigen::Matrix3d product = 0.01 * M.mass * points * points.transpose();
  const Eigen::Matrix3d S = (product + product.transpose()) / 2;
  M.I_G_B = S.trace() * Eigen::Matrix3d::Identity() - S;
  return M;
}

std::string LinkName(int i) { return "link" + std::to_string(i); }

}  // namespace

Eigen::VectorXd MakeRandomVector(int size, std::mt19937* draw) {
  Eigen::VectorXd x(size);
  for (int i = 0; i < size; ++i) x[i] = Uniform(draw);
  return x;
}

Tree MakeRandomTree(int num_joints, std::mt19937* draw, BaseType base,
                    const Eigen::Vector3d& gravity_W) {
  TreeBuilder builder;
  builder.SetGravity(gravity_W);
  builder.AddLink(LinkName(0), MakeRandomInertia(draw));
  for (int i = 1; i <= num_joints; ++i) {
    builder.AddLink(LinkName(i), MakeRandomInertia(draw));
    JointSpec joint;
    joint.name = "joint" + std::to_string(i);
    joint.type = i % 5 == 0 ? JointType::kPrismatic : JointType::kRevolute;
    // The parent is one of the last six links, which gives both branches and
    // long chains.
    const int first = std::max(0, i - 6);
    joint.parent = LinkName(first + static_cast<int>((*draw)() % (i - first)));
    joint.child = LinkName(i);
    const Eigen::Vector3d rotation = 2 * MakeRandomVector(3, draw);
    joint.X_PF.R = Eigen::AngleAxisd(rotation.norm(), rotation.normalized())
                       .toRotationMatrix();
    joint.X_PF.p = 0.2 * MakeRandomVector(3, draw);
    joint.axis_F = MakeRandomVector(3, draw).normalized();
    builder.AddJoint(joint);
  }
  return builder.Build(base);
}

Eigen::VectorXd MakeRandomConfiguration(const Tree& tree, std::mt19937* draw) {
  Eigen::VectorXd q = MakeRandomVector(tree.nq(), draw);
  if (tree.is_floating()) q.segment<4>(3).normalize();
  return q;
}

}  // namespace poise
