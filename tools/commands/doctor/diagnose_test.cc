// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/diagnose.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "poise/robot/control/stand.h"
#include "poise/tests/util/shared_data.h"
#include "poise/tests/util/test_file.h"
#include "poise/tools/commands/doctor/biped_fixture.h"
#include "poise/tools/commands/doctor/next_step.h"
#include "poise/tools/commands/doctor/why_falls.h"
#include "poise/tools/commands/doctor/write_diagnosis.h"

namespace poise {
namespace {

const char kInertial[] =
    "<inertial><mass value='1'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' "
    "iyz='0' izz='0.1'/></inertial>";

// Makes a chain of links 0, 1, 2 ..., with joints about the given axes and with
// the given elements inside each link.
std::string Chain(const std::vector<std::string>& parts,
                  const std::vector<std::string>& axes) {
  std::string text = "<robot name='chain'>";
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::string name = std::to_string(i);
    text += "<link name='" + name + "'>" + parts[i] + "</link>";
    if (i == 0) continue;
    text += "<joint name='j" + name +
            "' type='revolute'><origin xyz='0 0 0.1'/><parent link='" +
            std::to_string(i - 1) + "'/><child link='" + name +
            "'/><axis xyz='" + axes[i - 1] +
            "'/><limit lower='-1' upper='1' effort='9' velocity='9'/></joint>";
  }
  return text + "</robot>";
}

// Longer than the slowest build needs for a simulation, s: the sanitizers take
// ten times as long as the doctor.
constexpr double kEnough = 600;

Diagnosis Examine(const std::string& text) {
  return Diagnose(TestFile("robot.urdf", text), {}, {}, kEnough);
}

std::string Findings(const Diagnosis& diagnosis) {
  std::string all;
  for (const Finding& finding : diagnosis.findings) {
    all += finding.where + ": " + finding.what + ", " + finding.why + "\n";
  }
  return all;
}

TEST(Diagnose, FindsNoFaultInTheHumanoid) {
  const Diagnosis diagnosis =
      Diagnose("robot/models/humanoid.urdf",
               LoadProfile("robot/profiles/humanoid.yaml"));
  EXPECT_EQ(VerdictWord(diagnosis), "ok") << Findings(diagnosis);
  EXPECT_EQ(diagnosis.joints, 50);
  EXPECT_EQ(diagnosis.soles.size(), 2u);
  EXPECT_NEAR(diagnosis.soles[0].length, 0.23, 1e-9);
  EXPECT_NEAR(diagnosis.com_height.value(), 0.79, 0.01);
  double mass = 0;
  for (const Diagnosis::Mass& body : diagnosis.bodies) mass += body.mass;
  EXPECT_NEAR(mass, diagnosis.mass, 1e-12);
  mass = 0;
  for (const Diagnosis::Mass& link : diagnosis.links) mass += link.mass;
  EXPECT_NEAR(mass, diagnosis.mass, 1e-12);
  EXPECT_GT(diagnosis.links.size(), diagnosis.bodies.size());
  // Bullet must agree with our dynamics to this relative error.
  EXPECT_LT(diagnosis.parity.value(), 1e-9);
}

std::string HumanoidText() {
  std::ifstream file("robot/models/humanoid.urdf");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Diagnose, NamesMotorsTooWeakToStand) {
  std::string text = HumanoidText();
  // Both knees are weak. A single weak knee would not matter, because the
  // friction of the feet straightens it.
  for (const char* knee :
       {"<joint name=\"l_knee\"", "<joint name=\"r_knee\""}) {
    const size_t effort = text.find("effort=\"", text.find(knee)) + 8;
    text.replace(effort, text.find('"', effort) - effort, "2.5");
  }
  const Diagnosis diagnosis = Examine(text);
  EXPECT_EQ(VerdictWord(diagnosis), "warn");
  EXPECT_NE(Findings(diagnosis).find("joint 'l_knee': needs "),
            std::string::npos)
      << Findings(diagnosis);
  EXPECT_FALSE(diagnosis.stands);
  EXPECT_EQ(diagnosis.findings[0].what, "does not stand");
  EXPECT_NE(diagnosis.reason.find("it falls after "), std::string::npos)
      << diagnosis.reason;
  EXPECT_EQ(
      NextStep(diagnosis, {"a.urdf", "", {}}),
      "bazel run //tools:doctor -- a.urdf  # after you have corrected the "
      "effort of joint 'l_knee'");
}

// A wrong unit is the cause, and a weak motor what follows from it.
TEST(Diagnose, NamesWrongUnitsFirst) {
  std::string text = HumanoidText();
  const std::string mass = "<mass value=\"";
  for (size_t at = text.find(mass); at != std::string::npos;
       at = text.find(mass, at + 1)) {
    const size_t start = at + mass.size(), end = text.find('"', start);
    text.insert(end, "e3");
  }
  const Diagnosis diagnosis = Examine(text);
  EXPECT_FALSE(diagnosis.stands);
  EXPECT_EQ(diagnosis.findings[0].what.find("has a mass of 38660 kg"), 0u);
  Diagnosis standing = diagnosis;
  standing.stands = true;  // As with efforts in the same wrong unit.
  EXPECT_EQ(NextStep(standing, {"a.urdf", "", {}}),
            NextStep(diagnosis, {"a.urdf", "", {}}));
  EXPECT_EQ(NextStep(diagnosis, {"a.urdf", "", {}}),
            "bazel run //tools:doctor -- a.urdf  # after you have corrected "
            "the units of the file");
}

// Sets the effort of all joints whose name contains `part`.
std::string WithEffort(std::string text, const std::string& part,
                       const std::string& effort) {
  for (size_t at = 0;
       (at = text.find("<joint name=\"", at)) != std::string::npos;) {
    at += 13;
    const std::string name = text.substr(at, text.find('"', at) - at);
    if (name.find(part) == std::string::npos) continue;
    const size_t value = text.find("effort=\"", at) + 8;
    if (value > text.find("</joint>", at)) continue;
    text.replace(value, text.find('"', value) - value, effort);
  }
  return text;
}

// The arms reach forward. They need 1.5 N m each.
TEST(Diagnose, SaysThatARobotWithWeakArmsStands) {
  SmallBiped biped;
  biped.arm_tilt = 1.4;
  EXPECT_EQ(VerdictWord(Examine(TextOf(biped))), "ok");
  biped.arm_effort = 1;
  const Diagnosis diagnosis = Examine(TextOf(biped));
  EXPECT_NE(Findings(diagnosis).find("joint 'left_arm': needs 1.4"),
            std::string::npos)
      << Findings(diagnosis);
  EXPECT_TRUE(diagnosis.stands) << diagnosis.reason;
  EXPECT_TRUE(diagnosis.was_tested);
  // The arms hang down, up to 0.5 mrad.
  biped.arm_tilt = 5e-4;
  biped.arm_effort = 0;
  const Diagnosis hangs = Examine(TextOf(biped));
  EXPECT_EQ(Findings(hangs).find("to stand"), std::string::npos)
      << Findings(hangs);
  EXPECT_TRUE(hangs.stands) << hangs.reason;
}

// The torques of the wrists at rest are too small to report. The simulation
// decides if the humanoid stands without their motors.
TEST(Diagnose, SimulatesARobotWithPassiveJoints) {
  const auto file =
      TestFile("robot.urdf", WithEffort(HumanoidText(), "wrist", "0"));
  const Diagnosis diagnosis = Diagnose(file, {}, {}, kEnough);
  EXPECT_EQ(Findings(diagnosis).find("to stand, "), std::string::npos)
      << Findings(diagnosis);
  const auto fall = WhyFalls(LoadStandingRobot(file, {}), {}, 5, kEnough);
  ASSERT_TRUE(fall.has_value());
  EXPECT_EQ(diagnosis.stands, fall->empty()) << *fall;
}

// The cheek rests at the end of its range. The controller moves it away from
// the stop by 8 rad/s² at first.
TEST(Diagnose, IgnoresAccelerationsOfJointsThatDoNotMoveTheBase) {
  std::string text = TextOf({});
  const std::string cheek =
      "<link name='cheek'><inertial><origin xyz='0.06 0 0.01'/><mass "
      "value='0.37'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.001' iyz='0' "
      "izz='0.001'/></inertial></link><joint name='cheek' "
      "type='revolute'><origin xyz='0 0 0.5'/><parent link='trunk'/><child "
      "link='cheek'/><axis xyz='0 1 0'/><limit lower='-0.0576' upper='0' "
      "effort='100' velocity='1.8'/></joint>";
  text.insert(text.find("</robot>"), cheek);
  const Diagnosis diagnosis = Examine(text);
  EXPECT_TRUE(diagnosis.stands);
  EXPECT_EQ(VerdictWord(diagnosis), "ok") << Findings(diagnosis);
}

TEST(NextStep, CorrectsEffortsOfZero) {
  for (const char* part : {"_hip_", "_"}) {
    Diagnosis diagnosis = Examine(WithEffort(HumanoidText(), part, "0"));
    EXPECT_TRUE(diagnosis.was_tested);
    EXPECT_FALSE(diagnosis.stands);
    EXPECT_NE(
        diagnosis.reason.find("correct <limit effort=\"0\"> of joints 'l"),
        std::string::npos)
        << diagnosis.reason;
    EXPECT_EQ(NextStep(diagnosis, {"a.urdf", "", {}}),
              "bazel run //tools:doctor -- a.urdf  # after you have corrected "
              "the efforts of the legs, which are 0, in the file");
    EXPECT_TRUE(ProfileStub(diagnosis).empty());
  }
}

TEST(Diagnose, ExaminesTheRobotWithoutItsLockedJoints) {
  // A massless head would make M singular if its joints were not locked.
  std::string text = HumanoidText();
  for (const char* link : {"<link name=\"neck\"", "<link name=\"head\""}) {
    const size_t start = text.find("<inertial>", text.find(link));
    text.erase(start, text.find("</inertial>", start) + 11 - start);
  }
  const Diagnosis whole = Examine(text);
  EXPECT_NE(Findings(whole).find("has 2 joints that move no mass of their own: "
                                 "'neck_yaw', 'neck_pitch', locked"),
            std::string::npos)
      << Findings(whole);
  EXPECT_LT(whole.parity.value(), 1e-9);
  EXPECT_TRUE(whole.stands);
  const Diagnosis reduced =
      Diagnose(TestFile("robot.urdf", text),
               LoadProfile(TestFile(
                   "locked.yaml", "locked: {neck_yaw: 0.1, neck_pitch: 0}\n")));
  EXPECT_EQ(Findings(reduced).find("no mass"), std::string::npos);
  EXPECT_NE(Findings(reduced).find("has 2 joints locked by the profile, M, "
                                   "standing and parity are computed with the "
                                   "48 other joints"),
            std::string::npos)
      << Findings(reduced);
  EXPECT_LT(reduced.parity.value(), 1e-9);
}

TEST(Diagnose, WarnsOfJointsThatWouldMakeTheMassMatrixSingular) {
  const Diagnosis leaf =
      Examine(Chain({kInertial, kInertial, ""}, {"0 0 1", "0 1 0"}));
  EXPECT_EQ(VerdictWord(leaf), "warn");
  const std::string locked = "has 1 joint that moves no mass of its own: 'j2'";
  EXPECT_NE(Findings(leaf).find(locked), std::string::npos) << Findings(leaf);
  const Diagnosis collinear =
      Examine(Chain({kInertial, "", kInertial}, {"0 0 1", "0 0 1"}));
  EXPECT_EQ(VerdictWord(collinear), "warn");
  EXPECT_NE(Findings(collinear).find(locked), std::string::npos);
  // If the axes differ, the link between the joints may be massless.
  EXPECT_EQ(VerdictWord(
                Examine(Chain({kInertial, "", kInertial}, {"0 0 1", "1 0 0"}))),
            "ok");
}

TEST(Diagnose, NamesElementAndValueThatItRejects) {
  const Diagnosis diagnosis = Examine(Chain({kInertial, kInertial}, {"0 0 0"}));
  EXPECT_EQ(VerdictWord(diagnosis), "reject");
  EXPECT_EQ(diagnosis.findings[0].where, "joint 'j1' <axis>");
  EXPECT_EQ(diagnosis.findings[0].what, "xyz is '0 0 0'");
  EXPECT_EQ(VerdictWord(Diagnose("no/such.urdf")), "reject");
}

TEST(Diagnose, RejectsRobotWithoutMass) {
  const Diagnosis diagnosis = Examine(Chain({"", ""}, {"0 0 1"}));
  EXPECT_EQ(VerdictWord(diagnosis), "reject") << Findings(diagnosis);
  EXPECT_EQ(diagnosis.findings[0].what, "the mass of all links together is 0");
  EXPECT_EQ(diagnosis.findings[0].line, 1);
}

TEST(Diagnose, NamesTheLineOfInvalidXml) {
  const Diagnosis diagnosis = Examine("<robot>\n<!DOCTYPE a></robot>");
  ASSERT_EQ(VerdictWord(diagnosis), "reject");
  EXPECT_EQ(diagnosis.findings[0].line, 2);
  EXPECT_EQ(diagnosis.findings[0].what,
            "has a document type or entity declaration, must have none");
}

TEST(Diagnose, DoesNotSayIfALargeRobotStands) {
  Diagnosis diagnosis = Examine(Chain(std::vector<std::string>(300, kInertial),
                                      std::vector<std::string>(299, "0 0 1")));
  EXPECT_FALSE(diagnosis.was_tested);
  diagnosis.next_step = NextStep(diagnosis, {"a.urdf", "", {}});
  EXPECT_EQ(diagnosis.next_step,
            "bazel run //tools:doctor -- a.urdf --profile a.yaml  # after you "
            "have locked joints in a.yaml (locked: {JOINT: 0})");
  EXPECT_EQ(WriteTable(diagnosis).find(
                "verdict  ok\nstands   unknown: the robot has more than 200 "
                "joints"),
            0u)
      << WriteTable(diagnosis);
  EXPECT_TRUE(nlohmann::json::parse(WriteJson(diagnosis))["stands"].is_null());
}

// A leg of `joints` joints in series, each 0.2 m below the other.
std::string Leg(const std::string& name, const std::string& xyz, int joints) {
  std::string text;
  std::string parent = "trunk";
  for (int i = 0; i < joints; ++i) {
    const std::string link = name + std::to_string(i);
    text += "<link name='" + link + "'>" + kInertial + "</link><joint name='" +
            link + "' type='revolute'><origin xyz='" +
            (i == 0 ? xyz : "0 0 -0.2") + "'/><parent link='" + parent +
            "'/><child link='" + link +
            "'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='9' "
            "velocity='9'/></joint>";
    parent = link;
  }
  return text;
}

std::string Trunk(const std::string& limbs) {
  return std::string("<robot name='r'><link name='trunk'>") + kInertial +
         "</link>" + limbs + "</robot>";
}

TEST(Diagnose, WarnsIfABipedWithFewJointsDoesNotStand) {
  const Diagnosis biped =
      Examine(Trunk(Leg("l", "0 0.1 0", 3) + Leg("r", "0 -0.1 0", 3)));
  EXPECT_FALSE(biped.stands);
  EXPECT_TRUE(biped.was_tested);
  EXPECT_EQ(VerdictWord(biped), "warn") << Findings(biped);
  EXPECT_EQ(biped.findings[0].what, "does not stand");
}

TEST(Diagnose, SaysThatQuadrupedsAreNotSupported) {
  Diagnosis diagnosis =
      Examine(Trunk(Leg("a", "0.3 0.1 0", 3) + Leg("b", "0.3 -0.1 0", 3) +
                    Leg("c", "-0.3 0.1 0", 3) + Leg("d", "-0.3 -0.1 0", 3)));
  EXPECT_EQ(VerdictWord(diagnosis), "warn");
  EXPECT_NE(diagnosis.reason.find("reaches the ground with 4 bodies, must be "
                                  "two feet: quadrupeds are not supported"),
            std::string::npos)
      << diagnosis.reason;
  EXPECT_EQ(diagnosis.forward, "+x");
  EXPECT_TRUE(ProfileStub(diagnosis).empty());
  EXPECT_EQ(NextStep(diagnosis, {"a.urdf", "", {}}),
            "bazel run //tools:doctor -- ROBOT.urdf  # with a robot that has "
            "two legs");
}

TEST(Diagnose, SkipsMassMatrixAbove500Joints) {
  const Diagnosis diagnosis =
      Examine(Chain(std::vector<std::string>(602, kInertial),
                    std::vector<std::string>(601, "0 0 1")));
  EXPECT_EQ(VerdictWord(diagnosis), "ok");
  EXPECT_NE(Findings(diagnosis).find("M was not computed"), std::string::npos);
}

// Each foot has 80 000 corners, so the search for the sole must be fast.
TEST(Diagnose, ExaminesFeetWithAThousandShapes) {
  std::string feet;
  for (int i = 0; i < 1000; ++i) {
    feet += "<collision><origin rpy='0 0 " + std::to_string(i * 5e-4) +
            "'/><geometry><cylinder radius='0.1' length='0.05'/></geometry>"
            "</collision>";
  }
  std::string text =
      std::string("<robot name='r'><link name='base'>") + kInertial + "</link>";
  for (const char* side : {"l", "r"}) {
    std::string parent = "base";
    for (int i = 0; i < 6; ++i) {
      const std::string name = side + std::to_string(i);
      const char* axes[] = {"0 0 1", "1 0 0", "0 1 0",
                            "0 1 0", "0 1 0", "1 0 0"};
      text += "<link name='" + name + "'>" + kInertial + (i == 5 ? feet : "") +
              "</link><joint name='" + name +
              "' type='revolute'><origin xyz='0 " +
              (i > 0          ? "0"
               : *side == 'l' ? "0.15"
                              : "-0.15") +
              (i == 3 || i == 4 ? " -0.4" : " 0") + "'/><parent link='" +
              parent + "'/><child link='" + name + "'/><axis xyz='" + axes[i] +
              "'/><limit lower='-2' upper='2' effort='100' velocity='5'/>"
              "</joint>";
      parent = name;
    }
  }
  // The inertia of 1 kg in a sphere of 0.1 m.
  for (const char* name : {"<link name='l5'>", "<link name='r5'>"}) {
    size_t at = text.find(name);
    for (int i = 0; i < 3; ++i) {
      at = text.find("'0.1'", at);
      text.replace(at, 5, "'0.004'");
    }
  }
  const Diagnosis diagnosis = Examine(text + "</robot>");
  EXPECT_EQ(VerdictWord(diagnosis), "ok") << Findings(diagnosis);
  ASSERT_EQ(diagnosis.soles.size(), 2u);
  // The sole polygon is inside a circle with a radius of 0.1 m.
  EXPECT_NEAR(diagnosis.soles[0].length, 0.2, 0.002);
}

TEST(Diagnose, RejectsProfileThatDoesNotMatchTheRobot) {
  for (const char* text :
       {"feet:\n  left_foot: {frame: nope, size: [0.2, 0.1]}\n"
        "  right_foot: {frame: r_sole, size: [0.2, 0.1]}\n",
        "# Odd.\nlocked: {nope: 0}\n", "# Odd.\ntasks: {nope: on}\n",
        "# Odd.\ntasks: {posture: {kp: .nan}}\n"}) {
    const std::filesystem::path file = TestFile("profile.yaml", text);
    try {
      Diagnose("robot/models/humanoid.urdf", LoadProfile(file));
      ADD_FAILURE() << text;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.finding().line, 2) << refusal.what();
      EXPECT_EQ(std::string(refusal.what()).find(file.string() + ":2: "), 0u);
    }
  }
}

