// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Measures the time to solve a tick's hierarchy, for each tick of recorded
// sequences. The literal cascade is measured in the same run.
//   bazel run //tests/benchmarks:hqp_benchmark
// A sequence is 0.4 s of our own simulation and begins 50 ms before the push.
// It has three arguments:
// - push: the force of the push, N.
// - limits: whether torque and joint limits are on. Each has 50 two-sided rows,
//   that is 100 inequalities.
// - torque: the available share of the torque limits, percent.
//
// Times are in us. Each tick counts with the fastest of 5 repeats; median, p99
// and worst are over the ticks. "raw" is over all repeats. Further columns are
// the active rows, the factorisations, the worst certificate, the unsolved
// ticks and all ticks. Cold solves are measured every 4th tick, the cascade
// every 20th.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/sim/quantile.h"
#include "poise/tests/util/recorded_ticks.h"

namespace poise {
namespace {

// Reduced by main() if --benchmark_min_time=0 only checks that all run.
int repeats = 5;
double end = 0.45;  // s.

const RecordedTicks& Recorded(const benchmark::State& state) {
  static std::map<std::tuple<int, int, int>, RecordedTicks> sequences;
  const std::tuple<int, int, int> key(state.range(0), state.range(1),
                                      state.range(2));
  auto found = sequences.find(key);
  if (found == sequences.end()) {
    const auto [force, limits, percent] = key;
    RecordingConditions conditions;
    conditions.push_force = force;
    conditions.has_limits = limits != 0;
    conditions.torque_scale = percent / 100.;
    conditions.end = end;
    found = sequences.emplace(key, RecordTicks(conditions)).first;
  }
  return found->second;
}

using Solve = std::function<Status(const Hierarchy&, Solution*)>;

// Solves a sequence `repeats` times, each time with a new solver.
void Measure(const RecordedTicks& sequence, int every,
             const std::function<Solve()>& make, benchmark::State* state) {
  using Clock = std::chrono::steady_clock;
  const int n = sequence.ticks.front().num_variables();
  const int ticks = static_cast<int>(sequence.ticks.size());
  Solution solution(n, sequence.capacity);
  Certifier certifier(n, sequence.capacity);
  std::vector<double> fastest, raw, active, iterations;
  double certificate = 0;
  int unsolved = 0;
  for (auto _ : *state) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const Solve solve = make();
      for (int tick = 0, i = 0; tick < ticks; tick += every, ++i) {
        const Hierarchy& hierarchy = sequence.ticks[tick];
        const Clock::time_point start = Clock::now();
        const Status status = solve(hierarchy, &solution);
        raw.push_back(
            std::chrono::duration<double, std::micro>(Clock::now() - start)
                .count());
        if (repeat > 0) {
          fastest[i] = std::min(fastest[i], raw.back());
          continue;
        }
        fastest.push_back(raw.back());
        iterations.push_back(solution.iterations);
        unsolved += status != Status::kOptimal;
        certificate = std::max(certificate,
                               certifier.Certify(hierarchy, solution).worst());
        active.push_back(0);
        for (const LevelSolution& level : solution.levels) {
          for (const Side side : level.active) {
            active.back() += side != Side::kNone;
          }
        }
      }
    }
  }
  auto& counters = state->counters;
  counters["01_median"] = Quantile(&fastest, 0.5);
  counters["02_p99"] = Quantile(&fastest, 0.99);
  counters["03_worst"] = Quantile(&fastest, 1);
  counters["04_raw_p999"] = Quantile(&raw, 0.999);
  counters["05_raw_max"] = Quantile(&raw, 1);
  counters["06_active"] = Quantile(&active, 0.5);
  counters["07_active_max"] = Quantile(&active, 1);
  counters["08_iterations"] = Quantile(&iterations, 0.5);
  counters["09_iterations_max"] = Quantile(&iterations, 1);
  counters["10_certificate"] = certificate;
  counters["11_unsolved"] = unsolved;
  counters["12_ticks"] = static_cast<double>(fastest.size());
}

void Fast(benchmark::State& state, bool is_warm) {
  const RecordedTicks& sequence = Recorded(state);
  const auto make = [&]() -> Solve {
    auto solver = std::make_shared<Solver>(
        sequence.ticks.front().num_variables(), sequence.capacity);
    return [solver, is_warm](const Hierarchy& hierarchy, Solution* solution) {
      if (!is_warm) solver->Forget();
      return solver->Solve(hierarchy, solution);
    };
  };
  Measure(sequence, is_warm ? 1 : 4, make, &state);
}

void Literal(benchmark::State& state, RowSpaceMethod method) {
  const RecordedTicks& sequence = Recorded(state);
  const auto make = [&]() -> Solve {
    auto cascade = std::make_shared<Cascade>(
        sequence.ticks.front().num_variables(), sequence.capacity, method);
    return [cascade](const Hierarchy& hierarchy, Solution* solution) {
      return cascade->Solve(hierarchy, solution);
    };
  };
  Measure(sequence, 20, make, &state);
}

void Sequences(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"push", "limits", "torque"})->Iterations(1);
  for (const int force : {0, 120, 300}) {
    benchmark->Args({force, 0, 100})->Args({force, 1, 100});
  }
  benchmark->Args({0, 1, 5});
}

BENCHMARK_CAPTURE(Fast, cold, false)->Apply(Sequences);
BENCHMARK_CAPTURE(Fast, warm, true)->Apply(Sequences);
BENCHMARK_CAPTURE(Literal, svd, RowSpaceMethod::kSvd)->Apply(Sequences);
BENCHMARK_CAPTURE(Literal, cod, RowSpaceMethod::kCod)->Apply(Sequences);

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--benchmark_min_time=0") {
    poise::repeats = 1;
    poise::end = 0.12;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
