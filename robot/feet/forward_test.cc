// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/forward.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/robot/feet/find_feet.h"
#include "poise/robot/feet/parts_fixture.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A biped whose first leg is at `first`, the second one opposite. The prefixes
// name the legs. The soles are 0.2 m long and centered `toes` in front of the
// ankles.
struct Case {
  std::string prefix = "p_", other = "q_";
  Vector3d first = {0, 0.1, 0};
  double toes = 0;
  double knee_lower = -1, knee_upper = 1;
};

struct Answer {
  std::string forward;  // The result of ForwardAxis().
  std::string left;     // Link of the left foot.
  std::string warning;  // About the forward direction.
  Vector3d x_B;         // The x axis of the left contact frame, in the foot.
};

// Expects that the contact frames point along an axis, up to the precision of
// the orientation at rest.
void ExpectAlong(const Vector3d& axis, const Answer& answer) {
  EXPECT_LT((answer.x_B - axis).norm(), 1e-7) << answer.x_B.transpose();
}

std::string TextOf(const Case& from) {
  const std::string sole =
      ShapeAt("box size='0.2 0.1 0.02'", {from.toes, 0, -0.04});
  auto parts = Joined({MakeLeg({from.prefix, from.first, 0.8, sole}),
                       MakeLeg({from.other, -from.first, 0.8, sole})});
  for (Part& part : parts) {
    if (part.link.back() != 'd') continue;
    part.lower = from.knee_lower;
    part.upper = from.knee_upper;
  }
  return UrdfOf(parts);
}

Answer AnswerOf(const std::string& urdf, const FeetHints& hints = {}) {
  std::vector<Finding> findings;
  Robot robot{ParseUrdf(urdf, "test"), {}, {}, false};
  robot.feet = FindFeet(robot.model, &findings, hints);
  Answer answer{ForwardAxis(robot),
                robot.model.tree.frames()[robot.feet[0].frame].name, "",
                robot.feet[0].X_BC.R.col(0)};
  for (const Finding& finding : findings) {
    if (finding.where != "forward direction") continue;
    answer.warning += finding.what + "; " + finding.why;
  }
  return answer;
}

Answer AnswerOf(const Case& from) { return AnswerOf(TextOf(from)); }

void ExpectIn(const std::string& text, const std::string& whole) {
  EXPECT_NE(whole.find(text), std::string::npos) << whole;
}

constexpr const char* kAlone =
    "by REP 103 alone: names, toes and knees do not tell; if the robot faces "
    "the other way, write 'forward: -x'";

TEST(FindFacing, FollowsRep103IfNothingElseDecides) {
  const Answer answer = AnswerOf(Case{});
  EXPECT_EQ(answer.forward, "+x");
  ExpectAlong(Vector3d::UnitX(), answer);
  EXPECT_EQ(answer.left, "p_f");
  ExpectIn(kAlone, answer.warning);
}

TEST(FindFacing, FollowsNamesAgainstRep103) {
  const Answer agreed = AnswerOf(Case{"l_", "r_"});
  EXPECT_EQ(agreed.forward, "+x");
  EXPECT_EQ(agreed.left, "l_f");
  EXPECT_EQ(agreed.warning, "");
  const Answer turned = AnswerOf(Case{"r_", "l_"});
  EXPECT_EQ(turned.forward, "-x");
  EXPECT_EQ(turned.left, "l_f");
  ExpectIn(
      "is taken as -x of link 'trunk', by the names of the legs, but "
      "REP 103 says +x; if the robot faces the other way, write "
      "'forward: +x'",
      turned.warning);
}

// The names of these links say nothing, those of the joints do.
TEST(FindFacing, FindsSidesInTheNamesOfJoints) {
  std::string urdf = TextOf(Case{});
  for (const auto& [from, to] :
       {std::pair("name='p_c_joint'", "name='right_c'"),
        std::pair("name='q_c_joint'", "name='left_c'")}) {
    urdf.replace(urdf.find(from), std::string(from).size(), to);
  }
  const Answer answer = AnswerOf(urdf);
  EXPECT_EQ(answer.left, "q_f");
  EXPECT_EQ(answer.forward, "-x");
}

TEST(FindFacing, IgnoresNamesThatContradictEachOther) {
  std::string urdf = TextOf(Case{"l_", "r_"});
  for (const auto& [from, to] :
       {std::pair("name='l_c_joint'", "name='right_c'"),
        std::pair("name='r_c_joint'", "name='left_c'")}) {
    urdf.replace(urdf.find(from), std::string(from).size(), to);
  }
  const Answer answer = AnswerOf(urdf);
  EXPECT_EQ(answer.forward, "+x");
  ExpectIn("by REP 103, but the names of left and right are mixed",
           answer.warning);
}

