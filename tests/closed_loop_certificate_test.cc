// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <string>

#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/scenario_files.h"

namespace poise {
namespace {

class ClosedLoopCertificate : public testing::TestWithParam<std::string> {};

// Each solve that reports kOptimal must have a certificate of at most 1e-9, see
// hqp/certificate.h. The test checks every tick of a run, to its end or until
// the robot falls.
TEST_P(ClosedLoopCertificate, IsBelowToleranceInEveryTick) {
  const Robot robot = LoadHumanoid();
  const Scenario scenario = LoadScenario(GetParam());
  const RunResult result = poise::Run(robot, scenario);
  EXPECT_EQ(result.failures, 0);
  EXPECT_LE(result.certificate_max, 1e-9);
  // The robot must fall in this scenario only: an early fall would leave few
  // ticks to check.
  EXPECT_EQ(result.verdict.fell_at.has_value(),
            scenario.name == "strong_push_without_zmp");
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ClosedLoopCertificate,
                         testing::ValuesIn(ScenarioFiles()), ScenarioTestName);

TEST(ClosedLoop, FindsAllScenarioFiles) {
  EXPECT_EQ(ScenarioFiles().size(), kNumScenarios);
}

}  // namespace
}  // namespace poise
