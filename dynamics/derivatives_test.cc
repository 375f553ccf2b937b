// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/derivatives.h"

#include <gtest/gtest.h>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

RneaDerivatives DerivativesOf(const TreeMotion& m) {
  RneaDerivatives out(m.tree);
  ComputeRneaDerivatives(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &out);
  return out;
}

VectorXd RneaAt(const TreeMotion& m, const VectorXd& q, const VectorXd& v,
                const VectorXd& vdot) {
  Recursion scratch(m.tree);
  VectorXd tau(m.tree.nv());
  ComputeRnea(m.tree, q, v, vdot, m.F_Bo_W, &scratch, tau);
  return tau;
}

// Compares with Ceres' numeric derivative at dx = 0 of tau as a function of dx.
template <typename Function>
Residual CompareWithCeres(const TreeMotion& m, const MatrixXd& ours,
                          Function tau_at) {
  if (m.tree.nv() == 0) return {0, 0};
  const MatrixXd ceres = RiddersJacobian(tau_at, VectorXd::Zero(m.tree.nv()));
  return Compare(ours, ceres, kRiddersPrecision * (1000 + ours.norm()));
}

constexpr int kMaxJoints = 8;  // Each joint takes some thousand evaluations.

TEST(RneaDerivatives, WithRespectToQAgreeWithCeres) {
  EXPECT_TRUE(HoldsForTrees(
      "dtau/dq",
      [](const TreeMotion& m) {
        return CompareWithCeres(m, DerivativesOf(m).dtau_dq,
                                [&m](const VectorXd& dq) {
                                  VectorXd q(m.tree.nq());
                                  Integrate(m.tree, m.q, dq, 1, q);
                                  return RneaAt(m, q, m.v, m.vdot);
                                });
      },
      kMaxJoints));
}

TEST(RneaDerivatives, WithRespectToVAgreeWithCeres) {
  EXPECT_TRUE(HoldsForTrees(
      "dtau/dv",
      [](const TreeMotion& m) {
        return CompareWithCeres(m, DerivativesOf(m).dtau_dv,
                                [&m](const VectorXd& dv) {
                                  return RneaAt(m, m.q, m.v + dv, m.vdot);
                                });
      },
      kMaxJoints));
}

TEST(RneaDerivatives, WithRespectToAccelerationAgreeWithCeres) {
  EXPECT_TRUE(HoldsForTrees(
      "dtau/dv̇",
      [](const TreeMotion& m) {
        return CompareWithCeres(m, DerivativesOf(m).dtau_dvdot,
                                [&m](const VectorXd& dvdot) {
                                  return RneaAt(m, m.q, m.v, m.vdot + dvdot);
                                });
      },
      kMaxJoints));
}

TEST(RneaDerivatives, WithoutOutsideForcesAreThoseOfZeroForces) {
  EXPECT_TRUE(HoldsForTrees("no forces", [](const TreeMotion& motion) {
    TreeMotion m = motion;
    // Values of an earlier call must not change the result.
    RneaDerivatives none = DerivativesOf(m);
    ComputeRneaDerivatives(m.tree, m.q, m.v, m.vdot, {}, &none);
    m.F_Bo_W.assign(m.tree.num_bodies(), SpatialForce());
    const RneaDerivatives zero = DerivativesOf(m);
    MatrixXd difference = none.dtau_dq - zero.dtau_dq;
    difference += none.dtau_dv - zero.dtau_dv;
    difference += none.dtau_dvdot - zero.dtau_dvdot;
    return Compare(difference, 0 * difference, 0);
  }));
}

TEST(RneaDerivatives, DoNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  RneaDerivatives out(m.tree);
  CountMalloc count;
  ComputeRneaDerivatives(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &out);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
