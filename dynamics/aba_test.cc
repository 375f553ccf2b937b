// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/aba.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>

#include "poise/dynamics/crba.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Forward {
  AbaStatus status;
  VectorXd vdot;
};

Forward AbaOf(const Tree& tree, const VectorXd& q, const VectorXd& v,
              const VectorXd& tau, const std::vector<SpatialForce>& F_Bo_W) {
  AbaScratch scratch(tree);
  Forward result{AbaStatus::kOk, VectorXd::Constant(tree.nv(), 7)};
  result.status = ComputeAba(tree, q, v, tau, F_Bo_W, &scratch, result.vdot);
  return result;
}

// Makes an arm base - upper - lower with both joints about z.
Tree MakeArm(const Inertia& upper, const Inertia& lower, double armature = 0,
             BaseType base = BaseType::kFloating) {
  TreeBuilder builder;
  builder.AddLink("base", {5, {0.1, 0, 0}, Matrix3d::Identity()});
  builder.AddLink("upper", upper).AddLink("lower", lower);
  JointSpec joint;
  joint.type = JointType::kRevolute;
  joint.axis_F = Vector3d::UnitZ();
  joint.name = "1";
  joint.parent = "base";
  joint.child = "upper";
  builder.AddJoint(joint);
  joint.name = "2";
  joint.parent = "upper";
  joint.child = "lower";
  joint.X_PF.p = Vector3d(0.7, 0, 0);
  joint.armature = armature;
  builder.AddJoint(joint);
  return builder.Build(base);
}

const Inertia kLink{1, {0.2, 0.1, 0}, 0.1 * Matrix3d::Identity()};

Forward AtRest(const Tree& tree) {
  return AbaOf(tree, tree.MakeNeutral(), VectorXd::Zero(tree.nv()),
               VectorXd::Ones(tree.nv()), {});
}

TEST(Aba, UndoesRnea) {
  EXPECT_TRUE(HoldsForTrees("v̇ = aba(rnea(v̇))", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    VectorXd tau(m.tree.nv());
    MatrixXd M(m.tree.nv(), m.tree.nv());
    ComputeRnea(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &scratch, tau);
    ComputeCrba(m.tree, m.q, &scratch, M);
    const Forward forward = AbaOf(m.tree, m.q, m.v, tau, m.F_Bo_W);
    if (forward.status != AbaStatus::kOk) return Residual{1, 0};
    if (m.tree.nv() == 0) return Residual{0, 0};
    const VectorXd eigenvalues = Eigenvalues(M);
    // The residual force is rounding, relative to the largest force. The
    // smallest eigenvalue of M bounds the resulting error of v̇.
    const double scale = tau.norm() + M.norm() * m.vdot.norm() + 100;
    return Compare(forward.vdot, m.vdot,
                   Rounding(scale, m.tree.nv() + 10) / eigenvalues[0]);
  }));
}

TEST(Aba, OfAFreeBodyIsNewtonAndEuler) {
  const Inertia M_B{2, {0, 0, 0}, Vector3d(1, 2, 3).asDiagonal()};
  const Tree tree = TreeBuilder().AddLink("body", M_B).Build();
  VectorXd v(6), tau(6), expected(6);
  v << 1, 2, 3, 4, 5, 6;
  tau << 7, 8, 9, 10, 11, 12;
  // I alpha = n - w x I w, m a = f + m g.
  expected << 7 - 6, (8 + 6) / 2., (9 - 2) / 3., 5, 5.5, 6 - 9.81;
  const Forward forward = AbaOf(tree, tree.MakeNeutral(), v, tau, {});
  EXPECT_EQ(forward.status, AbaStatus::kOk);
  EXPECT_NEAR((forward.vdot - expected).norm(), 0, Rounding(20, 6));
}

TEST(Aba, ReportsAMasslessLeafAsSingular) {
  for (const BaseType base : {BaseType::kFloating, BaseType::kFixed}) {
    const Forward forward = AtRest(MakeArm(kLink, {}, 0, base));
    EXPECT_EQ(forward.status, AbaStatus::kSingular);
    EXPECT_TRUE(forward.vdot.array().isNaN().all());
  }
}

TEST(Aba, AcceptsAMasslessLeafWithAnArmature) {
  const Tree tree = MakeArm(kLink, {}, 0.25, BaseType::kFixed);
  const Forward forward = AtRest(tree);
  EXPECT_EQ(forward.status, AbaStatus::kOk);
  EXPECT_NEAR(forward.vdot[1], 1 / 0.25, Rounding(4, 3));
}

