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
/// and cold, and the fast solver and the cascade. Prints each pair whose true
/// difference of costs exceeds the sum of both gaps. A gap holds for optima
/// within a radius, see Certifier::gap(). Pairs beyond the radius count apart.
/// Also prints the first hierarchy of each kind shrunk. Returns the number of
/// pairs within the radius.
int CompareRandomPairs(std::uint64_t first_seed, int hierarchies);

/// Prints the levels of recorded ticks for which a warm and a cold solve are
/// optimal but differ in cost by more than 1e-6 of max(cost, CostFloor()).
/// Prints the number of such ticks last.
void PrintTicksThatDiffer(const RecordingConditions& conditions);

}  // namespace poise
