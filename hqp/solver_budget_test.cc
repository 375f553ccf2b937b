// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves that a limit of iterations or time ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/fast/budget.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/hierarchy_by_hand.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-14;  // A few operations on numbers near 1.
constexpr double kCertified = Certifier::kCertified;

void ExpectGapsDownToFailedLevel(const Hierarchy& hierarchy,
                                 const Solution& solution) {
  const int failed = solution.failed_level;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const double gap = solution.levels[level].gap;
    EXPECT_EQ(std::isfinite(gap), failed < 0 || level <= failed) << level;
  }
}

// The number of iterations is bounded by max_iterations, also when the budget
// is too small for the answer.
TEST(SolverBudget, TakesNoMoreIterationsThanItsLimit) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    for (const int budget : {0, 1, 2, 3, 5, 8, 500}) {
      solver.Forget();
      solver.max_iterations = budget;
      const Status status = solver.Solve(drawn.hierarchy, &solution);
      EXPECT_LE(solution.iterations, budget);
      EXPECT_EQ(status == Status::kOptimal, solution.failed_level < 0);
      ExpectGapsDownToFailedLevel(drawn.hierarchy, solution);
      // The levels above failed_level are certified.
      EXPECT_LE(certifier.Certify(drawn.hierarchy, solution).worst(),
                kCertified);
    }
  }
}

// Returns the first level that costs more at an answer than at another one, or
// -1 if a level above costs less, or if no level costs more.
int FirstWorseLevel(const Hierarchy& hierarchy, const Solution& solution,
                    const Solution& than) {
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    const double change = solution.levels[k].cost - than.levels[k].cost;
    const int terms = hierarchy.num_variables() + hierarchy.num_equalities(k) +
                      hierarchy.num_inequalities(k);
    const double size =
        CostSize(hierarchy, k, solution) + CostSize(hierarchy, k, than);
    // Answers are right to about the condition number of their rows, 1e3, times
    // the rounding of their sums.
    if (std::abs(change) > Rounding(size, terms, 1e3))
      return change > 0 ? k : -1;
  }
  return -1;
}

// Numbers of iterations, and times [s]. The times allow few iterations beside
// the modelled time of a solve.
constexpr double kBudgets[] = {2, 3, 5, 8, 36e-6, 50e-6};

void SetLimit(double limit, Solver* solver) {
  const bool is_time = limit > 0 && limit < 1;
  solver->max_iterations = is_time ? 500 : static_cast<int>(limit);
  solver->max_modelled_seconds = is_time ? limit : 0;
}

// Solves one hierarchy again and again. Expects that no answer is worse than
// the one before, and that the optimum is found. Returns the number of solves
// that were stopped.
int SolveInSteps(const Hierarchy& hierarchy, const Solution& optimum,
                 int max_solves, Solver* solver) {
  int stopped = 0;
  Solution now = optimum;
  std::optional<Solution> before;
  Status status = Status::kIterationLimit;
  for (int solve = 0; solve < max_solves && status != Status::kOptimal;
       ++solve) {
    const CountMalloc count;
    status = solver->Solve(hierarchy, &now);
    EXPECT_EQ(count.allocations(), 0);
    EXPECT_LE(now.iterations, solver->max_iterations);
    EXPECT_TRUE(!before || FirstWorseLevel(hierarchy, now, *before) < 0)
        << solve;
    before = now;
    stopped += status != Status::kOptimal;
  }
  EXPECT_EQ(status, Status::kOptimal);
  EXPECT_LT(FirstWorseLevel(hierarchy, now, optimum), 0);
  return stopped;
}

// A solver that is stopped too early in each solve goes on from where it was:
// its answers never get worse, and it arrives at the optimum.
TEST(SolverBudget, GoesOnFromWhereItWasStopped) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  int stopped = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    Solver solver(n, drawn.capacity);
    Solution optimum(n, drawn.capacity);
    ASSERT_EQ(solver.Solve(hierarchy, &optimum), Status::kOptimal);
    // Each solve needs one factorisation to know its start.
    const int most = 2 * optimum.iterations + 1;
    for (const double limit : kBudgets) {
      SCOPED_TRACE(limit);
      solver.Forget();
      SetLimit(limit, &solver);
      stopped += SolveInSteps(hierarchy, optimum, most, &solver);
    }
  }
  EXPECT_GT(stopped, 200);
}