TEST(WriteJson, HasTheKeysOfTheFormatForAnyRobotName) {
  const Diagnosis diagnosis =
      Examine(std::string("<robot name='\"\\ \xc3\xa9'><link name='a'>") +
              kInertial + "</link></robot>");
  const nlohmann::json json = nlohmann::json::parse(WriteJson(diagnosis));
  EXPECT_EQ(json["verdict"], "ok");
  EXPECT_EQ(json["robot"]["total_mass"], 1);
  for (const auto& finding : json["findings"]) {
    for (const char* key : {"severity", "where", "what", "why"}) {
      EXPECT_TRUE(finding[key].is_string()) << key;
    }
  }
}

TEST(WriteTable, ShowsRobotFindingsAndVerdict) {
  const std::string table =
      WriteTable(Examine(Chain({kInertial, ""}, {"0 0 1"})));
  EXPECT_NE(table.find("robot    'chain', root '0', 2 links, 1 moving joints"),
            std::string::npos)
      << table;
  EXPECT_NE(
      table.find(
          "warn     robot: has 1 joint that moves no mass of its own: 'j1'"),
      std::string::npos)
      << table;
  EXPECT_EQ(table.find("verdict  warn\nstands   no: "), 0u) << table;
}

// Each case changes one part of a good robot file.
TEST(Diagnose, GivesTheVerdictOfTheWorstFault) {
  const std::string good = Chain({kInertial, kInertial}, {"0 0 1"});
  const struct {
    const char* old_text;
    const char* new_text;
    const char* verdict;
  } cases[] = {
      {"<robot", "<robot", "ok"},
      {"ixx='0.1'", "ixx='-0.1'", "warn"},
      {"ixx='0.1'", "ixx='1e9'", "warn"},
      {"ixx='0.1'", "ixx='nan'", "reject"},
      {"ixx='0.1'", "ixx='1,0'", "reject"},
      {"value='1'", "value='inf'", "reject"},
      {"value='1'", "value='-1'", "reject"},
      {"axis xyz='0 0 1'", "axis xyz='0 0 5'", "ok"},
      {"axis xyz='0 0 1'", "axis xyz='0 0 1e-300'", "warn"},
      {"axis xyz='0 0 1'", "axis xyz='0 0'", "reject"},
      {"lower='-1'", "lower='1'", "warn"},
      {"lower='-1' upper='1'", "lower='-10' upper='10'", "ok"},
      {"lower='-1' upper='1'", "lower='-90' upper='90'", "warn"},
      {"lower='-1'", "", "warn"},
      {"effort='9'", "effort='-9'", "reject"},
      {"effort='9'", "effort='0'", "warn"},
      {"velocity='9'", "velocity='-9'", "warn"},
      {"ixx='0.1'", "ixx='0.1' Ixx='0.2'", "warn"},
      {"<limit", "<limits/><limit", "warn"},
      {"value='1'", "value='1e29'", "warn"},
      {"<limit", "<mimic joint='j1'/><limit", "reject"},
      {"revolute", "planar", "reject"},
      {"link='0'/>", "link='none'/>", "reject"},
      {"</robot>", "<loop_joint name='l'/></robot>", "ok"},
      {"</robot>", "<typo/></robot>", "ok"},
      {"</robot>", "<xacro:imu_sensor name='pelvis'/></robot>", "warn"},
      {"</robot>", "<xacro:leg_link side='left'/></robot>", "reject"},
      {"</robot>", "", "reject"},
      {"</robot>", "</robot><robot name='b'/>", "reject"},
  };
  for (const auto& [old_text, new_text, verdict] : cases) {
    std::string text = good;
    text.replace(text.find(old_text), std::string(old_text).size(), new_text);
    const Diagnosis diagnosis = Examine(text);
    EXPECT_EQ(VerdictWord(diagnosis), verdict) << new_text << "\n"
                                               << Findings(diagnosis);
  }
}

