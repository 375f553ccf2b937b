// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/find_profile.h"

#include <gtest/gtest.h>

#include <fstream>
#include <utility>

namespace poise {
namespace {

namespace fs = std::filesystem;

class FindProfileTest : public testing::Test {
 protected:
  FindProfileTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "robots");
    for (const char* name : {"g1.yaml", "g1_29dof.yaml", "t1.yaml", "t.txt"}) {
      std::ofstream(folder_ / name) << "mimic: free\n";
    }
  }
  std::string Find(const std::string& name, const std::string& urdf) const {
    return FindProfile(name, folder_ / "robots" / urdf, folder_)
        .filename()
        .string();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "profiles";
};

TEST_F(FindProfileTest, FindsByTheNameOfTheRobotOrOfTheFile) {
  EXPECT_EQ(Find("T1", "booster.urdf"), "t1.yaml");
  EXPECT_EQ(Find("robot", "t1.urdf"), "t1.yaml");
  EXPECT_EQ(Find("t1_walker", "a.urdf"), "t1.yaml");
}

TEST_F(FindProfileTest, PrefersTheLongestName) {
  EXPECT_EQ(Find("g1_29dof_rev_1_0", "a.urdf"), "g1_29dof.yaml");
  EXPECT_EQ(Find("g1_23dof", "a.urdf"), "g1.yaml");
}

TEST_F(FindProfileTest, IgnoresNamesThatShareOnlyPartOfAWord) {
  EXPECT_EQ(Find("t12", "t.urdf"), "");
  EXPECT_EQ(Find("", "t.urdf"), "");
  EXPECT_EQ(Find("my_t1", "my_g1.urdf"), "");
}

TEST_F(FindProfileTest, PrefersTheFileBesideTheUrdf) {
  std::ofstream(folder_ / "robots" / "booster.yaml") << "mimic: free\n";
  EXPECT_EQ(Find("T1", "booster.urdf"), "booster.yaml");
}

TEST_F(FindProfileTest, ReturnsAnEmptyPathWithoutAFolder) {
  EXPECT_EQ(FindProfile("t1", "t1.urdf", folder_ / "none"), "");
}

// Each robot for which robot/profiles has a profile.
TEST(FindProfile, FindsOurProfiles) {
  const std::pair<const char*, std::pair<const char*, const char*>> ours[] = {
      {"atlas", {"atlas", "atlas"}},
      {"draco3", {"draco_3", "draco3"}},
      {"g1", {"g1_29dof_rev_1_0", "g1_29dof"}},
      {"hrp4c", {"HRP4", "hrp4c"}},
      {"humanoid", {"humanoid", "humanoid"}},
      {"icub", {"iCub", "icub_erd_reduced"}},
      {"jvrc1", {"jvrc1", "jvrc1"}},
      {"t1", {"T1", "booster_t1"}},
      {"talos", {"talos", "talos_reduced"}}};
  for (const auto& [profile, robot] : ours) {
    EXPECT_EQ(FindProfile(robot.first, std::string(robot.second) + ".urdf"),
              std::string("robot/profiles/") + profile + ".yaml");
  }
  EXPECT_EQ(FindProfile("simple_humanoid", "simple_humanoid.urdf"), "");
}

}  // namespace
}  // namespace poise