struct Neighbors {
  HierarchyCase drawn, changed;
};

// Draws a hierarchy, and the same one after ChangeHierarchy().
Neighbors DrawNeighbors(int seed) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.max_inequalities = 12;
  HierarchyCase drawn = WithRoomToChange(MakeRandomHierarchy(seed, options));
  HierarchyCase changed = drawn;
  ChangeHierarchy(seed, &changed);
  return {std::move(drawn), std::move(changed)};
}

// As above, after the rows have changed, so that the search follows a path from
// the last optimum.
TEST(SolverBudget, GoesOnAlongAPath) {
  int stopped = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto [drawn, changed] = DrawNeighbors(seed);
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity), cold(n, drawn.capacity);
    Solution optimum(n, drawn.capacity), now(n, drawn.capacity);
    ASSERT_EQ(cold.Solve(changed.hierarchy, &optimum), Status::kOptimal);
    for (const double limit : kBudgets) {
      SCOPED_TRACE(limit);
      solver.Forget();
      SetLimit(500, &solver);
      ASSERT_EQ(solver.Solve(drawn.hierarchy, &now), Status::kOptimal);
      SetLimit(limit, &solver);
      // Each solve advances by a row at least. No row is removed more than ten
      // times in a solve.
      stopped += SolveInSteps(changed.hierarchy, optimum, 100, &solver);
    }
  }
  EXPECT_GT(stopped, 200);
}

struct Stopped {
  int solves = 0;
  int worse = 0;  // Answers that are worse than with one iteration less.
};

// Solves `changed` from the optimum of `drawn`, with limits of 0, 1, 2, ...
// iterations until none is needed.
Stopped SolveWithLargerLimits(const HierarchyCase& drawn,
                              const Hierarchy& changed) {
  constexpr int kMost = 100;
  const int n = drawn.hierarchy.num_variables();
  Solver solver(n, drawn.capacity);
  Solution now(n, drawn.capacity);
  std::optional<Solution> before;
  Stopped stopped;
  Status status = Status::kIterationLimit;
  for (int limit = 0; status != Status::kOptimal && limit < kMost; ++limit) {
    SCOPED_TRACE(limit);
    solver.Forget();
    solver.max_iterations = 500;
    EXPECT_EQ(solver.Solve(drawn.hierarchy, &now), Status::kOptimal);
    solver.max_iterations = limit;
    status = solver.Solve(changed, &now);
    stopped.worse += before && FirstWorseLevel(changed, now, *before) >= 0;
    before = now;
    stopped.solves += status != Status::kOptimal;
  }
  EXPECT_EQ(status, Status::kOptimal);
  return stopped;
}

// The cost of a level need not fall at each step of a path. So of 20 000
// problems, 36 have an answer that is worse with one iteration more
// (docs/limits.md); of 200, five or more have one with a probability below
// 1e-4.
TEST(SolverBudget, IsNoWorseWithOneIterationMore) {
  int stopped = 0, worse = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto [drawn, changed] = DrawNeighbors(seed);
    const Stopped of = SolveWithLargerLimits(drawn, changed.hierarchy);
    stopped += of.solves;
    worse += of.worse > 0;
  }
  EXPECT_GT(stopped, 200);
  EXPECT_LT(worse, 5);
}

// The optimum of the working set meets the levels before the last one, but
// violates more bounds of the last one than the answer of the last solve.
TEST(SolverBudget, NeverGetsWorseWhileItMeetsTheLevelsBeforeTheLast) {
  const std::vector<LevelCapacity> capacity = {{0, 0}, {0, 3}};
  Hierarchy hierarchy(1, capacity);
  const auto set = [&](double lower0, double upper0, double lower1,
                       double upper1, double upper2) {
    hierarchy.Clear(2);
    InequalityBlock rows = hierarchy.AddInequalities(1, 3);
    rows.C << 0.168735, 0.663447, 0.868708;
    rows.lower.head(2) << lower0, lower1;
    rows.upper << upper0, upper1, upper2;
  };
  Solver solver(1, capacity);
  Solution solution(1, capacity);
  set(-0.48687, -0.113943, 0.873413, 1.04694, 0);
  ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
  set(0.259948, 0.632875, 0.0885357, 0.262061, 0.815315);
  solver.max_modelled_seconds = 1e-9;  // Each solve makes two iterations only.
  double last = std::numeric_limits<double>::infinity();
  Status status = Status::kIterationLimit;
  for (int i = 0; i < 10 && status != Status::kOptimal; ++i) {
    status = solver.Solve(hierarchy, &solution);
    // A sum of three squares has a rounding of some 1e-16.
    EXPECT_LE(solution.levels[1].cost, last * (1 + 1e-12)) << i;
    last = solution.levels[1].cost;
  }
  EXPECT_EQ(status, Status::kOptimal);
}