TEST(WriteTable, NamesThreeFindingsOfAKind) {
  Diagnosis diagnosis;
  for (int i = 0; i < 114; ++i) {
    diagnosis.findings.push_back({Severity::kWarn, "link " + std::to_string(i),
                                  "has odd moments", "none may be larger", 0});
  }
  EXPECT_NE(WriteTable(diagnosis).find(
                "warn     link 0: has odd moments, none may be larger; also "
                "link 1, link 2, link 3 and 110 more\n"),
            std::string::npos)
      << WriteTable(diagnosis);
  EXPECT_NE(WriteTable(diagnosis).find("warnings 114 in 1 line, first link 0"),
            std::string::npos);
}

TEST(WriteTable, AnswersInItsFirstTenLines) {
  Diagnosis diagnosis = Diagnose("robot/models/humanoid.urdf");
  diagnosis.next_step = NextStep(diagnosis, {"my robot.urdf", "", {"a"}});
  std::istringstream table(WriteTable(diagnosis));
  const char* starts[] = {"verdict  ok",
                          "stands   yes",
                          "sole     left_foot: ",
                          "sole     right_foot: ",
                          "forward  +x of ",
                          "warnings 0",
                          "next     bazel run //tools:push -- --scenario stand "
                          "--robot 'my robot.urdf' --package-path a"};
  std::string line;
  for (const char* start : starts) {
    std::getline(table, line);
    EXPECT_EQ(line.find(start), 0u) << line << "\n" << start;
  }
}

