// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/recorded_ticks.h"

namespace poise {

/// Returns the cost of a level at y, computed from the rows in long double, so
/// that the difference of two costs is exact to about 1e-19 of their terms.
long double TrueCost(const Hierarchy& hierarchy, int level,
                     const Eigen::VectorXd& y);

/// Returns 1e-6 (1 + 1/2 sum weight b^2 + 1/2 sum bound^2). A relative
/// difference of costs below the floor is relative to the floor.
double CostFloor(const Hierarchy& hierarchy, int level);

/// Compares pairs of answers to random small hierarchies: the fast solver warm
/// and cold, and the cascade and the fast solver. Prints each pair whose true
/// difference of costs on a level exceeds the sum of both gaps. The gap is
/// wrong, and one gap suffices, if Certifier::gap() covers the cheaper answer:
/// this answer is within the radius, and on each level above it costs at most
/// the gap more. Other pairs are counted by the reason. Prints the first
/// hierarchy of each reason shrunk. Returns the number of wrong gaps.
int CompareRandomPairs(std::uint64_t first_seed, int hierarchies);

/// Prints the levels of recorded ticks for which a warm and a cold solve are
/// optimal but differ in cost by more than 1e-6 of max(cost, CostFloor()).
/// Prints the number of such ticks last.
void PrintTicksThatDiffer(const RecordingConditions& conditions);

}  // namespace poise
