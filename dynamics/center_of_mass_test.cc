// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/center_of_mass.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

CenterOfMass CenterOfMassAt(const Tree& tree, const VectorXd& q,
                            const VectorXd& v) {
  Recursion scratch(tree);
  CenterOfMass G(tree);
  G.J_WG.setConstant(7);  // The function must overwrite old values.
  ComputeCenterOfMass(tree, q, v, &scratch, &G);
  return G;
}

// Second derivation: the mean over the bodies.
struct Mean {
  Vector3d p = Vector3d::Zero();
  Vector3d v = Vector3d::Zero();
};

Mean MeanOf(const TreeMotion& m, const VectorXd& velocity) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V(m.tree.num_bodies());
  ComputePoses(m.tree, m.q, &X_WB);
  ComputeVelocities(m.tree, X_WB, velocity, &V);
  Mean mean;
  for (int b = 0; b < m.tree.num_bodies(); ++b) {
    const Inertia& M_B = m.tree.inertias()[b];
    const double part = M_B.mass / m.tree.total_mass();
    mean.p += part * (X_WB[b] * M_B.p_BoG_B);
    mean.v += part * Shift(V[b], X_WB[b].R * M_B.p_BoG_B).linear;
  }
  return mean;
}

TEST(CenterOfMass, IsTheMeanOfTheBodies) {
  EXPECT_TRUE(HoldsForTrees("p_WG, v_WG", [](const TreeMotion& m) {
    const CenterOfMass G = CenterOfMassAt(m.tree, m.q, m.v);
    const Mean mean = MeanOf(m, m.v);
    Eigen::Matrix<double, 3, 2> ours, theirs;
    ours << G.p_WG, G.v_WG;
    theirs << mean.p, mean.v;
    return Compare(ours, theirs, Rounding(10 + m.v.norm(), m.tree.nv() + 10));
  }));
}

TEST(CenterOfMass, HasItsVelocitiesAtUnitRatesAsJacobian) {
  EXPECT_TRUE(HoldsForTrees("J_WG", [](const TreeMotion& m) {
    const CenterOfMass G = CenterOfMassAt(m.tree, m.q, m.v);
    Eigen::Matrix3Xd J(3, m.tree.nv());
    for (int j = 0; j < m.tree.nv(); ++j) {
      J.col(j) = MeanOf(m, VectorXd::Unit(m.tree.nv(), j)).v;
    }
    return Compare(G.J_WG, J, Rounding(10, m.tree.nv() + 10));
  }));
}

TEST(CenterOfMass, BiasIsTheRateOfItsVelocity) {
  EXPECT_TRUE(HoldsForTrees("d/dt v_WG", [](const TreeMotion& m) {
    const CenterOfMass G = CenterOfMassAt(m.tree, m.q, m.v);
    const VectorXd rate = RiddersRate([&](double t) {
      VectorXd q(m.tree.nq());
      Integrate(m.tree, m.q, m.v, t, q);
      return VectorXd(CenterOfMassAt(m.tree, q, m.v).v_WG);
    });
    return Compare(G.bias, rate, kRiddersPrecision * (100 + G.bias.norm()));
  }));
}

TEST(CenterOfMass, OfATreeWithoutMassIsItsBase) {
  const Tree tree = TreeBuilder().AddLink("nothing").Build();
  VectorXd q = tree.MakeNeutral();
  q.head<3>() << 1, 2, 3;
  const CenterOfMass G = CenterOfMassAt(tree, q, VectorXd::Ones(6));
  EXPECT_EQ(G.p_WG, Vector3d(1, 2, 3));
  EXPECT_TRUE(G.v_WG.isZero(0));
  EXPECT_TRUE(G.J_WG.isZero(0));
  EXPECT_TRUE(G.bias.isZero(0));
}

TEST(CenterOfMass, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  Recursion scratch(m.tree);
  CenterOfMass G(m.tree);
  CountMalloc count;
  ComputeCenterOfMass(m.tree, m.q, m.v, &scratch, &G);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