// Returns the same problem with other targets and bounds, as most ticks have:
// each is shifted by a normally distributed number of 0.1, where the rows have
// entries near 1.
HierarchyCase WithMovedBounds(const HierarchyCase& drawn, int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.1);
  const Hierarchy& from = drawn.hierarchy;
  HierarchyCase moved = drawn;
  moved.hierarchy.Clear(from.num_levels());
  for (int k = 0; k < from.num_levels(); ++k) {
    auto [equalities, inequalities] = CopyLevel(from, k, &moved.hierarchy);
    for (double& b : equalities.b) b += normal(random);
    for (int i = 0; i < from.num_inequalities(k); ++i) {
      const double by = normal(random);
      inequalities.lower[i] += by;
      inequalities.upper[i] += by;
    }
  }
  moved.hierarchy.FindSpans();
  return moved;
}

// Returns the answer of the working set of the last tick, by singular value
// decompositions: each level is minimised over its equalities and active
// bounds, among the optima of the levels above, and y has minimum norm.
Solution AnswerOfWorkingSet(const HierarchyCase& now, const Solution& last) {
  const Hierarchy& hierarchy = now.hierarchy;
  const int n = hierarchy.num_variables();
  std::vector<LeastSquares> levels;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    levels.push_back({hierarchy.B(k), -hierarchy.b(k), hierarchy.weight(k)});
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      const double lower = hierarchy.lower(k)[i], upper = hierarchy.upper(k)[i];
      const Side side =
          lower == upper ? Side::kUpper : last.levels[k].active[i];
      const double bound = side == Side::kUpper ? upper : lower;
      if (side == Side::kNone || std::isinf(bound)) continue;
      AppendRow(hierarchy.C(k).row(i), bound, &levels.back());
    }
  }
  Solution answer(n, now.capacity);
  answer.Reset();
  answer.y = SolveLexicographically(n, levels).y;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    EvaluateLevel(hierarchy, k, &answer);
  }
  return answer;
}

struct Judged {
  int stopped = 0;    // Solves.
  int certified = 0;  // Levels of these that are certified.
  int worse = 0;      // Solves that are worse than the last working set.
};

// Solves `drawn`, and then `changed` with a limit. Compares the second answer
// with that of the first one's working set.
void JudgeStopped(const HierarchyCase& drawn, const HierarchyCase& changed,
                  double limit, Judged* judged) {
  const int n = drawn.hierarchy.num_variables();
  Solver solver(n, drawn.capacity);
  Solution last(n, drawn.capacity), now(n, drawn.capacity);
  ASSERT_EQ(solver.Solve(drawn.hierarchy, &last), Status::kOptimal);
  SetLimit(limit, &solver);
  int certified = changed.hierarchy.num_levels();
  if (solver.Solve(changed.hierarchy, &now) != Status::kOptimal) {
    ++judged->stopped;
    certified = now.failed_level;
    judged->certified += certified;
  }
  const Solution than = AnswerOfWorkingSet(changed, last);
  const int worse = FirstWorseLevel(changed.hierarchy, now, than);
  EXPECT_TRUE(worse < 0 || worse >= certified) << worse;
  judged->worse += worse >= 0;
}

// The levels above failed_level cost no more than at the answer of the last
// tick's working set, which a stopped solver could have returned.
TEST(SolverBudget, CertifiedLevelsAreNoWorseThanTheLastWorkingSet) {
  Judged judged;
  for (int seed = 0; seed < 200; ++seed) {
    const auto [drawn, changed] = DrawNeighbors(seed);
    // Iterations, and times [s] around that of a solve without any, 16 us.
    for (const double limit : {0.0, 1.0, 2.0, 3.0, 20e-6, 40e-6}) {
      SCOPED_TRACE(testing::Message() << seed << ", " << limit);
      JudgeStopped(drawn, changed, limit, &judged);
    }
  }
  EXPECT_GT(judged.stopped, 200);
  EXPECT_GT(judged.certified, 100);
}

