// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/summary.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/sim/push.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

using Eigen::Vector3d;
using nlohmann::ordered_json;

// Returns a weak box push on the head, then a strong half sine on a hand. The
// push on the waist would be the largest, but it starts after the end of the
// run.
Scenario MakeThreePushes() {
  Scenario scenario;
  scenario.name = "three";
  scenario.duration = 0.06;
  Push box;
  box.link = "head";
  box.force = Vector3d(-20, 0, 0);
  box.start = 0.01;
  box.duration = 0.02;
  Push sine;
  sine.link = "l_hand";
  sine.point = Vector3d(0.01, 0.02, 0.03);
  sine.force = Vector3d(0, 100, 0);
  sine.profile = PushProfile::kHalfSine;
  sine.start = 0.03;
  sine.duration = 0.03;
  Push late;
  late.link = "waist";
  late.force = Vector3d(1000, 0, 0);
  late.start = 7;
  scenario.pushes = {box, sine, late};
  return scenario;
}

TEST(Summary, DescribesEachPush) {
  const Robot robot = LoadHumanoid();
  const Scenario scenario = MakeThreePushes();
  const RunResult result = poise::Run(robot, scenario);
  const ordered_json json = ToJson(robot, scenario, result);
  ASSERT_EQ(json["pushes"].size(), 3u);
  const ordered_json& box = json["pushes"][0];
  EXPECT_EQ(box["link"], "head");
  EXPECT_EQ(box["force"], ordered_json({-20.0, 0.0, 0.0}));
  EXPECT_EQ(box["at"], 0.01);
  EXPECT_EQ(box["duration"], 0.02);
  EXPECT_EQ(box["shape"], "box");
  EXPECT_NEAR(box["impulse_Ns"].get<double>(), 0.4, 1e-12);
  const ordered_json& sine = json["pushes"][1];
  EXPECT_EQ(sine["link"], "l_hand");
  EXPECT_NE(sine["body"], box["body"]);
  EXPECT_NE(sine["point"], box["point"]);
  EXPECT_EQ(sine["force"], ordered_json({0.0, 100.0, 0.0}));
  EXPECT_EQ(sine["frame"], "world");
  EXPECT_EQ(sine["shape"], "half_sine");
  EXPECT_NEAR(sine["impulse_Ns"].get<double>(), 6 / M_PI, 1e-12);
  EXPECT_EQ(json["pushes"][2]["impulse_Ns"], 0.0);
}

TEST(Summary, DescribesTheLargestPushInTheKeysOfOnePush) {
  const Robot robot = LoadHumanoid();
  const Scenario scenario = MakeThreePushes();
  const ordered_json json =
      ToJson(robot, scenario, poise::Run(robot, scenario));
  const ordered_json& sine = json["pushes"][1];
  EXPECT_EQ(json["impulse_Ns"], sine["impulse_Ns"]);
  EXPECT_EQ(json["push_duration"], sine["duration"]);
  EXPECT_EQ(json["push_link"], sine["link"]);
  EXPECT_EQ(json["push_body"], sine["body"]);
  EXPECT_EQ(json["push_point"], sine["point"]);
}

TEST(Summary, PrintsALineForEachPushWithItsOwnForce) {
  const Robot robot = LoadHumanoid();
  Scenario scenario = MakeThreePushes();
  const auto table = [&] { return ToTable(robot, scenario, {}); };
  const auto has = [&](const std::string& line) {
    return table().find(line + '\n') != std::string::npos;
  };
  EXPECT_TRUE(
      has("0.40 N s over 0.020 s: 20 N at 180 deg on head, from 0.01 s"));
  EXPECT_TRUE(
      has("1.91 N s over 0.030 s: half sine, peak 100 N at 90 deg on "
          "l_hand, from 0.03 s"));
  EXPECT_EQ(table().find("waist"), std::string::npos);
  // The line of a single push has no start time.
  scenario.pushes.erase(scenario.pushes.begin());
  EXPECT_TRUE(
      has("1.91 N s over 0.030 s: half sine, peak 100 N at 90 deg on l_hand"));
  scenario.pushes.erase(scenario.pushes.begin());
  EXPECT_TRUE(has("none before the end of the run"));
  scenario = MakeThreePushes();
  for (Push& push : scenario.pushes) push.duration = 0;
  EXPECT_TRUE(has("none: all forces or durations are 0"));
  scenario = MakeThreePushes();
  for (Push& push : scenario.pushes) push.force.setZero();
  EXPECT_TRUE(has("none: all forces or durations are 0"));
  scenario.pushes[0].moment.z() = 1;
  EXPECT_TRUE(has("a moment of up to 1 N m for 0.020 s on head"));
  EXPECT_EQ(ToJson(robot, scenario, {}, {})["pushes"][0]["moment"][2], 1);
  scenario.pushes.clear();
  EXPECT_EQ(table().find("push"), std::string::npos);
  // The table shows at most five pushes.
  scenario.pushes = std::vector<Push>(8, MakeThreePushes().pushes[0]);
  EXPECT_TRUE(has("and 3 more"));
}

TEST(Summary, SaysWhereAStepLanded) {
  RunResult result;
  TakenStep step;
  step.at = 1.1;
  step.has_landed = true;
  step.swing_time = 0.2;
  step.planned = {0.18, 0.47};
  step.landed = {0.17, 0.45};
  result.steps = {step};
  EXPECT_NE(ToTable(LoadHumanoid(), {}, result)
                .find("left_foot at 1.100 s, landed at (0.17, 0.45) m after "
                      "0.20 s\n"),
            std::string::npos);
}

// A force that turns with its link is given in the axes of the link's body.
TEST(Summary, NamesTheAxesOfAForce) {
  const Robot robot = LoadHumanoid();
  Scenario scenario = MakeThreePushes();
  scenario.pushes.resize(1);
  scenario.pushes[0].frame = PushFrame::kLink;
  const ordered_json push = ToJson(robot, scenario, {})["pushes"][0];
  EXPECT_EQ(push["frame"], "body");
  const PushOnRobot aimed(robot, scenario.pushes[0]);
  const auto at_once = aimed.At(0.02, 1e-3, Eigen::Matrix3d::Identity());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(push["force"][i].get<double>(), at_once->force_W[i], 1e-12);
  }
}

}  // namespace
}  // namespace poise
