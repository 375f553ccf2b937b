// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/energy.h"

#include <gtest/gtest.h>

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

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Energies {
  double kinetic, potential;
};

Energies EnergiesAt(const Tree& tree, const VectorXd& q, const VectorXd& v) {
  std::vector<Pose> X_WB(tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(tree.num_bodies());
  ComputePoses(tree, q, &X_WB);
  ComputeVelocities(tree, X_WB, v, &V_WB_W);
  return {KineticEnergy(tree, X_WB, V_WB_W, v), PotentialEnergy(tree, X_WB)};
}

TEST(KineticEnergy, IsHalfOfVMV) {
  EXPECT_TRUE(HoldsForTrees("v'Mv/2", [](const TreeMotion& m) -> Residual {
    Recursion scratch(m.tree);
    MatrixXd M(m.tree.nv(), m.tree.nv());
    ComputeCrba(m.tree, m.q, &scratch, M);
    const double expected = 0.5 * m.v.dot(M * m.v);
    const double kinetic = EnergiesAt(m.tree, m.q, m.v).kinetic;
    return {std::abs(kinetic - expected),
            Rounding(M.norm() * m.v.squaredNorm() + 1, m.tree.nv() + 10)};
  }));
}

TEST(PotentialEnergy, FallsByTheWorkOfGravity) {
  EXPECT_TRUE(HoldsForTrees("dV/dt = v'g", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    VectorXd g(m.tree.nv());
    const VectorXd zero = VectorXd::Zero(m.tree.nv());
    ComputeBias(m.tree, m.q, zero, &scratch, g);
    const VectorXd rate = RiddersRate([&](double t) {
      VectorXd q(m.tree.nq());
      Integrate(m.tree, m.q, m.v, t, q);
      return VectorXd::Constant(1, EnergiesAt(m.tree, q, m.v).potential);
    });
    const double scale = g.norm() * m.v.norm() + 1000;
    return Compare(VectorXd::Constant(1, m.v.dot(g)), rate,
                   kRiddersPrecision * scale);
  }));
}

TEST(PotentialEnergy, IsTheClosedForm) {
  const Tree tree =
      TreeBuilder()
          .AddLink("body", {2, {0, 0, 0.5}, Eigen::Matrix3d::Zero()})
          .SetGravity({0, 0, -10})
          .Build();
  VectorXd q = tree.MakeNeutral();
  q[2] = 3;
  EXPECT_EQ(EnergiesAt(tree, q, VectorXd::Zero(6)).potential, 2 * 10 * 3.5);
}

// Returns the power of the forces F_Bo_W [W].
double PowerOf(const TreeMotion& m) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(m.tree.num_bodies());
  ComputePoses(m.tree, m.q, &X_WB);
  ComputeVelocities(m.tree, X_WB, m.v, &V_WB_W);
  double power = 0;
  for (int b = 0; b < m.tree.num_bodies(); ++b) {
    power += Dot(V_WB_W[b], m.F_Bo_W[b]);
  }
  return power;
}

TEST(Energy, ChangesByThePowerOfTheForces) {
  EXPECT_TRUE(HoldsForTrees("dE/dt = v'tau + V'F", [](const TreeMotion& m) {
    Recursion scratch(m.tree);
    VectorXd tau(m.tree.nv());
    ComputeRnea(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &scratch, tau);
    const double power = m.v.dot(tau) + PowerOf(m);
    const VectorXd rate = RiddersRate([&](double t) {
      VectorXd q(m.tree.nq());
      Integrate(m.tree, m.q, m.v + 0.5 * t * m.vdot, t, q);
      const Energies E = EnergiesAt(m.tree, q, m.v + t * m.vdot);
      return VectorXd::Constant(1, E.kinetic + E.potential);
    });
    const double scale = tau.norm() * m.v.norm() + 1000;
    return Compare(VectorXd::Constant(1, power), rate,
                   kRiddersPrecision * scale);
  }));
}

TEST(Energy, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(m.tree.num_bodies());
  ComputePoses(m.tree, m.q, &X_WB);
  CountMalloc count;
  KineticEnergy(m.tree, X_WB, V_WB_W, m.v);
  PotentialEnergy(m.tree, X_WB);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
