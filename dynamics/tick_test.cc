// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/tick.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> AllFrames(const Tree& tree) {
  std::vector<int> frames;
  for (size_t f = 0; f < tree.frames().size(); ++f) {
    frames.push_back(static_cast<int>(f));
  }
  return frames;
}

// Returns the tick of a motion, computed into the tick of another motion.
Tick TickOf(const TreeMotion& m) {
  Tick tick(m.tree, AllFrames(m.tree));
  VectorXd q(m.tree.nq());
  Integrate(m.tree, m.q, m.v, 1, q);
  ComputeTick(m.tree, q, m.vdot, &tick);
  ComputeTick(m.tree, m.q, m.v, &tick);
  return tick;
}

TEST(Tick, HasTheMassMatrixToTheBit) {
  EXPECT_TRUE(HoldsForTrees("M", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    MatrixXd M(m.tree.nv(), m.tree.nv());
    ComputeCrba(m.tree, m.q, &scratch, M);
    return Compare(TickOf(m).M, M, 0);
  }));
}

TEST(Tick, DoesNotDependOnTheNormOfTheQuaternion) {
  TreeMotion m = MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 5, 1});
  const Tick tick = TickOf(m);
  for (const double norm : {1e-170, 1e170}) {
    TreeMotion scaled = m;
    scaled.q.segment<4>(3) *= norm;
    EXPECT_LE((TickOf(scaled).M - tick.M).norm(), Rounding(tick.M.norm(), 20));
  }
  m.q.segment<4>(3).setZero();
  EXPECT_TRUE(TickOf(m).N.array().isNaN().all());
}

// Doubling all masses doubles M and N to the bit and keeps the center of mass.
TEST(Tick, ScalesWithMass) {
  EXPECT_TRUE(HoldsForTrees("M, N, p_WG, scaled", [](const TreeMotion& m) {
    const Tree heavy_tree = m.tree.WithScaledInertias(2);
    const Tick tick = TickOf(m);
    Tick heavy(heavy_tree, {});
    ComputeTick(heavy_tree, m.q, m.v, &heavy);
    MatrixXd ours(m.tree.nv(), m.tree.nv() + 2), expected = ours;
    const VectorXd zero = VectorXd::Zero(m.tree.nv());
    ours << heavy.M, heavy.N, zero;
    expected << 2 * tick.M, 2 * tick.N, zero;
    const int n = std::min(3, m.tree.nv());
    ours.col(m.tree.nv() + 1).head(n) = heavy.p_WG.head(n);
    expected.col(m.tree.nv() + 1).head(n) = tick.p_WG.head(n);
    return Compare(ours, expected, 0);
  }));
}

TEST(Tick, HasTheBiasForces) {
  EXPECT_TRUE(HoldsForTrees("N, c", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    MatrixXd ours(m.tree.nv(), 2), expected(m.tree.nv(), 2);
    ComputeBias(m.tree, m.q, m.v, &scratch, expected.col(0));
    ComputeCoriolis(m.tree, m.q, m.v, &scratch, expected.col(1));
    const Tick tick = TickOf(m);
    ours << tick.N, tick.c;
    return Compare(ours, expected,
                   Rounding(expected.norm() + 100, m.tree.nv() + 10));
  }));
}

TEST(Tick, HasThePosesOfBodiesAndFrames) {
  EXPECT_TRUE(HoldsForTrees("X_WB, X_WF", [](const TreeMotion& m) {
    const Tick tick = TickOf(m);
    if (tick.frames.size() != m.tree.frames().size()) return Residual{1, 0};
    std::vector<Pose> X_WB(m.tree.num_bodies());
    ComputePoses(m.tree, m.q, &X_WB);
    const int columns =
        m.tree.num_bodies() + static_cast<int>(tick.frames.size());
    MatrixXd ours(12, columns), expected(12, columns);
    int k = 0;
    for (; k < m.tree.num_bodies(); ++k) {
      ours.col(k) << tick.X_WB[k].R.reshaped(), tick.X_WB[k].p;
      expected.col(k) << X_WB[k].R.reshaped(), X_WB[k].p;
    }
    for (const FrameTick& frame : tick.frames) {
      const Pose X_WF = FramePose(m.tree, X_WB, frame.frame);
      ours.col(k) << frame.X_WF.R.reshaped(), frame.X_WF.p;
      expected.col(k++) << X_WF.R.reshaped(), X_WF.p;
    }
    return Compare(ours, expected, Rounding(10, m.tree.nv() + 10));
  }));
}

