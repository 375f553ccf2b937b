// Measures the time of a solve, and of the literal cascade in the same run.
//   bazel run //hqp:solver_benchmark
// Each solve has other targets and bounds than the one before: they change by
// up to 0.01, as from tick to tick. This change is not timed. To solve the same
// hierarchy again would be the best case of a warm start. The time is the mean;
// median_us, p999_us and max_us are quantiles of single solves.
//
// The dense cases have rows that no robot has: 20, 40 or 60 inequalities with
// normally distributed entries on each of 5 levels of 68 variables. With 20,
// about half as many rows are active as there are variables. With 40 or 60,
// most levels cannot be met, and each step factors such a level again. In cold
// solves of these, the fast solver is slower than the cascade by COD.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"

namespace poise {
namespace {

// Pseudorandom numbers in [-1, 1], the same in each run.
class Numbers {
 public:
  double Uniform() {
    state_ = state_ * 1664525u + 1013904223u;
    return state_ / 2147483648.0 - 1;
  }
  // Returns an almost normally distributed number of unit variance, the sum of
  // 12 uniform numbers of variance 1/12.
  double Normal() {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += Uniform() / 2;
    return sum;
  }

 private:
  unsigned state_ = 1;
};

struct Problem {
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

// Returns the numbers of rows of a hierarchy of the paper's shape. The last 12
// of n variables are forces. Five levels have: 6 equalities; `limits` two-sided
// rows; 12 equalities and 16 inequalities; 6 equalities; posture and forces.
// Each further level has 6 equalities. With fewer levels, the first ones are
// merged. The tighter the limits, the more rows are active.
std::vector<LevelCapacity> PaperCapacity(int n, int levels, int limits) {
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

Problem MakePaper(int n, int levels, int limits, double limit) {
  const std::vector<LevelCapacity> capacity = PaperCapacity(n, levels, limits);
  Problem problem{capacity, Hierarchy(n, capacity)};
  Numbers numbers;
  for (int level = 0; level < levels - 1; ++level) {
    EqualityBlock equalities =
        problem.hierarchy.AddEqualities(level, capacity[level].equalities);
    for (int i = 0; i < equalities.b.size(); ++i) {
      for (int j = 0; j < n; ++j) equalities.B(i, j) = numbers.Uniform();
      equalities.b[i] = numbers.Uniform();
    }
    InequalityBlock inequalities =
        problem.hierarchy.AddInequalities(level, capacity[level].inequalities);
    const int two_sided = capacity[level].inequalities >= limits ? limits : 0;
    for (int i = 0; i < inequalities.upper.size(); ++i) {
      for (int j = 0; j < n; ++j) inequalities.C(i, j) = numbers.Uniform();
      inequalities.upper[i] = limit;
      if (i < two_sided) inequalities.lower[i] = -limit;
    }
  }
  EqualityBlock last = problem.hierarchy.AddEqualities(levels - 1, n - 6);
  for (int i = 0; i < n - 6; ++i) {
    const bool is_force = i >= n - 18;
    last.B(i, 6 + i) = is_force ? 0.01 : 1;
    if (!is_force) last.b[i] = numbers.Uniform();
  }
  return problem;
}

// Returns levels of 6 equalities and `rows` inequalities each, with normally
// distributed entries.
Problem MakeDense(int n, int levels, int rows) {
  const std::vector<LevelCapacity> capacity(levels, {6, rows});
  Problem problem{capacity, Hierarchy(n, capacity)};
  Numbers numbers;
  for (int level = 0; level < levels; ++level) {
    EqualityBlock equalities = problem.hierarchy.AddEqualities(level, 6);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < n; ++j) equalities.B(i, j) = numbers.Normal();
      equalities.b[i] = numbers.Normal();
    }
    InequalityBlock inequalities =
        problem.hierarchy.AddInequalities(level, rows);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < n; ++j) inequalities.C(i, j) = numbers.Normal();
      inequalities.upper[i] = 0.1 + 0.3 * numbers.Normal();
    }
  }
  return problem;
}

// Fills the hierarchy of another tick: the targets and bounds of `problem`,
// each changed by up to 0.01.
void Change(const Problem& problem, Numbers* numbers, Hierarchy* hierarchy) {
  constexpr double kChange = 0.01;
  const Hierarchy& from = problem.hierarchy;
  hierarchy->Clear(from.num_levels());
  for (int level = 0; level < from.num_levels(); ++level) {
    EqualityBlock equalities =
        hierarchy->AddEqualities(level, from.num_equalities(level));
    equalities.B = from.B(level);
    equalities.weight = from.weight(level);
    for (int i = 0; i < equalities.b.size(); ++i) {
      equalities.b[i] = from.b(level)[i] + kChange * numbers->Uniform();
    }
    InequalityBlock inequalities =
        hierarchy->AddInequalities(level, from.num_inequalities(level));
    inequalities.C = from.C(level);
    for (int i = 0; i < inequalities.upper.size(); ++i) {
      // Both bounds move by the same amount, so that they do not cross.
      const double by = kChange * numbers->Uniform();
      inequalities.lower[i] = from.lower(level)[i] + by;
      inequalities.upper[i] = from.upper(level)[i] + by;
    }
  }
}

int NumActive(const Solution& solution) {
  int active = 0;
  for (const LevelSolution& level : solution.levels) {
    for (const Side side : level.active) active += side != Side::kNone;
  }
  return active;
}

