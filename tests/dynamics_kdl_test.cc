// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares inverse dynamics with another library, Orocos KDL, on random trees.
// dynamics_bullet_test.cc compares with a second library. Forward dynamics are
// compared with Bullet's in sim/plants/bullet/bullet_plant_test.cc.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <map>
#include <string>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/kdl_tree.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Converts the angles of KDL's base, about x, y and z, to Poise's rotation and
// angular velocity w of the base:
//     w = E rates,   w' = E rates' + E' rates.
struct BaseAngles {
  BaseAngles(const Vector3d& angles, const Vector3d& rates) {
    const AngleAxisd R_x(angles.x(), Vector3d::UnitX());
    const AngleAxisd R_y(angles.y(), Vector3d::UnitY());
    const AngleAxisd R_z(angles.z(), Vector3d::UnitZ());
    R_WB = R_x * R_y * R_z;
    E << Vector3d::UnitX(), R_x * Vector3d::UnitY(),
        R_x * (R_y * Vector3d::UnitZ());
    const Vector3d w_x = rates.x() * E.col(0);
    const Vector3d w_xy = w_x + rates.y() * E.col(1);
    E_dot << Vector3d::Zero(), w_x.cross(E.col(1)), w_xy.cross(E.col(2));
  }
  Eigen::Quaterniond R_WB;
  Matrix3d E, E_dot;
};

// Computes KDL's inverse dynamics of a motion, in the tree's order. For a
// floating base, the first three entries of m.v and m.vdot are the first and
// second derivatives of the three angles. The first three entries of the result
// are the generalised forces of these angles.
VectorXd KdlOf(const TreeMotion& m, const Vector3d& angles) {
  const Tree& tree = m.tree;
  const KDL::Tree kdl = MakeKdlTree(tree);
  const std::vector<int> numbers = KdlJoints(tree, kdl);
  const int offset = tree.is_floating() ? 6 : 0;
  KDL::JntArray q(tree.num_joints() + offset), qd = q, qdd = q, torques = q;
  for (int i = 0; i < offset; ++i) {
    q(i) = i < 3 ? m.q[i] : angles[i - 3];
    qd(i) = m.v[(i + 3) % 6];
    qdd(i) = m.vdot[(i + 3) % 6];
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    q(numbers[j]) = m.q[tree.q_start() + j];
    qd(numbers[j]) = m.v[tree.v_start() + j];
    qdd(numbers[j]) = m.vdot[tree.v_start() + j];
  }
  // KDL expects each force in the axes of its body.
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, m.q, &X_WB);
  std::map<std::string, KDL::Wrench> forces;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Vector3d n = X_WB[b].R.transpose() * m.F_Bo_W[b].angular;
    const Vector3d f = X_WB[b].R.transpose() * m.F_Bo_W[b].linear;
    forces[KdlBodyName(b)] = KDL::Wrench(KDL::Vector(f.x(), f.y(), f.z()),
                                         KDL::Vector(n.x(), n.y(), n.z()));
  }
  const Vector3d& g = tree.gravity_W();
  KDL::TreeIdSolver_RNE solver(kdl, KDL::Vector(g.x(), g.y(), g.z()));
  EXPECT_EQ(solver.CartToJnt(q, qd, qdd, forces, torques), 0);
  VectorXd tau(tree.nv());
  for (int i = 0; i < offset; ++i) tau[(i + 3) % 6] = torques(i);
  for (int j = 0; j < tree.num_joints(); ++j) {
    tau[tree.v_start() + j] = torques(numbers[j]);
  }
  return tau;
}

TEST(Rnea, AgreesWithKdl) {
  EXPECT_TRUE(HoldsForTrees("tau", [](const TreeMotion& original) {
    TreeMotion m = original, angular = original;
    const bool floating = m.tree.is_floating();
    const Vector3d angles =
        floating ? Vector3d(m.q.segment<3>(3) * 3) : Vector3d::Zero();
    const BaseAngles base(angles, floating ? Vector3d(m.v.head<3>()) : angles);
    if (floating) {
      m.q.segment<4>(3) = angular.q.segment<4>(3) = base.R_WB.coeffs();
      m.v.head<3>() = base.E * angular.v.head<3>();
      m.vdot.head<3>() =
          base.E * angular.vdot.head<3>() + base.E_dot * angular.v.head<3>();
    }
    Recursion scratch(m.tree);
    VectorXd tau(m.tree.nv());
    ComputeRnea(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &scratch, tau);
    if (floating) tau.head<3>() = (base.E.transpose() * tau.head<3>()).eval();
    return Compare(tau, KdlOf(angular, angles),
                   Rounding(1000 + 10 * tau.norm(), m.tree.nv() + 10));
  }));
}

}  // namespace
}  // namespace poise
