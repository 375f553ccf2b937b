// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/regressor.h"

#include <gtest/gtest.h>

#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Regressor, TimesParametersIsRnea) {
  EXPECT_TRUE(HoldsForTrees("Y pi = tau", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    const VectorXd pi = MakeInertialParameters(m.tree);
    // The function must overwrite old values.
    MatrixXd Y = MatrixXd::Constant(m.tree.nv(), pi.size(), 7);
    VectorXd tau(m.tree.nv());
    ComputeRegressor(m.tree, m.q, m.v, m.vdot, &scratch, Y);
    ComputeRnea(m.tree, m.q, m.v, m.vdot, {}, &scratch, tau);
    return Compare(Y * pi, tau,
                   Rounding(Y.norm() * pi.norm() + 1, m.tree.nv() + 10));
  }));
}

TEST(InertialParameters, AreAboutTheBodysOrigin) {
  // 2 kg at (1, 2, 3), I_G with six different numbers.
  Inertia M_B{2, {1, 2, 3}, Eigen::Matrix3d()};
  M_B.I_G_B << 20, 1, 2, 1, 21, 3, 2, 3, 22;
  JointSpec joint;
  joint.name = "joint";
  joint.type = JointType::kRevolute;
  joint.parent = "base";
  joint.child = "body";
  joint.armature = 0.5;
  const Tree tree = TreeBuilder()
                        .AddLink("base")
                        .AddLink("body", M_B)
                        .AddJoint(joint)
                        .Build();
  VectorXd expected = VectorXd::Zero(21);
  expected.segment<10>(10) << 2, 2, 4, 6, 20 + 2 * 13, 21 + 2 * 10, 22 + 2 * 5,
      1 - 2 * 2, 2 - 2 * 3, 3 - 2 * 6;
  expected[20] = 0.5;
  EXPECT_EQ(MakeInertialParameters(tree), expected);
}

TEST(Regressor, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  Recursion scratch(m.tree);
  MatrixXd Y(m.tree.nv(), 10 * m.tree.num_bodies() + m.tree.num_joints());
  CountMalloc count;
  ComputeRegressor(m.tree, m.q, m.v, m.vdot, &scratch, Y);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