TEST(Aba, SolvesAMasslessLinkBetweenParallelAxes) {
  // Joint 1 has inertia if joint 2 is locked, and none if joint 2 is free.
  // After the subtraction only rounding remains.
  const Tree tree = MakeArm({}, kLink);
  Tree collinear = tree;
  TreeBuilder builder;
  builder.AddLink("base", kLink).AddLink("upper").AddLink("lower", kLink);
  for (const int i : {1, 2}) {
    JointSpec joint;
    joint.name = std::to_string(i);
    joint.type = JointType::kRevolute;
    joint.parent = i == 1 ? "base" : "upper";
    joint.child = i == 1 ? "upper" : "lower";
    joint.axis_F = Vector3d(1, 2, 3);
    builder.AddJoint(joint);
  }
  EXPECT_EQ(AtRest(tree).status, AbaStatus::kOk);
  EXPECT_EQ(AtRest(builder.Build()).status, AbaStatus::kSingular);
}

TEST(Aba, TellsInertiaFromRounding) {
  // Wheels on one axis, each mounted on the one before. The last but one has x
  // + 1 kg m2 with the last one locked, and x with the joint of the last one
  // free.
  const auto wheel = [](double inertia) {
    return Inertia{1, {0, 0, 0}, Vector3d(1, 1, inertia).asDiagonal()};
  };
  const auto status_of = [&wheel](double x, BaseType base) {
    TreeBuilder builder;
    JointSpec joint;
    joint.type = JointType::kRevolute;
    joint.axis_F = Vector3d::UnitZ();
    if (base == BaseType::kFixed) {
      builder.AddLink("ground");
      joint.name = "1";
      joint.parent = "ground";
      joint.child = "wheel";
      builder.AddJoint(joint);
    }
    builder.AddLink("wheel", wheel(x)).AddLink("last", wheel(1));
    joint.name = "2";
    joint.parent = "wheel";
    joint.child = "last";
    builder.AddJoint(joint);
    return AtRest(builder.Build(base)).status;
  };
  for (const BaseType base : {BaseType::kFixed, BaseType::kFloating}) {
    EXPECT_EQ(status_of(3e-13, base), AbaStatus::kOk);
    EXPECT_EQ(status_of(3e-14, base), AbaStatus::kSingular);
  }
}

TEST(Aba, ReportsAMasslessBaseAsSingular) {
  // 7 coordinates move one body.
  TreeBuilder builder;
  builder.AddLink("base").AddLink("body", kLink);
  JointSpec joint;
  joint.name = "joint";
  joint.type = JointType::kRevolute;
  joint.parent = "base";
  joint.child = "body";
  builder.AddJoint(joint);
  EXPECT_EQ(AtRest(builder.Build()).status, AbaStatus::kSingular);
  EXPECT_EQ(AtRest(TreeBuilder().AddLink("nothing").Build()).status,
            AbaStatus::kSingular);
}

TEST(Aba, SolvesAFingerOfFourGrams) {
  // M's condition is above 1e9; the finger's own inertia is 1e-7 kg m2.
  TreeBuilder builder;
  builder.AddLink("robot", {60, {0, 0, 0}, 200 * Matrix3d::Identity()});
  builder.AddLink("finger",
                  {0.004, {0, 0, 0.005}, 1e-7 * Matrix3d::Identity()});
  JointSpec joint;
  joint.name = "joint";
  joint.type = JointType::kRevolute;
  joint.parent = "robot";
  joint.child = "finger";
  joint.X_PF.p = Vector3d(0.5, 0.6, 0.7);
  builder.AddJoint(joint);
  const Tree tree = builder.Build();
  Recursion scratch(tree);
  MatrixXd M(7, 7);
  VectorXd vdot(7), tau(7);
  vdot << 1, 2, 3, 4, 5, 6, 1000;
  ComputeCrba(tree, tree.MakeNeutral(), &scratch, M);
  const VectorXd eigenvalues = Eigenvalues(M);
  EXPECT_GT(eigenvalues[6] / eigenvalues[0], 1e9);
  ComputeRnea(tree, tree.MakeNeutral(), VectorXd::Zero(7), vdot, {}, &scratch,
              tau);
  const Forward forward =
      AbaOf(tree, tree.MakeNeutral(), VectorXd::Zero(7), tau, {});
  EXPECT_EQ(forward.status, AbaStatus::kOk);
  // The finger's torque of 2e-4 N m is a difference of terms of 0.04 N m.
  EXPECT_NEAR((forward.vdot - vdot).cwiseQuotient(vdot).norm(), 0,
              Rounding(1, 7, 200));
}

