// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <string>

#include "robot/profile.h"
#include "sim/run.h"
#include "sim/scenario.h"

namespace poise {
namespace {

class ClosedLoopCertificate : public testing::TestWithParam<std::string> {};

// A solve reported optimal has a certificate of 1e-9 at most, see
// hqp/certificate.h: in every tick of a run.
TEST_P(ClosedLoopCertificate, IsHeldInEveryTick) {
  const Robot robot = LoadRobot("robot/models/humanoid.urdf",
                                LoadProfile("robot/profiles/humanoid.yaml"));
  const RunResult result =
      poise::Run(robot, LoadScenario("sim/scenarios/" + GetParam() + ".yaml"));
  EXPECT_EQ(result.failures, 0);
  EXPECT_LE(result.certificate_max, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ClosedLoopCertificate,
                         testing::Values("stand", "weak_push", "strong_push"));

}  // namespace
}  // namespace poise
