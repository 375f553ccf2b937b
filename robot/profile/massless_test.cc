// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/massless.h"

#include <gtest/gtest.h>

#include <string>

#include "poise/robot/profile/profile.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

// Returns a link. With a radius of gyration of 0, its mass is one point.
std::string Link(const std::string& name, double mass, double radius = 0.1,
                 const std::string& center = "0 0 0") {
  if (mass == 0) return "<link name='" + name + "'/>";
  const std::string I = std::to_string(mass * radius * radius);
  return "<link name='" + name + "'><inertial><origin xyz='" + center +
         "'/><mass value='" + std::to_string(mass) + "'/><inertia ixx='" + I +
         "' ixy='0' ixz='0' iyy='" + I + "' iyz='0' izz='" + I +
         "'/></inertial></link>";
}

// Returns a link without mass, or with less than any part has, but with
// inertia.
std::string Dummy(const std::string& name, const std::string& mass,
                  const std::string& I) {
  return "<link name='" + name + "'><inertial><mass value='" + mass +
         "'/><inertia ixx='" + I + "' ixy='0' ixz='0' iyy='" + I +
         "' iyz='0' izz='" + I + "'/></inertial></link>";
}

// Returns a joint with the name of its child link and a '.'.
std::string Joint(const std::string& parent, const std::string& child,
                  const std::string& axis, const std::string& mimic = "") {
  return "<joint name='" + child +
         ".' type='revolute'><origin xyz='0 0 0.2'/>"
         "<parent link='" +
         parent + "'/><child link='" + child + "'/><axis xyz='" + axis + "'/>" +
         (mimic.empty()
              ? ""
              : "<mimic joint='" + mimic + ".' multiplier='2' offset='0.1'/>") +
         "<limit lower='-1' upper='1' effort='9' velocity='9'/></joint>";
}

// An arm on a base. The fingers `f1` and `f2` have no mass. The joint of `f1`
// leads those of `f2`, of `thumb`, which weighs 0.1 % of the robot, and of
// `leg`, which weighs 10 %.
std::string ArmText() {
  return "<robot name='r'>" + Link("base", 8.99) + Link("arm", 1) +
         Link("f1", 0) + Link("f2", 0) + Link("thumb", 0.01) +
         Link("leg", 1.1) + Joint("base", "arm", "0 1 0") +
         Joint("arm", "f1", "0 1 0") + Joint("f1", "f2", "0 1 0", "f1") +
         Joint("arm", "thumb", "0 1 0", "f1") +
         Joint("base", "leg", "1 0 0", "f1") + "</robot>";
}

using Names = std::vector<std::string>;

TEST(JointsWithoutMass, AreLockedWithTheirLightFollowers) {
  const UrdfDocument urdf(ArmText(), "arm.urdf");
  const RobotModel whole = urdf.MakeModel();
  for (const MimicPolicy policy :
       {MimicPolicy::kFree, MimicPolicy::kCoupled, MimicPolicy::kLocked}) {
    Profile profile;
    profile.mimic = policy;
    profile.joints["f1."] = {0.3, 1};
    const auto locked = LockedJoints(whole, profile);
    EXPECT_EQ(locked.at("f1.").value, 0.3);
    EXPECT_EQ(locked.at("f2.").value, 2 * 0.3 + 0.1);
    EXPECT_EQ(locked.at("thumb.").value, 2 * 0.3 + 0.1);
    EXPECT_EQ(locked.count("leg."), policy == MimicPolicy::kLocked);
    EXPECT_EQ(locked.count("arm."), 0u);
    const RobotModel model = MakeModel(urdf, profile);
    EXPECT_TRUE(model.mimics.empty());
    EXPECT_EQ(model.tree.num_joints(), 5 - static_cast<int>(locked.size()));
    EXPECT_NEAR(model.tree.total_mass(), 11.1, 1e-12);
    // The profile locks all mimic joints if its policy is kLocked.
    EXPECT_EQ(JointsWithoutMass(whole, profile),
              policy == MimicPolicy::kLocked ? Names{"f1."}
                                             : (Names{"f1.", "f2.", "thumb."}));
  }
}

TEST(JointsWithoutMass, LeaveOutJointsOfTheProfile) {
  const RobotModel whole = ParseUrdf(ArmText(), "arm.urdf");
  Profile profile;
  for (const char* name : {"f1.", "f2.", "thumb."}) {
    profile.locked[name] = {0, 1};
  }
  EXPECT_EQ(JointsWithoutMass(whole, profile), Names{});
  EXPECT_EQ(LockedJoints(whole, profile).size(), 3u);
}

Names MasslessOf(const std::string& text) {
  return JointsWithoutMass(
      ParseUrdf("<robot name='r'>" + text + "</robot>", "r.urdf"), {});
}

