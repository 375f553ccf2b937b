// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/crba.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

MatrixXd CrbaOf(const TreeMotion& m) {
  Recursion scratch(m.tree);
  // The function must overwrite old values.
  MatrixXd M = MatrixXd::Constant(m.tree.nv(), m.tree.nv(), 7);
  ComputeCrba(m.tree, m.q, &scratch, M);
  return M;
}

TEST(Crba, AgreesWithColumnsOfRnea) {
  EXPECT_TRUE(HoldsForTrees("M e = tau(e) - tau(0)", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    const int nv = m.tree.nv();
    MatrixXd columns(nv, nv);
    VectorXd tau(nv), N(nv);
    const VectorXd zero = VectorXd::Zero(nv);
    ComputeRnea(m.tree, m.q, zero, zero, {}, &scratch, N);
    for (int j = 0; j < nv; ++j) {
      ComputeRnea(m.tree, m.q, zero, VectorXd::Unit(nv, j), {}, &scratch, tau);
      columns.col(j) = tau - N;
    }
    const MatrixXd M = CrbaOf(m);
    return Compare(M, columns, Rounding(M.norm() + N.norm(), nv + 10));
  }));
}

TEST(Crba, IsSymmetricToTheBit) {
  EXPECT_TRUE(HoldsForTrees("M = M'", [](const TreeMotion& m) {
    const MatrixXd M = CrbaOf(m);
    return Compare(M, M.transpose(), 0);
  }));
}

TEST(Crba, IsPositiveDefinite) {
  EXPECT_TRUE(HoldsForTrees("M > 0", [](const TreeMotion& m) -> Residual {
    const Eigen::LLT<MatrixXd> llt(CrbaOf(m));
    return {llt.info() == Eigen::Success ? 0. : 1., 0};
  }));
}

TEST(Crba, OfADoublePendulumIsTheClosedForm) {
  // Point masses 2 kg and 3 kg at the ends of links of 1 m and 0.5 m.
  TreeBuilder builder;
  builder.AddLink("base");
  builder.AddLink("upper", {2, {1, 0, 0}, Eigen::Matrix3d::Zero()});
  builder.AddLink("lower", {3, {0.5, 0, 0}, Eigen::Matrix3d::Zero()});
  JointSpec joint;
  joint.type = JointType::kRevolute;
  joint.axis_F = Vector3d::UnitZ();
  joint.name = "1";
  joint.parent = "base";
  joint.child = "upper";
  joint.armature = 0.25;
  builder.AddJoint(joint);
  joint.name = "2";
  joint.parent = "upper";
  joint.child = "lower";
  joint.X_PF.p = Vector3d(1, 0, 0);
  joint.armature = 0;
  builder.AddJoint(joint);
  const Tree tree = builder.Build(BaseType::kFixed);
  Recursion scratch(tree);
  MatrixXd M(2, 2), expected(2, 2);
  ComputeCrba(tree, Eigen::Vector2d(0.3, 0.8), &scratch, M);
  const double inner = 3 * 0.25, coupled = 3 * 0.5 * std::cos(0.8);
  expected << 2 + 3 + inner + 2 * coupled + 0.25, inner + coupled,
      inner + coupled, inner;
  EXPECT_NEAR((M - expected).norm(), 0, Rounding(10, 10));
}

TEST(Crba, KeepsItsDigitsAtTheEndOfALongChain) {
  // 1000 links, 300 m: the last one's own inertia, about its joint.
  TreeBuilder builder;
  Inertia M_B{0.5, {0.1, 0, 0}, Eigen::Matrix3d::Identity() * 0.001};
  builder.AddLink("0", M_B);
  for (int i = 1; i <= 1000; ++i) {
    builder.AddLink(std::to_string(i), M_B);
    JointSpec joint;
    joint.name = joint.child = std::to_string(i);
    joint.parent = std::to_string(i - 1);
    joint.type = JointType::kRevolute;
    joint.axis_F = Vector3d::UnitZ();
    joint.X_PF.p.x() = 0.3;
    builder.AddJoint(joint);
  }
  const Tree tree = builder.Build();
  Recursion scratch(tree);
  MatrixXd M(tree.nv(), tree.nv());
  VectorXd q = tree.MakeNeutral();
  q.tail(1000).setConstant(1e-3);
  ComputeCrba(tree, q, &scratch, M);
  const double last = 0.001 + 0.5 * 0.1 * 0.1;
  EXPECT_NEAR(M(1005, 1005), last, Rounding(last, 1000));
}

TEST(Crba, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  Recursion scratch(m.tree);
  MatrixXd M(m.tree.nv(), m.tree.nv());
  CountMalloc count;
  ComputeCrba(m.tree, m.q, &scratch, M);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