// Both feet of this robot have no shapes.
TEST(WriteTable, ShowsTheGuessThatTheUserMustCorrect) {
  std::string text = HumanoidText();
  for (const char* name : {"<collision", "<visual"}) {
    for (size_t at = text.find(name); at != std::string::npos;
         at = text.find(name, at)) {
      const std::string end = "</" + std::string(name + 1) + ">";
      text.erase(at, text.find(end, at) + end.size() - at);
    }
  }
  Diagnosis diagnosis = Examine(text);
  EXPECT_EQ(diagnosis.soles.at(0).from, "guess");
  diagnosis.next_step = NextStep(diagnosis, {"robot.urdf", "", {}});
  EXPECT_NE(diagnosis.next_step.find("--save-profile robot.yaml"),
            std::string::npos)
      << diagnosis.next_step;
  std::istringstream table(WriteTable(diagnosis));
  std::string line, stub;
  for (int i = 0; i < 10 && std::getline(table, line); ++i) {
    if (line.find("feet:") == 0 || line.find("  ") == 0) stub += line + "\n";
  }
  // The stub is a profile, and it describes the same soles.
  const Diagnosis again = Diagnose(TestFile("robot.urdf", text),
                                   LoadProfile(TestFile("stub.yaml", stub)));
  ASSERT_EQ(again.soles.size(), 2u) << stub;
  for (const int i : {0, 1}) {
    EXPECT_EQ(again.soles[i].from, "guess");  // Until the user measures it.
    EXPECT_LT((again.soles[i].xyz - diagnosis.soles[i].xyz).norm(), 1e-5);
    // The stub has six digits.
    EXPECT_NEAR(again.soles[i].length, diagnosis.soles[i].length, 1e-5);
  }
  // The saved profile keeps the origin of the soles, so the warning stays.
  const std::filesystem::path found = TestFile("found.yaml", diagnosis.profile);
  Diagnosis saved = Diagnose(TestFile("robot.urdf", text), LoadProfile(found));
  EXPECT_EQ(saved.soles.at(0).from, "guess");
  EXPECT_EQ(VerdictWord(saved), "warn");
  EXPECT_NE(Findings(saved).find("is a guess, by line"), std::string::npos)
      << Findings(saved);
  saved.next_step = NextStep(saved, {"robot.urdf", "found.yaml", {}});
  EXPECT_EQ(saved.next_step,
            "bazel run //tools:doctor -- robot.urdf --profile found.yaml  # "
            "after you have measured the soles, corrected them in found.yaml, "
            "and removed `from: guess`");
}

