// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/random_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// Returns all rows of a hierarchy.
Eigen::MatrixXd Rows(const Hierarchy& hierarchy) {
  Eigen::MatrixXd rows(0, hierarchy.num_variables());
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    for (const auto& block : {hierarchy.B(k), hierarchy.C(k)}) {
      rows.conservativeResize(rows.rows() + block.rows(), Eigen::NoChange);
      rows.bottomRows(block.rows()) = block;
    }
  }
  return rows;
}

RandomHierarchyOptions Plain() {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.degenerate = 0;  // A zero row has bounds of scale 1e-3.
  return options;
}

TEST(MakeRandomHierarchy, DrawsIntegers) {
  RandomHierarchyOptions options = Plain();
  options.integer = 100;
  options.max_equalities = 0;
  int at_zero = 0, bounds = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const Eigen::MatrixXd rows = Rows(hierarchy);
    EXPECT_EQ(rows, rows.array().round().matrix()) << seed;
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
        if (hierarchy.C(k).row(i).isZero()) continue;
        for (const double bound :
             {hierarchy.lower(k)[i], hierarchy.upper(k)[i]}) {
          if (std::isinf(bound)) continue;
          ++bounds;
          at_zero += bound == 0;
          EXPECT_EQ(bound, std::round(bound)) << seed;
        }
      }
    }
  }
  EXPECT_GT(at_zero, bounds / 20);
}

TEST(MakeRandomHierarchy, ScalesColumnsByUnits) {
  RandomHierarchyOptions options = Plain();
  options.columns = 100;
  double least = 1, most = 1;
  for (int seed = 0; seed < 100; ++seed) {
    const Eigen::MatrixXd rows =
        Rows(MakeRandomHierarchy(seed, options).hierarchy);
    for (int j = 0; j < rows.cols(); ++j) {
      const double largest =
          rows.rows() == 0 ? 0 : rows.col(j).cwiseAbs().maxCoeff();
      if (largest == 0) continue;
      least = std::min(least, largest);
      most = std::max(most, largest);
    }
  }
  EXPECT_LT(least, 1e-2);
  EXPECT_GT(most, 1e5);
}

}  // namespace
}  // namespace poise
