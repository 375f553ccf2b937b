// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>
#include <string>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/fuzz/fuzzing.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace {

// Larger problems are read, not solved: a fuzzer is to try many.
bool IsSmall(const poise::Hierarchy& hierarchy) {
  int rows = 0;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    rows += hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  }
  return hierarchy.num_variables() <= 20 && rows <= 60;
}

// Zeros, and absent bounds, are harmless.
bool AreModest(const Eigen::MatrixXd& numbers) {
  constexpr double kLarge = 1e30;
  const auto size = numbers.array().abs();
  return (size == 0 || size.isInf() || (size > 1 / kLarge && size < kLarge))
      .all();
}

// Whether no number is so large or small that a cost, in which it stands in the
// third power, and by y as an inverse, may be beyond doubles. Where one is, the
// solver has to say that it gave up, but what it has found by then may be NaN.
bool HasModestNumbers(const poise::Hierarchy& hierarchy) {
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    if (!AreModest(hierarchy.B(k)) || !AreModest(hierarchy.b(k)) ||
        !AreModest(hierarchy.weight(k)) || !AreModest(hierarchy.C(k)) ||
        !AreModest(hierarchy.lower(k)) || !AreModest(hierarchy.upper(k))) {
      return false;
    }
  }
  return true;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using poise::Require;
  using poise::Status;
  const std::string text(reinterpret_cast<const char*>(data), size);
  poise::ExpectReadsOrRefuses([&] {
    const poise::HqpProblem problem = poise::ReadHqp(text);
    const std::string written = poise::WriteHqp(problem.hierarchy);
    Require(poise::WriteHqp(poise::ReadHqp(written).hierarchy) == written,
            "what is written reads as the same");
    if (!IsSmall(problem.hierarchy)) return;
    const int n = problem.hierarchy.num_variables();
    poise::Solution solution(n, problem.capacity);
    const Status status =
        poise::Solver(n, problem.capacity).Solve(problem.hierarchy, &solution);
    Require(status == solution.status, "the status is in the solution");
    // Bad input gives zeros.
    Require(solution.y.allFinite() || (status == Status::kIterationLimit &&
                                       !HasModestNumbers(problem.hierarchy)),
            "an answer is finite");
    const bool is_bad =
        status == Status::kNotFinite || status == Status::kBadInput;
    // By a certifier of its own; of an answer that was cut off, the levels above
    // that where it was.
    Require(is_bad || poise::Certifier(n, problem.capacity)
                              .Certify(problem.hierarchy, solution)
                              .worst() <= poise::Certifier::kCertified,
            "an answer is certified as far as it says");
  });
  return 0;
}