TEST(FindMovedMass, FindsPointMassOnTheAxis) {
  // A point on the axis has no inertia about the axis; a point beside it has.
  const std::string base = Link("base", 5);
  const std::string joint = Joint("base", "a", "0 0 1");
  EXPECT_EQ(MasslessOf(base + Link("a", 1, 0, "0 0 0.3") + joint), Names{"a."});
  EXPECT_EQ(MasslessOf(base + Link("a", 1, 0, "0.01 0 0.3") + joint), Names{});
  // At rest, the point is on the axis of joint `a`, but not elsewhere.
  EXPECT_EQ(MasslessOf(base + Link("a", 0) + Link("b", 1, 0.1, "0 0 0.3") +
                       joint + Joint("a", "b", "0 1 0")),
            Names{});
}

TEST(FindMovedMass, FindsBaseWithoutMass) {
  // A base without mass that carries one joint moves freely about it.
  EXPECT_EQ(
      MasslessOf(Link("base", 0) + Link("a", 1) + Joint("base", "a", "0 1 0")),
      Names{"a."});
  EXPECT_EQ(
      MasslessOf(Link("base", 0) + Link("a", 1) + Link("b", 1) +
                 Joint("base", "a", "0 1 0") + Joint("base", "b", "1 0 0")),
      Names{});
}

// A camera turns about x, z and x again, and the links between have no mass. At
// rest, the first and the last joint are the same motion, so M is singular.
TEST(FindMovedMass, FindsAJointWhoseMotionOthersMake) {
  const auto spindle = [](double m1, double m2, const std::string& last) {
    std::string text = Link("base", 5) + Link("a", m1) + Link("b", m2) +
                       Link("camera", 0.1, 0.1, "0.01 0.02 0.03") +
                       Joint("base", "a", "1 0 0") + Joint("a", "b", "0 0 1") +
                       Joint("b", "camera", last);
    // All three axes meet at one point.
    for (const char* place :
         {"0 0 0.2'/><parent link='a'", "0 0 0.2'/><parent link='b'"}) {
      text.replace(text.find(place), 7, "0 0 0.0");
    }
    return text;
  };
  EXPECT_EQ(MasslessOf(spindle(0, 0, "1 0 0")), Names{"camera."});
  EXPECT_EQ(MasslessOf(spindle(0, 0, "0 1 0")), Names{});
  EXPECT_EQ(MasslessOf(spindle(0.1, 0, "1 0 0")), Names{});
  EXPECT_EQ(MasslessOf(spindle(0, 0.1, "1 0 0")), Names{});
  // A base without mass may be a pelvis, and these joints its hips.
  EXPECT_EQ(
      MasslessOf(Link("base", 0) + Link("a", 1) + Link("b", 1) +
                 Joint("base", "a", "1 0 0") + Joint("base", "b", "1 0 0")),
      Names{});
}

// The robot weighs 5 kg. A link of 1e-12 kg is lighter than 1e-10 of it; a link
// of 1e-8 kg is not.
TEST(FindMovedMass, CountsInertiaWithoutMassAsNothing) {
  const std::string base = Link("base", 5);
  const std::string joint = Joint("base", "a", "0 1 0");
  std::string slide = joint;
  slide.replace(slide.find("revolute"), 8, "prismatic");
  for (const char* mass : {"0", "1e-12", "1e-300"}) {
    for (const char* inertia : {"0.01", "1e-16", "0"}) {
      SCOPED_TRACE(std::string(mass) + " kg, " + inertia + " kg m2");
      const std::string dummy = Dummy("a", mass, inertia);
      EXPECT_EQ(MasslessOf(base + dummy + joint), Names{"a."});
      EXPECT_EQ(MasslessOf(base + dummy + slide), Names{"a."});
      EXPECT_EQ(MasslessOf(base + dummy + Dummy("b", "0", "1") + joint +
                           Joint("a", "b", "1 0 0")),
                (Names{"a.", "b."}));
    }
  }
  EXPECT_EQ(MasslessOf(base + Dummy("a", "1e-8", "1e-12") + joint), Names{});
}

TEST(MakeModel, AddsInertiaWithoutMassToTheParent) {
  const UrdfDocument urdf("<robot name='r'>" + Link("base", 5) +
                              Dummy("a", "0", "0.25") +
                              Joint("base", "a", "0 1 0") + "</robot>",
                          "r.urdf");
  const Tree tree = MakeModel(urdf, {}).tree;
  ASSERT_EQ(tree.num_joints(), 0);
  EXPECT_EQ(tree.total_mass(), 5);
  // The base has 5 kg with a radius of gyration of 0.1 m.
  EXPECT_DOUBLE_EQ(tree.inertias()[0].I_G_B(1, 1), 0.05 + 0.25);
}