TEST(ProfileStub, HasNoRoundingErrors) {
  Diagnosis diagnosis;
  diagnosis.soles.assign(2, {"foot",
                             "ankle",
                             0.2,
                             0.1,
                             {0.05, -1e-9, -0.04},
                             {2.4e-16, -3e-17, 1.5},
                             "guess",
                             0.04});
  diagnosis.soles[1].link = "a # {b}, c";
  const std::vector<std::string> stub = ProfileStub(diagnosis);
  ASSERT_EQ(stub.size(), 3u);
  EXPECT_EQ(stub[1],
            "  foot: {frame: ankle, xyz: [0.05, 0, -0.04], rpy: [0, 0, 1.5], "
            "size: [0.2, 0.1], from: guess}");
  const YAML::Node feet = YAML::Load(stub[0] + "\n" + stub[2])["feet"];
  EXPECT_EQ(feet["foot"]["frame"].as<std::string>(), "a # {b}, c");
}

TEST(NextStep, SaysHowToExpandXacro) {
  for (const char* name : {"robot.xacro", "robot.urdf.xacro"}) {
    const Diagnosis diagnosis = Diagnose(
        TestFile(name, "<robot name='r'><xacro:leg side='l'/></robot>"));
    EXPECT_EQ(VerdictWord(diagnosis), "reject");
    EXPECT_EQ(NextStep(diagnosis, {name, "", {}}),
              std::string("xacro ") + name +
                  " > robot.urdf && bazel run //tools:doctor -- robot.urdf");
  }
}

