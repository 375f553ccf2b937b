// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile_reader.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include "poise/robot/profile/yaml_file.h"

namespace poise {
namespace {

const ProfileReader kReader{"f"};

std::string Refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

// Returns the message about the value of the key `a`, which is on line 2.
std::string RefusalOfNumber(const std::string& value) {
  const YAML::Node root = ParseYaml("b: 1\na: " + value + "\n", "f");
  return Refusal([&] { kReader.Number(root["a"], "a"); });
}

TEST(ProfileReader, ReadsEachFiniteNumberUpToItsBound) {
  for (const double x : {-1e6, -0.1, 0., 3e-300, 1e6}) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    EXPECT_EQ(kReader.Number(YAML::Load(text), "a"), x);
  }
  EXPECT_EQ(RefusalOfNumber("-1e6"), "accepted");
  EXPECT_EQ(RefusalOfNumber("-1.1e6"),
            "f:2: a is '-1.1e6', must be between -1e6 and 1e6");
  EXPECT_EQ(RefusalOfNumber("1.1e6"),
            "f:2: a is '1.1e6', must be between -1e6 and 1e6");
  for (const std::string bad : {"x", ".nan", "inf", "1 m"}) {
    EXPECT_EQ(RefusalOfNumber(bad),
              "f:2: a is '" + bad + "', must be a finite number");
  }
  EXPECT_EQ(RefusalOfNumber("[1]"),
            "f:2: a is the list '[1]', must be a finite number");
}

TEST(ProfileReader, ReadsVectorsInTheirOrder) {
  const YAML::Node three = ParseYaml("a: [1, -2, 3]", "f")["a"];
  EXPECT_EQ(kReader.Numbers<3>(three, "a"), Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(Refusal([&] { kReader.Numbers<2>(three, "a"); }),
            "f:1: a is the list '[1, -2, 3]', must be 2 numbers");
}

TEST(ProfileReader, ReadsAnglesOfAtMostOneTurn) {
  const auto angles = [](const std::string& text) {
    return kReader.Angles(ParseYaml("a: " + text, "f")["a"], "a");
  };
  EXPECT_EQ(angles("[1, -6.3, 3]"), Eigen::Vector3d(1, -6.3, 3));
  for (const char* text : {"[0, 0, 90]", "[-90, 0, 0]"}) {
    EXPECT_EQ(
        Refusal([&] { angles(text); }),
        "f:1: a is more than one turn, must be in rad: is it in degrees?");
  }
}

TEST(ProfileReader, ReadsNamesOnly) {
  const YAML::Node root = ParseYaml("a: [1]\nb: ''\nc: foot\n", "f");
  EXPECT_EQ(kReader.Text(root["c"], "c"), "foot");
  EXPECT_EQ(Refusal([&] { kReader.Text(root["a"], "a"); }),
            "f:1: a is the list '[1]', must be a name");
  EXPECT_NE(Refusal([&] { kReader.Text(root["b"], "b"); }), "accepted");
}

TEST(ProfileReader, RefusesUnknownKeys) {
  const YAML::Node root = ParseYaml("a: 1\nc: 2\n", "f");
  kReader.ExpectMap(root, "thing", {"a", "b", "c"});
  kReader.ExpectMap(root, "thing", {});
  EXPECT_EQ(Refusal([&] {
              kReader.ExpectMap(root, "thing", {"a", "b"});
            }),
            "f:2: thing: unknown key 'c', must be one of a b");
  EXPECT_EQ(Refusal([&] { kReader.ExpectMap(root["a"], "thing", {}); }),
            "f:1: thing is '1', must be a map");
}

TEST(ProfileReader, ReadsJointsWithTheirLines) {
  const YAML::Node root = ParseYaml("a:\n  hip: 1\n  knee: -0.5\n", "f")["a"];
  const auto joints = kReader.Joints(root, "a");
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints.at("hip").value, 1);
  EXPECT_EQ(joints.at("hip").line, 2);
  EXPECT_EQ(joints.at("knee").value, -0.5);
  EXPECT_EQ(joints.at("knee").line, 3);
}

}  // namespace
}  // namespace poise