// With one iteration, if only targets and bounds move, all levels together are
// at least as good: this iteration finds the answer of the last working set,
// and the solver keeps the better one. If the rows change as well,
// docs/limits.md says how often it fails.
TEST(SolverBudget, IsNoWorseThanTheLastWorkingSet) {
  Judged judged;
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = DrawNeighbors(seed).drawn;
    JudgeStopped(drawn, WithMovedBounds(drawn, seed), 1, &judged);
  }
  EXPECT_GT(judged.stopped, 50);
  EXPECT_EQ(judged.worse, 0);
}

// An example: y <= bound on level 0, y = target on level 1. The path moves the
// bound from 1 to 1/2 and the target from 2 to 0. The bound is active until
// both meet after 2/3 of the path, where y = 2/3 exceeds the bound at the end.
// The working set has y = 1/2.
TEST(SolverBudget, KeepsABoundThatTheLastWorkingSetMeets) {
  const auto tick = [](double bound, double target) {
    return HierarchyByHand(
        1, {{0, {1}, -INFINITY, bound}, {1, {1}, target, target}});
  };
  const HierarchyByHand first = tick(1, 2), second = tick(0.5, 0);
  Solver solver(1, first.capacity);
  Solution solution(1, first.capacity);
  ASSERT_EQ(solver.Solve(first.hierarchy, &solution), Status::kOptimal);
  solver.max_iterations = 1;
  EXPECT_EQ(solver.Solve(second.hierarchy, &solution), Status::kIterationLimit);
  EXPECT_NEAR(solution.y[0], 0.5, kTolerance);
  solver.max_iterations = 2;
  EXPECT_EQ(solver.Solve(second.hierarchy, &solution), Status::kOptimal);
  EXPECT_NEAR(solution.y[0], 0, kTolerance);
}

// The rows change in each solve, and bounds become infinite or equal, while the
// budget ends each solve. Afterwards, an ample budget suffices for the optimum,
// and a solver that forgets is as new.
TEST(SolverBudget, RecoversFromSolvesThatAreCutOff) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.max_inequalities = 12;
  int stopped = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    HierarchyCase drawn = WithRoomToChange(MakeRandomHierarchy(seed, options));
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity), fresh(n, drawn.capacity);
    Solution now(n, drawn.capacity), expected(n, drawn.capacity);
    ASSERT_EQ(solver.Solve(drawn.hierarchy, &now), Status::kOptimal);
    // 40 us allow about three iterations.
    for (const double seconds : {0.0, 40e-6}) {
      SCOPED_TRACE(seconds);
      solver.max_modelled_seconds = seconds;
      for (int tick = 0; tick < 12; ++tick) {
        ChangeHierarchy(seed + tick, &drawn);
        solver.max_iterations = seconds > 0 ? 500 : 2 + tick % 3;
        stopped += solver.Solve(drawn.hierarchy, &now) != Status::kOptimal;
      }
      solver.max_modelled_seconds = 0;
      fresh.max_iterations = solver.max_iterations = 500;
      fresh.Forget();
      ASSERT_EQ(fresh.Solve(drawn.hierarchy, &expected), Status::kOptimal);
      EXPECT_EQ(solver.Solve(drawn.hierarchy, &now), Status::kOptimal);
      EXPECT_LT(FirstWorseLevel(drawn.hierarchy, now, expected), 0);
      // With two iterations a path is cut off, and then forgotten.
      ChangeHierarchy(seed + 100, &drawn);
      solver.max_iterations = 2;
      (void)solver.Solve(drawn.hierarchy, &now);
      solver.max_iterations = 500;
      solver.Forget();
      fresh.Forget();
      (void)fresh.Solve(drawn.hierarchy, &expected);
      (void)solver.Solve(drawn.hierarchy, &now);
      EXPECT_EQ(now.y, expected.y);
    }
  }
  EXPECT_GT(stopped, 500);
}

