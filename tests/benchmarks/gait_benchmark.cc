// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Measures the time to plan one step, StepPlan::Solve(), for a capture point
// that moves as during a shove. A gait plans once per tick while a foot is in
// the air.
//   bazel run --config=opt //tests/benchmarks:gait_benchmark
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "poise/robot/gait/step_plan.h"

namespace poise {
namespace {

// The problem of the left foot, with the capture point at a place beside and in
// front of the right foot, m.
StepProblem MakeProblem(double x, double y) {
  StepProblem problem;
  problem.xi_S << x, y;
  problem.half_sole << 0.1, 0.05;
  problem.p_SZ =
      problem.xi_S.cwiseMax(-problem.half_sole).cwiseMin(problem.half_sole);
  problem.omega = 3.5;
  problem.time_min = 0.193;
  problem.time_max = 0.244;
  problem.time_nominal = 0.2;
  problem.swing_speed = 4.4;
  problem.side = 1;
  problem.width_min = 0.15;
  problem.base_S << 0, 0.1;
  problem.lift_off_S << 0, 0.157;
  problem.u_nominal_S << 0, 0.157;
  problem.b_nominal_S << 0, 0.014;
  for (int i = 0; i < StepProblem::kSides; ++i) {
    problem.region_normal_S[i] = StepRegion::normal(i);
    problem.region_bound[i] = StepRegion::normal(i).dot(problem.base_S) + 0.4;
  }
  return problem;
}

// The argument is the number of successive ticks in which the capture point
// moves by 1 mm each: with 1, all problems are the same.
void PlanStep(benchmark::State& state) {
  StepPlan plan;
  const int ticks = static_cast<int>(state.range(0));
  int i = 0;
  double certificate = 0;
  for (auto _ : state) {
    const double way = 0.001 * (i++ % ticks);
    const PlannedStep step = plan.Solve(MakeProblem(0.1 + 0.3 * way, way));
    benchmark::DoNotOptimize(step);
    certificate = std::max(certificate, step.certificate);
  }
  state.counters["certificate"] = certificate;
}
BENCHMARK(PlanStep)->Arg(1)->Arg(300)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
