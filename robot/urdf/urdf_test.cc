// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <stdexcept>
#include <string>

#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A valid robot with two links and a joint. The tests below change one part.
const char kGood[] = R"(<?xml version="1.0"?>
<robot name="test">
  <material name="red"><color rgba="1 0.5 0.25 1"/></material>
  <link name="a">
    <inertial>
      <origin xyz="0.1 0.2 0.3" rpy="0.1 -0.2 0.3"/>
      <mass value="2"/>
      <inertia ixx="0.02" ixy="0.001" ixz="0.002"
               iyy="0.03" iyz="0.003" izz="0.04"/>
    </inertial>
    <visual>
      <origin xyz="0 0 1"/>
      <geometry><box size="1 2 3"/></geometry>
      <material name="red"/>
    </visual>
    <visual><geometry><mesh filename="a.stl" scale="1 2 3"/></geometry></visual>
    <collision><geometry><sphere radius="0.5"/></geometry></collision>
  </link>
  <link name="b">
    <inertial>
      <mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
    <collision>
      <geometry><cylinder radius="0.5" length="2"/></geometry>
    </collision>
  </link>
  <joint name="j" type="revolute">
    <origin xyz="1 2 3" rpy="0.4 0.5 0.6"/>
    <parent link="a"/>
    <child link="b"/>
    <axis xyz="0 3 4"/>
    <limit lower="-1" upper="2" effort="10" velocity="5"/>
    <dynamics damping="0.5" friction="0.25"/>
  </joint>
</robot>
)";

// A point mass of 1 kg.
const char kPoint[] =
    "<inertial><mass value='1'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' "
    "iyz='0' izz='0'/></inertial>";

// Returns kGood with the first `old_text` replaced by `new_text`.
std::string With(const std::string& old_text, const std::string& new_text) {
  std::string text = kGood;
  const size_t at = text.find(old_text);
  if (at == std::string::npos) throw std::logic_error("not found: " + old_text);
  return text.replace(at, old_text.size(), new_text);
}

RobotModel Parse(const std::string& text,
                 std::vector<Finding>* findings = nullptr) {
  return ParseUrdf(text, "test.urdf", {}, findings);
}