// Measures solves of `problem`, each with other targets and bounds. `prepare`
// is not timed.
template <typename Prepare, typename Solve>
void Run(const Problem& problem, Prepare&& prepare, Solve&& solve,
         benchmark::State* state) {
  using Clock = std::chrono::steady_clock;
  const int n = problem.hierarchy.num_variables();
  Hierarchy hierarchy = problem.hierarchy;
  Solution solution(n, problem.capacity);
  Certifier certifier(n, problem.capacity);
  Numbers numbers;
  std::vector<double> times;
  double active = 0, iterations = 0, certificate = 0;
  int unsolved = 0;
  for (auto _ : *state) {
    Change(problem, &numbers, &hierarchy);
    prepare();
    const Clock::time_point start = Clock::now();
    const Status status = solve(hierarchy, &solution);
    const std::chrono::duration<double> time = Clock::now() - start;
    state->SetIterationTime(time.count());
    times.push_back(time.count() * 1e6);
    active += NumActive(solution);
    iterations += solution.iterations;
    unsolved += status != Status::kOptimal;
    certificate =
        std::max(certificate, certifier.Certify(hierarchy, solution).worst());
  }
  std::sort(times.begin(), times.end());
  const auto count = static_cast<double>(times.size());
  const auto quantile = [&](double share) {
    return times[static_cast<size_t>(share * (count - 1))];
  };
  auto& counters = state->counters;
  counters["median_us"] = quantile(0.5);
  counters["p999_us"] = quantile(0.999);
  counters["max_us"] = quantile(1);
  counters["active"] = active / count;
  counters["iterations"] = iterations / count;
  counters["certificate"] = certificate;
  counters["unsolved"] = unsolved;
}

void RunFast(const Problem& problem, bool is_warm, benchmark::State* state) {
  const int n = problem.hierarchy.num_variables();
  Solver solver(n, problem.capacity);
  // The dense cases have no deadline. The other cases need at most 500.
  solver.max_iterations = 10000;
  // The first timed solve is warm, too.
  Solution first(n, problem.capacity);
  benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, &first));
  Run(
      problem,
      [&] {
        if (!is_warm) solver.Forget();
      },
      [&](const Hierarchy& hierarchy, Solution* solution) {
        return solver.Solve(hierarchy, solution);
      },
      state);
}

void RunCascade(const Problem& problem, RowSpaceMethod method,
                benchmark::State* state) {
  Cascade cascade(problem.hierarchy.num_variables(), problem.capacity, method);
  Run(
      problem, [] {},
      [&](const Hierarchy& hierarchy, Solution* solution) {
        return cascade.Solve(hierarchy, solution);
      },
      state);
}

// The argument is the limit in tenths. With 100 no row is active.
Problem Limited(const benchmark::State& state) {
  return MakePaper(68, 5, 50, static_cast<double>(state.range(0)) / 10);
}

void Fast(benchmark::State& state, bool is_warm) {
  RunFast(Limited(state), is_warm, &state);
}

void Reference(benchmark::State& state, RowSpaceMethod method) {
  RunCascade(Limited(state), method, &state);
}

// The argument is the number of inequalities of a level.
Problem Dense(const benchmark::State& state) {
  return MakeDense(68, 5, static_cast<int>(state.range(0)));
}

void DenseFast(benchmark::State& state, bool is_warm) {
  RunFast(Dense(state), is_warm, &state);
}

void DenseReference(benchmark::State& state, RowSpaceMethod method) {
  RunCascade(Dense(state), method, &state);
}

// The arguments are the numbers of variables and of levels.
Problem Grown(const benchmark::State& state) {
  return MakePaper(static_cast<int>(state.range(0)),
                   static_cast<int>(state.range(1)), 50, 10);
}

void Growth(benchmark::State& state, bool is_warm) {
  RunFast(Grown(state), is_warm, &state);
}

void GrowthReference(benchmark::State& state, RowSpaceMethod method) {
  RunCascade(Grown(state), method, &state);
}

void Judge(benchmark::State& state) {
  const Problem problem = MakePaper(68, 5, 50, 10);
  Solver solver(68, problem.capacity);
  Solution solution(68, problem.capacity);
  benchmark::DoNotOptimize(solver.Solve(problem.hierarchy, &solution));
  Certifier certifier(68, problem.capacity);
  for (auto _ : state) {
    benchmark::DoNotOptimize(certifier.Certify(problem.hierarchy, solution));
  }
}

void Limits(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("limit")->Arg(100)->Arg(20)->Arg(12);
  benchmark->UseManualTime()->Unit(benchmark::kMicrosecond);
}

void DenseRows(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("rows")->Arg(20)->Arg(40)->Arg(60);
  benchmark->UseManualTime()->Unit(benchmark::kMicrosecond);
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"variables", "levels"});
  benchmark->ArgsProduct({{20, 36, 68, 130, 200}, {2, 3, 5, 10}});
  benchmark->UseManualTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(Fast, cold, false)->Apply(Limits);
BENCHMARK_CAPTURE(Fast, warm, true)->Apply(Limits);
BENCHMARK_CAPTURE(Reference, svd, RowSpaceMethod::kSvd)->Apply(Limits);
BENCHMARK_CAPTURE(Reference, cod, RowSpaceMethod::kCod)->Apply(Limits);
BENCHMARK(Judge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(DenseFast, cold, false)->Apply(DenseRows);
BENCHMARK_CAPTURE(DenseFast, warm, true)->Apply(DenseRows);
BENCHMARK_CAPTURE(DenseReference, cod, RowSpaceMethod::kCod)->Apply(DenseRows);
BENCHMARK_CAPTURE(Growth, cold, false)->Apply(Sizes);
BENCHMARK_CAPTURE(Growth, warm, true)->Apply(Sizes);
BENCHMARK_CAPTURE(GrowthReference, cod, RowSpaceMethod::kCod)->Apply(Sizes);

}  // namespace
}  // namespace poise

BENCHMARK_MAIN();