TEST(Tick, HasTheMotionOfFrames) {
  EXPECT_TRUE(HoldsForTrees("J, J̇v, V", [](const TreeMotion& m) {
    const Tick tick = TickOf(m);
    const int nv = m.tree.nv();
    std::vector<Pose> X_WB(m.tree.num_bodies());
    std::vector<SpatialMotion> V(m.tree.num_bodies());
    std::vector<SpatialAcceleration> A(m.tree.num_bodies());
    ComputePoses(m.tree, m.q, &X_WB);
    ComputeVelocities(m.tree, X_WB, m.v, &V);
    ComputeAccelerations(m.tree, X_WB, V, m.v, VectorXd::Zero(nv), &A);
    const int num_frames = static_cast<int>(tick.frames.size());
    MatrixXd ours(6, num_frames * (nv + 2)), expected = ours;
    for (int k = 0; k < num_frames; ++k) {
      const FrameTick& frame = tick.frames[k];
      Matrix6Xd J(6, nv);
      ComputeFrameJacobian(m.tree, X_WB, frame.frame, Axes::kWorld, J);
      ours.middleCols(k * (nv + 2), nv + 2) << frame.J_WF_W, frame.V_WF_W,
          frame.Jdot_v;
      expected.middleCols(k * (nv + 2), nv + 2) << J,
          FrameVelocity(m.tree, X_WB, V, frame.frame).vector(),
          FrameAcceleration(m.tree, X_WB, V, A, frame.frame).vector();
    }
    return Compare(ours, expected, Rounding(10 + ours.norm(), nv + 10));
  }));
}

TEST(Tick, HasTheCenterOfMass) {
  EXPECT_TRUE(HoldsForTrees("p_WG, v_WG, J, bias", [](const TreeMotion& m) {
    const Tick tick = TickOf(m);
    Recursion scratch(m.tree);
    CenterOfMass G(m.tree);
    ComputeCenterOfMass(m.tree, m.q, m.v, &scratch, &G);
    const double mass = m.tree.total_mass();
    Eigen::Matrix3Xd ours(3, m.tree.nv() + 3), expected = ours;
    ours << tick.p_WG, tick.v_WG, tick.H_G.bottomRows<3>() / mass,
        tick.H_G_bias.tail<3>() / mass;
    expected << G.p_WG, G.v_WG, G.J_WG, G.bias;
    return Compare(ours, expected,
                   Rounding(10 + ours.norm(), m.tree.nv() + 10));
  }));
}

TEST(Tick, HasTheCentroidalMomentum) {
  EXPECT_TRUE(HoldsForTrees("H_G, bias, L_G", [](const TreeMotion& m) {
    if (!m.tree.is_floating()) return Residual{0, 0};
    const Tick tick = TickOf(m);
    CentroidalMomentum H(m.tree);
    ComputeCentroidalMomentum(tick.M, tick.c, tick.p_WG - m.q.head<3>(), &H);
    Matrix6Xd ours(6, m.tree.nv() + 2), expected = ours;
    ours << tick.H_G, tick.H_G_bias, tick.L_G;
    expected << H.H_G, H.bias, H.H_G * m.v;
    return Compare(
        ours, expected,
        Rounding(10 + 5 * ours.norm() * m.v.norm(), m.tree.nv() + 10));
  }));
}

TEST(Tick, HasTheMomentumOfAFixedBaseToo) {
  // With the base at rest, bodies move as with a fixed base.
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    TreeCase from{TreeShape::kAny, BaseType::kFixed, 8, seed};
    const TreeMotion fixed = MakeTreeMotion(from);
    from.base = BaseType::kFloating;
    TreeMotion free = MakeTreeMotion(from);
    free.q << free.tree.MakeNeutral().head<7>(), fixed.q;
    free.v << VectorXd::Zero(6), fixed.v;
    free.vdot << VectorXd::Zero(6), fixed.vdot;
    const Tick a = TickOf(fixed), b = TickOf(free);
    const int n = fixed.tree.num_joints();
    const double tolerance = Rounding(100, 20);
    EXPECT_NEAR((a.H_G - b.H_G.rightCols(n)).norm(), 0, tolerance);
    EXPECT_NEAR((a.H_G_bias - b.H_G_bias).norm(), 0, tolerance);
    EXPECT_NEAR((a.L_G - b.L_G).norm(), 0, tolerance);
    EXPECT_NEAR((a.p_WG - b.p_WG).norm(), 0, tolerance);
    EXPECT_NEAR((a.v_WG - b.v_WG).norm(), 0, tolerance);
    EXPECT_NEAR((a.N - b.N.tail(n)).norm(), 0, tolerance);
  }
}

TEST(Tick, RotatesWithTheWorld) {
  // In a world that is rotated and far away, joint torques are the same and
  // quantities in world axes rotate.
  EXPECT_TRUE(HoldsForTrees("R N, R H_G", [](const TreeMotion& m) {
    if (!m.tree.is_floating()) return Residual{0, 0};
    const Eigen::Quaterniond R(
        Eigen::AngleAxisd(0.7, m.v.head<3>().normalized()));
    TreeMotion turned = m;
    const Eigen::Quaterniond R_WB(m.q[6], m.q[3], m.q[4], m.q[5]);
    turned.q.segment<4>(3) = (R * R_WB).coeffs();
    turned.q.head<3>() += Vector3d(1e6, -1e6, 1e6);
    const auto turn = [&R](VectorXd x) {
      x.head<3>() = (R * x.head<3>()).eval();
      x.segment<3>(3) = (R * x.segment<3>(3)).eval();
      return x;
    };
    turned.v = turn(m.v);
    const Tick a = TickOf(m), b = TickOf(turned);
    MatrixXd ours(m.tree.nv(), 1), expected = ours;
    ours << b.c;
    expected << turn(a.c);
    MatrixXd H = a.H_G;
    for (int j = 0; j < H.cols(); ++j) H.col(j) = turn(H.col(j));
    const Residual forces =
        Compare(ours, expected, Rounding(100 + a.c.norm(), m.tree.nv() + 10));
    if (!(forces.value <= forces.tolerance)) return forces;
    return Compare(b.H_G.rightCols(m.tree.num_joints()),
                   H.rightCols(m.tree.num_joints()),
                   Rounding(100 + H.norm(), m.tree.nv() + 10));
  }));
}

