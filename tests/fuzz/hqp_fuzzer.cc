// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>
#include <string>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/fuzz/fuzzing.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace {

// Larger problems are only read, so that the fuzzer can try many inputs.
bool IsSmall(const poise::Hierarchy& hierarchy) {
  int rows = 0;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    rows += hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  }
  return hierarchy.num_variables() <= 20 && rows <= 60;
}

// Zeros and absent bounds are always allowed.
bool AreModest(const Eigen::MatrixXd& numbers) {
  constexpr double kLarge = 1e30;
  const auto size = numbers.array().abs();
  return (size == 0 || size.isInf() || (size > 1 / kLarge && size < kLarge))
      .all();
}

// Returns whether all numbers are so moderate that no cost can overflow a
// double. A cost contains numbers to the third power, and through y also their
// inverses. If a number is too large or small, the solver must report the
// iteration limit, but its y may be NaN.
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
            "a written problem reads back unchanged");
    if (!IsSmall(problem.hierarchy)) return;
    const int n = problem.hierarchy.num_variables();
    poise::Solution solution(n, problem.capacity);
    const Status status =
        poise::Solver(n, problem.capacity).Solve(problem.hierarchy, &solution);
    Require(status == solution.status, "the solution has the returned status");
    // For bad input the solver returns zeros.
    Require(solution.y.allFinite() || (status == Status::kIterationLimit &&
                                       !HasModestNumbers(problem.hierarchy)),
            "y is finite");
    const bool is_bad =
        status == Status::kNotFinite || status == Status::kBadInput;
    // A separate certifier checks the solution. If the solver stopped early, it
    // checks only the levels above the one where the solver stopped.
    Require(is_bad || poise::Certifier(n, problem.capacity)
                              .Certify(problem.hierarchy, solution)
                              .worst() <= poise::Certifier::kCertified,
            "all levels that the solver reports as solved are certified");
  });
  return 0;
}