// Level 0 has the bounds -1 <= y_j <= 1, and the targets of level 1 leave them
// and come back to 0. A path from the last answer removes the 40 bounds one by
// one, a search from the start needs one iteration.
TEST(SolverBudget, StartsOverIfItIsStoppedAgainAndAgain) {
  constexpr int kVariables = 40;
  const std::vector<LevelCapacity> capacity{{0, kVariables}, {kVariables, 0}};
  Hierarchy hierarchy(kVariables, capacity);
  InequalityBlock bounds = hierarchy.AddInequalities(0, kVariables);
  bounds.C.setIdentity();
  bounds.lower.setConstant(-1);
  bounds.upper.setConstant(1);
  EqualityBlock target = hierarchy.AddEqualities(1, kVariables);
  target.B.setIdentity();
  target.B.diagonal(1).setConstant(0.1);
  target.b.setConstant(-5);
  Solver solver(kVariables, capacity), cold(kVariables, capacity);
  Solution solution(kVariables, capacity);
  ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);

  target.b.setZero();
  cold.max_iterations = solver.max_iterations = 2;
  ASSERT_EQ(cold.Solve(hierarchy, &solution), Status::kOptimal);
  int solves = 1;
  while (solver.Solve(hierarchy, &solution) != Status::kOptimal) {
    ASSERT_LT(++solves, kVariables);
  }
  EXPECT_GT(solves, 2);
  EXPECT_TRUE(solution.y.isZero(kTolerance));
}

// Draws matrices of normally distributed numbers.
class DrawMatrix {
 public:
  explicit DrawMatrix(int seed) : numbers_(seed) {}
  RowMajorMatrix operator()(int rows, int columns) {
    return RowMajorMatrix::NullaryExpr(rows, columns,
                                       [&] { return normal_(numbers_); });
  }

 private:
  std::mt19937 numbers_;
  std::normal_distribution<double> normal_;
};

// The rows of all levels drift, so that the last y misses the equalities of
// level 0 a little. A search that starts over and is cut off as well must not
// give up the limits of level 1, which the last y nearly met.
TEST(SolverBudget, KeepsTheLimitsIfItStartsOverInVain) {
  constexpr int kVariables = 40, kTicks = 60;
  const std::vector<LevelCapacity> capacity{
      {12, 0}, {0, 80}, {12, 0}, {kVariables, 0}};
  DrawMatrix draw(1);
  const RowMajorMatrix B = draw(12, kVariables), B_rate = draw(12, kVariables);
  const RowMajorMatrix T = draw(12, kVariables), C = draw(80, kVariables);
  const Eigen::VectorXd b = draw(12, 1), target = 6 * draw(12, 1);
  Solver solver(kVariables, capacity);
  Solution solution(kVariables, capacity);
  double largest = 0;
  int cut_off = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    Hierarchy hierarchy(kVariables, capacity);
    EqualityBlock first = hierarchy.AddEqualities(0, 12);
    first.B = B + 1e-3 * tick * B_rate;
    first.b = b;
    InequalityBlock limits = hierarchy.AddInequalities(1, 80);
    limits.C = C;
    limits.lower.setConstant(-1);
    limits.upper.setConstant(1);
    EqualityBlock last = hierarchy.AddEqualities(2, 12);
    last.B = T;
    if (tick > 0) last.b = target;
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    solver.max_iterations = tick == 0 ? 500 : 2;
    cut_off += solver.Solve(hierarchy, &solution) != Status::kOptimal;
    // The limits can be met; a tick of drift costs about 1e-5.
    const double cost = solution.levels[1].cost;
    if (tick > 1) {
      EXPECT_LE(cost, 100 * largest) << tick;
    }
    largest = std::max(largest, cost);
  }
  EXPECT_EQ(cut_off, kTicks - 1);
}

// Adds equalities B y + b = 0.
void AddEqualities(int level, const RowMajorMatrix& B, const RowMajorMatrix& b,
                   Hierarchy* hierarchy) {
  EqualityBlock rows =
      hierarchy->AddEqualities(level, static_cast<int>(B.rows()));
  rows.B = B;
  rows.b = b;
}