TEST(FindMovedMass, WorksAbove500Joints) {
  std::string text = Link("0", 1);
  for (int i = 1; i <= 501; ++i) {
    const std::string name = std::to_string(i);
    text += Link(name, i < 501 ? 1 : 0) +
            Joint(std::to_string(i - 1), name, "0 1 0");
  }
  EXPECT_EQ(MasslessOf(text), Names{"501."});
}

TEST(MakeModel, GivesMassToLinksBetweenJoints) {
  const UrdfDocument urdf("<robot name='r'>" + Link("base", 9) +
                              Link("cross", 0) + Link("a", 1) +
                              Joint("base", "cross", "0 1 0") +
                              Joint("cross", "a", "1 0 0") + "</robot>",
                          "r.urdf");
  const auto small = MakeSmallInertias(urdf.MakeModel());
  ASSERT_EQ(small.size(), 1u);
  // The farthest joint is 0.4 m above the base.
  EXPECT_DOUBLE_EQ(small.at("cross").mass, 1e-6 * 10);
  EXPECT_DOUBLE_EQ(small.at("cross").I_G_B(1, 1), 1e-5 * 4e-3 * 4e-3);
  const Tree tree = MakeModel(urdf, {}).tree;
  EXPECT_EQ(tree.num_joints(), 2);
  EXPECT_EQ(tree.inertias()[1].mass, 1e-6 * 10);
  EXPECT_EQ(tree.inertias()[2].mass, 1);
}

// Returns a robot that turns a mass about z and then about an axis through the
// same point. At rest, the mass is on the z axis, 0.2 m away.
std::string PanTilt(double radius) {
  return "<robot name='r'>" + Link("base", 9) + Link("pan", 0) +
         Link("tilt", 0) + Link("camera", 1, radius) +
         Joint("base", "pan", "0 0 1") + Joint("pan", "tilt", "0 1 0") +
         "<joint name='rod' type='fixed'><origin xyz='0 0 0.2'/>"
         "<parent link='tilt'/><child link='camera'/></joint></robot>";
}

TEST(MakeModel, GivesInertiaToPointMassThatMakesMSingular) {
  const UrdfDocument urdf(PanTilt(0), "r.urdf");
  const RobotModel whole = urdf.MakeModel();
  EXPECT_EQ(JointsWithoutMass(whole, {}), Names{});
  // The farthest joint is 0.4 m above the base.
  const auto point = MakePointInertias(whole);
  ASSERT_EQ(point.size(), 1u);
  EXPECT_EQ(point.at("tilt").mass, 0);
  EXPECT_DOUBLE_EQ(point.at("tilt").I_G_B(2, 2), 4e-3 * 4e-3);
  const Tree tree = MakeModel(urdf, {}).tree;
  ASSERT_EQ(tree.num_joints(), 2);
  EXPECT_EQ(tree.inertias()[1].mass, 1e-6 * 10);
  EXPECT_EQ(tree.inertias()[2].mass, 1);
  EXPECT_NEAR(tree.inertias()[2].I_G_B(2, 2), 4e-3 * 4e-3, 1e-18);
}

TEST(MakePointInertias, LeavesRegularMassMatrix) {
  EXPECT_TRUE(MakePointInertias(ParseUrdf(PanTilt(0.1), "r.urdf")).empty());
  // A pendulum with its mass in one point has a regular M.
  EXPECT_TRUE(MakePointInertias(ParseUrdf("<robot name='r'>" + Link("base", 9) +
                                              Link("bob", 1, 0, "0 0 -0.2") +
                                              Joint("base", "bob", "0 1 0") +
                                              "</robot>",
                                          "r.urdf"))
                  .empty());
}

TEST(MakeSmallInertias, LeavesSingularMassMatrix) {
  // Both joints turn about the same axis.
  EXPECT_TRUE(
      MakeSmallInertias(ParseUrdf("<robot name='r'>" + Link("base", 9) +
                                      Link("cross", 0) + Link("a", 1) +
                                      Joint("base", "cross", "0 0 1") +
                                      Joint("cross", "a", "0 0 1") + "</robot>",
                                  "r.urdf"))
          .empty());
}

TEST(WarnOfMassless, CountsJointsAndNamesThree) {
  EXPECT_FALSE(WarnOfMassless({}).has_value());
  EXPECT_EQ(WarnOfMassless({"a"})->what,
            "has 1 joint that moves no mass of its own: 'a'");
  EXPECT_EQ(WarnOfMassless({"a", "b", "c", "d"})->what,
            "has 4 joints that move no mass of their own: 'a', 'b', 'c', ...");
}

}  // namespace
}  // namespace poise
