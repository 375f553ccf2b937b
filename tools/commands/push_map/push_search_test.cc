// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace poise {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(PushSearch, FindsTheLargestImpulseFromAnyGuess) {
  for (const double edge : {0.3, 1.0, 7.9, 16.1, 39.9}) {
    for (const double guess : {0.0, 0.5, 7.0, 16.0, 40.0, 1e9, kInf}) {
      SCOPED_TRACE(testing::Message() << edge << " from " << guess);
      std::set<double> tried;
      const auto found = FindLargestImpulse(
          [&](double impulse) -> std::optional<bool> {
            EXPECT_TRUE(tried.insert(impulse).second)
                << "the impulse was tried twice";
            return impulse <= edge;
          },
          guess, 0.25, 40);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->recovered, 0.25 * std::floor(edge / 0.25));
      EXPECT_EQ(found->failed, found->recovered + 0.25);
      EXPECT_LE(tried.size(), 17u);
    }
  }
}

TEST(PushSearch, ScanFindsTheFirstFailureAndTheHolesAboveIt) {
  // Fails at 30, 31 and from 34 on; the scan ends at 36 = 1.2 x 30.
  std::set<double> tried;
  const auto scan = ScanImpulses(
      [&](double impulse) -> std::optional<bool> {
        EXPECT_TRUE(tried.insert(impulse).second);
        return impulse < 29.9 || (impulse > 31.1 && impulse < 33.9);
      },
      2, 0.5, 80);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->recovered, 29.5);
  EXPECT_EQ(scan->failed, 30);
  EXPECT_EQ(scan->holes, (std::vector<double>{30, 30.5, 31}));
  EXPECT_EQ(*tried.begin(), 2);
  EXPECT_EQ(*tried.rbegin(), 36);
}

TEST(PushSearch, ScanReportsNoFailureNoRecoveryAndAnAbort) {
  const auto all =
      ScanImpulses([](double) { return std::optional(true); }, 2, 1, 20);
  EXPECT_EQ(all->recovered, 20);
  EXPECT_EQ(all->failed, kInf);
  const auto none =
      ScanImpulses([](double) { return std::optional(false); }, 2, 1, 20);
  EXPECT_EQ(none->recovered, 0);
  EXPECT_EQ(none->failed, 2);
  EXPECT_TRUE(none->holes.empty());
  EXPECT_FALSE(
      ScanImpulses([](double) { return std::optional<bool>(); }, 2, 1, 20));
}

TEST(PushSearch, NeedsFewTrialsFromAGoodGuess) {
  int trials = 0;
  FindLargestImpulse(
      [&](double impulse) -> std::optional<bool> {
        ++trials;
        return impulse <= 15.8;
      },
      16, 0.25, 64);
  EXPECT_LE(trials, 4);
}

TEST(PushSearch, ReportsNoRecoveryAndNoFailure) {
  const auto none = FindLargestImpulse(
      [](double) -> std::optional<bool> { return false; }, 5, 0.25, 40);
  EXPECT_EQ(none->recovered, 0);
  EXPECT_EQ(none->failed, 0.25);
  const auto all = FindLargestImpulse(
      [](double impulse) -> std::optional<bool> {
        EXPECT_LE(impulse, 40);
        return true;
      },
      5, 0.25, 40);
  EXPECT_EQ(all->recovered, 40);
  EXPECT_EQ(all->failed, kInf);
}

TEST(PushSearch, StopsIfATrialIsAborted) {
  int trials = 0;
  const auto found = FindLargestImpulse(
      [&](double) -> std::optional<bool> {
        if (++trials == 3) return std::nullopt;
        return true;
      },
      5, 0.25, 40);
  EXPECT_FALSE(found);
  EXPECT_EQ(trials, 3);
}

}  // namespace
}  // namespace poise
