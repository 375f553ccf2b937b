// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/save_profile.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/rpy.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

const char kUrdf[] = "robot/models/humanoid.urdf";

std::string TextOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

TEST(SaveProfile, MakesTheSameRobot) {
  const Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  const Robot robot = LoadRobot(kUrdf, profile);
  const auto file = TestFile("saved.yaml", "");
  SaveProfile(robot, profile, file);
  const Robot again = LoadRobot(kUrdf, LoadProfile(file));
  EXPECT_TRUE(again.can_stand);
  const double written = 1e-8;  // Nine digits.
  EXPECT_LT((again.q_nominal - robot.q_nominal).norm(), written);
  for (const int i : {0, 1}) {
    EXPECT_EQ(again.feet[i].name, robot.feet[i].name);
    EXPECT_EQ(again.feet[i].frame, robot.feet[i].frame);
    EXPECT_LT((again.feet[i].X_BC.p - robot.feet[i].X_BC.p).norm(), written);
    EXPECT_LT((again.feet[i].X_BC.R - robot.feet[i].X_BC.R).norm(), written);
    EXPECT_LT((again.feet[i].half_size - robot.feet[i].half_size).norm(),
              written);
  }
}

// Returns a profile in which the base is pitched. The hips compensate the
// pitch, so that the legs keep their orientation.
Profile MakeLeaningProfile(double pitch) {
  Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  const Robot robot = LoadRobot(kUrdf, profile);
  const Tree& tree = robot.model.tree;
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, robot.q_nominal, &X_WB);
  profile.base_rpy = {0, pitch, 0};
  for (int j = 0; j < tree.num_joints(); ++j) {
    const std::string& name = tree.joints()[j].name;
    if (name != "l_hip_pitch" && name != "r_hip_pitch") continue;
    profile.joints.at(name).value -= pitch;
    // The base moves so that the hips keep their position.
    const Eigen::Vector3d p_BH = X_WB[j + 1].p - X_WB[0].p;
    Eigen::Vector3d p_WB =
        X_WB[j + 1].p - MatrixFromRpy(profile.base_rpy) * p_BH;
    p_WB.y() = 0;
    profile.base_xyz = p_WB;
  }
  return profile;
}

TEST(SaveProfile, KeepsOrientationOfALeaningBase) {
  constexpr double kPitch = 0.1;
  const Profile profile = MakeLeaningProfile(kPitch);
  const Robot robot = LoadRobot(kUrdf, profile);
  const Eigen::Vector4d wanted(0, std::sin(kPitch / 2), 0,
                               std::cos(kPitch / 2));  // x, y, z, w.
  EXPECT_LT((robot.q_nominal.segment<4>(3) - wanted).norm(), 1e-12);
  const auto file = TestFile("leaning.yaml", "");
  SaveProfile(robot, profile, file);
  const Robot again = LoadRobot(kUrdf, LoadProfile(file));
  EXPECT_LT((again.q_nominal - robot.q_nominal).norm(), 1e-8);  // Nine digits.
}

TEST(SaveProfile, KeepsLockedJointsMimicPolicyAndTasks) {
  const Profile profile = LoadProfile(TestFile(
      "given.yaml",
      "locked: {neck_yaw: 0.25}\nmimic: coupled\ntasks: {com: {rank: 4}}"));
  const auto file = TestFile("saved.yaml", "");
  SaveProfile(LoadRobot(kUrdf, profile), profile, file);
  const Profile again = LoadProfile(file);
  EXPECT_FALSE(again.base_xyz.has_value());
  EXPECT_EQ(again.locked.at("neck_yaw").value, 0.25);
  EXPECT_EQ(again.mimic, MimicPolicy::kCoupled);
  EXPECT_EQ(again.tasks["com"]["rank"].as<int>(), 4);
}

TEST(SaveProfile, KeepsTheSides) {
  const Profile profile = LoadProfile(
      TestFile("sides.yaml", "forward: -x\nleft: r_foot\nright: l_foot\n"));
  const auto file = TestFile("saved.yaml", "");
  const Robot robot = LoadRobot(kUrdf, profile);
  SaveProfile(robot, profile, file);
  const Profile again = LoadProfile(file);
  EXPECT_EQ(again.sides.forward.text, "-x");
  EXPECT_EQ(again.sides.left.text, "r_foot");
  EXPECT_EQ(again.sides.right.text, "l_foot");
  EXPECT_EQ(LoadRobot(kUrdf, again).feet[0].body, robot.feet[0].body);
}

// In YAML, a key on one line has at most 1024 characters.
TEST(SaveProfile, KeepsNamesOfAnyLength) {
  const std::string name(1100, 'n');
  Profile profile;
  profile.locked[name] = {0.5, 0};
  const Robot robot = LoadRobot(kUrdf);
  const auto file = TestFile("long.yaml", "");
  SaveProfile(robot, profile, file);
  EXPECT_EQ(LoadProfile(file).locked.at(name).value, 0.5);
}

TEST(SaveProfile, KeepsPostureFoundOnlyIfTheProfileGaveTheBase) {
  Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  const Robot robot = LoadRobot(kUrdf, profile);
  profile.posture_found = "measured";
  const auto file = TestFile("found.yaml", "");
  SaveProfile(robot, profile, file);
  EXPECT_EQ(LoadProfile(file).posture_found, "measured");
  profile.base_xyz.reset();
  SaveProfile(robot, profile, file);
  EXPECT_NE(LoadProfile(file).posture_found, "measured");
}

TEST(SaveProfile, DoesNotOverwriteTheProfileThatWasRead) {
  const auto file = TestFile("mine.yaml", "# Mine.\nmimic: free\n");
  const Profile profile = LoadProfile(file);
  EXPECT_THROW(SaveProfile(LoadRobot(kUrdf, profile), profile, file),
               std::invalid_argument);
  EXPECT_EQ(TextOf(file), "# Mine.\nmimic: free\n");
}

TEST(SaveProfile, NamesTheFileThatIsNotWritable) {
  const Profile profile;
  const Robot robot = LoadRobot(kUrdf, profile);
  const auto file = TestFile("plain", "") / "saved.yaml";  // "plain" is a file.
  try {
    SaveProfile(robot, profile, file);
    ADD_FAILURE() << "SaveProfile() did not throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(),
              file.string() + ": cannot be written: Not a directory");
  }
}

}  // namespace
}  // namespace poise
