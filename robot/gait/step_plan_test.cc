// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

// A problem with a landing region that is a circle of 12 sides.
StepProblem MakeProblem(const Eigen::Vector2d& xi_S, double side) {
  StepProblem problem;
  problem.xi_S = xi_S;
  problem.half_sole << 0.1, 0.05;
  problem.p_SZ = xi_S.cwiseMax(-problem.half_sole).cwiseMin(problem.half_sole);
  problem.omega = 3.5;
  problem.time_min = 0.2;
  problem.time_max = 0.3;
  problem.time_nominal = 0.25;
  problem.side = side;
  problem.width_min = 0.15;
  problem.base_S << 0, side * 0.1;
  problem.lift_off_S << 0, side * 0.17;
  problem.swing_speed = 3;
  problem.u_nominal_S << 0, side * 0.17;
  problem.b_nominal_S = -0.1 * problem.u_nominal_S;
  for (int i = 0; i < StepProblem::kSides; ++i) {
    problem.region_normal_S[i] = StepRegion::normal(i);
    problem.region_bound[i] = StepRegion::normal(i).dot(problem.base_S) + 0.5;
  }
  return problem;
}

// How far xi lands beyond the sole and the feet, by the problem's statement.
double Excess(const StepProblem& problem, const Eigen::Vector2d& u, double T) {
  const Eigen::Vector2d xi = problem.p_SZ + (problem.xi_S - problem.p_SZ) *
                                                std::exp(problem.omega * T);
  const Eigen::Vector2d b = xi - u;
  const double x = std::max(0.0, std::abs(b.x()) - problem.half_sole.x());
  const double out =
      std::max(0.0, problem.side * b.y() - problem.half_sole.y());
  const double in =
      std::max(0.0, -problem.half_sole.y() - problem.side * xi.y());
  return std::hypot(x, std::hypot(out, in));
}

bool IsAllowed(const StepProblem& problem, const Eigen::Vector2d& u, double T,
               double slack) {
  for (int i = 0; i < StepProblem::kSides; ++i) {
    if (problem.region_normal_S[i].dot(u) > problem.region_bound[i] + slack) {
      return false;
    }
    const double far = StepRegion::normal(i).dot(u - problem.lift_off_S);
    if (far > problem.swing_speed * (problem.time_over + T) + slack) {
      return false;
    }
  }
  return problem.side * u.y() >= problem.width_min - slack &&
         T >= problem.time_min - slack && T <= problem.time_max + slack;
}

StepProblem DrawProblem() {
  const double side = *rc::gen::element(-1.0, 1.0);
  const Eigen::Vector2d xi = 0.4 * (*VectorsXd(2, 1)).head<2>();
  return MakeProblem(xi, side);
}

// Second derivation: an exhaustive search over place and time. No place and
// time of the grid lets xi land nearer to the support.
RC_GTEST_PROP(StepPlan, NoPlaceOrTimeCatchesBetter, ()) {
  const StepProblem problem = DrawProblem();
  StepPlan planner;
  const PlannedStep step = planner.Solve(problem);
  RC_ASSERT(step.is_optimal);
  RC_ASSERT(step.certificate <= 1e-9);
  // The bound of the speed is linear in exp(w T): its tangent allows more time
  // than T itself, by (w dT)² / (2 w) with dT <= 0.05 s, times the speed.
  const double tangent = problem.swing_speed * problem.omega * 0.05 * 0.05 / 2 *
                         std::exp(problem.omega * 0.05);
  RC_ASSERT(IsAllowed(problem, step.u_S, step.time, tangent + 1e-9));
  RC_ASSERT(std::abs(Excess(problem, step.u_S, step.time) - step.excess) <
            1e-9);
  for (double T = problem.time_min; T <= problem.time_max; T += 0.01) {
    for (double x = -0.8; x <= 0.8; x += 0.04) {
      for (double y = -0.8; y <= 0.8; y += 0.04) {
        const Eigen::Vector2d u(x, y);
        if (!IsAllowed(problem, u, T, 0)) continue;
        RC_ASSERT(Excess(problem, u, T) >= step.excess - 1e-9);
      }
    }
  }
}

// Among the steps that catch equally well, none costs less.
RC_GTEST_PROP(StepPlan, NoEquallyGoodStepIsNearerToTheNominalOne, ()) {
  const StepProblem problem = DrawProblem();
  StepPlan planner;
  const PlannedStep step = planner.Solve(problem);
  RC_PRE(step.excess == 0);
  const auto cost = [&](const Eigen::Vector2d& u, double T) {
    const double tau = std::exp(problem.omega * T);
    const Eigen::Vector2d b =
        problem.p_SZ + (problem.xi_S - problem.p_SZ) * tau - u;
    const double dtau = tau - std::exp(problem.omega * problem.time_nominal);
    return 0.5 *
           (planner.place_weight * (u - problem.u_nominal_S).squaredNorm() +
            planner.offset_weight * (b - problem.b_nominal_S).squaredNorm() +
            planner.time_weight * dtau * dtau);
  };
  RC_ASSERT(std::abs(cost(step.u_S, step.time) - step.cost) <
            1e-9 * (1 + step.cost));
  for (double T = problem.time_min; T <= problem.time_max; T += 0.01) {
    for (double x = -0.8; x <= 0.8; x += 0.04) {
      for (double y = -0.8; y <= 0.8; y += 0.04) {
        const Eigen::Vector2d u(x, y);
        if (!IsAllowed(problem, u, T, 0) || Excess(problem, u, T) > 0) continue;
        RC_ASSERT(cost(u, T) >= step.cost - 1e-9);
      }
    }
  }
}

TEST(StepPlan, StepsToTheNominalPlaceWithoutAPush) {
  // xi at rest over the stance foot: the offset between the feet is not
  // reached, but the place is nearly the nominal one.
  const StepProblem problem = MakeProblem({0, 0.02}, 1);
  StepPlan planner;
  const PlannedStep step = planner.Solve(problem);
  EXPECT_EQ(step.excess, 0);
  EXPECT_LT(std::abs(step.u_S.x()), 1e-9);
  EXPECT_GE(step.u_S.y(), problem.width_min - 1e-9);
}

TEST(StepPlan, IsSymmetric) {
  StepPlan planner;
  const PlannedStep left = planner.Solve(MakeProblem({0.1, 0.2}, 1));
  const PlannedStep right = planner.Solve(MakeProblem({0.1, -0.2}, -1));
  EXPECT_NEAR(left.u_S.x(), right.u_S.x(), 1e-9);
  EXPECT_NEAR(left.u_S.y(), -right.u_S.y(), 1e-9);
  EXPECT_NEAR(left.time, right.time, 1e-9);
}

TEST(StepPlan, ContainsRefusesNaN) {
  const StepProblem problem = MakeProblem({0, 0}, 1);
  EXPECT_TRUE(Contains(problem, {0, 0.2}));
  EXPECT_FALSE(Contains(problem, {0, 0.1}));  // Crosses the stance foot.
  EXPECT_FALSE(Contains(problem, {0.6, 0.2}));
  EXPECT_FALSE(Contains(problem, {NAN, 0.2}));
  EXPECT_FALSE(Contains(problem, {0, NAN}));
}

}  // namespace
}  // namespace poise
