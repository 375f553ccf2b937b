// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A hierarchy from a file, with the sizes to solve it with.
struct HqpProblem {
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
  std::vector<std::string> ignored;  ///< Keys that the format does not have.
};

/// Reads the format hqp-1: {"format": "hqp-1", "variables": n, "levels": [{"B",
/// "b", "weight", "A", "a", "C", "lower", "upper"}, ...], "y_lower", "y_upper",
/// "y_bounds_level"}, where all but the first three may be absent. The
/// inequalities of a level are those of A, of C, then the bounds on y. Bounds
/// that cross and negative weights are refused, as CheckInput() would.
///
/// Throws std::invalid_argument with one line: which entry, and what is wrong.
HqpProblem ReadHqp(const std::string& text);

/// The same, of a hierarchy: what a running controller dumps, to be replayed.
/// Reading it gives the same numbers to the last bit.
std::string WriteHqp(const Hierarchy& hierarchy);

/// How many levels, from the first on, the certificate of an answer is about:
/// all if it is optimal, those above the one that failed if it is not.
int CertifiedLevels(const Hierarchy& hierarchy, const Solution& solution);

/// An answer for people: a line, and one more a level. Says of which levels the
/// certificate is.
std::string DescribeHqpSolution(const Hierarchy& hierarchy,
                                const Solution& solution,
                                const Certificate& certificate,
                                double microseconds);

/// An answer, as `//tools:hqp -- --json` prints it: `failed_level` is null if
/// it is optimal, `certified_levels` is CertifiedLevels(), and the numbers of a
/// certificate of no levels are null.
std::string WriteHqpSolution(const Hierarchy& hierarchy,
                             const Solution& solution,
                             const Certificate& certificate,
                             double microseconds);

/// "optimal", "iteration_limit", "not_finite" or "bad_input".
std::string Name(Status status);

}  // namespace poise
