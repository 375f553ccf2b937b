// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/feet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "poise/robot/feet/find_feet.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

// Tolerance on the results of LargestRectangle() for polygons of size 1, m.
constexpr double kPromised = 1e-7;

TEST(ConvexHull, IsCounterclockwiseWithoutPointsOnEdges) {
  const Points hull =
      ConvexHull({{0, 0}, {1, 0}, {0.5, 0}, {1, 1}, {0.4, 0.6}, {0, 1}});
  ASSERT_EQ(hull.size(), 4u);
  double twice_area = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d& a = hull[i];
    const Vector2d& b = hull[(i + 1) % 4];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_EQ(twice_area, 2);
}

TEST(ConvexHull, HasFewerThanThreeCornersForPointsOnALine) {
  EXPECT_LT(ConvexHull({{0, 0}, {1, 1}, {2, 2}}).size(), 3u);
  EXPECT_LT(ConvexHull({{1, 2}, {1, 2}}).size(), 3u);
}

TEST(IsConvex, RejectsNotchesAndCrossings) {
  EXPECT_TRUE(IsConvex({{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
  EXPECT_TRUE(IsConvex({{0, 1}, {2, 1}, {2, 0}, {0, 0}}));
  // One corner lies on an edge, and another occurs twice.
  EXPECT_TRUE(IsConvex({{0, 0}, {1, 1e-6}, {2, 0}, {2, 0}, {1, 1}}));
  EXPECT_FALSE(IsConvex({{0, 0}, {1, 0.1}, {2, 0}, {2, 1}, {0, 1}}));
  EXPECT_FALSE(IsConvex({{0, 0}, {2, 1}, {2, 0}, {0, 1}}));
  std::vector<Eigen::Vector2d> star;
  for (int i = 0; i < 5; ++i) {
    star.emplace_back(std::cos(0.8 * M_PI * i), std::sin(0.8 * M_PI * i));
  }
  EXPECT_FALSE(IsConvex(star));
}

TEST(LargestRectangle, ReturnsARectangleUnchanged) {
  const Rectangle r = LargestRectangle({{-1, -2}, {3, -2}, {3, 0}, {-1, 0}});
  EXPECT_LT((r.center - Vector2d(1, -1)).norm(), kPromised);
  EXPECT_LT((r.half_size - Vector2d(2, 1)).norm(), kPromised);
}

// A box that was rotated and rotated back has no side exactly along y. With an
// exact comparison, the result would be a quarter narrower, or empty.
TEST(LargestRectangle, ToleratesRoundingOfSidesAlongY) {
  for (const double e : {3e-17, 3e-16, 1e-15, 1e-13}) {
    const Rectangle r = LargestRectangle(
        {{-0.08 + e, -0.03}, {0.08, -0.03}, {0.08, 0.03}, {-0.08 - e, 0.03}});
    EXPECT_LT(r.center.norm(), kPromised);
    EXPECT_LT((r.half_size - Vector2d(0.08, 0.03)).norm(), kPromised);
  }
}

// The largest rectangle in a triangle has half its base and half its height.
TEST(LargestRectangle, CoversHalfOfATriangle) {
  const Rectangle r = LargestRectangle({{0, -1}, {1, 0}, {0, 1}});
  EXPECT_LT((r.half_size - Vector2d(0.25, 0.5)).norm(), kPromised);
  EXPECT_LT((r.center - Vector2d(0.25, 0)).norm(), kPromised);
}

// The trapezoid is 2 wide at x = 0 and 4 wide at x = 2. Its largest rectangle
// has its full length and is 2 wide.
TEST(LargestRectangle, HasTheFullLengthOfATrapezoid) {
  const Rectangle r = LargestRectangle({{0, -1}, {2, -2}, {2, 2}, {0, 1}});
  EXPECT_LT((r.half_size - Vector2d(1, 1)).norm(), kPromised);
}

TEST(LargestRectangle, IsASquareInACircle) {
  Points circle;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * M_PI * (i + 0.5) / 64;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  const Rectangle r = LargestRectangle(circle);
  EXPECT_NEAR(r.half_size.x(), std::sqrt(0.5), 2e-3);  // A 64-gon.
  EXPECT_NEAR(r.half_size.y(), std::sqrt(0.5), 2e-3);
}

// A robot with one link: a point mass of 1 kg.
const char kOneLink[] =
    "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia "
    "ixx='0' "
    "ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link></robot>";

// Returns the URDF of a biped. Each leg has six joints, of which the first
// `motors` have a motor, and ends in a foot with the given shapes. `foot_rpy`
// orients the foot's link, and `knee_range` is the limit of the knee. At rest
// the ankle is 1 m below the base.
std::string Biped(const std::string& shapes, const std::string& foot_rpy,
                  const std::string& knee_range = "lower='0' upper='2'",
                  int motors = 6) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial>";
  std::string text =
      "<robot name='biped'><link name='base'>" + inertial + "</link>";
  for (const std::string side : {"r", "l"}) {
    std::string parent = "base";
    for (int i = 1; i <= 6; ++i) {
      const std::string name = side + std::to_string(i);
      const bool is_knee = i == 4;
      const std::string axis = i == 1             ? "0 0 1"
                               : i == 2 || i == 6 ? "1 0 0"
                                                  : "0 1 0";
      const std::string y = side == "l" ? "0.1" : "-0.1";
      const std::string xyz = i == 1             ? "0 " + y + " 0"
                              : i == 4 || i == 5 ? "0 0 -0.5"
                                                 : "0 0 0";
      text += "<link name='" + name + "'>" + inertial + (i == 6 ? shapes : "") +
              "</link><joint name='j" + name +
              "' type='revolute'><origin xyz='" + xyz + "' rpy='" +
              (i == 6 ? foot_rpy : "0 0 0") + "'/><parent link='" + parent +
              "'/><child link='" + name + "'/><axis xyz='" + axis +
              "'/><limit " + (is_knee ? knee_range : "lower='-1' upper='1'") +
              " effort='" + (i <= motors ? "9" : "0") +
              "' velocity='9'/></joint>";
      parent = name;
    }
  }
  return text + "</robot>";
}

std::string Collision(const std::string& geometry, const std::string& xyz,
                      const std::string& rpy = "0 0 0") {
  return "<collision><origin xyz='" + xyz + "' rpy='" + rpy + "'/><geometry><" +
         geometry + "/></geometry></collision>";
}

std::vector<Foot> Find(const std::string& text,
                       std::vector<Finding>* findings = nullptr) {
  const RobotModel model = ParseUrdf(text, "biped");
  std::vector<Foot> feet = FindFeet(model, findings);
  EXPECT_EQ(feet.size(), 2u);
  EXPECT_EQ(feet[0].name, "left_foot");
  EXPECT_EQ(model.tree.frames()[feet[0].frame].name, "l6");
  EXPECT_EQ(model.tree.frames()[feet[1].frame].name, "r6");
  return feet;
}

std::string Refusal(const std::string& text) {
  try {
    FindFeet(ParseUrdf(text, "biped"));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "found";
}

TEST(FindFeet, FindsTheUndersideOfABox) {
  const auto feet = Find(
      Biped(Collision("box size='0.2 0.1 0.02'", "0.03 0 -0.04"), "0 0 0"));
  EXPECT_LT((feet[0].half_size - Vector2d(0.1, 0.05)).norm(), kPromised);
  EXPECT_LT((feet[0].X_BC.p - Eigen::Vector3d(0.03, 0, -0.05)).norm(),
            kPromised);
  EXPECT_LT((feet[0].X_BC.R - Eigen::Matrix3d::Identity()).norm(), kPromised);
}

TEST(FindFeet, FindsTheLowestPointsOfSpheres) {
  std::string shapes = Collision("sphere radius='0.01'", "0 0 0.03");
  for (const char* xyz : {"0.1 0.03 -0.02", "0.1 -0.03 -0.02",
                          "-0.05 0.02 -0.02", "-0.05 -0.02 -0.02"}) {
    shapes += Collision("sphere radius='0.01'", xyz);
  }
  const auto feet = Find(Biped(shapes, "0 0 0"));
  EXPECT_EQ(feet[0].polygon_C.size(), 4u);
  EXPECT_NEAR(feet[0].X_BC.p.z(), -0.03, kPromised);
  EXPECT_NEAR(feet[0].half_size.x(), 0.075, kPromised);
  EXPECT_NEAR(feet[0].half_size.y(), 0.02, kPromised);
}

// One sphere for collisions has no flat underside.
TEST(FindFeet, TakesTheVisualShapesIfTheCollisionShapesHaveNoSole) {
  const std::string sphere = Collision("sphere radius='0.02'", "0 0 -0.03");
  const auto visual = [](const std::string& size) {
    return "<visual><origin xyz='0.03 0 -0.04'/><geometry><box size='" + size +
           "'/></geometry></visual>";
  };
  std::vector<Finding> findings;
  const auto feet =
      Find(Biped(sphere + visual("0.2 0.1 0.02"), "0 0 0"), &findings);
  EXPECT_LT((feet[0].half_size - Vector2d(0.1, 0.05)).norm(), kPromised);
  EXPECT_NEAR(feet[0].X_BC.p.z(), -0.05, kPromised);
  EXPECT_TRUE(findings.empty());
  // A stub is no sole: the estimate stays, with its warning.
  Find(Biped(sphere + visual("0.03 0.03 0.02"), "0 0 0"), &findings);
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(findings[0].what.find("is estimated"), std::string::npos);
}

// The other shapes of a foot with a missing mesh may be much smaller than the
// foot, such as the decoration of an ankle.
TEST(FindFeet, WarnsOfASoleWithoutTheMeshOfTheFoot) {
  const std::string missing = Collision("mesh filename='no.stl'", "0 0 0");
  const std::string shape = Collision("box size='0.2 0.1 0.02'", "0.03 0 0");
  const auto seen = [](std::string collision) {
    for (size_t at; (at = collision.find("collision")) != std::string::npos;) {
      collision.replace(at, 9, "visual");
    }
    return collision;
  };
  const auto warning = [](const std::string& shapes) {
    std::vector<Finding> findings;
    Find(Biped(shapes, "0 0 0"), &findings);
    for (const Finding& finding : findings) {
      if (finding.why.find("no.stl") != std::string::npos) {
        return finding.where + " " + finding.what;
      }
    }
    return std::string("none");
  };
  const std::string expected =
      "sole of link 'l6' is 0.2 x 0.1 m without a mesh of the foot";
  EXPECT_EQ(warning(missing + shape), expected);
  EXPECT_EQ(warning(missing + seen(shape)), expected);
  EXPECT_EQ(warning(seen(missing + shape)), expected);
  const std::string sphere = Collision("sphere radius='0.02'", "0 0 -0.03");
  EXPECT_EQ(warning(sphere + seen(missing + shape)), expected);
  EXPECT_EQ(warning(sphere + missing + seen(shape)), expected);
  // The visual shapes are not used, so none is missed.
  EXPECT_EQ(warning(shape + seen(missing)), "none");
  // The estimate is for want of the mesh, not of a flat underside.
  EXPECT_NE(warning(sphere + seen(missing)).find("is estimated"),
            std::string::npos);
}

TEST(FindFeet, FindsTheEndOfACylinder) {
  const auto feet = Find(Biped(
      Collision("cylinder radius='0.1' length='0.04'", "0 0 -0.02"), "0 0 0"));
  EXPECT_EQ(feet[0].polygon_C.size(), 16u);
  EXPECT_NEAR(feet[0].X_BC.p.z(), -0.04, kPromised);
}

// The z axis of this foot's link points down, as in some robots. The z axis of
// the contact frame still points up.
TEST(FindFeet, PointsTheContactFrameOutOfTheGround) {
  const auto feet =
      Find(Biped(Collision("box size='0.2 0.1 0.02'", "0.03 0 0.04"),
                 "3.14159265358979 0 0"));
  EXPECT_LT((feet[0].X_BC.R.col(2) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((feet[0].X_BC.R.col(0) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(feet[0].X_BC.p.z(), 0.05, kPromised);
}

// A roll joint moves this foot, so the foot's origin may lie anywhere along the
// roll axis. Seen from this origin, the heel reaches further than the toes.
// Seen from the ankle it does not, so the toes do not contradict the names.
TEST(FindFeet, MeasuresTheToesFromTheAnkle) {
  std::string biped =
      Biped(Collision("box size='0.2 0.1 0.02'", "-0.02 0 -0.04"), "0 0 0");
  std::vector<Finding> findings;
  EXPECT_GT(Find(biped, &findings)[0].X_BC.R(0, 0), 0);
  EXPECT_EQ(findings.size(), 1u);
  for (const std::string side : {"l", "r"}) {
    const size_t at = biped.find("<joint name='j" + side + "6'");
    biped.replace(biped.find("'0 0 0'", at), 7, "'0.05 0 0'");
  }
  findings.clear();
  EXPECT_GT(Find(biped, &findings)[0].X_BC.R(0, 0), 0);
  EXPECT_TRUE(findings.empty());
}

TEST(FindFeet, EstimatesTheSoleOfAMesh) {
  std::vector<Finding> findings;
  const auto feet =
      Find(Biped(Collision("mesh filename='foot.stl'", "0 0 0"), "0 0 0"),
           &findings);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].severity, Severity::kWarn);
  EXPECT_EQ(findings[0].what,
            "is estimated as 0.22 x 0.085 m, 0.1 m below the ankle");
  EXPECT_LT((feet[0].half_size - Vector2d(0.11, 0.0425)).norm(), kPromised);
  EXPECT_LT((feet[0].X_BC.p - Eigen::Vector3d(0.04, 0, -0.1)).norm(),
            kPromised);
}

// The center of mass of the left foot lies beside its joint origin. The
// estimated sole is centered sideways below this center of mass.
TEST(FindFeet, EstimatesASoleBelowTheCenterOfMass) {
  std::string biped =
      Biped(Collision("mesh filename='foot.stl'", "0 0 0"), "0 0 0");
  const std::string foot = "<link name='l6'><inertial>";
  const size_t at = biped.find(foot) + foot.size();
  biped.insert(at, "<origin xyz='0.05 0.037 -0.03'/>");
  const auto feet = Find(biped);
  EXPECT_LT((feet[0].X_BC.p - Eigen::Vector3d(0.04, 0.037, -0.1)).norm(),
            kPromised);
  EXPECT_LT((feet[1].X_BC.p - Eigen::Vector3d(0.04, 0, -0.1)).norm(),
            kPromised);
}

// A link without shapes may be below the soles, but is not a foot.
TEST(FindFeet, IgnoresLinksWithoutShapes) {
  const std::string biped =
      Biped(Collision("box size='0.2 0.1 0.02'", "0.03 0 -0.04"), "0 0 0");
  const std::string fixed = "<joint name='f' type='fixed'>";
  const std::string footprint =
      "<link name='base_footprint'/>" + fixed +
      "<parent link='base'/><child link='base_footprint'/>"
      "<origin xyz='0 0 -1.1'/></joint></robot>";
  const std::string world = "<link name='world'/>" + fixed +
                            "<parent link='world'/><child link='base'/>"
                            "<origin xyz='0 0 1.5'/></joint></robot>";
  for (const std::string& added : {footprint, world}) {
    const auto feet = Find(biped.substr(0, biped.rfind("</robot>")) + added);
    EXPECT_NEAR(feet[0].X_BC.p.z(), -0.05, kPromised);
  }
}

TEST(FindFeet, ReportsWhyNoFeetAreFound) {
  EXPECT_EQ(Refusal(kOneLink),
            "robot 'r' has no two legs (no limb has two joints or more), must "
            "have two feet: give the feet in a profile");
  EXPECT_EQ(
      Refusal(
          Biped(Collision("box size='0.2 0.0008 0.02'", "0 0 -0.04"), "0 0 0")),
      "robot 'biped' has a sole under 1 mm wide or long, give the sole in "
      "a profile: link 'l6'");
}

TEST(FindFeet, NeedsFourMotorsAndWarnsBelowFive) {
  const std::string box = Collision("box size='0.2 0.1 0.02'", "0.03 0 -0.04");
  const std::string range = "lower='0' upper='2'";
  std::vector<Finding> findings;
  Find(Biped(box, "0 0 0", range, 5), &findings);
  EXPECT_TRUE(findings.empty());
  Find(Biped(box, "0 0 0", range, 4), &findings);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].severity, Severity::kWarn);
  EXPECT_EQ(findings[0].where.substr(0, 12), "leg of link ");
  EXPECT_EQ(findings[0].what, "has 4 motors");
  // Feet without shapes have estimated soles, and need as many motors.
  EXPECT_EQ(Refusal(Biped("", "0 0 0", range, 5)), "found");
  for (const std::string& shapes : {box, std::string()}) {
    EXPECT_EQ(Refusal(Biped(shapes, "0 0 0", range, 3)),
              "robot 'biped': leg of link 'r6' has 3 motors (joints with an "
              "effort above 0), must have at least 5, or 4 with a warning, to "
              "lay a sole flat: correct <limit effort=\"0\"> of joints 'jr6', "
              "'jr5', 'jr4'");
  }
}

// The leg is 1 m long.
TEST(FindFeet, WarnsOfASoleThatIsShortForTheLeg) {
  for (const char* length : {"0.099", "0.101"}) {
    std::vector<Finding> findings;
    Find(Biped(Collision("box size='" + std::string(length) + " 0.05 0.02'",
                         "0.01 0 -0.04"),
               "0 0 0"),
         &findings);
    EXPECT_EQ(findings.size(), length == std::string("0.099") ? 2u : 0u);
    if (findings.empty()) continue;
    EXPECT_EQ(findings[0].what,
              "is 0.099 m long, less than a tenth of the leg (1 m)");
  }
}

// The leg is 1 m long.
TEST(FindFeet, WarnsOfASoleThatIsLargerThanTheLeg) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"0.99 0.1", ""},
      {"1.01 0.1", "is 1.01 m long, longer than the leg (1 m)"},
      {"0.2 1.01", "is 1.01 m wide, more than the length of the leg (1 m)"}};
  for (const auto& [size, what] : cases) {
    std::vector<Finding> findings;
    Find(Biped(Collision("box size='" + size + " 0.02'", "0.01 0 -0.04"),
               "0 0 0"),
         &findings);
    ASSERT_EQ(findings.size(), what.empty() ? 0u : 2u) << size;
    for (const Finding& finding : findings) EXPECT_EQ(finding.what, what);
  }
}

TEST(FindFeet, SaysWhereTheSoleComesFrom) {
  EXPECT_EQ(
      Find(Biped(Collision("box size='0.2 0.1 0.02'", "0 0 -0.04"), "0 0 0"))[0]
          .source,
      SoleSource::kBox);
  EXPECT_EQ(Find(Biped("", "0 0 0"))[0].source, SoleSource::kGuess);
}

TEST(MakeFoot, RejectsASoleUnderOneMillimeter) {
  const RobotModel model = ParseUrdf(kOneLink, "r");
  EXPECT_FALSE(MakeFoot(model, "f", 0, {}, {{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_FALSE(
      MakeFoot(model, "f", 0, {}, {{0, 0}, {1, 0}, {1, 9e-4}, {0, 9e-4}}));
  EXPECT_TRUE(
      MakeFoot(model, "f", 0, {}, {{0, 0}, {1, 0}, {1, 2e-3}, {0, 2e-3}}));
}

TEST(MakeFoot, ReducesAPolygonTo64ExtremeCorners) {
  const RobotModel model = ParseUrdf(kOneLink, "r");
  std::vector<Vector2d> rim;
  for (int i = 0; i < 100'000; ++i) {
    rim.emplace_back(0.1 * std::cos(i), 0.1 * std::sin(i));
  }
  const Foot foot = MakeFoot(model, "f", 0, {}, rim).value();
  EXPECT_LE(foot.polygon_C.size(), 64u);
  EXPECT_GT(foot.polygon_C.size(), 60u);
  // The result is the square inside the circle, slightly reduced: a chord
  // between two of 64 corners is off the circle by 0.12 % of the radius.
  const double half = 0.1 * std::sqrt(0.5);
  for (const double side : {foot.half_size.x(), foot.half_size.y()}) {
    EXPECT_NEAR(side, half, 0.01 * half);
  }
  for (const Vector2d& corner : foot.polygon_C) {
    EXPECT_NEAR(corner.norm(), 0.1, 1e-4);
  }
}

}  // namespace
}  // namespace poise
