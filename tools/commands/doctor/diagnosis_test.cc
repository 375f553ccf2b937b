// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "poise/tests/util/shared_data.h"
#include "poise/tests/util/test_file.h"
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

Diagnosis Examine(const std::string& text) {
  return Diagnose(TestFile("robot.urdf", text));
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
}

TEST(Diagnose, ExaminesTheRobotWithoutItsLockedJoints) {
  // The joints of a massless head make M singular, unless they are locked.
  std::string text = HumanoidText();
  for (const char* link : {"<link name=\"neck\"", "<link name=\"head\""}) {
    const size_t start = text.find("<inertial>", text.find(link));
    text.erase(start, text.find("</inertial>", start) + 11 - start);
  }
  const Diagnosis whole = Examine(text);
  EXPECT_NE(Findings(whole).find("moves no mass"), std::string::npos);
  EXPECT_FALSE(whole.parity.has_value());
  const Diagnosis reduced =
      Diagnose(TestFile("robot.urdf", text),
               LoadProfile(TestFile(
                   "locked.yaml", "locked: {neck_yaw: 0.1, neck_pitch: 0}\n")));
  EXPECT_EQ(Findings(reduced).find("moves no mass"), std::string::npos);
  EXPECT_NE(Findings(reduced).find("has 2 joints locked by the profile, M, "
                                   "standing and parity are computed with the "
                                   "48 other joints"),
            std::string::npos)
      << Findings(reduced);
  EXPECT_LT(reduced.parity.value(), 1e-9);
}

TEST(Diagnose, WarnsOfSingularMassMatrix) {
  const Diagnosis leaf =
      Examine(Chain({kInertial, kInertial, ""}, {"0 0 1", "0 1 0"}));
  EXPECT_EQ(VerdictWord(leaf), "warn");
  EXPECT_NE(Findings(leaf).find("joint 'j2': moves no mass"), std::string::npos)
      << Findings(leaf);
  const Diagnosis collinear =
      Examine(Chain({kInertial, "", kInertial}, {"0 0 1", "0 0 1"}));
  EXPECT_EQ(VerdictWord(collinear), "warn");
  EXPECT_NE(Findings(collinear).find("makes M singular"), std::string::npos);
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

TEST(Diagnose, SkipsMassMatrixAbove500Joints) {
  const Diagnosis diagnosis =
      Examine(Chain(std::vector<std::string>(602, kInertial),
                    std::vector<std::string>(601, "0 0 1")));
  EXPECT_EQ(VerdictWord(diagnosis), "ok");
  EXPECT_NE(Findings(diagnosis).find("M was not computed"), std::string::npos);
}

// Each foot has 80 000 corners, so the search for the sole must be fast.
TEST(Diagnose, ExaminesFeetWithThousandsOfShapes) {
  std::string feet;
  for (int i = 0; i < 4990; ++i) {
    feet += "<collision><origin rpy='0 0 " + std::to_string(i * 1e-4) +
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
  // Takes less than a second.
  const Diagnosis diagnosis = Examine(text + "</robot>");
  EXPECT_EQ(VerdictWord(diagnosis), "ok") << Findings(diagnosis);
  ASSERT_EQ(diagnosis.soles.size(), 2u);
  // The sole is a circle with a radius of 0.1 m.
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
  EXPECT_NE(table.find("warn     joint 'j1': moves no mass"),
            std::string::npos);
  EXPECT_NE(table.find("verdict  warn"), std::string::npos);
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

TEST(WriteTable, SaysHowManyLinesItOmits) {
  Diagnosis diagnosis;
  diagnosis.links.resize(1003, {"l", 1});
  diagnosis.findings.resize(1002, {Severity::kNote, "", "odd", "", 0});
  const std::string table = WriteTable(diagnosis);
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
  EXPECT_NE(reason("cassie.urdf").find("has no flat sole"), std::string::npos)
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
