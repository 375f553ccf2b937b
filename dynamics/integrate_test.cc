// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/integrate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::VectorXd;

Tree MakeBody() { return TreeBuilder().AddLink("body").Build(); }

TEST(Integrate, TurnsAboutTheWorldsAxes) {
  // Rotation by 90 degrees about x, then by 90 degrees about the world's z.
  const double half = std::sqrt(0.5);
  VectorXd q(7), v(6), expected(7);
  q << 1, 2, 3, half, 0, 0, half;
  v << 0, 0, M_PI, 4, 5, 6;
  expected << 3, 4.5, 6, 0.5, 0.5, 0.5, 0.5;
  VectorXd q_out(7);
  Integrate(MakeBody(), q, v, 0.5, q_out);
  EXPECT_NEAR((q_out - expected).norm(), 0, Rounding(6, 7));
}

TEST(Integrate, MayWriteOverItsInput) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 5, 1});
  VectorXd expected(m.tree.nq()), q = m.q;
  Integrate(m.tree, q, m.v, 0.1, expected);
  Integrate(m.tree, q, m.v, 0.1, q);
  EXPECT_EQ(q, expected);
}

TEST(Integrate, NormalizesTheQuaternion) {
  VectorXd q = MakeBody().MakeNeutral(), expected = q, q_out(7);
  for (const double norm : {1e-300, 1e-160, 3.0, 1e160, 1e300}) {
    q[6] = norm;
    Integrate(MakeBody(), q, VectorXd::Zero(6), 1, q_out);
    EXPECT_EQ(q_out, expected);
  }
  q[6] = 0;
  Integrate(MakeBody(), q, VectorXd::Zero(6), 1, q_out);
  EXPECT_TRUE(q_out.tail<4>().array().isNaN().all());
}

TEST(Integrate, KeepsTinyRotations) {
  const Tree body = MakeBody();
  for (const double angle : {1e-300, 1e-20, 1e-9, 1e-4}) {
    SCOPED_TRACE(angle);
    VectorXd v = VectorXd::Zero(6), q_out(7), v_back(6);
    v[1] = angle;
    Integrate(body, body.MakeNeutral(), v, 1, q_out);
    EXPECT_NEAR(q_out[4], std::sin(angle / 2), Rounding(angle, 1));
    Difference(body, body.MakeNeutral(), q_out, v_back);
    EXPECT_NEAR(v_back[1], angle, Rounding(angle, 2));
  }
}

TEST(Difference, UndoesIntegrate) {
  EXPECT_TRUE(HoldsForTrees("q - q [+] v = v", [](const TreeMotion& m) {
    VectorXd q_to(m.tree.nq()), v(m.tree.nv());
    Integrate(m.tree, m.q, m.v, 0.8, q_to);  // |w| dt < pi.
    Difference(m.tree, m.q, q_to, v);
    return Compare(v, 0.8 * m.v, Rounding(4, 8));
  }));
}

TEST(Difference, GoesTheShorterWayRound) {
  const Tree body = MakeBody();
  VectorXd v = VectorXd::Zero(6), q_to(7), v_back(6);
  v[2] = 5;
  Integrate(body, body.MakeNeutral(), v, 1, q_to);
  Difference(body, body.MakeNeutral(), q_to, v_back);
  EXPECT_NEAR(v_back[2], 5 - 2 * M_PI, Rounding(5, 2));
}

TEST(Difference, IsZeroBetweenAQuaternionAndItsNegative) {
  const Tree body = MakeBody();
  VectorXd q = body.MakeNeutral(), v(6);
  q[6] = -1;
  Difference(body, body.MakeNeutral(), q, v);
  EXPECT_TRUE(v.isZero(0));
}

TEST(Integrate, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 5, 1});
  VectorXd q_out(m.tree.nq()), v_out(m.tree.nv());
  CountMalloc count;
  Integrate(m.tree, m.q, m.v, 0.1, q_out);
  Difference(m.tree, m.q, q_out, v_out);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
