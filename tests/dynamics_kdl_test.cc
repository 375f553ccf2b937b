// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Inverse dynamics against another library's, Orocos KDL, on random trees.

#include <gtest/gtest.h>

#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include "dynamics/rnea.h"
#include "tests/util/kdl_tree.h"
#include "tests/util/tolerance.h"
#include "tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::VectorXd;

// KDL's inverse dynamics of the joints, in the tree's order, with the base at
// the identity: KDL's rates of its base joints are then v and w.
VectorXd KdlOf(const TreeMotion& m) {
  const Tree& tree = m.tree;
  const KDL::Tree kdl = MakeKdlTree(tree);
  const std::vector<int> numbers = KdlJoints(tree, kdl);
  const int offset = tree.is_floating() ? 6 : 0;
  KDL::JntArray q(tree.num_joints() + offset), qd = q, qdd = q, torques = q;
  for (int i = 0; i < offset; ++i) {
    qd(i) = m.v[(i + 3) % 6];
    qdd(i) = m.vdot[(i + 3) % 6];
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    q(numbers[j]) = m.q[tree.q_start() + j];
    qd(numbers[j]) = m.v[tree.v_start() + j];
    qdd(numbers[j]) = m.vdot[tree.v_start() + j];
  }
  const Eigen::Vector3d& g = tree.gravity_W();
  KDL::TreeIdSolver_RNE solver(kdl, KDL::Vector(g.x(), g.y(), g.z()));
  EXPECT_EQ(solver.CartToJnt(q, qd, qdd, {}, torques), 0);
  VectorXd tau(tree.nv());
  for (int i = 0; i < offset; ++i) tau[(i + 3) % 6] = torques(i);
  for (int j = 0; j < tree.num_joints(); ++j) {
    tau[tree.v_start() + j] = torques(numbers[j]);
  }
  return tau;
}

TEST(Rnea, AgreesWithKdl) {
  EXPECT_TRUE(HoldsForTrees("tau", [](const TreeMotion& original) {
    TreeMotion m = original;
    if (m.tree.is_floating()) {
      m.q.head<7>() = m.tree.MakeNeutral().head<7>();
      // The rates of three angles are w, but their accelerations are w's
      // derivative only where the base does not turn.
      m.v.head<3>().setZero();
    }
    Recursion scratch(m.tree);
    VectorXd tau(m.tree.nv());
    ComputeRnea(m.tree, m.q, m.v, m.vdot, {}, &scratch, tau);
    return Compare(tau, KdlOf(m),
                   Rounding(1000 + 10 * tau.norm(), m.tree.nv() + 10));
  }));
}

}  // namespace
}  // namespace poise
