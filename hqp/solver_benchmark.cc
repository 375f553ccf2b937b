// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// How long a solve takes, beside the literal cascade in the same run.
//   bazel run //hqp:solver_benchmark
#include <benchmark/benchmark.h>

#include "hqp/cascade.h"
#include "hqp/certificate.h"
#include "hqp/solver.h"

namespace poise {
namespace {

// A hierarchy of the paper's shape: of n variables the last 12 are forces. 6
// equalities; `limits` two-sided rows; 12 equalities and 16 inequalities; levels
// of 6 equalities as many as wanted; posture; forces. The tighter the limits,
// the more rows are active.
struct Problem {
  Problem(int n, int middle_levels, int limits, double limit)
      : capacity{{6, 0}, {0, limits}, {12, 16}},
        hierarchy(
            (capacity.resize(3 + middle_levels, {6, 0}),
             capacity.push_back({n - 18, 0}), capacity.push_back({12, 0}), n),
            capacity) {
    const int levels = hierarchy.num_levels();
    for (int level = 0; level < levels - 2; ++level) {
      EqualityBlock equalities =
          hierarchy.AddEqualities(level, capacity[level].equalities);
      for (int i = 0; i < equalities.b.size(); ++i) {
        for (int j = 0; j < n; ++j) equalities.B(i, j) = Number();
        equalities.b[i] = Number();
      }
      InequalityBlock inequalities =
          hierarchy.AddInequalities(level, capacity[level].inequalities);
      for (int i = 0; i < inequalities.upper.size(); ++i) {
        for (int j = 0; j < n; ++j) inequalities.C(i, j) = Number();
        inequalities.upper[i] = limit;
        if (level == 1) inequalities.lower[i] = -limit;
      }
    }
    EqualityBlock posture = hierarchy.AddEqualities(levels - 2, n - 18);
    for (int i = 0; i < n - 18; ++i) {
      posture.B(i, 6 + i) = 1;
      posture.b[i] = Number();
    }
    EqualityBlock forces = hierarchy.AddEqualities(levels - 1, 12);
    for (int i = 0; i < 12; ++i) forces.B(i, n - 12 + i) = 0.01;
  }

  // Numbers in [-1, 1], the same each time.
  double Number() {
    state = state * 1664525u + 1013904223u;
    return state / 2147483648.0 - 1;
  }

  unsigned state = 1;
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

void Report(const Problem& problem, const Solution& solution,
            benchmark::State* state) {
  int active = 0;
  for (const LevelSolution& level : solution.levels) {
    for (const Side side : level.active) active += side != Side::kNone;
  }
  Certifier certifier(problem.hierarchy.num_variables(), problem.capacity);
  state->counters["active"] = active;
  state->counters["iterations"] = solution.iterations;
  state->counters["certificate"] =
      certifier.Certify(problem.hierarchy, solution).worst();
}

template <typename Method>
void Run(const Problem& problem, Method&& solve, benchmark::State* state) {
  Solution solution(problem.hierarchy.num_variables(), problem.capacity);
  for (auto _ : *state) solve(&solution);
  Report(problem, solution, state);
}

// By limit in tenths: 100 leaves nothing active.
void Cold(benchmark::State& state) {
  const Problem problem(68, 1, 50, static_cast<int>(state.range(0)) / 10.);
  Solver solver(68, problem.capacity);
  Run(
      problem,
      [&](Solution* solution) {
        solver.Forget();
        benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, solution));
      },
      &state);
}

void Warm(benchmark::State& state) {
  const Problem problem(68, 1, 50, static_cast<int>(state.range(0)) / 10.);
  Solver solver(68, problem.capacity);
  Run(
      problem,
      [&](Solution* solution) {
        benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, solution));
      },
      &state);
}

void Reference(benchmark::State& state, RowSpaceMethod method) {
  const Problem problem(68, 1, 50, static_cast<int>(state.range(0)) / 10.);
  Cascade cascade(68, problem.capacity, method);
  Run(
      problem,
      [&](Solution* solution) {
        benchmark::DoNotOptimize(cascade.Solve(problem.hierarchy, solution));
      },
      &state);
}

void Judge(benchmark::State& state) {
  const Problem problem(68, 1, 50, 10);
  Solver solver(68, problem.capacity);
  Solution solution(68, problem.capacity);
  benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, &solution));
  Certifier certifier(68, problem.capacity);
  for (auto _ : state) {
    benchmark::DoNotOptimize(certifier.Certify(problem.hierarchy, solution));
  }
}

// By variables and by levels of 6 rows between contact and posture.
void Growth(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Problem problem(n, static_cast<int>(state.range(1)), 50, 10);
  Solver solver(n, problem.capacity);
  Run(
      problem,
      [&](Solution* solution) {
        benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, solution));
      },
      &state);
}

BENCHMARK(Cold)->Arg(100)->Arg(20)->Arg(12)->Unit(benchmark::kMicrosecond);
BENCHMARK(Warm)->Arg(100)->Arg(20)->Arg(12)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Reference, svd, RowSpaceMethod::kSvd)
    ->Arg(100)
    ->Arg(20)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Reference, cod, RowSpaceMethod::kCod)
    ->Arg(100)
    ->Arg(20)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Judge)->Unit(benchmark::kMicrosecond);
BENCHMARK(Growth)
    ->Args({20, 1})
    ->Args({36, 1})
    ->Args({68, 1})
    ->Args({68, 3})
    ->Args({68, 5})
    ->Args({130, 1})
    ->Args({200, 1})
    ->Args({200, 5})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poise

BENCHMARK_MAIN();
