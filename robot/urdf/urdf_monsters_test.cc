// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

// Tests the URDF loader with files that are extremely large, deeply nested or
// broken. The loader must return a robot, or throw an error of one line.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/shared_data.h"

namespace poise {
namespace {

const char kInertial[] =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
    "iyz='0' izz='1'/></inertial>";

// Returns the URDF of a robot with a root and `links` more links. A joint of
// the given type connects each link to the previous link, or to the root if
// is_star.
std::string Many(int links, const std::string& type, bool is_star) {
  std::string text =
      std::string("<robot name='r'><link name='0'>") + kInertial + "</link>";
  for (int i = 1; i <= links; ++i) {
    const std::string name = std::to_string(i);
    const std::string parent = std::to_string(is_star ? 0 : i - 1);
    text += "<link name='" + name + "'>" + kInertial + "</link><joint name='" +
            name + "' type='" + type + "'><parent link='" + parent +
            "'/><child link='" + name +
            "'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
  }
  return text + "</robot>";
}

std::string Repeat(const std::string& text, int times) {
  std::string repeated;
  for (int i = 0; i < times; ++i) repeated += text;
  return repeated;
}

// Returns the URDF of a robot with one link. The link contains `text`.
std::string With(const std::string& text) {
  return std::string("<robot name='r'><link name='a'>") + kInertial + text +
         "</link></robot>";
}

std::string Rejection(const std::string& text) {
  try {
    ParseUrdf(text, "file");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Monsters, LoadsLongChainsAndWideStars) {
  for (const bool is_star : {false, true}) {
    const RobotModel fixed = ParseUrdf(Many(20'000, "fixed", is_star), "file");
    EXPECT_EQ(fixed.tree.num_joints(), 0);
    EXPECT_EQ(fixed.tree.frames().size(), 20'001u);
    EXPECT_EQ(fixed.tree.total_mass(), 20'001);
    const RobotModel moving =
        ParseUrdf(Many(5'000, "revolute", is_star), "file");
    EXPECT_EQ(moving.tree.num_joints(), 5'000);
  }
}

TEST(Monsters, LoadsAHugeComment) {
  EXPECT_EQ(
      ParseUrdf(With("<!--" + std::string(100'000'000, '-') + "-->"), "file")
          .tree.num_bodies(),
      1);
}

TEST(Monsters, RefusesTooMuchMarkupBeforeParsing) {
  const std::string too_much =
      "file:1: has more than 16 MiB without comments, must have less";
  EXPECT_EQ(Rejection(With(std::string(20'000'000, 'x'))), too_much);
  EXPECT_EQ(Rejection(With(Repeat("<!---->", 4'000'000))), too_much);
  EXPECT_EQ(Rejection(With(Repeat("<a/>", 5'000'000))), too_much);
  std::string attributes;
  for (int i = 0; i < 2'000; ++i) {
    attributes += " a" + std::to_string(i) + "=''";
  }
  EXPECT_EQ(Rejection("<robot" + attributes + "/>"),
            "file:1: an element has more than 100 attributes, must have fewer");
  EXPECT_EQ(Rejection("<robot name='r'>" +
                      [] {
                        std::string links;
                        for (int i = 0; i <= 100'000; ++i) {
                          links += "<link name='" + std::to_string(i) + "'/>";
                        }
                        return links;
                      }() +
                      "</robot>"),
            "file:1: <robot>: has 100001 links, must have at most 100000");
}

TEST(Monsters, RefusesDeepNesting) {
  EXPECT_EQ(Rejection(With(Repeat("<a>", 100'000))),
            "file:1: elements are nested more than 100 levels deep");
}

TEST(Monsters, RefusesAFileThatEndsInsideMarkup) {
  const std::string open = "<robot name='r'>";
  for (const char* tail : {"<", "<a", "<a b='", "<!--", "<![CDATA[", "<?"}) {
    const std::string message = Rejection(open + tail);
    EXPECT_EQ(message.find("file:1: the file ends"), 0u) << tail << message;
  }
  EXPECT_EQ(Rejection(std::string(10'000'000, '<')),
            "file:1: the file ends inside a tag");
}

TEST(Monsters, RefusesEntities) {
  EXPECT_EQ(
      Rejection("<!DOCTYPE r [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>" +
                With("&b;")),
      "file:1: has a document type or entity declaration, must have none");
}

TEST(Monsters, HandlesManyFloatingOrMimicJoints) {
  EXPECT_NE(
      Rejection(Many(20'000, "floating", true)).find("joint '1': is floating"),
      std::string::npos);
  std::string text =
      std::string("<robot name='r'><link name='0'>") + kInertial + "</link>";
  for (int i = 1; i <= 20'000; ++i) {
    const std::string name = std::to_string(i);
    text +=
        "<link name='" + name + "'/><joint name='" + name +
        "' type='continuous'><parent link='0'/><child link='" + name + "'/>" +
        (i == 20'000 ? "" : "<mimic joint='" + std::to_string(i + 1) + "'/>") +
        "</joint>";
  }
  EXPECT_EQ(ParseUrdf(text + "</robot>", "file").mimics.size(), 19'999u);
}

// Each hostile file is loaded or rejected as expected.
TEST(Monsters, JudgesHostileFilesAsExpected) {
  const auto folder = SharedData("urdf_hostile");
  if (!folder) GTEST_SKIP() << "the shared data is missing";
  std::ifstream stream(*folder / "EXPECTED.json");
  const nlohmann::json all = nlohmann::json::parse(stream);
  int files = 0;
  for (const auto& [name, expected] : all.items()) {
    SCOPED_TRACE(name);
    ++files;
    bool may_load = false;
    bool may_be_rejected = false;
    for (const auto& verdict : expected["verdict"]) {
      (verdict == "REJECT" ? may_be_rejected : may_load) = true;
    }
    try {
      LoadUrdf(*folder / name);
      EXPECT_TRUE(may_load);
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(may_be_rejected) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(files, 0);
}

TEST(Monsters, LoadsRealRobots) {
  const auto folder = SharedData("robots");
  if (!folder) GTEST_SKIP() << "the shared data is missing";
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().filename());
    const RobotModel model = LoadUrdf(entry.path());
    EXPECT_GT(model.tree.total_mass(), 1);
    EXPECT_GT(model.tree.num_joints(), 4);
  }
}

// Sanitizers use more memory: the address sanitizer keeps freed memory, and the
// thread sanitizer doubles the memory. So the bound is not checked with them.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Checks the peak memory of the process after all tests.
class Memory : public testing::Environment {
  void TearDown() override {
    rusage usage;
    ASSERT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
    EXPECT_LT(usage.ru_maxrss, 1L << 20)
        << "the peak memory in KiB is above 1 GiB";
  }
};

[[maybe_unused]] const auto* const kMemory =
    testing::AddGlobalTestEnvironment(new Memory);
#endif

}  // namespace
}  // namespace poise
