// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/sole_profile.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <string>

#include "poise/robot/finding.h"

namespace poise {
namespace {

SoleProfile Read(const std::string& text) {
  return ReadSole(ProfileReader{"a.yaml"}, "left_foot", YAML::Load(text));
}

TEST(ReadSole, KeepsWhereTheSoleWasFound) {
  EXPECT_FALSE(Read("{frame: f, size: [0.2, 0.1]}").source.has_value());
  for (const SoleSource source :
       {SoleSource::kBox, SoleSource::kMesh, SoleSource::kGuess}) {
    EXPECT_EQ(Read(std::string("{frame: f, size: [0.2, 0.1], from: ") +
                   NameOf(source) + "}")
                  .source,
              source);
  }
  try {
    Read("{frame: f, size: [0.2, 0.1],\n from: ruler}");
    ADD_FAILURE();
  } catch (const Refusal& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "a.yaml:2: feet.left_foot.from is 'ruler', must be box, mesh "
                 "or guess");
  }
}

TEST(ReadSole, MakesARectangleAroundTheOrigin) {
  const SoleProfile sole = Read("{frame: f, xyz: [1, 2, 3], size: [0.2, 0.1]}");
  EXPECT_EQ(sole.X_FS.p, Eigen::Vector3d(1, 2, 3));
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : sole.sole_S) box.extend(corner);
  EXPECT_EQ(box.min(), Eigen::Vector2d(-0.1, -0.05));
  EXPECT_EQ(box.max(), Eigen::Vector2d(0.1, 0.05));
}

}  // namespace
}  // namespace poise