// Compares residual forces, relative to the sum of their terms. M grows with
// the cube of the length, so v̇ itself has an error proportional to the
// condition.
TEST(Aba, SolvesLongChains) {
  for (const TreeShape shape :
       {TreeShape::kChain, TreeShape::kStar, TreeShape::kAny}) {
    for (const int joints : {100, 1000}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(shape) << joints);
      const TreeMotion m =
          MakeTreeMotion({shape, BaseType::kFloating, joints, 3});
      const VectorXd tau = 10 * m.vdot;
      const Forward forward = AbaOf(m.tree, m.q, m.v, tau, m.F_Bo_W);
      ASSERT_EQ(forward.status, AbaStatus::kOk);
      Recursion scratch(m.tree);
      VectorXd undone(m.tree.nv());
      ComputeRnea(m.tree, m.q, m.v, forward.vdot, m.F_Bo_W, &scratch, undone);
      MatrixXd M(m.tree.nv(), m.tree.nv());
      ComputeCrba(m.tree, m.q, &scratch, M);
      const double scale =
          (M.cwiseAbs() * forward.vdot.cwiseAbs()).maxCoeff() + tau.norm();
      EXPECT_LE((undone - tau).cwiseAbs().maxCoeff(),
                Rounding(scale, m.tree.nv()));
    }
  }
}

TEST(Aba, ReportsInputThatIsNotFinite) {
  const Tree tree = MakeArm(kLink, kLink);
  const VectorXd q = tree.MakeNeutral(), zero = VectorXd::Zero(tree.nv());
  const auto status_of = [&](VectorXd q_bad, VectorXd v, VectorXd tau,
                             double force) {
    std::vector<SpatialForce> F(3);
    F[1].linear[1] = force;
    const Forward forward = AbaOf(tree, q_bad, v, tau, F);
    EXPECT_TRUE(forward.vdot.array().isNaN().all());
    return forward.status;
  };
  VectorXd bad_q = q, bad = zero;
  bad_q[7] = kNaN;
  bad[6] = kNaN;
  EXPECT_EQ(status_of(bad_q, zero, zero, 0), AbaStatus::kNotFinite);
  EXPECT_EQ(status_of(q, bad, zero, 0), AbaStatus::kNotFinite);
  EXPECT_EQ(status_of(q, zero, bad, 0), AbaStatus::kNotFinite);
  EXPECT_EQ(status_of(q, zero, zero, kNaN), AbaStatus::kNotFinite);
  VectorXd no_quaternion = q;
  no_quaternion.segment<4>(3).setZero();
  EXPECT_EQ(status_of(no_quaternion, zero, zero, 0), AbaStatus::kNotFinite);
  bad[6] = 1e200;  // Its square overflows.
  EXPECT_EQ(status_of(q, bad, zero, 0), AbaStatus::kNotFinite);
}

// A link at 1e200 m has a moment of inertia beyond the largest double, about
// joint 1 and about a floating base.
TEST(Aba, ReportsInertiaThatOverflowsAsNotFinite) {
  for (const BaseType base : {BaseType::kFixed, BaseType::kFloating}) {
    for (const JointType first : {JointType::kRevolute, JointType::kFixed}) {
      if (base == BaseType::kFixed && first == JointType::kFixed) continue;
      SCOPED_TRACE(testing::Message() << (base == BaseType::kFixed)
                                      << (first == JointType::kFixed));
      TreeBuilder builder;
      builder.AddLink("base", kLink).AddLink("upper", kLink);
      builder.AddLink("lower", kLink);
      JointSpec joint;
      joint.type = first;
      joint.axis_F = Vector3d::UnitZ();
      joint.name = "1";
      joint.parent = "base";
      joint.child = "upper";
      builder.AddJoint(joint);
      joint.type = JointType::kPrismatic;
      joint.axis_F = Vector3d::UnitX();
      joint.name = "2";
      joint.parent = "upper";
      joint.child = "lower";
      builder.AddJoint(joint);
      const Tree tree = builder.Build(base);
      VectorXd q = tree.MakeNeutral();
      q[q.size() - 1] = 1e200;
      const Forward forward = AbaOf(tree, q, VectorXd::Zero(tree.nv()),
                                    VectorXd::Zero(tree.nv()), {});
      EXPECT_EQ(forward.status, AbaStatus::kNotFinite);
      EXPECT_TRUE(forward.vdot.array().isNaN().all());
    }
  }
}

TEST(Aba, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  AbaScratch scratch(m.tree);
  VectorXd vdot(m.tree.nv());
  CountMalloc count;
  const AbaStatus status =
      ComputeAba(m.tree, m.q, m.v, m.v, m.F_Bo_W, &scratch, vdot);
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_EQ(status, AbaStatus::kOk);
}

}  // namespace
}  // namespace poise
