// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {

/// Reads a file in the format hqp-1. Throws std::invalid_argument, with the
/// name of the file, if the file cannot be read.
HqpProblem LoadHqp(const std::string& name);

/// The choice of a solver and its settings.
struct HqpMethod {
  std::string name = "fast";   ///< Or "svd" or "cod" for the cascade.
  int max_iterations = 10000;  ///< Limit for "fast"; no tick limits the time.
  double budget_us = 0;        ///< 1e6 Solver::max_modelled_seconds of "fast".
  bool cold = false;           ///< True: each problem gets a new solver.
};

/// Solves hierarchies one after the other. With "fast", the solver starts from
/// the working set of the previous problem if both have the same number of
/// variables. Its memory is that of a controller, so that it repeats the ticks
/// of a run to the bit.
class HqpSequence {
 public:
  /// @param problems  all problems that Solve() will receive. The solver
  ///                  allocates memory for their rows.
  HqpSequence(const HqpMethod& method, const std::vector<HqpProblem>& problems);

  [[nodiscard]] Status Solve(const HqpProblem& problem, Solution* solution,
                             SolveTimes* times);

 private:
  Status Dispatch(const HqpProblem& problem, Solution* solution);

  const HqpMethod method_;
  const std::vector<LevelCapacity> room_;
  std::unique_ptr<Solver> solver_;  // Solver of the previous problem, if any.
  int num_variables_ = 0;
};

}  // namespace poise
