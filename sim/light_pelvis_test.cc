// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests a robot whose pelvis is light, below a waist of three joints.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "poise/robot/control/stand.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/sim/story_fixture.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

void Replace(const std::string& from, const std::string& to, size_t start,
             std::string* text) {
  const size_t at = text->find(from, start);
  ASSERT_NE(at, std::string::npos) << from;
  text->replace(at, from.size(), to);
}

// Returns the humanoid with a fifth of the pelvis's moments of inertia, and a
// roll joint in its waist, which has joints for pitch and yaw only.
Robot WithLightPelvis() {
  std::ifstream file("robot/models/humanoid.urdf");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const size_t pelvis = text.find("<link name=\"pelvis\">");
  Replace("ixx=\"0.0165799\"", "ixx=\"0.0033\"", pelvis, &text);
  Replace("iyy=\"0.0126764\"", "iyy=\"0.0025\"", pelvis, &text);
  Replace("izz=\"0.0220966\"", "izz=\"0.0044\"", pelvis, &text);
  const size_t yaw = text.find("<joint name=\"chest_yaw\"");
  Replace("<parent link=\"waist\"/>", "<parent link=\"waist_roll\"/>", yaw,
          &text);
  text.insert(yaw, R"(
    <link name="waist_roll"><inertial>
      <mass value="0.3"/>
      <inertia ixx="3e-4" ixy="0" ixz="0" iyy="3e-4" iyz="0" izz="3e-4"/>
    </inertial></link>
    <joint name="chest_roll" type="revolute">
      <parent link="waist"/>
      <child link="waist_roll"/>
      <axis xyz="1 0 0"/>
      <limit lower="-0.6" upper="0.6" effort="100" velocity="6"/>
    </joint>
  )");
  Robot robot = LoadRobot(TestFile("light_pelvis.urdf", text));
  if (!robot.can_stand) StandUp(&robot);
  return robot;
}

// The robot stands on its left foot from 3 s on, and is pushed at 6 s. It comes
// to rest before. If `momentum` kept the pelvis upright instead of the torso,
// the waist would move for seconds, by more and more.
TEST(LightPelvis, ComesToRestOnOneFoot) {
  const Robot robot = WithLightPelvis();
  ClosedLoop loop(robot, Ours("one_leg", 5.9));
  Judge judge(StandingHeight(robot));
  double fastest = 0;  // rad/s.
  while (loop.time() < 5.9 - 1e-6) {
    loop.Tick();
    judge.Look(loop.observation());
    if (loop.time() < 5.4) continue;
    const auto rates = loop.record().end.v.tail(robot.model.tree.num_joints());
    fastest = std::max(fastest, rates.lpNorm<Eigen::Infinity>());
  }
  EXPECT_FALSE(judge.is_down());
  // The swing ends at 4 s. An error that decays with kd / 2 = 7.5 1/s is then
  // down to 3e-5.
  EXPECT_LT(fastest, 5e-3);
}

}  // namespace
}  // namespace poise
