// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/legs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>
#include <stdexcept>

#include "poise/robot/feet/parts_fixture.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Eigen::Vector3d;

const char kBox[] = "box size='0.2 0.1 0.02'";
const std::string kSole = ShapeAt(kBox, {0.03, 0, -0.04});
const std::string kMesh = ShapeAt("mesh filename='foot.stl'", {0, 0, 0});

std::vector<Part> MakeLegs(const std::string& foot, bool words = false,
                           double length = 0.8) {
  return Joined({MakeLeg({"p_", {0, 0.1, 0}, length, foot, words}),
                 MakeLeg({"q_", {0, -0.1, 0}, length, foot, words})});
}

std::vector<Part> MakeArms(double shoulder, double length, bool words) {
  return Joined({MakeArm({"s_", {0, 0.3, shoulder}, length, kSole, words}),
                 MakeArm({"t_", {0, -0.3, shoulder}, length, kSole, words})});
}

// Returns the names of the feet of a robot.
std::set<std::string> FeetOf(const std::string& urdf,
                             std::vector<Finding>* findings = nullptr) {
  const RobotModel model = ParseUrdf(urdf, "test");
  const Legs legs = FindLegs(model, MakeOutlines(model), findings);
  return {LinkOf(model, legs.feet[0]), LinkOf(model, legs.feet[1])};
}