// Adds bounds of C y, which are `largest` on both sides of zero.
void AddLimits(int level, const RowMajorMatrix& C, double largest,
               Hierarchy* hierarchy) {
  InequalityBlock rows =
      hierarchy->AddInequalities(level, static_cast<int>(C.rows()));
  rows.C = C;
  rows.lower.setConstant(-largest);
  rows.upper.setConstant(largest);
}

// Ticks that lose level 0 or 1, and the time of all ticks.
struct LostLimits {
  int ticks = 0;
  double modelled_seconds = 0;
};

// Solves 200 ticks. Level 0 must be met, level 1 has limits, level 2 has a
// task, whose target jumps in each tick, and level 3 chooses among the optima.
LostLimits CountLostLimits(int max_iterations, double max_modelled_seconds) {
  constexpr int kVariables = 40, kLimits = 80, kTask = 12;
  const std::vector<LevelCapacity> capacity{
      {12, 0}, {0, kLimits}, {kTask, 0}, {kVariables, 0}};
  DrawMatrix draw(2);
  const RowMajorMatrix B = draw(12, kVariables), T = draw(kTask, kVariables);
  const RowMajorMatrix C = draw(kLimits, kVariables);
  Solver solver(kVariables, capacity);
  Solution solution(kVariables, capacity);
  LostLimits lost;
  for (int tick = 0; tick < 200; ++tick) {
    Hierarchy hierarchy(kVariables, capacity);
    AddEqualities(0, B, draw(12, 1), &hierarchy);
    AddLimits(1, C, 3, &hierarchy);
    AddEqualities(2, T, 10 * draw(kTask, 1), &hierarchy);
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    if (tick > 0) {
      solver.max_iterations = max_iterations;
      solver.max_modelled_seconds = max_modelled_seconds;
    }
    const Status status = solver.Solve(hierarchy, &solution);
    lost.ticks += status != Status::kOptimal && solution.failed_level < 2;
    lost.modelled_seconds += solver.modelled_seconds();
  }
  return lost;
}

// With a limit of time, limits come before the task. So fewer ticks lose them
// than if all levels are searched at once, for as long or longer.
TEST(SolverBudget, LosesTheLastLeadingLevelFirst) {
  // Enough for the limits in most ticks, but not for the task.
  const LostLimits limited = CountLostLimits(500, 500e-6);
  LostLimits at_once;
  for (int iterations = 5; at_once.modelled_seconds < limited.modelled_seconds;
       ++iterations) {
    ASSERT_LE(iterations, 500);
    at_once = CountLostLimits(iterations, 0);
  }
  EXPECT_LT(2 * limited.ticks, at_once.ticks)
      << limited.modelled_seconds << " s and " << at_once.modelled_seconds;
}

// Draws ticks whose equalities and targets wander. Level 1 limits y, and level
// 2, which is searched last, is a task.
class WanderingTicks {
 public:
  static constexpr int kVariables = 20, kTask = 2;
  explicit WanderingTicks(double speed) : speed_(speed) {}
  Hierarchy Draw() {
    b_ += speed_ * draw_(4, 1);
    t_ += 3 * speed_ * draw_(6, 1);
    Hierarchy hierarchy(kVariables, capacity_);
    AddEqualities(0, B_, b_, &hierarchy);
    AddLimits(1, C_, 1, &hierarchy);
    AddEqualities(kTask, T_, t_, &hierarchy);
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    hierarchy.FindSpans();
    return hierarchy;
  }
  Solver MakeSolver() const { return Solver(kVariables, capacity_); }
  Solution MakeSolution() const { return Solution(kVariables, capacity_); }

 private:
  double speed_;
  std::vector<LevelCapacity> capacity_{
      {4, 0}, {0, 30}, {6, 0}, {kVariables, 0}};
  DrawMatrix draw_{5};
  RowMajorMatrix B_ = draw_(4, kVariables), C_ = draw_(30, kVariables);
  RowMajorMatrix T_ = draw_(6, kVariables), b_ = draw_(4, 1);
  RowMajorMatrix t_ = 3 * draw_(6, 1);
};

