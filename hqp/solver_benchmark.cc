// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// How long a solve takes, beside the literal cascade in the same run.
//   bazel run //hqp:solver_benchmark
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "hqp/cascade.h"
#include "hqp/certificate.h"
#include "hqp/solver.h"

namespace poise {
namespace {

// A hierarchy of the paper's shape: of n variables the last 12 are forces. 6
// equalities; `limits` two-sided rows; 12 equalities and 16 inequalities; 6
// equalities, and again 6 in each level more than 5; posture and forces. In
// fewer than 5 levels, the first ones share one. The tighter the limits, the
// more rows are active.
struct Problem {
  Problem(int n, int levels, int limits, double limit)
      : capacity(Capacity(n, levels, limits)), hierarchy(n, capacity) {
    for (int level = 0; level < levels - 1; ++level) {
      EqualityBlock equalities =
          hierarchy.AddEqualities(level, capacity[level].equalities);
      for (int i = 0; i < equalities.b.size(); ++i) {
        for (int j = 0; j < n; ++j) equalities.B(i, j) = Number();
        equalities.b[i] = Number();
      }
      InequalityBlock inequalities =
          hierarchy.AddInequalities(level, capacity[level].inequalities);
      const int two_sided = capacity[level].inequalities >= limits ? limits : 0;
      for (int i = 0; i < inequalities.upper.size(); ++i) {
        for (int j = 0; j < n; ++j) inequalities.C(i, j) = Number();
        inequalities.upper[i] = limit;
        if (i < two_sided) inequalities.lower[i] = -limit;
      }
    }
    EqualityBlock last = hierarchy.AddEqualities(levels - 1, n - 6);
    for (int i = 0; i < n - 6; ++i) {
      const bool is_force = i >= n - 18;
      last.B(i, 6 + i) = is_force ? 0.01 : 1;
      if (!is_force) last.b[i] = Number();
    }
  }

  static std::vector<LevelCapacity> Capacity(int n, int levels, int limits) {
    std::vector<LevelCapacity> rows = {{6, 0}, {0, limits}, {12, 16}};
    while (static_cast<int>(rows.size()) < std::max(levels - 1, 4)) {
      rows.push_back({6, 0});
    }
    while (static_cast<int>(rows.size()) > levels - 1) {
      rows[1].equalities += rows[0].equalities;
      rows[1].inequalities += rows[0].inequalities;
      rows.erase(rows.begin());
    }
    rows.push_back({n - 6, 0});
    return rows;
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
  const Problem problem(68, 5, 50, static_cast<int>(state.range(0)) / 10.);
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
  const Problem problem(68, 5, 50, static_cast<int>(state.range(0)) / 10.);
  Solver solver(68, problem.capacity);
  Run(
      problem,
      [&](Solution* solution) {
        benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, solution));
      },
      &state);
}

void Reference(benchmark::State& state, RowSpaceMethod method) {
  const Problem problem(68, 5, 50, static_cast<int>(state.range(0)) / 10.);
  Cascade cascade(68, problem.capacity, method);
  Run(
      problem,
      [&](Solution* solution) {
        benchmark::DoNotOptimize(cascade.Solve(problem.hierarchy, solution));
      },
      &state);
}

void Judge(benchmark::State& state) {
  const Problem problem(68, 5, 50, 10);
  Solver solver(68, problem.capacity);
  Solution solution(68, problem.capacity);
  benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, &solution));
  Certifier certifier(68, problem.capacity);
  for (auto _ : state) {
    benchmark::DoNotOptimize(certifier.Certify(problem.hierarchy, solution));
  }
}

// By variables and by levels.
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
    ->ArgNames({"variables", "levels"})
    ->ArgsProduct({{20, 36, 68, 130, 200}, {2, 3, 5, 10}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poise

BENCHMARK_MAIN();