TEST(Tick, DoesNotDependOnTheOrderOfTheJoints) {
  // Two arms in either order.
  const auto build = [](bool swap) {
    TreeBuilder builder;
    builder.AddLink("base", {3, {0.1, 0.2, 0.3}, Matrix3d::Identity()});
    for (int k = 0; k < 2; ++k) {
      const bool left = (k == 0) != swap;
      const std::string name = left ? "left" : "right";
      builder.AddLink(name,
                      {left ? 1. : 2., {0, 0.5, 0.1}, Matrix3d::Identity()});
      JointSpec joint;
      joint.name = joint.child = name;
      joint.parent = "base";
      joint.type = JointType::kRevolute;
      joint.axis_F = left ? Vector3d(1, 2, 3) : Vector3d(3, 1, -2);
      joint.X_PF.p = Vector3d(0, left ? 0.3 : -0.3, 0.5);
      builder.AddJoint(joint);
    }
    return builder.Build();
  };
  VectorXd q(9), v(8);
  q << 1, 2, 3, 0.5, 0.5, -0.5, 0.5, 0.7, -0.4;
  v << 1, -1, 2, 3, 2, -3, 1.5, 2.5;
  Tick a(build(false), {}), b(build(true), {});
  ComputeTick(build(false), q, v, &a);
  std::swap(q[7], q[8]);
  std::swap(v[6], v[7]);
  ComputeTick(build(true), q, v, &b);
  Eigen::PermutationMatrix<8> swap;
  swap.setIdentity();
  swap.applyTranspositionOnTheRight(6, 7);
  const double tolerance = Rounding(100, 10);
  EXPECT_NEAR((swap * a.M * swap.transpose() - b.M).norm(), 0, tolerance);
  EXPECT_NEAR((swap * a.N - b.N).norm(), 0, tolerance);
  EXPECT_NEAR((a.H_G * swap.transpose() - b.H_G).norm(), 0, tolerance);
}

TEST(Tick, OfATreeWithoutMassHasNoCenterOfMass) {
  const Tree tree = TreeBuilder().AddLink("nothing").Build();
  Tick tick(tree, {0});
  VectorXd q = tree.MakeNeutral();
  q[1] = 2;
  ComputeTick(tree, q, VectorXd::Ones(6), &tick);
  EXPECT_EQ(tick.p_WG, Vector3d(0, 2, 0));
  EXPECT_TRUE(tick.v_WG.isZero(0));
  EXPECT_TRUE(tick.M.isZero(0));
}

TEST(Tick, KeepsItsDigitsOverAThousandLinks) {
  // A straight chain of 1000 rods of 0.3 m that rotates as one body: the base's
  // block of M is that of one rod of 300 m.
  TreeBuilder builder;
  const double m = 0.5, l = 0.3;
  const Inertia rod{m,
                    {l / 2, 0, 0},
                    Vector3d(0, m * l * l / 12, m * l * l / 12).asDiagonal()};
  builder.AddLink("1", rod);
  for (int i = 2; i <= 1000; ++i) {
    builder.AddLink(std::to_string(i), rod);
    JointSpec joint;
    joint.name = joint.child = std::to_string(i);
    joint.parent = std::to_string(i - 1);
    joint.type = JointType::kRevolute;
    joint.axis_F = Vector3d::UnitZ();
    joint.X_PF.p.x() = l;
    builder.AddJoint(joint);
  }
  const Tree tree = builder.Build();
  Tick tick(tree, {});
  ComputeTick(tree, tree.MakeNeutral(), VectorXd::Zero(tree.nv()), &tick);
  const double inertia = 1000 * m * 300 * 300 / 3;
  EXPECT_NEAR(tick.M(2, 2), inertia, Rounding(inertia, 1000));
  EXPECT_NEAR(tick.p_WG.x(), 150, Rounding(150, 1000));
  EXPECT_NEAR(tick.H_G(2, 2), inertia / 4, Rounding(inertia, 1000));
  // The last joint moves the last rod only.
  EXPECT_NEAR(tick.M(1004, 1004), m * l * l / 3, Rounding(m * l * l, 10));
}

TEST(Tick, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  Tick tick(m.tree, AllFrames(m.tree));
  CountMalloc count;
  ComputeTick(m.tree, m.q, m.v, &tick);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