// The links of the legs would come from the ignored element.
TEST(NextStep, SaysHowToExpandXacroInAFileWithAnotherError) {
  const Diagnosis diagnosis = Examine(
      "<robot name='r'><link name='base'/><xacro:leg side='l'/></robot>");
  EXPECT_EQ(VerdictWord(diagnosis), "reject");
  EXPECT_EQ(NextStep(diagnosis, {"robot.urdf", "", {}}),
            "xacro robot.urdf > expanded.urdf && bazel run //tools:doctor -- "
            "expanded.urdf");
}

TEST(NextStep, CallsTheFunctionsOfPythonThatDoTheSame) {
  Diagnosis diagnosis;
  diagnosis.stands = diagnosis.was_tested = true;
  diagnosis.soles.resize(2);
  const Arguments arguments = {
      "it's.urdf", "mine.yaml", {"a", "b"}, Caller::kPython};
  EXPECT_EQ(NextStep(diagnosis, arguments),
            "poise.run('stand', poise.Robot.load('it\\'s.urdf', "
            "profile='mine.yaml', packages=['a', 'b']))");
  diagnosis.soles[0].from = "guess";
  EXPECT_EQ(NextStep(diagnosis, {"a.urdf", "", {}, Caller::kPython}),
            "open('a.yaml', 'w').write(poise.doctor('a.urdf').profile)  # then "
            "measure the soles and correct them in 'a.yaml'");
  diagnosis.is_xacro = true;
  diagnosis.findings = {{Severity::kReject, "link 'a'", "is odd", "must", 0}};
  EXPECT_EQ(NextStep(diagnosis, {"a.xacro", "", {}, Caller::kPython}),
            "poise.doctor('a.urdf')  # after this command in a shell: xacro "
            "a.xacro > a.urdf");
}

