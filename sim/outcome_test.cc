// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/outcome.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(Outcome, DistinguishesAFallFromAFinalError) {
  Verdict verdict;
  EXPECT_EQ(Outcome(verdict), "does not come back");
  verdict.fell_at = 1.056;
  EXPECT_EQ(Outcome(verdict), "falls at 1.06 s");
  verdict = {};
  verdict.recovered = true;
  EXPECT_EQ(Outcome(verdict), "recovers");
}

}  // namespace
}  // namespace poise
