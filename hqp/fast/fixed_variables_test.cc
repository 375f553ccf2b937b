// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/fixed_variables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace poise {
namespace {

constexpr int kVariables = 9;

// The order by another rule: a list of the fixed variables, and a set of
// columns.
TEST(FixedVariables, KeepsFreeVariablesBeforeFixedOnes) {
  std::mt19937 random(1);
  FixedVariables variables(kVariables);
  std::vector<int> fixed;
  for (int change = 0; change < 3000; ++change) {
    const int j = static_cast<int>(random() % kVariables);
    const auto at = std::find(fixed.begin(), fixed.end(), j);
    if (at == fixed.end()) {
      const int before = variables.column(j);
      const int moved = variables.variable(variables.num_free() - 1);
      EXPECT_EQ(variables.Fix(j), before);
      fixed.push_back(j);
      if (moved != j) {
        EXPECT_EQ(variables.column(moved), before);
      }
    } else {
      variables.Release(static_cast<int>(at - fixed.begin()));
      *at = fixed.back();
      fixed.pop_back();
      EXPECT_EQ(variables.column(j), variables.num_free() - 1);
    }
    ASSERT_EQ(variables.size(), static_cast<int>(fixed.size()));
    ASSERT_EQ(variables.num_free(), kVariables - variables.size());
    std::vector<int> columns;
    for (int k = 0; k < kVariables; ++k) {
      columns.push_back(variables.column(k));
      EXPECT_EQ(variables.variable(columns.back()), k);
      EXPECT_EQ(variables.is_fixed(k),
                std::find(fixed.begin(), fixed.end(), k) != fixed.end());
    }
    std::sort(columns.begin(), columns.end());
    for (int c = 0; c < kVariables; ++c) EXPECT_EQ(columns[c], c);
    for (int e = 0; e < variables.size(); ++e) {
      EXPECT_EQ(variables.fixed_variable(e), fixed[e]);
      EXPECT_EQ(variables.column(fixed[e]), variables.fixed_column(e));
      EXPECT_EQ(variables.fixed_column(e), kVariables - 1 - e);
    }
  }
}

TEST(FixedVariables, ClearRestoresTheNumbersOfTheVariables) {
  FixedVariables variables(kVariables);
  for (const int j : {4, 0, 7}) variables.Fix(j);
  variables.Release(1);
  variables.Clear();
  EXPECT_EQ(variables.size(), 0);
  for (int j = 0; j < kVariables; ++j) {
    EXPECT_EQ(variables.column(j), j);
    EXPECT_EQ(variables.variable(j), j);
    EXPECT_FALSE(variables.is_fixed(j));
  }
}

}  // namespace
}  // namespace poise