// A path that ends within its share of the time is not preceded by another
// search: limits that block at its start are added on the path.
TEST(SolverBudget, TakesNoMoreIterationsIfThePathEndsInTime) {
  WanderingTicks ticks(0.1);
  Solver solver = ticks.MakeSolver(), timed = ticks.MakeSolver();
  Solution solution = ticks.MakeSolution();
  int in_time = 0, without = 0, with = 0;
  for (int tick = 0; tick < 200; ++tick) {
    SCOPED_TRACE(tick);
    const Hierarchy hierarchy = ticks.Draw();
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    without += solution.iterations;
    timed.max_modelled_seconds = solver.modelled_seconds() / 0.75;
    in_time += timed.Solve(hierarchy, &solution) == Status::kOptimal;
    with += solution.iterations;
    timed.max_modelled_seconds = 1;
    ASSERT_EQ(timed.Solve(hierarchy, &solution), Status::kOptimal);
  }
  EXPECT_GT(in_time, 180);
  EXPECT_GT(without, 600);
  EXPECT_LT(with, 1.05 * without);
}

// A path that is cut off leaves time to meet the limits. Each path begins at an
// optimum. The limit is 0.8 of the time without one, so that the path or what
// follows it is cut off in a third of the ticks.
TEST(SolverBudget, LeavesTimeForTheLimitsAfterThePath) {
  WanderingTicks ticks(0.3);
  Solver solver = ticks.MakeSolver(), timed = ticks.MakeSolver();
  Solution solution = ticks.MakeSolution();
  int cut_off = 0, lost = 0;
  for (int tick = 0; tick < 400; ++tick) {
    SCOPED_TRACE(tick);
    const Hierarchy hierarchy = ticks.Draw();
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    timed.max_modelled_seconds = 0.8 * solver.modelled_seconds();
    if (timed.Solve(hierarchy, &solution) != Status::kOptimal) {
      ++cut_off;
      lost += solution.failed_level < WanderingTicks::kTask;
    }
    timed.max_modelled_seconds = 1;
    ASSERT_EQ(timed.Solve(hierarchy, &solution), Status::kOptimal);
  }
  EXPECT_GT(cut_off, 100);
  EXPECT_LT(lost, cut_off / 2);
}

// A time that is too short for a step of all levels in one solve must not end
// the search: the last leading level gets a step sooner or later.
TEST(SolverBudget, ReachesTheOptimumWithAnyTime) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.max_variables = 20;
  options.max_levels = 6;
  options.max_inequalities = 20;
  int cut_off = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    solver.max_modelled_seconds = 30e-6;  // Two iterations take longer.
    int solves = 1;
    while (solver.Solve(drawn.hierarchy, &solution) != Status::kOptimal) {
      ASSERT_LE(++solves, 200);
    }
    cut_off += solves > 1;
  }
  EXPECT_GT(cut_off, 100);
}

// Levels 1 and 2 contradict each other in each tick, and all targets jump. The
// third iteration and later ones end at Budget::kMost times the limit at the
// latest. What follows them, and the first two, take less than 1.25 times the
// first two iterations from an empty working set with what follows those.
// Without interruptions, some ticks take longer.
TEST(SolverBudget, EndsSoonAfterItsLimit) {
  constexpr int kVariables = 60, kLimits = 100, kTask = 20;
  constexpr double kLimit = 300e-6;
  const std::vector<LevelCapacity> capacity{
      {12, 0}, {0, kLimits}, {kTask, 0}, {6, 0}, {kVariables, 0}};
  DrawMatrix draw(4);
  Solver solver(kVariables, capacity), two_iterations(kVariables, capacity);
  Solution solution(kVariables, capacity);
  solver.max_modelled_seconds = kLimit;
  two_iterations.max_iterations = 2;
  const RowMajorMatrix B = draw(12, kVariables), T = draw(kTask, kVariables);
  RowMajorMatrix C = draw(kLimits, kVariables);
  C.topRows(kVariables).setIdentity();
  int cut_off = 0;
  for (int tick = 0; tick < 300; ++tick) {
    Hierarchy hierarchy(kVariables, capacity);
    AddEqualities(0, B, draw(12, 1), &hierarchy);
    AddLimits(1, C, 0.4, &hierarchy);
    AddEqualities(2, T, 10 * draw(kTask, 1), &hierarchy);
    const RowMajorMatrix M = draw(6, kVariables);
    AddEqualities(3, M, 10 * draw(6, 1), &hierarchy);
    hierarchy.AddEqualities(4, kVariables).B.setIdentity();
    hierarchy.FindSpans();
    two_iterations.Forget();
    (void)two_iterations.Solve(hierarchy, &solution);
    cut_off += solver.Solve(hierarchy, &solution) != Status::kOptimal;
    EXPECT_LE(solver.modelled_seconds(),
              Budget::kMost * kLimit + 1.25 * two_iterations.modelled_seconds())
        << tick;
  }
  EXPECT_GT(cut_off, 200);
}

