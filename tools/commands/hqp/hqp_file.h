// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A hierarchy read from a file, and the capacity that its solver needs.
struct HqpProblem {
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
  std::vector<std::string> ignored;  ///< Keys that the format does not have.
};

/// Reads the format hqp-1: {"format": "hqp-1", "variables": n, "levels": [{"B",
/// "b", "weight", "A", "a", "C", "lower", "upper"}, ...], "y_lower", "y_upper",
/// "y_bounds_level"}. All keys but the first three may be absent. The
/// inequalities of a level are the rows of A, then those of C, then the bounds
/// on y.
///
/// Throws std::invalid_argument with one line that names the entry and the
/// error, or Refusal as ParseJson() does. As in CheckInput(), a lower bound
/// above its upper bound and a negative weight are errors.
///
/// @param source  the name of the text in the messages of ParseJson().
HqpProblem ReadHqp(const std::string& text, const std::string& source = "file");

/// Returns a hierarchy in the format hqp-1. A running controller can dump its
/// problem this way, to replay the solve later. ReadHqp() restores each number
/// exactly.
std::string WriteHqp(const Hierarchy& hierarchy);

/// Returns how many leading levels the certificate of a solution covers. These
/// are all levels if the solution is optimal, otherwise the levels above the
/// failed one.
int CertifiedLevels(const Hierarchy& hierarchy, const Solution& solution);

/// Times of a solve, us.
struct SolveTimes {
  double measured;
  /// Solver::modelled_seconds(), if known. It includes the search for the
  /// nullity, which a controller leaves out.
  std::optional<double> modelled;
};

/// Returns a description for people: one line, and one line for each level. It
/// says which levels the certificate covers.
std::string DescribeHqpSolution(const Hierarchy& hierarchy,
                                const Solution& solution,
                                const Certificate& certificate,
                                const SolveTimes& times);

/// Returns a solution as JSON, as `//tools:hqp -- --json` prints it.
/// `failed_level` is null if the solution is optimal. `certified_levels` is
/// CertifiedLevels(); if it is 0, the numbers of the certificate are null.
std::string WriteHqpSolution(const Hierarchy& hierarchy,
                             const Solution& solution,
                             const Certificate& certificate,
                             const SolveTimes& times);

/// Returns "optimal", "iteration_limit", "not_finite" or "bad_input".
std::string Name(Status status);

}  // namespace poise