// The reaches of a sole of 0.2 m differ by twice the offset of its middle. The
// bound is 5 % of the length, so an offset of 5 mm.
TEST(FindFacing, FollowsToesOnlyIfTheyAreClear) {
  for (const double offset : {-0.0049, 0.0049, 0.0051, 0.03}) {
    const Answer answer = AnswerOf(Case{"p_", "q_", {0, 0.1, 0}, offset});
    EXPECT_EQ(answer.forward, "+x") << offset;
    ExpectAlong(Vector3d::UnitX(), answer);
    EXPECT_EQ(answer.left, "p_f");
    if (std::abs(offset) < 0.005) {
      ExpectIn(kAlone, answer.warning);
    } else {
      EXPECT_EQ(answer.warning, "") << offset;
    }
  }
  const Answer turned = AnswerOf(Case{"p_", "q_", {0, 0.1, 0}, -0.0051});
  EXPECT_EQ(turned.forward, "-x");
  EXPECT_EQ(turned.left, "q_f");
  ExpectAlong(-Vector3d::UnitX(), turned);
  ExpectIn("because the toes point there, but REP 103 says +x", turned.warning);
}

TEST(FindFacing, WarnsIfToesContradictNames) {
  const Answer answer = AnswerOf(Case{"l_", "r_", {0, 0.1, 0}, -0.03});
  EXPECT_EQ(answer.forward, "+x");
  EXPECT_EQ(answer.left, "l_f");
  ExpectIn("by the names of the legs, but the toes point to -x",
           answer.warning);
}

// A knee that bends backward has a positive range about -y.
TEST(FindFacing, FollowsKneesOnlyIfRep103DoesNotApply) {
  const Vector3d along_y(0, 0.1, 0), along_x(0.1, 0, 0);
  const Answer rounding =
      AnswerOf(Case{"p_", "q_", along_y, 0, -3.14159, 3.14158});
  EXPECT_EQ(rounding.forward, "+x");
  ExpectIn(kAlone, rounding.warning);
  const Answer bird = AnswerOf(Case{"p_", "q_", along_y, 0, -2, 0});
  EXPECT_EQ(bird.forward, "+x");
  ExpectIn("by REP 103, but the knees point to -x", bird.warning);
  const Answer named = AnswerOf(Case{"l_", "r_", along_y, 0, -2, 0});
  EXPECT_EQ(named.forward, "+x");
  EXPECT_EQ(named.warning, "");
  // The legs are apart along x. These knees turn about x.
  std::string urdf = TextOf(Case{"p_", "q_", along_x, 0, 0, 2});
  const Answer chance = AnswerOf(urdf);
  EXPECT_EQ(chance.forward, "+y");
  ExpectIn("by chance, nothing decides, but REP 103 says +x", chance.warning);
  for (const auto& [axis, forward] :
       {std::pair("1 0 0", "-y"), std::pair("-1 0 0", "+y")}) {
    std::string turned = urdf;
    for (const char* link : {"p_d", "q_d"}) {
      size_t at = turned.find(std::string("<child link='") + link);
      at = turned.find("xyz='", at) + 5;
      turned.replace(at, std::string("0 1 0").size(), axis);
    }
    const Answer answer = AnswerOf(turned);
    EXPECT_EQ(answer.forward, forward);
    ExpectAlong(AxisOfName(forward).value(), answer);
    EXPECT_EQ(answer.left, answer.forward == "+y" ? "q_f" : "p_f");
    ExpectIn("because the knees point there", answer.warning);
  }
}

// The legs are apart along x, and the knees turn about x in a symmetric range.
// At rest they are bent by 0.49 rad.
TEST(FindFacing, FollowsKneesThatAreBentAtRest) {
  for (const double side : {-1, 1}) {
    auto parts = Joined({MakeLeg({"p_", {0.1, 0, 0}, 0.8}),
                         MakeLeg({"q_", {-0.1, 0, 0}, 0.8})});
    for (Part& part : parts) {
      if (part.link.back() == 'd') {
        part.axis = Vector3d::UnitX();
        part.xyz.y() = 0.1 * side;
      }
      if (part.link.back() == 'e') part.xyz.y() = -0.1 * side;
    }
    const Answer answer = AnswerOf(UrdfOf(parts));
    EXPECT_EQ(answer.forward, side > 0 ? "+y" : "-y");
    ExpectAlong(side * Vector3d::UnitY(), answer);
    EXPECT_EQ(answer.left, side > 0 ? "q_f" : "p_f");
  }
}