// If the iterations end before the search has begun, a limit of time that is
// not reached changes nothing, neither the levels that are certified nor
// multipliers.
TEST(SolverBudget, IsTheSameAtTheStartWithALimitOfTime) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity), timed(n, drawn.capacity);
    Solution solution(n, drawn.capacity), other(n, drawn.capacity);
    solver.max_iterations = timed.max_iterations = 1;
    timed.max_modelled_seconds = 1;
    EXPECT_EQ(timed.Solve(drawn.hierarchy, &other),
              solver.Solve(drawn.hierarchy, &solution));
    EXPECT_EQ(other.y, solution.y);
    EXPECT_EQ(other.failed_level, solution.failed_level);
    for (int k = 0; k < drawn.hierarchy.num_levels(); ++k) {
      EXPECT_EQ(other.levels[k].nullity, solution.levels[k].nullity);
      for (int above = 0; above < k; ++above) {
        EXPECT_EQ(other.levels[k].multipliers[above].inequality,
                  solution.levels[k].multipliers[above].inequality);
      }
    }
  }
}

// Level 1 contradicts the equalities of level 0, and level 2 is diagonal, with
// targets outside the bounds. A search that is cut off on level 2 keeps the
// multipliers that certify level 1.
TEST(SolverBudget, CertifiesTheLeadingLevelsIfADiagonalOneIsCutOff) {
  constexpr int kVariables = 20;
  const std::vector<LevelCapacity> capacity{
      {5, kVariables}, {3, 0}, {kVariables, 0}};
  DrawMatrix draw(3);
  Hierarchy hierarchy(kVariables, capacity);
  const RowMajorMatrix B = draw(5, kVariables);
  hierarchy.AddEqualities(0, 5).B = B;
  InequalityBlock bounds = hierarchy.AddInequalities(0, kVariables);
  bounds.C.setIdentity();
  bounds.lower.setConstant(-1);
  bounds.upper.setConstant(1);
  EqualityBlock task = hierarchy.AddEqualities(1, 3);
  task.B = B.topRows(3);
  task.b.setConstant(1);
  EqualityBlock posture = hierarchy.AddEqualities(2, kVariables);
  posture.B.setIdentity();
  posture.b.setConstant(-5);
  for (const double seconds : {0.0, 1.0}) {
    SCOPED_TRACE(seconds);
    Solver solver(kVariables, capacity);
    Solution solution(kVariables, capacity);
    solver.max_modelled_seconds = seconds;
    int cut_on_level_2 = 0;
    for (int limit = 1; limit < 100; ++limit) {
      solver.Forget();
      solver.max_iterations = limit;
      if (solver.Solve(hierarchy, &solution) == Status::kOptimal) break;
      cut_on_level_2 += solution.failed_level == 2;
    }
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_GT(solution.levels[1].cost, 0);
    EXPECT_GT(cut_on_level_2, 0);
  }
}

// The modelled time of a solve is part of its result: a replay is exact.
TEST(SolverBudget, StopsAtItsModelledTime) {
  int stopped = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity), again(n, drawn.capacity);
    Solution solution(n, drawn.capacity), replay(n, drawn.capacity);
    int before = 0;
    for (const double seconds : {1e-9, 25e-6, 50e-6, 1.0}) {
      solver.Forget();
      solver.max_modelled_seconds = again.max_modelled_seconds = seconds;
      const Status status = solver.Solve(drawn.hierarchy, &solution);
      EXPECT_GE(solution.iterations, std::max(before, 1));
      before = solution.iterations;
      stopped += status == Status::kIterationLimit;
      again.Forget();
      EXPECT_EQ(again.Solve(drawn.hierarchy, &replay), status);
      EXPECT_EQ(replay.y, solution.y);
    }
  }
  EXPECT_GT(stopped, 50);
}

}  // namespace
}  // namespace poise
