// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/exact_difference.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/exact/small_hierarchy.h"

namespace poise {
namespace {

// The default run; //tests/exact:judge draws more.
TEST(ExactDifference, FindsNoneInSmallHierarchies) {
  for (int seed = 1; seed <= 200; ++seed) {
    EXPECT_EQ(DifferenceFromExact(MakeSmallHierarchy(seed)), "") << seed;
  }
}

// The draw has the cases that its header names, in the first 200 seeds.
TEST(SmallHierarchy, DrawsEachKindOfRow) {
  Eigen::Index deficient = 0, contradictory = 0, unweighted = 0, equal = 0;
  Eigen::Index shared = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    const Hierarchy hierarchy = MakeSmallHierarchy(seed).hierarchy;
    const ExactOptimum exact = SolveExactly(hierarchy);
    int rows = 0;
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      rows += hierarchy.num_equalities(k);
      unweighted += (hierarchy.weight(k).array() == 0).count();
      equal +=
          (hierarchy.lower(k).array() == hierarchy.upper(k).array()).count();
      for (const ExactMultipliers& of : exact.levels[k].multipliers) {
        shared += !IsZero(of.inequality);
      }
    }
    const int rank = hierarchy.num_variables() - exact.levels.end()[-2].nullity;
    deficient += rank < rows;
    contradictory += exact.levels[0].cost > 0;
  }
  for (const Eigen::Index count :
       {deficient, contradictory, unweighted, equal, shared}) {
    EXPECT_GE(count, 20);
  }
}

}  // namespace
}  // namespace poise
