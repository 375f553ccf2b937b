// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

std::filesystem::path Write(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "trial.yaml";
  std::ofstream(file) << text;
  return file;
}

Scenario Read(const std::string& text) { return LoadScenario(Write(text)); }

// Returns the error message of a scenario, after the folder's name.
std::string Complaint(const std::string& text) {
  try {
    Read(text);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    const size_t start = what.find("trial.yaml");
    return start == std::string::npos ? what : what.substr(start);
  }
  return "none";
}

TEST(Scenario, ReadsEveryScenarioOfTheRepository) {
  for (const char* name : {"stand", "posture_off", "com_sinusoid", "weak_push",
                           "strong_push_without_zmp", "strong_push", "one_leg",
                           "slope", "board"}) {
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
          ramp: 0.3, inscribed: true, feedforward: true, weighted: true, estimator: true}
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

// A fraction of a bound needs a direction on the ground.
TEST(Scenario, RefusesAFractionWithoutAHorizontalForce) {
  for (const char* push :
       {"impulse_fraction: 0.4", "force: [0, 1, 2], elsewhere: 0.4",
        "force: [1, 0, 0], frame: link, impulse_fraction: 0.4",
        "force: [1, 0, 0], moment: [0, 0, 1], impulse_fraction: 0.4"}) {
    EXPECT_EQ(Complaint("pushes: [{" + std::string(push) + "}]"),
              "trial.yaml: a fraction of the bound must come with a horizontal "
              "force, without moment, in the frame world")
        << push;
  }
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

TEST(Scenario, DocsListEveryKeyWithItsDefault) {
  const Scenario documented = Read(Documented()), fresh;
  EXPECT_EQ(documented.duration, fresh.duration);
  EXPECT_EQ(documented.seed, fresh.seed);
  EXPECT_EQ(documented.pushes[0].start, Push().start);
  EXPECT_EQ(documented.pushes[0].duration, Push().duration);
  EXPECT_EQ(documented.stance[0].over, StanceEvent().over);
  EXPECT_EQ(documented.stance[1].height, StanceEvent().height);
  EXPECT_EQ(documented.com.period, fresh.com.period);
  EXPECT_EQ(documented.control.tasks, fresh.control.tasks);
  EXPECT_EQ(documented.control.dt, fresh.control.dt);
  EXPECT_EQ(documented.control.friction, fresh.control.friction);
  EXPECT_EQ(documented.control.ramp, fresh.control.ramp);
  EXPECT_EQ(documented.plant.dt, fresh.plant.dt);
  EXPECT_EQ(documented.plant.friction, fresh.plant.friction);
  EXPECT_EQ(documented.plant.torque_scale, fresh.plant.torque_scale);
  EXPECT_TRUE(documented.plant.joint_limits && documented.plant.joint_damping &&
              documented.plant.self_collision);
  EXPECT_EQ(documented.sensors.joint_position, fresh.sensors.joint_position);
  EXPECT_EQ(documented.sensors.joint_velocity, fresh.sensors.joint_velocity);
  EXPECT_EQ(documented.sensors.base_orientation,
            fresh.sensors.base_orientation);
  EXPECT_EQ(documented.sensors.base_rate, fresh.sensors.base_rate);
  EXPECT_EQ(documented.sensors.foot_force, fresh.sensors.foot_force);
  EXPECT_EQ(documented.sensors.foot_moment, fresh.sensors.foot_moment);
  EXPECT_EQ(documented.sensors.accelerometer, fresh.sensors.accelerometer);
  EXPECT_EQ(documented.sensors.gyroscope, fresh.sensors.gyroscope);
  EXPECT_EQ(documented.sensors.contact_threshold,
            fresh.sensors.contact_threshold);
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

TEST(Scenario, RejectsAnUnknownKeyWithItsLine) {
  EXPECT_EQ(Complaint("duration: 5\nstart:\n  joint: 0.1\n"),
            "trial.yaml:3: key 'joint' is unknown, must be one of joints, "
            "drop, heading, place");
  EXPECT_EQ(Complaint("pushes:\n- {link: torso}\n- {forse: [0, 1, 0]}\n"),
            "trial.yaml:3: key 'forse' is unknown, must be one of link, point, "
            "impulse_fraction, elsewhere, frame, profile, force, moment, at, "
            "duration");
}

TEST(Scenario, RejectsAnInvalidValueWithItsLine) {
  EXPECT_EQ(Complaint("\nduration: long\n"),
            "trial.yaml:2: 'duration' is 'long', must be a number");
  EXPECT_EQ(Complaint("duration: .inf\n"),
            "trial.yaml:1: 'duration' is '.inf', must be a number");
  EXPECT_EQ(Complaint("pushes:\n - force: [1, 2]\n"),
            "trial.yaml:2: 'force' is a list, must be a list of 3 numbers");
  EXPECT_EQ(Complaint("pushes:\n - profile: bang\n"),
            "trial.yaml:2: 'profile' is 'bang', must be box, half_sine or "
            "impulse");
  EXPECT_EQ(Complaint("plant: {kind: mars}\n"),
            "trial.yaml:1: 'kind' is 'mars', must be bullet or mujoco");
  EXPECT_EQ(Complaint("control: {inscribed: 3}\n"),
            "trial.yaml:1: 'inscribed' is '3', must be true or false");
  EXPECT_EQ(Complaint("start: 3\n"),
            "trial.yaml:1: 'start' is '3', must be a map");
  EXPECT_EQ(Complaint("- 3\n"), "trial.yaml:1: is a list, must be a map");
  for (const char* seed : {"-1", "0.5", "4294967296"}) {
    EXPECT_EQ(Complaint(std::string("seed: ") + seed + "\n"),
              std::string("trial.yaml:1: 'seed' is '") + seed +
                  "', must be a whole number from 0 to 2^32 - 1");
  }
  EXPECT_EQ(Complaint("seed: 4294967295\n"), "none");
}

TEST(Scenario, ReportsAnErrorOnOneLine) {
  EXPECT_EQ(Complaint("seed: \"1\\n2\"\n"),
            "trial.yaml:1: 'seed' is '1 2', must be a number");
}

TEST(Scenario, RejectsAStanceEventWithoutAnAction) {
  EXPECT_EQ(Complaint("stance:\n  - {at: 3}\n"),
            "trial.yaml:2: 'at' is '3', must come with lift, put_down, shift "
            "or step");
  EXPECT_EQ(Complaint("stance: [{height: 0.3}]\n"),
            "trial.yaml:1: 'at' is missing, must come with lift, put_down, "
            "shift or step");
  EXPECT_NE(Complaint("stance: [{at: 3, shift: middle, over: 0}]\n"), "none");
  EXPECT_NE(Complaint("stance: [{at: 3, lift: a, height: -1}]\n"), "none");
}

TEST(Scenario, RejectsContradictoryStanceEntries) {
  EXPECT_EQ(Complaint("stance:\n"
                      "- {at: 1, lift: right_foot}\n"
                      "- {at: 0.5, put_down: right_foot}\n"),
            "trial.yaml: stance[1].at is 0.5, must be at least 1, the time of "
            "the entry before: entries must be in order of time");
  EXPECT_EQ(
      Complaint("stance:\n- {at: 1, shift: middle, lift: left_foot}\n"),
      "trial.yaml:2: 'lift' is 'left_foot', must not be in one entry with "
      "shift: write two entries");
  EXPECT_EQ(Complaint("stance:\n- {at: 1, shift: middle, put_down: a}\n"),
            "trial.yaml:2: 'put_down' is 'a', must not be in one entry with "
            "shift: write two entries");
  EXPECT_EQ(Complaint("stance: [{lift: a, put_down: b}]\n"),
            "trial.yaml:1: 'lift' is 'a', must not be in one entry with "
            "put_down: write two entries");
  EXPECT_EQ(Complaint("stance:\n- {at: 1, lift: a}\n- {at: 2, lift: b}\n"),
            "trial.yaml: stance[1].lift is 'b', must come after 'a' is put "
            "down: one foot is lifted at a time");
  EXPECT_EQ(Complaint("stance: [{at: 1, put_down: a}]\n"),
            "trial.yaml: stance[0].put_down is 'a', must be a foot that is "
            "lifted");
  EXPECT_EQ(Complaint("stance:\n"
                      "- {at: 1, lift: a}\n- {at: 1, put_down: a}\n"
                      "- {at: 1, shift: b}\n- {at: 2, lift: b}\n"),
            "none");
}

// The name becomes the name of a folder and a string in JSON.
TEST(Scenario, RejectsNamesThatAreNotFileNames) {
  const std::string wanted =
      "', must be the name of a file, in UTF-8, of at most 100 bytes";
  for (const char* name : {".", "..", "../a", "/tmp", "a\\b"}) {
    EXPECT_EQ(Complaint("name: " + std::string(name) + "\n"),
              "trial.yaml:1: 'name' is '" + std::string(name) + wanted);
  }
  EXPECT_EQ(Complaint("name: \xe9\n"), "trial.yaml:1: 'name' is '?" + wanted);
  EXPECT_EQ(Complaint("name: \"a\\nb\"\n"),
            "trial.yaml:1: 'name' is 'a b" + wanted);
  EXPECT_EQ(Complaint("name: \"\"\n"), "trial.yaml:1: 'name' is '" + wanted);
  EXPECT_EQ(
      Complaint("name: " + std::string(300'000, 'a') + "\n"),
      "trial.yaml:1: 'name' is '" + std::string(60, 'a') + "..." + wanted);
  EXPECT_EQ(Complaint("name: h\xc3\xa9..b\n"), "none");
  EXPECT_LT(Complaint(std::string(300'000, 'a') + ": 1\n").size(), 300u);
}

// Each text has a number that would overflow, hang or use up the memory.
TEST(Scenario, RejectsNumbersOutOfRangeWithTheirLine) {
  EXPECT_EQ(Complaint("\nduration: -1\n"),
            "trial.yaml:2: 'duration' is '-1', must be 0.001 to 86400 s");
  EXPECT_EQ(Complaint("plant: {rate: 1e9}\n"),
            "trial.yaml:1: 'rate' is '1e9', must be 10 to 100000 Hz");
  EXPECT_EQ(Complaint("pushes:\n- force: [0, 1e300, 0]\n"),
            "trial.yaml:2: 'force' is a list, must be -1e+06 to 1e+06 N");
  for (const char* text :
       {"duration: 1e6",
        "start: {joints: -1}",
        "start: {joints: 4}",
        "start: {drop: 11}",
        "start: {heading: 1e9}",
        "pushes: [{moment: [0, 0, 1e9]}]",
        "pushes: [{at: -1}]",
        "pushes: [{duration: -1}]",
        "pushes: [{duration: 1e9}]",
        "pushes: [{point: [0, 0, 101]}]",
        "com: {sine: [0, 0, 11]}",
        "com: {cosine: [-11, 0, 0]}",
        "com: {period: 0}",
        "stance: [{at: -1, lift: a}]",
        "stance: [{at: 1, lift: a, height: 2}]",
        "stance: [{at: 1, lift: a, height: 0}]",
        "stance: [{at: 1, shift: a, over: 0}]",
        "control: {rate: 0}",
        "control: {rate: 1e9}",
        "control: {delay: -0.001}",
        "control: {delay: 2}",
        "control: {friction: 11}",
        "control: {mass_error: -1}",
        "control: {mass_error: 11}",
        "control: {ramp: -0.1}",
        "control: {ramp: 101}",
        "plant: {rate: 1}",
        "plant: {friction: -1}",
        "plant: {friction: 1e9}",
        "plant: {restitution: 2}",
        "plant: {torque_scale: -1}",
        "plant: {torque_scale: 0}",
        "plant: {roll: -2}",
        "plant: {pitch: 2}",
        "plant: {boards: [{size: [1, 1, 0]}]}",
        "plant: {boards: [{size: [1, 1, 1], center: [0, 0, 1e4]}]}",
        "plant: {boards: [{size: [1, 1, 1], yaw: 11}]}",
        "sensors: {noise: -1}",
        "sensors: {noise: 1e9}",
        "sensors: {bias: 1e9}",
        "sensors: {resolution: 1e9}",
        "sensors: {base_position: 11}",
        "sensors: {base_velocity: 1e9}",
        "sensors: {joint_delay: 2}",
        "sensors: {base_delay: -1}",
        "sensors: {foot_delay: 2}",
        "sensors: {dropout: 2}",
        "sensors: {joint_position: 11}",
        "sensors: {joint_velocity: 1e9}",
        "sensors: {base_orientation: 11}",
        "sensors: {base_rate: 1e9}",
        "sensors: {foot_force: 1e9}",
        "sensors: {foot_moment: 1e9}",
        "sensors: {accelerometer: 1e9}",
        "sensors: {gyroscope: 1e9}",
        "sensors: {joint_bias: 11}",
        "sensors: {gyroscope_bias: 1e9}",
        "sensors: {force_bias: 1e9}",
        "sensors: {joint_resolution: 11}",
        "sensors: {force_resolution: 1e9}",
        "sensors: {contact_threshold: 1e9}"}) {
    const std::string complaint = Complaint(text);
    EXPECT_EQ(complaint.rfind("trial.yaml:1: '", 0), 0u) << complaint;
    EXPECT_NE(complaint.find(", must be "), std::string::npos) << complaint;
  }
}

TEST(Scenario, RejectsIncompatibleNumbers) {
  const auto whole_part = [](const std::string& rate) {
    return "trial.yaml: control.rate is " + rate +
           ", must evenly divide plant.rate, which is 1000";
  };
  EXPECT_EQ(Complaint("control: {rate: 300}\n"), whole_part("300"));
  EXPECT_EQ(Complaint("control: {rate: 2000}\n"), whole_part("2000"));
  EXPECT_EQ(Complaint("control: {rate: 250}\n"), "none");
  const std::string times =
      "trial.yaml: control.rate is 10, must be at least a thousandth of "
      "plant.rate, which is 20000";
  EXPECT_EQ(Complaint("{control: {rate: 10}, plant: {rate: 10000}}"), "none");
  EXPECT_EQ(Complaint("{control: {rate: 10}, plant: {rate: 20000}}"), times);
  EXPECT_EQ(Complaint("control: {delay: 0.0015}\n"),
            "trial.yaml: control.delay is 0.0015, must be a multiple of the "
            "plant's step");
  EXPECT_EQ(Complaint("{duration: 10000, control: {rate: 100000}, "
                      "plant: {rate: 100000}}"),
            "trial.yaml: duration is 10000, must be at most 1e8 control "
            "ticks");
}

TEST(Scenario, ValidatesChangedSettings) {
  const auto complaint = [](auto change) -> std::string {
    Scenario scenario;
    scenario.pushes.resize(1);
    scenario.stance.resize(1);
    change(&scenario);
    try {
      Validate(scenario);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint([](Scenario*) {}), "none");
  EXPECT_EQ(complaint([](Scenario* s) { s->plant.dt = 1e-9; }),
            "plant.rate is 1e+09, must be 10 to 100000 Hz");
  EXPECT_EQ(complaint([](Scenario* s) { s->control.dt = 1 / 0.0; }),
            "control.rate is 0, must be 10 to 100000 Hz");
  EXPECT_EQ(complaint([](Scenario* s) { s->duration = NAN; }),
            "duration is nan, must be 0.001 to 86400 s");
  EXPECT_EQ(complaint([](Scenario* s) { s->start.drop = -1; }),
            "start.drop is -1, must be 0 to 10 m");
  EXPECT_EQ(complaint([](Scenario* s) { s->com.period = 0; }),
            "com.period is 0, must be 0.01 to 86400 s");
  EXPECT_EQ(complaint([](Scenario* s) { s->sensors.noise = 1e9; }),
            "sensors.noise is 1e+09, must be 0 to 1000");
  EXPECT_EQ(complaint([](Scenario* s) { s->pushes[0].force.y() = 1e9; }),
            "pushes[0].force is 1e+09, must be -1e+06 to 1e+06 N");
  EXPECT_EQ(complaint([](Scenario* s) { s->stance[0].at = -1; }),
            "stance[0].at is -1, must be 0 to 86400 s");
  EXPECT_EQ(complaint([](Scenario* s) { s->pushes.resize(1001); }),
            "pushes has 1001 entries, must have at most 1000");
  EXPECT_EQ(complaint([](Scenario* s) { s->stance.resize(1001); }),
            "stance has 1001 entries, must have at most 1000");
  EXPECT_EQ(complaint([](Scenario* s) {
              s->plant.ground.boards.resize(
                  101, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()});
            }),
            "plant.boards has 101 entries, must have at most 100");
}

TEST(Scenario, RejectsInvalidYamlWithItsLine) {
  EXPECT_EQ(Complaint("a: 1\nb: [1,\n").substr(0, 11), "trial.yaml:");
  EXPECT_THROW(LoadScenario("nowhere.yaml"), std::invalid_argument);
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