TEST(NextStep, OffersTheDynamicsOfARobotWithoutLegs) {
  const Diagnosis diagnosis =
      Examine(std::string("<robot name='r'><link name='base'>") + kInertial +
              "</link></robot>");
  EXPECT_EQ(VerdictWord(diagnosis), "ok");
  EXPECT_EQ(
      NextStep(diagnosis, {"robot.urdf", "", {}}),
      "bazel run //tools:dynamics -- --urdf robot.urdf --states STATES.json  # "
      "the dynamics alone: balance needs two legs");
}

TEST(Diagnose, WarnsIfARobotWithLegsDoesNotStand) {
  const std::string text = HumanoidText();
  std::string rigid = text;
  // A knee that is always bent makes one leg shorter than the other can be.
  const size_t at =
      rigid.find("lower=\"", rigid.find("<joint name=\"l_knee\""));
  rigid.replace(at, rigid.find(' ', rigid.find("upper=", at)) - at,
                "lower=\"2.2\" upper=\"2.2\"");
  const size_t other =
      rigid.find("lower=\"", rigid.find("<joint name=\"r_knee\""));
  rigid.replace(other, rigid.find(' ', rigid.find("upper=", other)) - other,
                "lower=\"0\" upper=\"0\"");
  const Diagnosis diagnosis = Examine(rigid);
  EXPECT_FALSE(diagnosis.stands);
  EXPECT_EQ(VerdictWord(diagnosis), "warn");
  EXPECT_EQ(diagnosis.findings[0].what, "does not stand")
      << Findings(diagnosis);
}

