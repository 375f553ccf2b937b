// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/solve_cascade.h"

#include <gtest/gtest.h>

namespace poise {

Solution SolveCascade(const HierarchyCase& drawn, RowSpaceMethod method) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  EXPECT_EQ(
      Cascade(n, drawn.capacity, method).Solve(drawn.hierarchy, &solution),
      Status::kOptimal);
  return solution;
}

}  // namespace poise