// Returns the message with which a text is rejected.
std::string Rejection(const std::string& text) {
  try {
    Parse(text);
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "accepted";
}

// Returns the findings of one severity about a valid text. A | ends each
// finding.
std::string Findings(const std::string& text, Severity severity) {
  std::vector<Finding> findings;
  Parse(text, &findings);
  std::string all;
  for (const Finding& finding : findings) {
    if (finding.severity == severity) all += Message("", finding) + "|";
  }
  return all;
}

Eigen::Matrix3d RzRyRx(double roll, double pitch, double yaw) {
  Eigen::Matrix3d Rx, Ry, Rz;
  Rx << 1, 0, 0, 0, std::cos(roll), -std::sin(roll), 0, std::sin(roll),
      std::cos(roll);
  Ry << std::cos(pitch), 0, std::sin(pitch), 0, 1, 0, -std::sin(pitch), 0,
      std::cos(pitch);
  Rz << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0,
      1;
  return Rz * Ry * Rx;
}

TEST(LoadUrdf, ReadsJoints) {
  const RobotModel model = Parse(kGood);
  EXPECT_EQ(model.name, "test");
  ASSERT_EQ(model.tree.num_joints(), 1);
  EXPECT_TRUE(model.tree.is_floating());
  const Joint& joint = model.tree.joints()[0];
  EXPECT_EQ(joint.name, "j");
  EXPECT_EQ(joint.type, JointType::kRevolute);
  EXPECT_EQ(joint.parent, 0);
  EXPECT_LT((joint.X_PF.p - Eigen::Vector3d(1, 2, 3)).norm(), Rounding(4, 3));
  EXPECT_LT((joint.X_PF.R - RzRyRx(0.4, 0.5, 0.6)).norm(), Rounding(2, 9));
  EXPECT_LT((joint.axis_F - Eigen::Vector3d(0, 0.6, 0.8)).norm(),
            Rounding(1, 3));
}

TEST(LoadUrdf, ReadsLimits) {
  const JointLimits limits = Parse(kGood).limits.at(0);
  EXPECT_EQ(limits.lower, -1);
  EXPECT_EQ(limits.upper, 2);
  EXPECT_EQ(limits.effort, 10);
  EXPECT_EQ(limits.velocity, 5);
  EXPECT_EQ(limits.damping, 0.5);
  EXPECT_EQ(limits.friction, 0.25);
}

TEST(LoadUrdf, ReadsInertiasInTheAxesOfTheLink) {
  const Inertia M = Parse(kGood).tree.inertias()[0];
  EXPECT_EQ(M.mass, 2);
  EXPECT_EQ(M.p_BoG_B, Eigen::Vector3d(0.1, 0.2, 0.3));
  Eigen::Matrix3d I;
  I << 0.02, 0.001, 0.002, 0.001, 0.03, 0.003, 0.002, 0.003, 0.04;
  const Eigen::Matrix3d R = RzRyRx(0.1, -0.2, 0.3);
  EXPECT_LT((M.I_G_B - R * I * R.transpose()).norm(), Rounding(I.norm(), 9));
}

TEST(LoadUrdf, ReadsShapes) {
  const RobotModel model = Parse(kGood);
  ASSERT_EQ(model.visuals.size(), 2u);
  const Shape& box = model.visuals[0];
  EXPECT_EQ(model.tree.frames()[box.frame].name, "a");
  EXPECT_EQ(std::get<Box>(box.geometry).size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(box.X_FS.p, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(box.rgba, Eigen::Vector4d(1, 0.5, 0.25, 1));
  const Mesh& mesh = std::get<Mesh>(model.visuals[1].geometry);
  EXPECT_EQ(mesh.file, "a.stl");
  EXPECT_EQ(mesh.scale, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(model.collisions.size(), 2u);
  EXPECT_EQ(std::get<Sphere>(model.collisions[0].geometry).radius, 0.5);
  const Shape& cylinder = model.collisions[1];
  EXPECT_EQ(model.tree.frames()[cylinder.frame].name, "b");
  EXPECT_EQ(std::get<Cylinder>(cylinder.geometry).radius, 0.5);
  EXPECT_EQ(std::get<Cylinder>(cylinder.geometry).length, 2);
}

TEST(LoadUrdf, KeepsTheOrderOfTheFile) {
  std::string text =
      std::string("<robot name='r'><link name='root'>") + kPoint + "</link>";
  for (const char* name : {"z", "y", "x"}) {
    text += std::string("<link name='") + name + "'/><joint name='to_" + name +
            "' type='continuous'><parent link='root'/><child link='" + name +
            "'/></joint>";
  }
  const RobotModel model = Parse(text + "</robot>");
  ASSERT_EQ(model.tree.num_joints(), 3);
  EXPECT_EQ(model.tree.joints()[0].name, "to_z");
  EXPECT_EQ(model.tree.joints()[1].name, "to_y");
  EXPECT_EQ(model.tree.joints()[2].name, "to_x");
}

TEST(LoadUrdf, LocksJointsAtAValue) {
  const RobotModel model = ParseUrdf(kGood, "test.urdf", {{"j", 0.7}});
  EXPECT_EQ(model.tree.num_joints(), 0);
  EXPECT_TRUE(model.limits.empty());
  const Frame& b = model.tree.frames()[model.tree.FindFrame("b").value()];
  const Eigen::Matrix3d R =
      RzRyRx(0.4, 0.5, 0.6) *
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0, 0.6, 0.8)).toRotationMatrix();
  EXPECT_LT((b.X_BF.R - R).norm(), Rounding(2, 20));
}

TEST(LoadUrdf, UsesTheRootAsTheBaseEvenIfNamedWorld) {
  const std::string fixed =
      With("<joint",
           "<link name='world'/><joint name='w' type='fixed'><origin "
           "xyz='0 0 5'/><parent link='world'/><child link='a'/></joint>"
           "<joint");
  const RobotModel model = Parse(fixed);
  EXPECT_TRUE(model.tree.is_floating());
  EXPECT_EQ(model.tree.frames()[model.root_frame].name, "world");
  const Frame& a = model.tree.frames()[model.tree.FindFrame("a").value()];
  EXPECT_EQ(a.body, 0);
  EXPECT_EQ(a.X_BF.p.z(), 5);
}

TEST(LoadUrdf, LeavesOutAMasslessRootWithAFloatingJoint) {
  const std::string floating =
      With("<joint",
           "<link name='world'/><joint name='w' type='floating'><origin "
           "xyz='0 0 5'/><parent link='world'/><child link='a'/></joint>"
           "<joint");
  const RobotModel model = Parse(floating);
  EXPECT_EQ(model.tree.frames()[model.root_frame].name, "a");
  EXPECT_FALSE(model.tree.FindFrame("world").has_value());
  EXPECT_EQ(model.tree.num_joints(), 1);
}

// A link above the floating joint is massless if it has no <inertial>, or if
// the mass in its <inertial> is 0.
TEST(LoadUrdf, LeavesOutAllMasslessLinksAboveAFloatingJoint) {
  const std::string massless =
      "<inertial><mass value='0'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' "
      "iyz='0' izz='0'/></inertial>";
  const std::string text =
      With("<joint", "<link name='world'>" + massless +
                         "</link><link name='odom'/>" +
                         "<joint name='w' type='fixed'><parent link='world'/>"
                         "<child link='odom'/></joint>"
                         "<joint name='f' type='floating'><parent link='odom'/>"
                         "<child link='a'/></joint><joint");
  const RobotModel model = Parse(text);
  EXPECT_EQ(model.tree.frames()[model.root_frame].name, "a");
  EXPECT_EQ(model.tree.frames().size(), 2u);
  EXPECT_EQ(model.tree.num_joints(), 1);
  std::string heavy = text;
  heavy.replace(heavy.find("value='0'"), 9, "value='1'");
  EXPECT_NE(Rejection(heavy).find("joint 'f': is floating"), std::string::npos);
}

TEST(LoadUrdf, RejectsFloatingJointsElsewhere) {
  EXPECT_EQ(Rejection(With("revolute", "floating")),
            "test.urdf:28: joint 'j': is floating, only one joint below the "
            "massless root may be floating");
}

TEST(LoadUrdf, AcceptsCommentsInAnyEncoding) {
  EXPECT_EQ(Parse(With("<joint", "<!-- caf\xe9 --><joint")).tree.num_joints(),
            1);
  EXPECT_EQ(Parse(With("?>", " encoding='ISO-8859-1'?>")).name, "test");
}

TEST(LoadLinkMasses, KeepsLinksThatTheTreeMerges) {
  const std::filesystem::path file =
      std::filesystem::path(std::getenv("TEST_TMPDIR")) / "masses.urdf";
  std::ofstream(file) << With("revolute\">", "fixed\">");
  EXPECT_EQ(LoadUrdf(file).tree.num_bodies(), 1);
  const std::map<std::string, double> masses = {{"a", 2}, {"b", 1}};
  EXPECT_EQ(LoadLinkMasses(file), masses);
}

TEST(LoadUrdf, ReadsMimics) {
  const std::string text =
      With("</robot>",
           "<link name='c'/><joint name='k' type='prismatic'><parent "
           "link='b'/><child link='c'/><limit lower='0' upper='1' effort='1' "
           "velocity='1'/><mimic joint='j' multiplier='-2' offset='0.5'/>"
           "</joint></robot>");
  const RobotModel model = Parse(text);
  ASSERT_EQ(model.mimics.size(), 1u);
  EXPECT_EQ(model.tree.joints()[model.mimics[0].joint].name, "k");
  EXPECT_EQ(model.tree.joints()[model.mimics[0].source].name, "j");
  EXPECT_EQ(model.mimics[0].multiplier, -2);
  EXPECT_EQ(model.mimics[0].offset, 0.5);
  // If the source is locked, the mimic joint is independent.
  EXPECT_TRUE(ParseUrdf(text, "test.urdf", {{"j", 0}}).mimics.empty());
}

TEST(LoadUrdf, TreatsInvalidLimitsAsInfinite) {
  for (const char* limit : {"effort='1' velocity='1'",
                            "lower='-inf' upper='inf' effort='1' "
                            "velocity='1'",
                            "lower='1' upper='-1' effort='1' velocity='1'"}) {
    SCOPED_TRACE(limit);
    const JointLimits limits =
        Parse(With("lower=\"-1\" upper=\"2\" effort=\"10\" velocity=\"5\"",
                   limit))
            .limits[0];
    EXPECT_EQ(limits.lower, -kInfinity);
    EXPECT_EQ(limits.upper, kInfinity);
    EXPECT_EQ(limits.effort, 1);
  }
  const JointLimits limits =
      Parse(With("effort=\"10\" velocity=\"5\"", "effort='inf' velocity='0'"))
          .limits[0];
  EXPECT_EQ(limits.effort, kInfinity);
  EXPECT_EQ(limits.velocity, kInfinity);
}

TEST(LoadUrdf, TreatsAContinuousJointAsUnbounded) {
  const JointLimits limits = Parse(With("revolute", "continuous")).limits[0];
  EXPECT_EQ(limits.lower, -kInfinity);
  EXPECT_EQ(limits.upper, kInfinity);
  EXPECT_EQ(limits.effort, 10);
  EXPECT_EQ(limits.velocity, 5);
}

TEST(LoadUrdf, TreatsAMissingUpperLimitAsZero) {
  const JointLimits limits = Parse(With("upper=\"2\"", "")).limits[0];
  EXPECT_EQ(limits.lower, -1);
  EXPECT_EQ(limits.upper, 0);
}

TEST(LoadUrdf, AcceptsAnyWhiteSpaceBetweenNumbers) {
  const RobotModel model =
      Parse(With("\"1 2 3\" rpy", "\" +1\t2\n 3.0 \" rpy"));
  EXPECT_EQ(model.tree.joints()[0].X_PF.p, Eigen::Vector3d(1, 2, 3));
}

// A change of kGood, and a part of the expected message.
struct Case {
  const char* old_text;
  const char* new_text;
  const char* message;
};

// Changes of kGood for which the file is rejected.
const Case kRejected[] = {
    {"<robot", "<!DOCTYPE x [<!ENTITY a \"b\">]><robot",
     ":2: has a document type or entity declaration, must have none"},
    {"</robot>", "",
     "an element is not closed, or its end tag has another name"},
    {"</robot>", "</robot></x>", "an element is closed that is not open"},
    {"</robot>", "</robot>hello", "there is text outside the root element"},
    {"<?xml", "hello<?xml", "has a <?...?> that is not at its very start"},
    {"name=\"test\"", "name=\"te&#0;st\"",
     ":2: a value has a character that XML forbids, '&#0;'"},
    {"name=\"test\"", "name=\"te&#x00;st\"", "XML forbids, '&#x00;'"},
    {"name=\"test\"", "name=\"te&#1;st\"", "XML forbids, '&#1;'"},
    {"name=\"test\"", "name=\"te&#;st\"", "XML forbids, '&#;'"},
    {"name=\"test\"", "name=\"te&#xZZ;st\"", "XML forbids, '&#xZZ;'"},
    {"name=\"test\"", "name=\"te&#99999999999;st\"", "XML forbids"},
    {"name=\"test\"", "name=\"caf\xe9\"",
     "<robot>: name is 'caf?', must be UTF-8"},
    {"name=\"j\"", "name = \"j\" type='a' name='k'",
     ":28: the attribute 'name' occurs twice"},
    {"</robot>\n", "</robot", "the file ends inside a tag"},
    {"</robot>", "</robot><robot name='b'/>",
     "has a second root element, must have only one <robot>"},
    {" name=\"test\"", "", "<robot>: has no name, must have one"},
    {" name=\"a\"", "", "<link>: has no name, must have one"},
    {"name=\"a\"", "name=\"\"", "link '': its name is empty"},
    {"name=\"b\"", "name=\"a\"", "link 'a': occurs twice"},
    {"name=\"j\"", "name=\"\"", "joint '': its name is empty"},
    {"<mass value=\"2\"/>", "", "link 'a' <inertial>: has no <mass>"},
    {"value=\"2\"", "value=\"-2\"",
     "link 'a' <inertial>: mass is -2, must be zero or positive"},
    {"value=\"2\"", "value=\"2,5\"",
     ":7: link 'a' <mass>: value is '2,5', must be a number with a decimal "
     "point, not a comma"},
    {"value=\"2\"", "value=\"${m}\"", "is xacro, expand the file first"},
    {"value=\"2\"", "value=\"nan\"", "must be finite"},
    {"value=\"2\"", "value=\"inf\"", "is out of range, must be within"},
    {"value=\"2\"", "value=\"1e999\"", "is out of range, must be within"},
    {"value=\"2\"", "value=\"1e31\"", "is out of range, must be within"},
    {"ixx=\"0.02\"", "ixx=\"-1e308\"", ":8: link 'a' <inertia>: ixx is '-1e3"},
    {"radius=\"0.5\"", "radius=\"-0.5\"", "must be zero or positive"},
    {"value=\"2\"", "value=\"0x2\"", "must be a number"},
    {"value=\"2\"", "value=\"+-2\"", "must be a number"},
    {"value=\"2\"", "value=\"2\" value=\"3\"",
     ":7: the attribute 'value' occurs twice"},
    {"value=\"2\"", "value=2", "attribute is malformed"},
    {"ixx=\"0.02\"", "ixx=\"1.0d-2\"", "<inertia>: ixx is '1.0d-2'"},
    {"ixy=\"0.001\"", "", "<inertia>: has no ixy, must have one"},
    {"0.1 0.2 0.3", "0.1 nan 0.3", "must be finite"},
    {"0.1 0.2 0.3", "0.1 0.3", "must be 3 numbers"},
    {"size=\"1 2 3\"", "size=\"1 2\"", "<box>: size is '1 2'"},
    {"type=\"revolute\"", "", "joint 'j': has no type, must have one"},
    {"revolute", "planar", "joint 'j': its type is 'planar', must be"},
    {"revolute", "Revolute", "joint 'j': its type is 'Revolute', must be"},
    {"<parent link=\"a\"/>", "", "joint 'j': has no <parent>"},
    {"<child link=\"b\"/>", "", "joint 'j': has no <child>"},
    {"<child link=\"b\"/>", "<child link='b'/><child link='a'/>",
     "joint 'j' <child>: occurs twice, a joint connects two links"},
    {"<parent link=\"a\"/>", "<parent link='a'/><parent link='b'/>",
     "joint 'j' <parent>: occurs twice"},
    {"<origin xyz=\"0 0 1\"/>", "<origin xyz='0 0 1' quat_xyzw='0 0 0 1'/>",
     "<origin>: has 'quat_xyzw', must have rpy"},
    {"value=\"2\"", "value=\"2\"a=\"3\"",
     ":7: there is no space after the value of the attribute 'value'"},
    {"value=\"2\"", "value=\"2\" a=\"1&2\"",
     ":7: a value has &, must be &amp;"},
    {"value=\"2\"", "value=\"2\" a=\"1&b;2\"", "a value has &"},
    {"value=\"2\"", "value=\"2\" a=\"<\"", ":7: a value has <, must be"},
    {"<parent link=\"a\"/>", "<parent/>", "<parent>: has no link"},
    {"parent link=\"a\"", "parent link=\"A\"",
     "joint 'j': connects 'A', there is no such link"},
    {"parent link=\"a\"", "parent link=\"b\"",
     "joint 'j': connects 'b' to itself"},
    {"xyz=\"0 3 4\"", "xyz=\"0 0 0\"", "must not be zero"},
    {"xyz=\"0 3 4\"", "", "<axis>: has no xyz"},
    {"<limit lower=\"-1\" upper=\"2\" effort=\"10\" velocity=\"5\"/>", "",
     "joint 'j': has no <limit>, must have one"},
    {"effort=\"10\"", "", "<limit>: has no effort, must have one"},
    {"velocity=\"5\"", "", "<limit>: has no velocity, must have one"},
    {"effort=\"10\"", "effort=\"-10\"",
     ":33: joint 'j' <limit>: effort is -10, must be zero or positive: give "
     "the largest torque or force"},
    {"effort=\"10\"", "effort=\"-inf\"",
     "<limit>: effort is -inf, must be zero"},
    {"upper=\"2\"", "upper=\"nan\"", "<limit>: upper is 'nan'"},
    {"damping=\"0.5\"", "damping=\"much\"", "<dynamics>: damping is 'much'"},
    {"<axis", "<mimic/><axis", "<mimic>: has no joint, must have one"},
    {"<axis", "<mimic joint='j'/><axis",
     "joint 'j': mimics 'j', must be another joint"},
    {"<axis", "<mimic joint='k'/><axis",
     "joint 'j': mimics 'k', there is no such joint"},
    {"<link name=\"b\">", "<xacro:leg_Joint side='l'/><link name=\"b\">",
     ":19: <xacro:leg_Joint>: is xacro, expand the file with xacro first: the "
     "robot would lose a link, a joint, a limit or mass"},
    {"<link name=\"b\">",
     "<xacro:if value='1'><xacro:a><link/></xacro:a></xacro:if><link "
     "name=\"b\">",
     "<xacro:if>: is xacro"},
    {"<link name=\"b\">",
     "<xacro:if value='1'><transmission/></xacro:if><link name=\"b\">",
     "<xacro:if>: is xacro"},
    {"<link name=\"b\">", "<link name=\"b\"><xacro:box_inertia m='1'/>",
     "link 'b' <xacro:box_inertia>: is xacro"},
    {"<axis", "<xacro:default/><axis", "joint 'j' <xacro:default>: is xacro"},
    {"effort=\"10\"", "effort=\"${e}\"",
     "effort is '${e}', is xacro, expand the file first"},
    {"<link name=\"b\">", "<link name=\"c\"/><link name=\"b\">",
     "link 'c': is a second root beside 'a', must be the child of a joint"},
};

TEST(LoadUrdf, RejectsInvalidFilesWithAOneLineMessage) {
  for (const Case& c : kRejected) {
    const std::string message = Rejection(With(c.old_text, c.new_text));
    EXPECT_NE(message.find(c.message), std::string::npos)
        << c.new_text << "\n  gives: " << message
        << "\n  without: " << c.message;
    EXPECT_EQ(message.find("test.urdf:"), 0u) << message;
  }
}

TEST(LoadUrdf, RejectsOtherFormats) {
  EXPECT_EQ(Rejection(""), "test.urdf: is empty, must be XML");
  EXPECT_EQ(Rejection(" \n"), "test.urdf: is empty, must be XML");
  EXPECT_NE(Rejection("hello").find("is not XML"), std::string::npos);
  EXPECT_EQ(Rejection(std::string("<robot\0/>", 9)),
            "test.urdf: is binary, must be UTF-8 text");
  EXPECT_EQ(Rejection("<sdf/>"),
            "test.urdf:1: is a <sdf>, which is SDF, must be URDF: <robot>; "
            "export the robot as URDF");
  EXPECT_EQ(Rejection("<mujoco/>"),
            "test.urdf:1: is a <mujoco>, which is MJCF, must be URDF: <robot>; "
            "export the robot as URDF");
  EXPECT_EQ(Rejection("<a/>"), "test.urdf:1: is a <a>, must be a <robot>");
  EXPECT_EQ(Rejection("<!-- -->"),
            "test.urdf: has no element, must have a <robot>");
  EXPECT_EQ(Rejection("<robot name='r'/>"),
            "test.urdf:1: <robot>: has no link, must have at least one");
}

// Massless links are allowed. But if all links are massless, M is zero.
TEST(LoadUrdf, RejectsARobotWithoutMass) {
  const std::string joint =
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
      "</joint></robot>";
  const std::string links = "\n<robot name='r'><link name='a'/><link name='b'";
  const std::string wanted =
      "test.urdf:2: <robot>: the mass of all links together is 0, must be "
      "positive, else M is singular: give the links an <inertial>";
  EXPECT_EQ(Rejection(links + "/>" + joint), wanted);
  std::string massless = kPoint;
  massless.replace(massless.find("'1'"), 3, "'0'");
  EXPECT_EQ(Rejection(links + ">" + massless + "</link>" + joint), wanted);
  EXPECT_EQ(Parse(links + ">" + kPoint + "</link>" + joint).tree.total_mass(),
            1);
}

TEST(LoadUrdf, RejectsLoops) {
  const std::string joint = "<limit effort='1' velocity='1'/></joint></robot>";
  EXPECT_NE(Rejection(With("</robot>",
                           "<joint name='k' type='revolute'><parent link='a'/>"
                           "<child link='b'/>" +
                               joint))
                .find("link 'b': has two parents, by joint 'j' and by 'k'"),
            std::string::npos);
  EXPECT_NE(Rejection(With("</robot>",
                           "<joint name='k' type='revolute'><parent link='b'/>"
                           "<child link='a'/>" +
                               joint))
                .find("<robot>: has no root, the joints form a cycle"),
            std::string::npos);
  // The file has a tree and a separate cycle.
  EXPECT_NE(Rejection(With("</robot>",
                           "<link name='c'/><link name='d'/>"
                           "<joint name='k' type='fixed'><parent link='c'/>"
                           "<child link='d'/></joint>"
                           "<joint name='l' type='fixed'><parent link='d'/>"
                           "<child link='c'/></joint></robot>"))
                .find("2 of its links are not below its root 'a'"),
            std::string::npos);
}

TEST(LoadUrdf, RejectsCyclesOfMimics) {
  std::string text = "<robot name='r'><link name='root'/>";
  for (const char* name : {"1", "2", "3"}) {
    const std::string source =
        name[0] == '3' ? "1" : std::string(1, name[0] + 1);
    text += std::string("<link name='") + name + "'/><joint name='" + name +
            "' type='continuous'><parent link='root'/><child link='" + name +
            "'/><mimic joint='" + source + "'/></joint>";
  }
  EXPECT_NE(Rejection(text + "</robot>").find("which mimics it in turn"),
            std::string::npos);
}

// Changes of kGood that give a warning.
const Case kWarnedOf[] = {
    {"ixx=\"0.02\"", "ixx=\"-0.02\"", "negative principal moment"},
    {"izz=\"0.04\"", "izz=\"0.06\"", "larger than the sum of the other two"},
    {"ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"",
     "ixx='1e6' ixy='0' ixz='0' iyy='1e6' iyz='0' izz='1e6'",
     "1e+06 kg m2 for 1 kg"},
    {"0.1 0.2 0.3", "100 0 0", "over 10 m away: is it in millimeters?"},
    {"1 2 3\" rpy", "0 0 -350\" rpy", "over 10 m away: is it in millimeters?"},
    {"0 0 1", "0 0 11", "link 'a' <origin>: xyz is '0 0 11', which is over"},
    {"0.4 0.5 0.6", "0 90 0", "more than one turn: is it in degrees?"},
    {"lower=\"-1\" upper=\"2\"", "lower='-90' upper='90'", "in degrees?"},
    {"value=\"2\"", "value=\"0\"", "has inertia but mass 0"},
    {"0 3 4", "0 0 1e-9", "too short for a reliable direction"},
    {"lower=\"-1\" upper=\"2\"", "lower='1' upper='-1'", "is not a range"},
    {"lower=\"-1\" upper=\"2\"", "lower='1' upper='1'", "cannot move"},
    {"lower=\"-1\" upper=\"2\"", "", "neither lower nor upper"},
    {"upper=\"2\"", "", "has no upper, the URDF default 0"},
    {"lower=\"-1\"", "", "has no lower, the URDF default 0"},
    {"<limit", "<Limits/><limit",
     ":33: joint 'j' <Limits>: is not a URDF element, is ignored: did you mean "
     "<limit>?"},
    {"<axis", "<!-- --><mimick/><axis", "did you mean <mimic>?"},
    {"<axis", "<Axis/><axis", "did you mean <axis>?"},
    {"<axis", "<axes/><axis", "did you mean <axis>?"},
    {"<axis", "<xis/><axis", "did you mean <axis>?"},
    {"<axis", "<mass/><axis", "<mass>: is not a URDF element here"},
    {"<link name=\"b\">", "<macro/><link name=\"b\">",
     "is xacro without a prefix"},
    {"<link name=\"b\">",
     "<xacro:pelvis_imu parent='pelvis_link' port='${p}'/><link name=\"b\">",
     ":19: <xacro:pelvis_imu>: is xacro, is ignored: expand the file "
     "with xacro first to keep the parts that it adds"},
    {"<link name=\"b\">",
     "<xacro:include filename='imu.xacro'/><link name=\"b\">",
     "<xacro:include>: is xacro of the file 'imu.xacro', is ignored"},
    {"<link name=\"b\">",
     "<xacro:if value='1'><gazebo><mu1/></gazebo></xacro:if><link "
     "name=\"b\">",
     "<xacro:if>: is xacro, is ignored"},
    {"<link name=\"b\">", "<link name=\"b\"><xacro:camera name='eye'/>",
     "link 'b' <xacro:camera>: is xacro, is ignored"},
    {"<mass value=\"2\"/>", "<mass value=\"2\">3</mass>",
     "<mass>: holds the text '3', is ignored"},
    {"damping=", "Damping=",
     "<dynamics>: has 'Damping', is ignored: did you mean damping?"},
    {"damping=", "dampin=", "did you mean damping?"},
    {"<box size=\"1 2 3\"/>", "<box size='1 2 3'/><sphere radius='1'/>",
     "is a second shape, only the first one is used"},
    {"<link name=\"b\">", "<material name='${m}'/><link name=\"b\">",
     "looks like xacro"},
    {"lower=\"-1\" upper=\"2\"", "lower='-inf' upper='2'", "infinite end"},
    {"lower=\"-1\" upper=\"2\"", "lower='-1e9' upper='2'", "a placeholder"},
    {"effort=\"10\"", "effort=\"1e9\"", "placeholder"},
    {"effort=\"10\"", "effort=\"0\"", "it is passive"},
    {"velocity=\"5\"", "velocity=\"-1\"", "must be positive"},
    {"effort=\"10\"", "effort=\"inf\"", "treated as unknown"},
    {"velocity=\"5\"", "velocity=\"0\"", "velocity is 0"},
    {"velocity=\"5\"", "velocity=\"1e4\"", "placeholder"},
    {"damping=\"0.5\"", "damping=\"-0.5\"", "damping is -0.5, must be"},
    {"friction=\"0.25\"", "friction=\"-1\"", "friction is -1, must be"},
    {"friction=\"0.25\"", "friction=\"10\"",
     "friction is 10, must be below the effort limit, 10"},
    {"name=\"test\"",
     "name='test'><material name='red'><color rgba='1 1 1 "
     "1'/></material",
     "material 'red': occurs twice"},
    {"1 0.5 0.25 1", "1 0.5", "material 'red' <color>: rgba is '1 0.5'"},
    {"<box size=\"1 2 3\"/>", "<capsule radius='1'/>",
     "has no shape that can be read"},
    {"<origin xyz=\"0 0 1\"/>", "<origin xyz='0 0 1'/><origin xyz='0 0 2'/>",
     "occurs twice"},
    {"<link name=\"b\">",
     "<link name='${p}c'/><joint name='k' type='fixed'>"
     "<parent link='a'/><child link='${p}c'/></joint>"
     "<link name=\"b\">",
     "looks like xacro"},
};

TEST(LoadUrdf, WarnsOfLikelyMistakes) {
  EXPECT_EQ(Findings(kGood, Severity::kWarn), "");
  for (const Case& c : kWarnedOf) {
    const std::string found =
        Findings(With(c.old_text, c.new_text), Severity::kWarn);
    EXPECT_NE(found.find(c.message), std::string::npos)
        << c.new_text << "\n  gives: " << found << "\n  without: " << c.message;
    // Each mistake gives one warning; two names with an expression give two.
    const bool is_xacro =
        std::string(c.new_text).find("<link name='${p}c'") == 0;
    EXPECT_EQ(std::count(found.begin(), found.end(), '|'), is_xacro ? 2 : 1)
        << found;
  }
}

TEST(LoadUrdf, WarnsOfAVeryLongPrismaticJoint) {
  const std::string slide = With("revolute", "prismatic");
  EXPECT_EQ(Findings(slide, Severity::kWarn), "");
  std::string text = slide;
  text.replace(text.find("upper=\"2\""), 9, "upper='11'");
  EXPECT_NE(Findings(text, Severity::kWarn).find("in millimeters?"),
            std::string::npos);
}

TEST(LoadUrdf, NotesUnusualParts) {
  EXPECT_NE(Findings(kGood, Severity::kNote).find("xyz is '0 3 4'"),
            std::string::npos);
  const Case cases[] = {
      {"<axis xyz=\"0 3 4\"/>", "", "has no <axis>"},
      {"revolute", "continuous", "has lower or upper for a continuous joint"},
      {"lower=\"-1\"", "lower=\"1\"", "0 is outside"},
      {"<link name=\"b\">", "<loop_joint/><link name=\"b\">", "closes a loop"},
      {"<limit", "<unlimited/><limit",
       ":33: joint 'j' <unlimited>: is not a URDF element here, is ignored"},
      {"<box size", "<box weight='1' size", "has 'weight', is ignored"},
      {"</robot>",
       "<link name='c'/><joint name='k' type='continuous'><parent "
       "link='b'/><child link='c'/></joint></robot>",
       "link 'c': has no <inertial>, its mass is treated as 0"},
      {"</robot>",
       "<link name='world'/><joint name='k' type='fixed'><parent "
       "link='world'/><child link='a'/></joint></robot>",
       "link 'world': is the root, the robot has a floating base"},
      {"</robot>",
       "<link name='c'/><joint name='k' type='revolute'><parent link='b'/>"
       "<child link='c'/><limit lower='-1' upper='1' effort='1' velocity='1'/>"
       "<mimic joint='j'/></joint></robot>",
       "joint 'k' <mimic>: moves the joint to 2, which is outside its limits"},
  };
  for (const Case& c : cases) {
    const std::string found =
        Findings(With(c.old_text, c.new_text), Severity::kNote);
    EXPECT_NE(found.find(c.message), std::string::npos) << found;
  }
}

// The moments of thin plates are often rounded, and elements without effect on
// the dynamics are common.
TEST(LoadUrdf, DoesNotWarnOfCommonParts) {
  const Case cases[] = {
      {"ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"",
       "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='2.00001'", ""},
      {"<link name=\"b\">",
       "<gazebo reference='a'><mu1>x</mu1></gazebo><link name=\"b\">", ""},
      {"<axis", "<safety_controller k_velocity='x'/><axis", ""},
      {"radius=\"0.5\"", "radius=\"0\"", ""},
      {"<material name=\"red\"/>", "<material name='undefined'/>", ""},
      {"revolute\">", "fixed\"><axis xyz='0 0 0'/><limit/>", ""},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(Findings(With(c.old_text, c.new_text), Severity::kWarn), "")
        << c.new_text;
  }
}

TEST(LoadUrdf, KeepsNamesUnchanged) {
  const std::string name = "l <a> \"q\" %s %n \\ \xc3\xa9 \xe6\x97\xa5";
  std::string text =
      std::string("<robot name='%n%s'><material name='%n'/>") +
      "<link name='l &lt;a&gt; &quot;q&quot; %s %n \\ \xc3\xa9 \xe6\x97\xa5'>" +
      kPoint +
      "<visual><geometry><box size='1 1 1'/></geometry><material name='%n'/>"
      "</visual></link></robot>";
  const RobotModel model = Parse(text);
  EXPECT_EQ(model.name, "%n%s");
  EXPECT_EQ(model.tree.frames()[0].name, name);
}

TEST(LoadUrdf, CutsLongNamesInMessages) {
  const std::string name(100'000, 'n');
  const std::string message =
      Rejection("<robot name='r'><link name='" + name + "'/><link name='" +
                name + "'/></robot>");
  EXPECT_LT(message.size(), 200u);
  EXPECT_NE(message.find("nnn...'"), std::string::npos);
}

// In a locale with a decimal comma, the decimal separator is still a point.
TEST(LoadUrdf, DoesNotDependOnTheLocale) {
  class Comma : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new Comma));
  const char* c_locale = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const RobotModel model = Parse(kGood);
  const std::string message = Rejection(With("value=\"2\"", "value=\"-2.5\""));
  if (c_locale != nullptr) std::setlocale(LC_ALL, "C");
  std::locale::global(before);
  EXPECT_EQ(model.tree.inertias()[0].p_BoG_B, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(model.limits[0].friction, 0.25);
  EXPECT_NE(message.find("mass is -2.5,"), std::string::npos) << message;
}

TEST(LoadUrdf, NamesAFileThatCannotBeRead) {
  const std::string pipe = std::string(std::getenv("TEST_TMPDIR")) + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string file : {"no/such.urdf", "/", pipe.c_str()}) {
    try {
      LoadUrdf(file);
      ADD_FAILURE() << file;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                file + (file == "no/such.urdf"
                            ? ": cannot be read: No such file or directory"
                        : file == "/" ? ": cannot be read: Is a directory"
                                      : ": is not a regular file"));
    }
  }
}

}  // namespace
}  // namespace poise
