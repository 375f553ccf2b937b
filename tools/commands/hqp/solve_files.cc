// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/hqp/solve_files.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>

#include "poise/hqp/reference/cascade.h"
#include "poise/robot/finding.h"
#include "poise/robot/text_file.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1024;  // Largest file, MiB.

// Returns the largest number of rows of each level over all problems.
std::vector<LevelCapacity> Room(const std::vector<HqpProblem>& problems) {
  std::vector<LevelCapacity> room;
  for (const HqpProblem& problem : problems) {
    room.resize(std::max(room.size(), problem.capacity.size()));
    for (size_t level = 0; level < problem.capacity.size(); ++level) {
      const LevelCapacity& rows = problem.capacity[level];
      LevelCapacity& to = room[level];
      to.equalities = std::max(to.equalities, rows.equalities);
      to.inequalities = std::max(to.inequalities, rows.inequalities);
    }
  }
  return room;
}

}  // namespace

HqpProblem LoadHqp(const std::string& name) {
  const std::string text = ReadTextFile(UserPath(name), kMostMib);
  try {
    return ReadHqp(text, name);
  } catch (const Refusal&) {  // Already names the file.
    throw;
  } catch (const std::exception& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
}

HqpSequence::HqpSequence(const HqpMethod& method,
                         const std::vector<HqpProblem>& problems)
    : method_(method), room_(Room(problems)) {}

Status HqpSequence::Solve(const HqpProblem& problem, Solution* solution,
                          SolveTimes* times) {
  const int n = problem.hierarchy.num_variables();
  if (method_.cold || n != num_variables_) solver_.reset();
  num_variables_ = n;
  const auto start = std::chrono::steady_clock::now();
  const Status status = Dispatch(problem, solution);
  times->measured = std::chrono::duration<double, std::micro>(
                        std::chrono::steady_clock::now() - start)
                        .count();
  times->modelled.reset();
  if (solver_) times->modelled = 1e6 * solver_->modelled_seconds();
  return status;
}

Status HqpSequence::Dispatch(const HqpProblem& problem, Solution* solution) {
  const int n = problem.hierarchy.num_variables();
  if (method_.name == "fast") {
    if (solver_ == nullptr) {
      solver_ = std::make_unique<Solver>(n, room_, NumRows(room_));
    }
    solver_->max_iterations = method_.max_iterations;
    solver_->max_modelled_seconds = 1e-6 * method_.budget_us;
    return solver_->Solve(problem.hierarchy, solution);
  }
  return Cascade(n, problem.capacity,
                 method_.name == "svd" ? RowSpaceMethod::kSvd
                                       : RowSpaceMethod::kCod)
      .Solve(problem.hierarchy, solution);
}

}  // namespace poise
