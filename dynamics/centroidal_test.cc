// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/centroidal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

CentroidalMomentum CentroidalMomentumAt(const Tree& tree, const VectorXd& q,
                                        const VectorXd& v) {
  Recursion scratch(tree);
  CentroidalMomentum out(tree);
  out.H_G.setConstant(7);  // The function must overwrite old values.
  ComputeCentroidalMomentum(tree, q, v, &scratch, &out);
  return out;
}

// Second derivation: the sum of the bodies' momenta about G.
Vector6d MomentumOf(const Tree& tree, const VectorXd& q, const VectorXd& v) {
  std::vector<Pose> X_WB(tree.num_bodies());
  std::vector<SpatialMotion> V(tree.num_bodies());
  ComputePoses(tree, q, &X_WB);
  ComputeVelocities(tree, X_WB, v, &V);
  const Vector3d p_WG = CompositeInertia(tree, X_WB).p_BoG_B;
  Vector6d L = Vector6d::Zero();
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M_B = tree.inertias()[b];
    const Vector3d w = V[b].angular;
    const Vector3d p_GB = X_WB[b] * M_B.p_BoG_B - p_WG;
    const Vector3d f =
        M_B.mass * (V[b].linear + w.cross(X_WB[b].R * M_B.p_BoG_B));
    L.head<3>() +=
        X_WB[b].R * M_B.I_G_B * X_WB[b].R.transpose() * w + p_GB.cross(f);
    L.tail<3>() += f;
  }
  return L;
}

// Checks a property on trees with a floating base.
bool HoldsForFloatingTrees(
    const std::string& property,
    const std::function<Residual(const TreeMotion&)>& residual_of) {
  return HoldsForTrees(property, [&residual_of](const TreeMotion& m) {
    return m.tree.is_floating() ? residual_of(m) : Residual{0, 0};
  });
}

TEST(CentroidalMomentum, IsTheSumOfTheBodiesMomenta) {
  EXPECT_TRUE(HoldsForTrees("H_G", [](const TreeMotion& m) {
    const Matrix6Xd H_G = CentroidalMomentumAt(m.tree, m.q, m.v).H_G;
    Matrix6Xd sums(6, m.tree.nv());
    for (int j = 0; j < m.tree.nv(); ++j) {
      sums.col(j) = MomentumOf(m.tree, m.q, VectorXd::Unit(m.tree.nv(), j));
    }
    return Compare(H_G, sums, Rounding(H_G.norm() * 5, m.tree.nv() + 10));
  }));
}

// Another derivation: the base's rows of M and c, shifted to G, (19).
TEST(CentroidalMomentum, AgreesWithTheRowsOfTheMassMatrix) {
  EXPECT_TRUE(HoldsForFloatingTrees("X M_l, X c_l", [](const TreeMotion& m) {
    const int nv = m.tree.nv();
    Recursion scratch(m.tree);
    MatrixXd M(nv, nv);
    VectorXd c(nv);
    CenterOfMass G(m.tree);
    ComputeCrba(m.tree, m.q, &scratch, M);
    ComputeCoriolis(m.tree, m.q, m.v, &scratch, c);
    ComputeCenterOfMass(m.tree, m.q, m.v, &scratch, &G);
    CentroidalMomentum rows(m.tree);
    ComputeCentroidalMomentum(M, c, G.p_WG - m.q.head<3>(), &rows);
    const CentroidalMomentum H = CentroidalMomentumAt(m.tree, m.q, m.v);
    Matrix6Xd ours(6, nv + 1), expected(6, nv + 1);
    ours << H.H_G, H.bias;
    expected << rows.H_G, rows.bias;
    return Compare(ours, expected, Rounding(10 + 5 * ours.norm(), nv + 10));
  }));
}

TEST(CentroidalMomentum, MatrixAloneIsTheSameToTheBit) {
  EXPECT_TRUE(HoldsForTrees("H_G alone", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    Matrix6Xd H_G = Matrix6Xd::Constant(6, m.tree.nv(), 7);
    ComputeCentroidalMomentumMatrix(m.tree, m.q, &scratch, &H_G);
    return Compare(H_G, CentroidalMomentumAt(m.tree, m.q, m.v).H_G, 0);
  }));
}

