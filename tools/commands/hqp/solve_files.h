// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {

/// Reads a file in the format hqp-1. Throws std::invalid_argument, with the name
/// of the file, if it cannot be read.
HqpProblem LoadHqp(const std::string& name);

/// The choice of a solver.
struct HqpMethod {
  std::string name = "fast";   ///< Or "svd" or "cod", for the cascade.
  int max_iterations = 10000;  ///< Budget of "fast"; no tick limits the time.
  bool cold = false;           ///< Each problem gets a new solver.
};

/// Solves hierarchies one after the other. With "fast", a problem starts from
/// the working set of the problem before, if both have as many variables.
class HqpSequence {
 public:
  /// @param problems  all problems to come: the solver gets room for their rows.
  HqpSequence(const HqpMethod& method, const std::vector<HqpProblem>& problems);

  [[nodiscard]] Status Solve(const HqpProblem& problem, Solution* solution,
                             double* microseconds);

 private:
  Status Dispatch(const HqpProblem& problem, Solution* solution);

  const HqpMethod method_;
  const std::vector<LevelCapacity> room_;
  std::unique_ptr<Solver> solver_;  // Of the problem before, if any.
  int num_variables_ = 0;
};

}  // namespace poise