TEST(WriteTable, SaysHowManyLinesItOmits) {
  Diagnosis diagnosis;
  diagnosis.links.resize(1003, {"l", 1});
  diagnosis.findings.resize(1002, {Severity::kNote, "", "odd", "", 0});
  EXPECT_EQ(WriteTable(diagnosis).find("... and 3 more\n"), std::string::npos);
  const std::string table = WriteTable(diagnosis, /*masses=*/true);
  EXPECT_NE(table.find("... and 3 more\n"), std::string::npos);
  EXPECT_NE(table.find("... and 2 more\n"), std::string::npos);
  const auto json = nlohmann::json::parse(WriteJson(diagnosis));
  EXPECT_EQ(json["findings"].size(), 1000u);
  EXPECT_EQ(json["findings_left_out"], 2);
}

TEST(Diagnose, AgreesWithBulletOnRealRobots) {
  const auto folder = SharedData("robots");
  if (!folder) GTEST_SKIP() << "the shared robot files are missing";
  for (const char* name : {"atlas", "booster_t1", "draco3", "g1_29dof",
                           "icub_erd_reduced", "jvrc1", "talos_reduced"}) {
    const Diagnosis diagnosis =
        Diagnose(*folder / (std::string(name) + ".urdf"));
    EXPECT_NE(VerdictWord(diagnosis), "reject") << name;
    EXPECT_TRUE(diagnosis.com_height.has_value()) << name;
    EXPECT_LT(diagnosis.parity.value(), 1e-9) << name;
  }
  const auto reason = [&](const char* name) {
    return Findings(Diagnose(*folder / name));
  };
  EXPECT_NE(reason("cassie.urdf").find("LeftTarsusPitch"), std::string::npos)
      << reason("cassie.urdf");
  EXPECT_NE(reason("solo12.urdf").find("reaches the ground with 4 bodies"),
            std::string::npos)
      << reason("solo12.urdf");
}

TEST(Diagnose, JudgesHostileFilesAsExpected) {
  const auto folder = SharedData("urdf_hostile");
  if (!folder) GTEST_SKIP() << "the shared hostile files are missing";
  std::ifstream stream(*folder / "EXPECTED.json");
  const nlohmann::json all = nlohmann::json::parse(stream);
  for (const auto& [name, expected] : all.items()) {
    std::string verdict = VerdictWord(Diagnose(*folder / name));
    if (verdict == "ok") verdict = "accept";
    std::transform(verdict.begin(), verdict.end(), verdict.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    const auto& verdicts = expected["verdict"];
    EXPECT_NE(std::find(verdicts.begin(), verdicts.end(), verdict),
              verdicts.end())
        << name << " is " << verdict;
  }
}

}  // namespace
}  // namespace poise
