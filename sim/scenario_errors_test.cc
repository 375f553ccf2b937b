// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "poise/sim/scenario.h"
#include "poise/sim/scenario_fixture.h"
#include "poise/sim/yaml_fields.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

// A fraction of a bound needs a direction on the ground.
TEST(Scenario, RefusesAFractionWithoutAHorizontalForce) {
  for (const char* push :
       {"impulse_fraction: 0.4", "force: [0, 1, 2], elsewhere: 0.4",
        "force: [1, 0, 0], frame: link, impulse_fraction: 0.4",
        "force: [1, 0, 0], moment: [0, 0, 1], impulse_fraction: 0.4"}) {
    EXPECT_EQ(
        Complaint("pushes: [{" + std::string(push) + "}]"),
        "trial.yaml:1: a fraction of the bound must come with a horizontal "
        "force, without moment, in the frame world")
        << push;
  }
}

TEST(Scenario, RejectsABoardWithoutSizeWithItsLine) {
  EXPECT_EQ(Complaint("plant:\n  boards:\n    - {size: [1, 1, 1]}\n"
                      "    - {yaw: 1}\n"),
            "trial.yaml:4: 'size' is missing, must be a list of 3 numbers, m");
}

TEST(LineOf, FollowsKeysAndIndices) {
  const std::string file =
      TestFile("lines.yaml",
               "duration: 2\npushes:\n  - {at: 1}\n  - at: 2\n"
               "    link: nose\ntasks: {with: [zmp, cop,\n  nope]}\n")
          .string();
  EXPECT_EQ(LineOf(file, "duration"), 1);
  EXPECT_EQ(LineOf(file, "pushes[0]"), 3);
  EXPECT_EQ(LineOf(file, "pushes[1].link"), 5);
  EXPECT_EQ(LineOf(file, "tasks.with[2]"), 7);
  for (const std::string absent :
       {"plant", "plant.rate", "pushes[2].link", "pushes[0].link",
        "duration.link", "duration[0]", "tasks[0]", "tasks.with.set"}) {
    EXPECT_EQ(LineOf(file, absent), 0) << absent;
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
            "trial.yaml:2: 'force' is the list '[1, 2]', must be a list of 3 "
            "numbers");
  EXPECT_EQ(Complaint("pushes:\n - profile: bang\n"),
            "trial.yaml:2: 'profile' is 'bang', must be box, half_sine or "
            "impulse");
  EXPECT_EQ(Complaint("plant: {kind: mars}\n"),
            "trial.yaml:1: 'kind' is 'mars', must be bullet or mujoco");
  EXPECT_EQ(Complaint("control: {inscribed: 3}\n"),
            "trial.yaml:1: 'inscribed' is '3', must be true or false, or "
            "on or off");
  EXPECT_EQ(Complaint("start: 3\n"),
            "trial.yaml:1: 'start' is '3', must be a map");
  EXPECT_EQ(Complaint("- 3\n"),
            "trial.yaml:1: is the list '[3]', must be a map");
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

// A key that the action does not use would be ignored in silence.
TEST(Scenario, RejectsAKeyOfAnotherStanceAction) {
  EXPECT_EQ(Complaint("stance:\n- {at: 1, lift: a, over: 2}\n"),
            "trial.yaml:2: 'over' is '2', must come with shift only");
  EXPECT_EQ(Complaint("stance:\n- {at: 1, shift: a, height: 0.1}\n"),
            "trial.yaml:2: 'height' is '0.1', must come with lift only");
  for (const char* key : {"over: 2", "height: 0.1"}) {
    EXPECT_NE(Complaint(std::string("steps: on\nstance: [{at: 1, step: a, "
                                    "to: [0, 0], ") +
                        key + "}]\n"),
              "none")
        << key;
  }
}

TEST(Scenario, RejectsContradictoryStanceEntries) {
  EXPECT_EQ(
      Complaint("stance:\n"
                "- {at: 1, lift: right_foot}\n"
                "- {at: 0.5, put_down: right_foot}\n"),
      "trial.yaml:3: stance[1].at is 0.5, must be at least 1, the time of "
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
            "trial.yaml:3: stance[1].lift is 'b', must come after 'a' is put "
            "down: one foot is lifted at a time");
  EXPECT_EQ(Complaint("stance: [{at: 1, put_down: a}]\n"),
            "trial.yaml:1: stance[0].put_down is 'a', must be a foot that is "
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
            "trial.yaml:2: 'force' is the list '[0, 1e300, 0]', must be -1e+06 "
            "to 1e+06 N");
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
        "control: {budget_us: -1}",
        "control: {budget_us: 1e7}",
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
    return "trial.yaml:1: control.rate is " + rate +
           ", must evenly divide plant.rate, which is 1000";
  };
  EXPECT_EQ(Complaint("control: {rate: 300}\n"), whole_part("300"));
  EXPECT_EQ(Complaint("control: {rate: 2000}\n"), whole_part("2000"));
  EXPECT_EQ(Complaint("control: {rate: 250}\n"), "none");
  const std::string times =
      "trial.yaml:1: control.rate is 10, must be at least a thousandth of "
      "plant.rate, which is 20000";
  EXPECT_EQ(Complaint("{control: {rate: 10}, plant: {rate: 10000}}"), "none");
  EXPECT_EQ(Complaint("{control: {rate: 10}, plant: {rate: 20000}}"), times);
  EXPECT_EQ(Complaint("control: {delay: 0.0015}\n"),
            "trial.yaml:1: control.delay is 0.0015, must be a multiple of the "
            "plant's step");
  EXPECT_EQ(Complaint("{duration: 10000, control: {rate: 100000}, "
                      "plant: {rate: 100000}}"),
            "trial.yaml:1: duration is 10000, must be at most 1e8 control "
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

}  // namespace
}  // namespace poise
