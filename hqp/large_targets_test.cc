// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cstdint>

#include "poise/hqp/solver.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

// Returns the hierarchy with all targets and bounds multiplied by `factor`.
Hierarchy WithTargets(const HierarchyCase& drawn, double factor) {
  const Hierarchy& from = drawn.hierarchy;
  Hierarchy to(from.num_variables(), drawn.capacity);
  to.Clear(from.num_levels());
  for (int k = 0; k < from.num_levels(); ++k) {
    LevelBlocks rows = CopyLevel(from, k, &to);
    rows.equalities.b *= factor;
    rows.inequalities.lower *= factor;
    rows.inequalities.upper *= factor;
  }
  to.FindSpans();
  return to;
}

// The multipliers are those of the search, before y was refined. They must
// suffice for the certificate where targets are large as well.
TEST(LargeTargets, AreCertified) {
  RandomHierarchyOptions options;
  options.degenerate = 0;  // Where rows depend on each other, rounding decides.
  for (const double factor : {1e9, 1e14}) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
      const Hierarchy hierarchy = WithTargets(drawn, factor);
      Solver solver(hierarchy.num_variables(), drawn.capacity);
      Solution solution(hierarchy.num_variables(), drawn.capacity);
      EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal)
          << "seed " << seed << ", factor " << factor;
    }
  }
}

}  // namespace
}  // namespace poise