std::string Refusal(const std::string& urdf) {
  try {
    FeetOf(urdf);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "found";
}

using Names = std::set<std::string>;
const Names kFeet = {"p_f", "q_f"};

TEST(FindLegs, FindsTheEndsOfTwoLegs) {
  EXPECT_EQ(FeetOf(UrdfOf(MakeLegs(kSole))), kFeet);
  EXPECT_EQ(FeetOf(UrdfOf(MakeLegs(kMesh))), kFeet);
  EXPECT_EQ(FeetOf(UrdfOf(MakeLegs(""))), kFeet);
}

// The hands reach 0.4 m below the feet and end in boxes.
TEST(FindLegs, TellsHandsFromFeet) {
  const auto legs = MakeLegs(kMesh);
  EXPECT_EQ(FeetOf(UrdfOf(Joined({legs, MakeArms(0.4, 1.6, false)}))), kFeet);
  // Nothing but the names tells arms that begin at the hips.
  EXPECT_EQ(
      FeetOf(UrdfOf(Joined({MakeLegs(kMesh, true), MakeArms(0, 1.2, true)}))),
      Names({"p_foot", "q_foot"}));
}

TEST(FindLegs, RejectsATorsoWithArms) {
  for (const bool words : {false, true}) {
    const std::string message = Refusal(UrdfOf(MakeArms(0.5, 0.7, words)));
    EXPECT_NE(message.find(words ? "is an arm by its names"
                                 : "begins above the trunk's center of mass"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("must have two feet"), std::string::npos);
  }
}

// The arms hang down from the middle of the trunk, as legs do.
TEST(FindLegs, BelievesTheNamesOfArms) {
  EXPECT_EQ(Refusal(UrdfOf(MakeArms(0, 0.7, false))), "found");
  EXPECT_NE(Refusal(UrdfOf(MakeArms(0, 0.7, true)))
                .find("'s_shoulder' is an arm by its names"),
            std::string::npos);
}

// A cylinder along the shank ends 30 mm below the foot's origin. The foot has
// a mesh, so its own depth is unknown.
TEST(FindLegs, DoesNotTakeAKneeForAFoot) {
  auto parts = MakeLegs(kMesh);
  for (Part& part : parts) {
    if (part.link.back() != 'd') continue;
    part.shapes = ShapeAt("cylinder radius='0.03' length='0.4'", {0, 0, -0.23});
  }
  EXPECT_EQ(FeetOf(UrdfOf(parts)), kFeet);
}

// The root link's origin and its shape are at the ground, between the feet.
TEST(FindLegs, IgnoresTheOriginOfTheRootLink) {
  std::vector<Part> parts = MakeLegs(kSole);
  for (Part& part : parts) {
    if (part.parent == "trunk") part.xyz.z() += 0.85;
  }
  EXPECT_EQ(FeetOf(UrdfOf(parts, Eigen::Matrix3d::Identity(), {0, 0, 1.1},
                          ShapeAt(kBox, {0, 0, 0}))),
            kFeet);
}

// Exporters put the origin of the root link anywhere, for example on the ground
// of another scene.
TEST(FindLegs, DoesNotDependOnTheOriginOfTheRootLink) {
  for (const double z : {-3.0, 0.0, 3.0}) {
    EXPECT_EQ(FeetOf(UrdfOf(
                  Joined({MakeLeg({"p_", {0, 0.1, z}, 0.8, kSole, true}),
                          MakeLeg({"q_", {0, -0.1, z}, 0.8, kSole, true})}))),
              Names({"p_foot", "q_foot"}))
        << z;
  }
}

// The legs are 3 m long, and one foot is 0.1 m lower.
TEST(FindLegs, ComparesLevelsWithTheLengthOfTheLeg) {
  auto parts = MakeLegs(kSole, false, 3);
  parts.back().xyz.z() -= 0.1;
  EXPECT_EQ(FeetOf(UrdfOf(parts)), kFeet);
}

TEST(FindLegs, CountsTheLegsOfAQuadruped) {
  std::vector<std::vector<Part>> legs;
  for (const double x : {-0.3, 0.3}) {
    for (const double y : {-0.1, 0.1}) {
      legs.push_back(MakeLeg({"p" + std::to_string(legs.size()), {x, y, 0}}));
    }
  }
  EXPECT_EQ(Refusal(UrdfOf(Joined(legs))),
            "robot 'generated' reaches the ground with 4 bodies, must be two "
            "feet: quadrupeds are not supported; if only two bodies are feet, "
            "give them in a profile");
}

TEST(FindLegs, RejectsRobotsWithoutLegs) {
  EXPECT_EQ(Refusal(UrdfOf({})),
            "robot 'generated' has no two legs (no limb has two joints or "
            "more), must have two feet: give the feet in a profile");
  const std::string one = Refusal(UrdfOf(MakeLeg({"p_", {0, 0, 0}})));
  EXPECT_NE(one.find("'p_a' has no mirror image"), std::string::npos) << one;
  auto uneven = Joined(
      {MakeLeg({"p_", {0, 0.1, 0}, 0.8}), MakeLeg({"q_", {0, -0.1, 0}, 0.4})});
  const std::string message = Refusal(UrdfOf(uneven));
  EXPECT_NE(message.find("has another length"), std::string::npos) << message;
}

// Toes on a hinge in front of the foot are not the foot.
TEST(FindLegs, LeavesOutToes) {
  auto parts = MakeLegs(kSole);
  for (const std::string side : {"p_", "q_"}) {
    parts.push_back({side + "g",
                     side + "f",
                     {0.14, 0, -0.04},
                     {0, 1, 0},
                     0.2,
                     ShapeAt("box size='0.04 0.1 0.02'", {0.02, 0, 0})});
  }
  std::vector<Finding> findings;
  EXPECT_EQ(FeetOf(UrdfOf(parts), &findings), kFeet);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].where, "joint 'p_g_joint'");
  EXPECT_EQ(findings[0].what, "moves toes in front of foot 'p_f'");
  // A roll joint in front of the ankle moves the foot, not toes.
  parts = MakeLegs(kSole);
  for (Part& part : parts) {
    if (part.link.back() == 'f') part.xyz.x() = 0.1;
  }
  EXPECT_EQ(FeetOf(UrdfOf(parts)), kFeet);
}

