// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/warnings.h"

#include <gtest/gtest.h>

#include "poise/sim/scenario.h"

namespace poise {
namespace {

using Lines = std::vector<std::string>;

Finding Warn(const std::string& where, const std::string& why) {
  return {Severity::kWarn, where, "is odd", why, 0};
}

TEST(WarningLines, OmitNotes) {
  EXPECT_EQ(WarningLines("a.urdf", {{Severity::kNote, "b", "c", "d", 1}}),
            Lines{});
}

TEST(WarningLines, JoinWarningsOfOneKind) {
  EXPECT_EQ(
      WarningLines("a.urdf", {Warn("l_sole", "guessed"), Warn("knee", "weak"),
                              Warn("r_sole", "guessed")}),
      (Lines{"a.urdf: l_sole: is odd, guessed; also r_sole",
             "a.urdf: knee: is odd, weak"}));
}

TEST(WarningLines, LimitLinesAndNames) {
  std::vector<Finding> findings(10, Warn("x", "same"));
  for (const char* why : {"1", "2", "3", "4", "5", "6"}) {
    findings.push_back(Warn("y", why));
  }
  const Lines lines = WarningLines("a.urdf", findings);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "a.urdf: x: is odd, same; also x, x, x and 6 more");
  EXPECT_EQ(lines[5],
            "a.urdf: 2 more kinds of warnings, see bazel run //tools:doctor");
}

TEST(BudgetWarning, IsForMoreThanAThirdOfThePeriod) {
  ControlSettings control;
  control.dt = 3e-3;
  for (const double budget_us : {0.0, 300.0, 999.0}) {
    control.budget_us = budget_us;
    EXPECT_EQ(BudgetWarning(control), "");
  }
  control.budget_us = 1001;
  EXPECT_EQ(BudgetWarning(control),
            "the budget is 1001 us, more than a third of the control period, "
            "3000 us: on a robot, a tick may end late, see docs/failures.md");
}

}  // namespace
}  // namespace poise
