// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace poise {
namespace {

constexpr int kVariables = 5;  // u, b, exp(w T).
constexpr int kTau = 4;

std::vector<LevelCapacity> Capacity() {
  return {{2, 2 * StepProblem::kSides + 2}, {0, 3}, {5, 0}};
}

}  // namespace

bool Contains(const StepProblem& problem, const Eigen::Vector2d& u_S) noexcept {
  for (int i = 0; i < StepProblem::kSides; ++i) {
    // The comparisons are negated so that a NaN is outside.
    if (!(problem.region_normal_S[i].dot(u_S) <= problem.region_bound[i])) {
      return false;
    }
  }
  return problem.side * u_S.y() >= problem.width_min;
}

StepPlan::StepPlan()
    : hierarchy_(kVariables, Capacity()),
      solver_(kVariables, Capacity()),
      solution_(kVariables, Capacity()) {}

PlannedStep StepPlan::Solve(const StepProblem& problem) noexcept {
  hierarchy_.Clear(3);
  EqualityBlock motion = hierarchy_.AddEqualities(0, 2);
  motion.B.block<2, 2>(0, 0).setIdentity();
  motion.B.block<2, 2>(0, 2).setIdentity();
  motion.B.col(kTau) = problem.p_SZ - problem.xi_S;
  motion.b = -problem.p_SZ;

  InequalityBlock region =
      hierarchy_.AddInequalities(0, 2 * StepProblem::kSides + 2);
  for (int i = 0; i < StepProblem::kSides; ++i) {
    region.C.row(i).head<2>() = problem.region_normal_S[i];
    region.upper[i] = problem.region_bound[i];
  }
  // |u - lift_off| <= speed (over + T), with T linear in exp(w T) about the
  // nominal time.
  const double tau0 = std::exp(problem.omega * problem.time_nominal);
  const double slope = problem.swing_speed / (problem.omega * tau0);
  for (int i = 0; i < StepProblem::kSides; ++i) {
    const Eigen::Vector2d n = StepRegion::normal(i);
    const int row = StepProblem::kSides + 2 + i;
    region.C.row(row).head<2>() = n;
    region.C(row, kTau) = -slope;
    region.upper[row] =
        n.dot(problem.lift_off_S) - slope * tau0 +
        problem.swing_speed * (problem.time_over + problem.time_nominal);
  }
  region.C(StepProblem::kSides, 1) = problem.side;
  region.lower[StepProblem::kSides] = problem.width_min;
  region.C(StepProblem::kSides + 1, kTau) = 1;
  region.lower[StepProblem::kSides + 1] =
      std::exp(problem.omega * problem.time_min);
  region.upper[StepProblem::kSides + 1] =
      std::exp(problem.omega * problem.time_max);

  InequalityBlock caught = hierarchy_.AddInequalities(1, 3);
  caught.C(0, 2) = 1;
  caught.lower[0] = -problem.half_sole.x();
  caught.upper[0] = problem.half_sole.x();
  caught.C(1, 3) = problem.side;
  caught.upper[1] = problem.half_sole.y();
  caught.C(2, 1) = problem.side;
  caught.C(2, 3) = problem.side;
  caught.lower[2] = -problem.half_sole.y();

  EqualityBlock nominal = hierarchy_.AddEqualities(2, 5);
  nominal.B.setIdentity();
  nominal.b.head<2>() = -problem.u_nominal_S;
  nominal.b.segment<2>(2) = -problem.b_nominal_S;
  nominal.b[kTau] = -std::exp(problem.omega * problem.time_nominal);
  nominal.weight << place_weight, place_weight, offset_weight, offset_weight,
      time_weight;

  PlannedStep step;
  step.is_optimal = solver_.Solve(hierarchy_, &solution_) == Status::kOptimal;
  step.u_S = solution_.y.head<2>();
  step.b_S = solution_.y.segment<2>(2);
  step.time = std::log(std::max(1.0, solution_.y[kTau])) / problem.omega;
  step.excess = solution_.levels[1].slack.head<3>().norm();
  step.cost = solution_.levels[2].cost;
  step.certificate = solution_.certificate.worst();
  return step;
}

}  // namespace poise
