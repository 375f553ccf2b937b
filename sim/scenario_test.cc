// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/scenario.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/sim/number_field.h"
#include "poise/sim/scenario_fields.h"
#include "poise/sim/scenario_fixture.h"

namespace poise {
namespace {

TEST(Scenario, ReadsEveryScenarioOfTheRepository) {
  for (const char* name : {"stand", "posture_off", "com_sinusoid", "weak_push",
                           "strong_push_without_zmp", "strong_push", "one_leg",
                           "slope", "board", "shove"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(LoadScenario("sim/scenarios/" + std::string(name) + ".yaml").name,
              name);
  }
}

// A scenario with every key. Each value differs from the default.
constexpr char kEveryKey[] = R"(
name: all
duration: 7
seed: 3
chosen_for: {mass: 31, com_height: 0.7}
start: {joints: 0.1, drop: 0.01, heading: 0.5, place: [1, -2]}
pushes:
  - {link: torso, point: [1, 2, 3], frame: link, force: [4, 5, 6],
     moment: [7, 8, 9], profile: half_sine, at: 2, duration: 0.3}
  - {profile: impulse}
  - {force: [1, 2, 0], impulse_fraction: 0.4, elsewhere: 0.5}
stance:
  - {at: 1, shift: left_foot, over: 2}
  - {at: 3, lift: right_foot, height: 0.1}
  - {at: 4, put_down: right_foot}
  - {at: 5, shift: middle}
com: {sine: [1, 2, 3], cosine: [4, 5, 6], period: 4}
tasks: {set: paper, with: [zmp], without: [cop, yaw]}
control: {rate: 500, delay: 0.002, friction: 0.4, mass_error: -0.1,
          ramp: 0.3, budget_us: 250, budget_clock: true, inscribed: true,
          feedforward: true, weighted: true, estimator: true}
plant: {kind: mujoco, rate: 2000, friction: 0.7, torque_scale: 0.5, roll: 0.1,
        pitch: 0.2, boards: [{center: [1, 2, 3], size: [4, 5, 6], yaw: 1}],
        joint_limits: false, joint_damping: false, self_collision: false,
        restitution: 0.25}
sensors: {noise: 1, joint_position: 1.1, joint_velocity: 1.2,
          base_orientation: 1.3, base_rate: 1.4, foot_force: 1.5,
          foot_moment: 1.6, accelerometer: 1.7, gyroscope: 1.8, joint_bias: 1.9,
          gyroscope_bias: 2.1, force_bias: 2.2, joint_resolution: 2.3,
          force_resolution: 2.4, dropout: 0.5, contact_threshold: 2.6,
          freeze_at: 2.7, freeze_for: 2.8, bias: 2.9, resolution: 3.1,
          base_position: 3.2, base_velocity: 3.3, joint_delay: 0.1,
          base_delay: 0.2, foot_delay: 0.3}
)";

TEST(Scenario, ReadsNameDurationSeedAndStart) {
  const Scenario s = Read(kEveryKey);
  EXPECT_EQ(s.name, "all");
  EXPECT_EQ(s.duration, 7);
  EXPECT_EQ(s.seed, 3u);
  ASSERT_TRUE(s.chosen_for);
  EXPECT_EQ(s.chosen_for->mass, 31);
  EXPECT_EQ(s.chosen_for->com_height, 0.7);
  EXPECT_EQ(s.start.joints, 0.1);
  EXPECT_EQ(s.start.drop, 0.01);
  EXPECT_EQ(s.start.heading, 0.5);
  EXPECT_EQ(s.start.place, Eigen::Vector2d(1, -2));
}

TEST(Scenario, ParsesTextLikeAFile) {
  // JSON is valid YAML.
  const Scenario s = ParseScenario(
      R"({"duration": 2.5, "steps": true, "pushes": [{"force": [0, 60, 0]}]})",
      "text", "mine");
  EXPECT_EQ(s.name, "mine");
  EXPECT_EQ(s.duration, 2.5);
  EXPECT_TRUE(s.steps);
  ASSERT_EQ(s.pushes.size(), 1u);
  EXPECT_EQ(s.pushes[0].force, Eigen::Vector3d(0, 60, 0));
  EXPECT_EQ(ParseScenario("name: given", "text", "mine").name, "given");
}

TEST(Scenario, ReadsEachKeyOfPushes) {
  const Scenario s = Read(kEveryKey);
  ASSERT_EQ(s.pushes.size(), 3u);
  EXPECT_EQ(s.pushes[0].link, "torso");
  EXPECT_EQ(*s.pushes[0].point, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(s.pushes[0].frame, PushFrame::kLink);
  EXPECT_EQ(s.pushes[0].force, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(s.pushes[0].moment, Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(s.pushes[0].profile, PushProfile::kHalfSine);
  EXPECT_EQ(s.pushes[0].start, 2);
  EXPECT_EQ(s.pushes[0].duration, 0.3);
  EXPECT_EQ(s.pushes[1].profile, PushProfile::kImpulse);
  EXPECT_FALSE(s.pushes[1].point);
  EXPECT_FALSE(s.pushes[1].impulse_fraction);
  EXPECT_EQ(s.pushes[2].impulse_fraction, 0.4);
  EXPECT_EQ(s.pushes[2].elsewhere, 0.5);
}

TEST(Scenario, ReadsEachKeyOfStanceAndCom) {
  const Scenario s = Read(kEveryKey);
  ASSERT_EQ(s.stance.size(), 4u);
  EXPECT_EQ(s.stance[0].kind, StanceEvent::Kind::kShift);
  EXPECT_EQ(s.stance[0].at, 1);
  EXPECT_EQ(s.stance[0].foot, "left_foot");
  EXPECT_EQ(s.stance[0].over, 2);
  EXPECT_EQ(s.stance[1].kind, StanceEvent::Kind::kLift);
  EXPECT_EQ(s.stance[1].foot, "right_foot");
  EXPECT_EQ(s.stance[1].height, 0.1);
  EXPECT_EQ(s.stance[2].kind, StanceEvent::Kind::kPutDown);
  EXPECT_EQ(s.stance[2].foot, "right_foot");
  EXPECT_EQ(s.stance[3].foot, "");
  EXPECT_EQ(s.com.sine, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(s.com.cosine, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(s.com.period, 4);
}

TEST(Scenario, ReadsEachKeyOfTasksAndControl) {
  const Scenario s = Read(kEveryKey);
  EXPECT_EQ(s.control.tasks, "paper");
  EXPECT_EQ(s.control.with, std::vector<std::string>{"zmp"});
  EXPECT_EQ(s.control.without, (std::vector<std::string>{"cop", "yaw"}));
  EXPECT_EQ(s.control.dt, 0.002);
  EXPECT_EQ(s.control.delay, 0.002);
  EXPECT_EQ(s.control.friction, 0.4);
  EXPECT_EQ(s.control.mass_error, -0.1);
  EXPECT_EQ(s.control.ramp, 0.3);
  EXPECT_EQ(s.control.budget_us, 250);
  EXPECT_TRUE(s.control.budget_clock);
  EXPECT_TRUE(s.control.inscribed && s.control.feedforward &&
              s.control.weighted && s.control.estimator);
}

TEST(Scenario, ReadsEachKeyOfPlant) {
  const Scenario s = Read(kEveryKey);
  EXPECT_EQ(s.plant_kind, "mujoco");
  EXPECT_EQ(s.plant.dt, 0.0005);
  EXPECT_EQ(s.plant.friction, 0.7);
  EXPECT_EQ(s.plant.torque_scale, 0.5);
  EXPECT_EQ(s.plant.restitution, 0.25);
  EXPECT_EQ(s.plant.ground.roll, 0.1);
  EXPECT_EQ(s.plant.ground.pitch, 0.2);
  ASSERT_EQ(s.plant.ground.boards.size(), 1u);
  EXPECT_EQ(s.plant.ground.boards[0].center_W, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(s.plant.ground.boards[0].size, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(s.plant.ground.boards[0].yaw, 1);
  EXPECT_FALSE(s.plant.joint_limits || s.plant.joint_damping ||
               s.plant.self_collision);
}

TEST(Scenario, ReadsEachKeyOfSensors) {
  const SensorSettings n = Read(kEveryKey).sensors;
  EXPECT_EQ(n.noise, 1);
  EXPECT_EQ(n.joint_position, 1.1);
  EXPECT_EQ(n.joint_velocity, 1.2);
  EXPECT_EQ(n.base_orientation, 1.3);
  EXPECT_EQ(n.base_rate, 1.4);
  EXPECT_EQ(n.foot_force, 1.5);
  EXPECT_EQ(n.foot_moment, 1.6);
  EXPECT_EQ(n.accelerometer, 1.7);
  EXPECT_EQ(n.gyroscope, 1.8);
  EXPECT_EQ(n.joint_bias, 1.9);
  EXPECT_EQ(n.gyroscope_bias, 2.1);
  EXPECT_EQ(n.force_bias, 2.2);
  EXPECT_EQ(n.joint_resolution, 2.3);
  EXPECT_EQ(n.force_resolution, 2.4);
  EXPECT_EQ(n.dropout, 0.5);
  EXPECT_EQ(n.contact_threshold, 2.6);
  EXPECT_EQ(n.freeze_at, 2.7);
  EXPECT_EQ(n.freeze_for, 2.8);
  EXPECT_EQ(n.bias, 2.9);
  EXPECT_EQ(n.resolution, 3.1);
  EXPECT_EQ(n.base_position, 3.2);
  EXPECT_EQ(n.base_velocity, 3.3);
  EXPECT_EQ(n.joint_delay, 0.1);
  EXPECT_EQ(n.base_delay, 0.2);
  EXPECT_EQ(n.foot_delay, 0.3);
}

// Returns the YAML in docs/scenarios.md.
std::string Documented() {
  std::ifstream stream("docs/scenarios.md");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string fence = "```yaml\n";
  const size_t start = text.find(fence) + fence.size();
  return text.substr(start, text.find("```", start) - start);
}

// Expects that the page has the default of each number.
template <typename Part>
void ExpectDefaults(Part documented) {
  Part fresh;
  const std::vector<NumberField> page = Fields(&documented);
  const std::vector<NumberField> defaults = Fields(&fresh);
  ASSERT_EQ(page.size(), defaults.size());
  for (std::size_t i = 0; i < page.size(); ++i) {
    for (int k = 0; k < page[i].size; ++k) {
      EXPECT_EQ(page[i].value[k], defaults[i].value[k]) << page[i].key;
    }
  }
}

TEST(Scenario, DocsListEveryKeyWithItsDefault) {
  const Scenario documented = Read(Documented()), fresh;
  ExpectDefaults(documented);
  ExpectDefaults(documented.start);
  ExpectDefaults(documented.com);
  ExpectDefaults(documented.control);
  ExpectDefaults(documented.sensors);
  EXPECT_EQ(documented.seed, fresh.seed);
  EXPECT_EQ(documented.steps, fresh.steps);
  EXPECT_EQ(documented.pushes[0].start, Push().start);
  EXPECT_EQ(documented.pushes[0].duration, Push().duration);
  EXPECT_EQ(documented.pushes[0].moment, Push().moment);
  EXPECT_EQ(documented.stance[0].over, StanceEvent().over);
  EXPECT_EQ(documented.stance[1].height, StanceEvent().height);
  EXPECT_EQ(documented.control.tasks, fresh.control.tasks);
  EXPECT_FALSE(documented.control.inscribed || documented.control.feedforward ||
               documented.control.weighted || documented.control.estimator);
  EXPECT_EQ(documented.plant_kind, fresh.plant_kind);
  EXPECT_EQ(documented.plant.dt, fresh.plant.dt);
  EXPECT_EQ(documented.plant.friction, fresh.plant.friction);
  EXPECT_EQ(documented.plant.restitution, fresh.plant.restitution);
  EXPECT_EQ(documented.plant.torque_scale, fresh.plant.torque_scale);
  EXPECT_TRUE(documented.plant.joint_limits && documented.plant.joint_damping &&
              documented.plant.self_collision);
  for (const char* wrong :
       {"?: 0", "start: {?: 0}", "pushes: [{?: 0}]", "stance: [{?: 0}]",
        "com: {?: 0}", "tasks: {?: 0}", "control: {?: 0}", "plant: {?: 0}",
        "plant: {boards: [{?: 0}]}", "sensors: {?: 0}"}) {
    const std::string text = wrong;
    const size_t at = text.find('?');
    std::string known =
        Complaint(text.substr(0, at) + "nonsense" + text.substr(at + 1) + '\n');
    known = known.substr(known.find("one of ") + 7) + ", ";
    for (size_t end; (end = known.find(", ")) != std::string::npos;
         known = known.substr(end + 2)) {
      const std::string key = known.substr(0, end);
      EXPECT_NE(Documented().find(key + ":"), std::string::npos)
          << key << " of " << wrong;
    }
  }
}

TEST(Scenario, LoadsPushesFromASeparateFile) {
  const auto pushes =
      LoadPushes(Write("pushes: [{force: [1, 0, 0]}, {force: [0, 2, 0]}]\n"));
  ASSERT_EQ(pushes.size(), 2u);
  EXPECT_EQ(pushes[1].force, Eigen::Vector3d(0, 2, 0));
  EXPECT_THROW(LoadPushes(Write("push: []\n")), std::invalid_argument);
}

}  // namespace
}  // namespace poise
