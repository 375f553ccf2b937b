// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/hqp/solve_files.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace poise {
namespace {

// y >= 3 above y = 0: a cold solve takes two iterations, a warm one takes one.
HqpProblem TwoLevels() {
  return ReadHqp(R"({"format": "hqp-1", "variables": 1, "levels": [
      {"C": [[1]], "lower": [3], "upper": [9]}, {"B": [[1]], "b": [0]}]})");
}

int SecondIterations(const HqpMethod& method) {
  const std::vector<HqpProblem> problems = {TwoLevels(), TwoLevels()};
  HqpSequence sequence(method, problems);
  Solution solution(1, problems[0].capacity);
  SolveTimes times = {-1, {}};
  for (const HqpProblem& problem : problems) {
    EXPECT_EQ(sequence.Solve(problem, &solution, &times), Status::kOptimal);
    EXPECT_NEAR(solution.y[0], 3, 1e-9);  // Far above rounding errors.
    EXPECT_GE(times.measured, 0);
  }
  return solution.iterations;
}

TEST(HqpSequence, StartsFromThePreviousWorkingSet) {
  EXPECT_EQ(SecondIterations({}), 1);
}

TEST(HqpSequence, StartsColdIfRequested) {
  HqpMethod method;
  method.cold = true;
  EXPECT_EQ(SecondIterations(method), 2);
}

// A target beyond 20 bounds needs a change of the working set for each of them.
// A budget of 1 us allows two iterations.
TEST(HqpSequence, LimitsThePredictedTime) {
  constexpr int kRows = 20;
  const std::vector<LevelCapacity> capacity = {{0, kRows}, {kRows, 0}};
  HqpProblem problem{capacity, Hierarchy(kRows, capacity), {}};
  InequalityBlock bounds = problem.hierarchy.AddInequalities(0, kRows);
  bounds.C.setIdentity();
  EqualityBlock target = problem.hierarchy.AddEqualities(1, kRows);
  for (int i = 0; i < kRows; ++i) {
    bounds.upper[i] = i + 1;
    target.B.row(i).setOnes();
    target.B(i, i) = 2;
    target.b[i] = -10 * kRows;
  }
  problem.hierarchy.FindSpans();
  for (const double budget_us : {0.0, 1.0}) {
    HqpMethod method;
    method.budget_us = budget_us;
    HqpSequence sequence(method, {problem});
    Solution solution(kRows, capacity);
    SolveTimes times;
    EXPECT_EQ(sequence.Solve(problem, &solution, &times),
              budget_us == 0 ? Status::kOptimal : Status::kIterationLimit);
    ASSERT_TRUE(times.modelled.has_value());
    EXPECT_GT(*times.modelled, 1);  // Two iterations take longer than 1 us.
    if (budget_us > 0) {
      EXPECT_EQ(solution.iterations, 2);
    }
  }
}

// A replay is exact if the solver keeps as many factors as a controller's: the
// answers are the same to the last bit.
TEST(HqpSequence, RepeatsTheSolverOfAController) {
  constexpr int kVariables = 12, kRows = 40;
  const std::vector<LevelCapacity> capacity = {
      {3, kRows}, {4, kRows}, {kVariables, 0}};
  Solver controller(kVariables, capacity, 2 * (kVariables + kRows));
  Solution expected(kVariables, capacity), solution(kVariables, capacity);
  HqpProblem problem{capacity, Hierarchy(kVariables, capacity), {}};
  HqpSequence sequence({}, {problem});
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int tick = 0; tick < 60; ++tick) {
    Hierarchy& hierarchy = problem.hierarchy;
    hierarchy.Clear(3);
    const auto draw = [&](auto&& rows) {
      for (auto row : rows.rowwise()) {
        for (double& entry : row) entry = normal(random);
      }
    };
    for (const int level : {0, 1}) {
      EqualityBlock targets = hierarchy.AddEqualities(level, 3 + level);
      draw(targets.B);
      draw(targets.b);
      InequalityBlock bounds = hierarchy.AddInequalities(level, kRows);
      draw(bounds.C);
      draw(bounds.upper);
    }
    hierarchy.AddEqualities(2, kVariables).B.setIdentity();
    SolveTimes times;
    EXPECT_EQ(sequence.Solve(problem, &solution, &times),
              controller.Solve(hierarchy, &expected));
    EXPECT_EQ(solution.y, expected.y) << tick;
  }
}

TEST(HqpSequence, SolvesWithTheCascade) {
  for (const char* name : {"svd", "cod"}) {
    SCOPED_TRACE(name);
    HqpMethod method;
    method.name = name;
    (void)SecondIterations(method);
  }
}

}  // namespace
}  // namespace poise