TEST(CentroidalMomentum, OfATreeWithoutMassIsZero) {
  const Tree tree = TreeBuilder().AddLink("nothing").Build();
  const CentroidalMomentum H =
      CentroidalMomentumAt(tree, tree.MakeNeutral(), VectorXd::Ones(6));
  EXPECT_TRUE(H.H_G.isZero(0));
  EXPECT_TRUE(H.bias.isZero(0));
}

TEST(CentroidalMomentum, BiasIsTheRateOfMomentumAtConstantV) {
  EXPECT_TRUE(HoldsForTrees("bias", [](const TreeMotion& m) {
    const Vector6d bias = CentroidalMomentumAt(m.tree, m.q, m.v).bias;
    const VectorXd rate = RiddersRate([&](double t) {
      VectorXd q(m.tree.nq());
      Integrate(m.tree, m.q, m.v, t, q);
      return VectorXd(MomentumOf(m.tree, q, m.v));
    });
    return Compare(bias, rate, kRiddersPrecision * (300 + bias.norm()));
  }));
}

TEST(CentroidalMomentum, RatesAddUp) {
  EXPECT_TRUE(HoldsForTrees("H v̇ + bias", [](const TreeMotion& m) {
    const CentroidalMomentum H = CentroidalMomentumAt(m.tree, m.q, m.v);
    const Vector6d expected = H.H_G * m.vdot + H.bias;
    const VectorXd rate = RiddersRate([&](double t) {
      VectorXd q(m.tree.nq());
      Integrate(m.tree, m.q, m.v + 0.5 * t * m.vdot, t, q);
      return VectorXd(CentroidalMomentumAt(m.tree, q, m.v).H_G *
                      (m.v + t * m.vdot));
    });
    return Compare(expected, rate, kRiddersPrecision * (300 + expected.norm()));
  }));
}

TEST(CompositeInertia, IsTheMomentumOfTheLockedRobot) {
  EXPECT_TRUE(HoldsForFloatingTrees("I_G w", [](const TreeMotion& m) {
    std::vector<Pose> X_WB(m.tree.num_bodies());
    ComputePoses(m.tree, m.q, &X_WB);
    const Inertia composite = CompositeInertia(m.tree, X_WB);
    const Matrix6Xd H_G = CentroidalMomentumAt(m.tree, m.q, m.v).H_G;
    Matrix6d locked = Matrix6d::Zero();
    locked.topLeftCorner<3, 3>() = composite.I_G_B;
    locked.bottomRightCorner<3, 3>() = composite.mass * Matrix3d::Identity();
    Matrix6d ours = H_G.leftCols<6>();
    // v_WG = v_WB + w x p_BoG is zero for a pure rotation about G.
    const Vector3d p = composite.p_BoG_B - m.q.head<3>();
    for (int k = 0; k < 3; ++k) {
      const Vector3d v = Vector3d::Unit(k).cross(p);
      ours.col(k) -= ours.rightCols<3>() * v;
    }
    return Compare(ours, locked, Rounding(10 * H_G.norm(), m.tree.nv() + 10));
  }));
}

TEST(CompositeInertia, OfATreeWithoutMassIsZero) {
  const Tree tree = TreeBuilder().AddLink("nothing").Build();
  const Inertia composite = CompositeInertia(tree, std::vector<Pose>(1));
  EXPECT_EQ(composite.mass, 0);
  EXPECT_TRUE(composite.p_BoG_B.isZero(0));
  EXPECT_TRUE(composite.I_G_B.isZero(0));
}

TEST(CentroidalMomentum, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  const MatrixXd M = MatrixXd::Identity(m.tree.nv(), m.tree.nv());
  CentroidalMomentum out(m.tree);
  const Vector3d p(1, 2, 3);
  Recursion scratch(m.tree);
  CountMalloc count;
  ComputeCentroidalMomentumMatrix(m.tree, m.q, &scratch, &out.H_G);
  ComputeCentroidalMomentum(m.tree, m.q, m.v, &scratch, &out);
  ComputeCentroidalMomentum(M, m.v, p, &out);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
