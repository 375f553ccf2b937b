// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/rnea.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/dynamics/crba.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd RneaOf(const TreeMotion& m, const std::vector<SpatialForce>& F_Bo_W) {
  Recursion scratch(m.tree);
  VectorXd tau(m.tree.nv());
  ComputeRnea(m.tree, m.q, m.v, m.vdot, F_Bo_W, &scratch, tau);
  return tau;
}

VectorXd BiasOf(const TreeMotion& m) {
  Recursion scratch(m.tree);
  VectorXd N(m.tree.nv());
  ComputeBias(m.tree, m.q, m.v, &scratch, N);
  return N;
}

VectorXd CoriolisOf(const TreeMotion& m) {
  Recursion scratch(m.tree);
  VectorXd c(m.tree.nv());
  ComputeCoriolis(m.tree, m.q, m.v, &scratch, c);
  return c;
}

TEST(Rnea, IsNewtonAndEulerForEachBody) {
  // Second derivation: Newton-Euler equations of each body about its center of
  // mass, and the principle of virtual power with the bodies' Jacobians.
  EXPECT_TRUE(HoldsForTrees("tau = sum J'F", [](const TreeMotion& m) {
    const Tree& tree = m.tree;
    std::vector<Pose> X_WB(tree.num_bodies());
    std::vector<SpatialMotion> V(tree.num_bodies());
    std::vector<SpatialAcceleration> A(tree.num_bodies());
    ComputePoses(tree, m.q, &X_WB);
    ComputeVelocities(tree, X_WB, m.v, &V);
    ComputeAccelerations(tree, X_WB, V, m.v, m.vdot, &A);
    VectorXd tau = VectorXd::Zero(tree.nv());
    double scale = 10;
    for (size_t f = 0; f < tree.frames().size(); ++f) {
      // The own frame of the body.
      const int b = tree.frames()[f].body;
      if (!tree.frames()[f].X_BF.p.isZero(0) ||
          !tree.frames()[f].X_BF.R.isIdentity(0)) {
        continue;
      }
      const Inertia& M_B = tree.inertias()[b];
      const Vector3d w = V[b].angular, alpha = A[b].angular;
      const Vector3d p = X_WB[b].R * M_B.p_BoG_B;
      const Vector3d a_G = A[b].linear + alpha.cross(p) + w.cross(w.cross(p));
      const Matrix3d I_G_W = X_WB[b].R * M_B.I_G_B * X_WB[b].R.transpose();
      const Vector3d force = M_B.mass * (a_G - tree.gravity_W());
      Vector6d F;
      F << I_G_W * alpha + w.cross(I_G_W * w) + p.cross(force), force;
      Matrix6Xd J(6, tree.nv());
      ComputeFrameJacobian(tree, X_WB, static_cast<int>(f), Axes::kWorld, J);
      tau += J.transpose() * F;
      scale += J.norm() * F.norm();
    }
    for (int j = 0; j < tree.num_joints(); ++j) {
      tau[tree.v_start() + j] +=
          tree.joints()[j].armature * m.vdot[tree.v_start() + j];
    }
    return Compare(RneaOf(m, {}), tau, Rounding(scale, tree.nv() + 10));
  }));
}

TEST(Rnea, IsMTimesAccelerationPlusBias) {
  EXPECT_TRUE(HoldsForTrees("tau = M v̇ + N", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    MatrixXd M(m.tree.nv(), m.tree.nv());
    ComputeCrba(m.tree, m.q, &scratch, M);
    const VectorXd N = BiasOf(m);
    const double scale = M.norm() * m.vdot.norm() + N.norm() + 10;
    return Compare(RneaOf(m, {}), M * m.vdot + N,
                   Rounding(scale, m.tree.nv() + 10));
  }));
}

TEST(Rnea, AddsForcesByTheirJacobians) {
  EXPECT_TRUE(HoldsForTrees("tau - sum J'F", [](const TreeMotion& m) {
    std::vector<Pose> X_WB(m.tree.num_bodies());
    ComputePoses(m.tree, m.q, &X_WB);
    VectorXd tau = RneaOf(m, {});
    double scale = tau.norm() + 10;
    std::vector<bool> done(m.tree.num_bodies(), false);
    for (size_t f = 0; f < m.tree.frames().size(); ++f) {
      const int b = m.tree.frames()[f].body;
      if (done[b]) continue;  // The first frame is that of the body.
      done[b] = true;
      Matrix6Xd J(6, m.tree.nv());
      ComputeFrameJacobian(m.tree, X_WB, static_cast<int>(f), Axes::kWorld, J);
      tau -= J.transpose() * m.F_Bo_W[b].vector();
      scale += J.norm() * m.F_Bo_W[b].vector().norm();
    }
    return Compare(RneaOf(m, m.F_Bo_W), tau, Rounding(scale, m.tree.nv() + 10));
  }));
}

TEST(Rnea, BiasIsCoriolisPlusGravity) {
  // Gravity is the bias force of a robot at rest.
  EXPECT_TRUE(HoldsForTrees("N = c + g", [](const TreeMotion& m) {
    TreeMotion rest = m;
    rest.v.setZero();
    const VectorXd N = BiasOf(m), c = CoriolisOf(m), g = BiasOf(rest);
    return Compare(N, c + g,
                   Rounding(c.norm() + g.norm() + 10, m.tree.nv() + 10));
  }));
}

TEST(Rnea, CoriolisIsQuadraticInVelocity) {
  EXPECT_TRUE(HoldsForTrees("c(2 v) = 4 c(v)", [](const TreeMotion& m) {
    TreeMotion fast = m;
    fast.v *= 2;
    return Compare(CoriolisOf(fast), 4 * CoriolisOf(m), 0);
  }));
}

TEST(Rnea, DoesNotDependOnUniformMotion) {
  EXPECT_TRUE(HoldsForTrees("tau(v_WB + u)", [](const TreeMotion& m) {
    TreeMotion train = m;
    if (m.tree.is_floating()) {
      train.v.segment<3>(3) += Vector3d(30, -20, 10);
      train.q.head<3>() += Vector3d(1000, 2000, -500);
    }
    return Compare(RneaOf(train, {}), RneaOf(m, {}), 0);
  }));
}

TEST(Rnea, OfAPendulumIsTheClosedForm) {
  TreeBuilder builder;
  builder.AddLink("base").AddLink(
      "bob", {2, {0, 0, -0.5}, 0.1 * Matrix3d::Identity()});
  JointSpec joint;
  joint.name = "joint";
  joint.type = JointType::kRevolute;
  joint.parent = "base";
  joint.child = "bob";
  joint.axis_F = Vector3d(0, -2, 0);
  joint.armature = 0.3;
  builder.AddJoint(joint);
  const Tree tree = builder.Build(BaseType::kFixed);
  Recursion scratch(tree);
  VectorXd q(1), v(1), vdot(1), tau(1);
  q << 0.4;
  v << 5;
  vdot << 1.5;
  ComputeRnea(tree, q, v, vdot, {}, &scratch, tau);
  const double inertia = 0.1 + 2 * 0.25 + 0.3;
  EXPECT_NEAR(tau[0], inertia * 1.5 + 2 * 9.81 * 0.5 * std::sin(0.4),
              Rounding(5, 10));
}

TEST(Rnea, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  Recursion scratch(m.tree);
  VectorXd tau(m.tree.nv());
  CountMalloc count;
  ComputeRnea(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &scratch, tau);
  ComputeBias(m.tree, m.q, m.v, &scratch, tau);
  ComputeCoriolis(m.tree, m.q, m.v, &scratch, tau);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