// A light rod of the ankle's drive ends lower than the foot's origin. A link
// without mass and shape follows the foot.
TEST(FindLegs, SkipsRodsAndEmptyLinks) {
  std::vector<Part> parts;
  for (const Part& part : MakeLegs(kMesh)) {
    const std::string side = part.link.substr(0, 2);
    if (part.link.back() == 'e') {  // The rod precedes the ankle.
      parts.push_back(
          {side + "rod", side + "d", {-0.05, 0, -0.42}, {0, 1, 0}, 0.05});
    }
    parts.push_back(part);
    if (part.link.back() == 'f') {
      parts.push_back({side + "g", side + "f", {0, 0, -0.05}, {0, 1, 0}, 0});
    }
  }
  EXPECT_EQ(FeetOf(UrdfOf(parts)), kFeet);
}

// Two long rods on each shank drive the ankle. Each rod ends in a link of its
// own, where the loop was cut. So the shank branches as a trunk does.
TEST(FindLegs, FindsLegsThatBranch) {
  for (const bool words : {false, true}) {
    std::vector<Part> parts;
    for (const Part& part : MakeLegs(kSole, words)) {
      parts.push_back(part);
      const std::string side = part.link.substr(0, 2);
      if (part.link != side + (words ? "shank" : "d")) continue;
      for (const double y : {-0.03, 0.03}) {
        const std::string rod = side + (y > 0 ? "a_" : "b_") + "rod";
        parts.push_back({rod, part.link, {-0.04, y, -0.05}, {0, 1, 0}, 0.05});
        parts.push_back({rod + "_end", rod, {0, 0, -0.34}, {0, 1, 0}, 0.05});
      }
    }
    EXPECT_EQ(FeetOf(UrdfOf(Joined({parts, MakeArms(0.4, 0.6, words)}))),
              words ? Names({"p_foot", "q_foot"}) : kFeet);
  }
}

// The root link is turned in all 24 ways. The legs keep their place in the
// trunk, so the vertical in the root link turns along.
TEST(FindLegs, FindsTheVerticalOfATurnedRootLink) {
  const auto parts = Joined({MakeLegs(kSole), MakeArms(0.4, 0.6, false)});
  int turns = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (const double si : {-1, 1}) {
        for (const double sj : {-1, 1}) {
          if (i == j) continue;
          Eigen::Matrix3d R_RT;
          R_RT.col(0) = si * Vector3d::Unit(i);
          R_RT.col(2) = sj * Vector3d::Unit(j);
          R_RT.col(1) = R_RT.col(2).cross(R_RT.col(0));
          const RobotModel model = ParseUrdf(UrdfOf(parts, R_RT), "test");
          const Legs legs = FindLegs(model, MakeOutlines(model));
          EXPECT_EQ(legs.up_B, R_RT.col(2));
          EXPECT_NEAR(legs.length, 0.8, 1e-12);  // Rounding of a rotation.
          EXPECT_EQ(
              Names({LinkOf(model, legs.feet[0]), LinkOf(model, legs.feet[1])}),
              kFeet);
          ++turns;
        }
      }
    }
  }
  EXPECT_EQ(turns, 24);
}

TEST(FindLegsOf, FindsHipsAndVerticalOfGivenFeet) {
  const RobotModel model = ParseUrdf(UrdfOf(MakeArms(0.5, 0.7, true)), "test");
  const auto body = [&](const char* link) {
    return model.tree.frames()[*model.tree.FindFrame(link)].body;
  };
  const Legs legs = FindLegsOf(model, {body("s_hand"), body("t_hand")});
  EXPECT_EQ(LinkOf(model, legs.hips[0]), "s_shoulder");
  EXPECT_EQ(LinkOf(model, legs.hips[1]), "t_shoulder");
  EXPECT_EQ(legs.up_B, Vector3d::UnitZ());
  EXPECT_NEAR(legs.length, 0.7, 1e-12);
  EXPECT_THROW(FindLegsOf(model, {body("s_elbow"), body("s_hand")}),
               std::invalid_argument);
}

}  // namespace
}  // namespace poise
