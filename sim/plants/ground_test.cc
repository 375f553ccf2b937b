// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <string>

#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Runs a scenario of sim/scenarios for another duration, s.
RunResult RunOurs(const std::string& name, double duration) {
  Scenario scenario = LoadScenario("sim/scenarios/" + name + ".yaml");
  scenario.duration = duration;
  return poise::Run(LoadHumanoid(), scenario);
}

TEST(Ground, StandsOnASlopeAndRecoversFromAPush) {
  const RunResult result = RunOurs("slope", 3);
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_LT(result.verdict.foot_tilt_peak, 0.02);  // Relative to the slope.
  EXPECT_LT(result.verdict.foot_slide_peak, 5e-3);
  EXPECT_EQ(result.failures, 0);
}

TEST(Ground, StandsOnAnUnmodelledBoardUnderAFoot) {
  const RunResult result = RunOurs("board", 3.5);
  EXPECT_TRUE(result.verdict.recovered);
  // The soles are 0.2 m apart, so a board of 10 mm tilts the feet by 0.05 rad.
  EXPECT_NEAR(result.verdict.foot_tilt_peak, 0.05, 0.03);
  EXPECT_LT(result.verdict.com_error_final.norm(), 2e-3);
  EXPECT_EQ(result.failures, 0);
}

}  // namespace
}  // namespace poise
