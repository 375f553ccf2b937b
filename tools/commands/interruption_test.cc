// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/interruption.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace poise {
namespace {

class InterruptionDeathTest : public testing::TestWithParam<int> {};

TEST_P(InterruptionDeathTest, IsSaidAndEndsTheProgram) {
  EXPECT_EXIT(
      {
        SayIfInterrupted("figures");
        (void)std::raise(GetParam());
      },
      testing::KilledBySignal(GetParam()), "^\nfigures: interrupted\n$");
}

TEST_P(InterruptionDeathTest, IsCaughtOnce) {
  EXPECT_EXIT(
      {
        std::signal(GetParam(), SIG_IGN);
        SayIfInterrupted("figures");
        CatchInterruption();
        if (IsInterrupted()) std::exit(3);
        (void)std::raise(GetParam());
        if (!IsInterrupted()) std::exit(4);
        (void)std::raise(GetParam());
      },
      testing::KilledBySignal(GetParam()), "^$");
}

// A shell starts programs in the background so that they ignore SIGINT.
TEST_P(InterruptionDeathTest, IsIgnoredIfItWas) {
  EXPECT_EXIT(
      {
        std::signal(GetParam(), SIG_IGN);
        SayIfInterrupted("figures");
        (void)std::raise(GetParam());
        std::exit(3);
      },
      testing::ExitedWithCode(3), "^$");
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptionDeathTest,
                         testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace poise
