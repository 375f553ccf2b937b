// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <string>

#include "hqp/solver.h"
#include "tests/fuzz/fuzzing.h"
#include "tools/hqp_file.h"

namespace {

// Larger problems are read, not solved: a fuzzer is to try many.
bool IsSmall(const poise::Hierarchy& hierarchy) {
  int rows = 0;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    rows += hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  }
  return hierarchy.num_variables() <= 20 && rows <= 60;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using poise::Require;
  const std::string text(reinterpret_cast<const char*>(data), size);
  poise::ExpectReadsOrRefuses([&] {
    const poise::HqpProblem problem = poise::ReadHqp(text);
    const std::string written = poise::WriteHqp(problem.hierarchy);
    Require(poise::WriteHqp(poise::ReadHqp(written).hierarchy) == written,
            "what is written reads as the same");
    if (!IsSmall(problem.hierarchy)) return;
    const int n = problem.hierarchy.num_variables();
    poise::Solution solution(n, problem.capacity);
    const poise::Status status =
        poise::Solver(n, problem.capacity).Solve(problem.hierarchy, &solution);
    Require(status == solution.status, "the status is in the solution");
    Require(status != poise::Status::kOptimal || solution.y.allFinite(),
            "an optimal answer is finite");
  });
  return 0;
}