TEST(FindFacing, FollowsNamesOfLegsThatAreApartAlongX) {
  const Answer answer = AnswerOf(Case{"l_", "r_", {0.1, 0, 0}});
  EXPECT_EQ(answer.forward, "-y");  // The cross product of left (x) and up.
  EXPECT_EQ(answer.left, "l_f");
  ExpectIn("REP 103 says +x", answer.warning);
}

// A robot whose root link is turned has the same soles in its feet, and the
// same left foot, as the robot with z up.
TEST(FindFacing, TurnsWithTheRootLink) {
  const std::string sole = ShapeAt("box size='0.2 0.1 0.02'", {0.03, 0, -0.04});
  const auto parts = Joined({MakeLeg({"l_", {0, 0.1, 0}, 0.8, sole}),
                             MakeLeg({"r_", {0, -0.1, 0}, 0.8, sole})});
  const RobotModel upright = ParseUrdf(UrdfOf(parts), "test");
  const std::vector<Foot> feet = FindFeet(upright);
  for (int i = 0; i < 3; ++i) {
    for (const double angle : {0.5 * M_PI, M_PI, 1.5 * M_PI}) {
      const Eigen::Matrix3d R_RT =
          Eigen::AngleAxisd(angle, Vector3d::Unit(i)).toRotationMatrix();
      Robot robot{ParseUrdf(UrdfOf(parts, R_RT), "test"), {}, {}, false};
      std::vector<Finding> findings;
      robot.feet = FindFeet(robot.model, &findings);
      EXPECT_EQ(ForwardAxis(robot), NameOfAxis(R_RT.col(0)));
      for (const int side : {0, 1}) {
        EXPECT_EQ(robot.feet[side].body, feet[side].body);
        // Rounding of rotations of a vector of 0.1 m.
        const Pose& X_BC = robot.feet[side].X_BC;
        EXPECT_LT((X_BC.R - feet[side].X_BC.R).norm(), 1e-12);
        EXPECT_LT((X_BC.p - feet[side].X_BC.p).norm(), 1e-9);
      }
      const bool z_is_up = i == 2;
      EXPECT_EQ(!findings.empty() && findings[0].where == "root link 'trunk'",
                !z_is_up);
    }
  }
}

TEST(FindFacing, FollowsHints) {
  FeetHints hints;
  hints.forward_B = -Vector3d::UnitX();
  const std::string urdf = TextOf(Case{"l_", "r_"});
  const Answer turned = AnswerOf(urdf, hints);
  EXPECT_EQ(turned.forward, "-x");
  EXPECT_EQ(turned.left, "r_f");
  EXPECT_EQ(turned.warning, "");
  hints.forward_B = Vector3d::UnitY();  // From foot to foot: no effect.
  EXPECT_EQ(AnswerOf(urdf, hints).forward, "+x");
  const RobotModel model = ParseUrdf(urdf, "test");
  const auto body = [&](const char* link) {
    return model.tree.frames()[*model.tree.FindFrame(link)].body;
  };
  hints.feet = {body("r_f"), body("l_f")};
  const Answer swapped = AnswerOf(urdf, hints);
  EXPECT_EQ(swapped.forward, "-x");
  EXPECT_EQ(swapped.left, "r_f");
  EXPECT_EQ(swapped.warning, "");
}

TEST(NameOfAxis, NamesAxesNearAVector) {
  EXPECT_EQ(NameOfAxis({2, 0.1, -0.1}), "+x");
  EXPECT_EQ(NameOfAxis({0, -1, 0}), "-y");
  EXPECT_EQ(NameOfAxis({1, -0.6, 0.3}), "+x");  // 0.59 rad off.
  EXPECT_EQ(NameOfAxis({1, 1, 0}), "");
  EXPECT_EQ(NameOfAxis({0, 0, 0}), "");
  for (const char* name : {"+x", "-x", "+y", "-y", "+z", "-z"}) {
    EXPECT_EQ(NameOfAxis(AxisOfName(name).value()), name);
  }
  EXPECT_FALSE(AxisOfName("x"));
  EXPECT_FALSE(AxisOfName(""));
}

}  // namespace
}  // namespace poise
