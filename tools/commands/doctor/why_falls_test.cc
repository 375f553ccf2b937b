// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/why_falls.h"

#include <gtest/gtest.h>

#include <string>

#include "poise/robot/control/stand.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tools/commands/doctor/biped_fixture.h"

namespace poise {
namespace {

// Longer than the slowest build needs, s: the sanitizers take ten times as long
// as the doctor.
constexpr double kEnough = 600;

Robot Stand(const SmallBiped& biped) {
  return MakeStandingRobot(UrdfDocument(TextOf(biped), "robot.urdf"));
}

TEST(WhyFalls, SaysNothingAboutARobotThatStands) {
  EXPECT_EQ(WhyFalls(Stand({}), {}, 5, kEnough).value_or("no time"), "");
}

// Without motors in its legs, the robot folds within a second or two.
TEST(WhyFalls, GivesTheTimeOfTheFall) {
  SmallBiped biped;
  biped.leg_effort = 0.1;
  const std::string reason =
      WhyFalls(Stand(biped), {}, 5, kEnough).value_or("no time");
  const std::string start = "it falls after ";
  ASSERT_EQ(reason.find(start), 0u) << reason;
  const double time = std::stod(reason.substr(start.size()));
  EXPECT_GT(time, 0);
  EXPECT_LT(time, 3);
  EXPECT_NE(reason.find(" s of the scenario stand: "), std::string::npos)
      << reason;
}

}  // namespace
}  // namespace poise
