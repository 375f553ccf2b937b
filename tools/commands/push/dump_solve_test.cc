// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/dump_solve.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(SolveAgain, HasTheBudgetOnlyFromTheFirstTickOn) {
  ControlSettings control;
  const auto command = [&](double first) {
    return SolveAgain(control, {first, 0.2}, "out/solves/solve_*.json");
  };
  const std::string start = "bazel run //tools:hqp -- --max-iterations 500 ";
  EXPECT_EQ(command(0), start + "out/solves/solve_*.json");
  control.budget_us = 62.5;
  EXPECT_EQ(command(0), start + "--budget-us 62.5 out/solves/solve_*.json");
  EXPECT_EQ(command(0.1), start + "out/solves/solve_*.json");
  // The time that a clock has measured cannot be repeated.
  control.budget_clock = true;
  EXPECT_EQ(command(0), start + "out/solves/solve_*.json");
}

TEST(SolveAgain, IsAShellCommand) {
  EXPECT_EQ(SolveAgain({}, {0, 0.2}, "my run/solve_*.json"),
            "bazel run //tools:hqp -- --max-iterations 500 'my run'/"
            "solve_*.json");
}

}  // namespace
}  // namespace poise
