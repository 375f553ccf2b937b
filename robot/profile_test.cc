// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/profile.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "robot/rpy.h"
#include "robot/save_profile.h"

namespace poise {
namespace {

const char kUrdf[] = "robot/models/humanoid.urdf";

std::filesystem::path TestFile(const std::string& name,
                               const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(std::getenv("TEST_TMPDIR")) / name;
  std::ofstream(file) << text;
  return file;
}

Profile Parse(const std::string& text) {
  return LoadProfile(TestFile("profile.yaml", text));
}

// The message, from the line number on.
std::string Refusal(const std::string& text) {
  try {
    LoadRobot(kUrdf, Parse(text));
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const size_t at = message.find("profile.yaml:");
    return at == std::string::npos ? message : message.substr(at + 13);
  }
  return "accepted";
}

TEST(LoadProfile, ReadsAllItMayHold) {
  const Profile profile = Parse(R"(
feet:
  left_foot: {frame: l_foot, xyz: [1, 2, 3], rpy: [0.1, 0.2, 0.3], size: [4, 2]}
  right_foot: {frame: r_foot, polygon: [[0, 0], [1, 0], [0, 1]]}
posture:
  found: somehow
  base: {xyz: [0, 0, 0.7], rpy: [0, 0.1, 0]}
  joints: {l_knee: 0.5}
locked: {neck_yaw: 0.25}
mimic: coupled
tasks:
  com: {rank: 4}
)");
  ASSERT_EQ(profile.feet.size(), 2u);
  const SoleProfile& left = profile.feet[0];
  EXPECT_EQ(left.name, "left_foot");
  EXPECT_EQ(left.frame, "l_foot");
  EXPECT_EQ(left.X_FS.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(left.X_FS.R, RotationFromRpy({0.1, 0.2, 0.3}));
  ASSERT_EQ(left.sole_S.size(), 4u);
  EXPECT_EQ(left.sole_S[0], Eigen::Vector2d(-2, -1));
  EXPECT_EQ(left.sole_S[3], Eigen::Vector2d(2, 1));
  EXPECT_EQ(profile.feet[1].sole_S.size(), 3u);
  EXPECT_EQ(profile.base_xyz.value(), Eigen::Vector3d(0, 0, 0.7));
  EXPECT_EQ(profile.base_rpy, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(profile.posture_found, "somehow");
  EXPECT_EQ(profile.joints.at("l_knee").value, 0.5);
  EXPECT_EQ(profile.locked.at("neck_yaw").value, 0.25);
  EXPECT_EQ(profile.mimic, MimicPolicy::kCoupled);
  EXPECT_EQ(profile.tasks["com"]["rank"].as<int>(), 4);
  EXPECT_EQ(profile.tasks["com"].Mark().line + 1, 12);
}

TEST(LoadProfile, NamesTheLineOfWhatIsWrong) {
  const std::string feet =
      "feet:\n"
      "  left_foot: {frame: l_sole, size: [1, 1]}\n"
      "  right_foot: {frame: r_sole, size: [1, 1]}\n";
  EXPECT_EQ(Refusal("\nfeets: {}"),
            "2: a profile: unknown key 'feets', must be one of feet locked "
            "mimic posture tasks");
  EXPECT_EQ(Refusal("a"), "1: a profile must be a map");
  EXPECT_EQ(Refusal("feet:\n  left_foot: {frame: l_sole, size: [1, 1]}"),
            "2: feet: no right_foot");
  EXPECT_EQ(Refusal("feet: {left_foot: {size: [1, 1]}}"),
            "1: feet.left_foot: must have a frame, a link");
  EXPECT_EQ(Refusal(feet + "mimic: maybe"),
            "4: mimic is 'maybe', must be free, coupled or locked");
  EXPECT_EQ(Refusal(feet + "locked:\n  neck_yaw: a"),
            "5: locked.neck_yaw must be a finite number");
  EXPECT_EQ(Refusal(feet + "posture:\n  joints:\n    l_knee: .nan"),
            "6: posture.joints.l_knee must be a finite number");
  EXPECT_EQ(Refusal(feet + "posture:\n  joints: {no_joint: 0}"),
            "5: posture.joints: the robot has no moving joint 'no_joint'");
  EXPECT_EQ(Refusal(feet + "posture:\n  base: {rpy: [0, 0, 0]}"),
            "5: posture.base: must have xyz");
  EXPECT_EQ(Refusal(feet + "posture:\n  base: {xyz: [0, 0]}"),
            "5: posture.base.xyz must be 3 numbers");
  EXPECT_EQ(Refusal("feet:\n  left_foot: {frame: l, size: [1, 1]}\n"
                    "  right_foot: {frame: r, size: [1, 1]}\n"),
            "2: feet.left_foot: the robot has no link 'l'");
  EXPECT_EQ(Refusal("feet:\n  left_foot: {frame: l, size: [1, 0]}\n"
                    "  right_foot: {frame: r, size: [1, 1]}\n"),
            "2: feet.left_foot.size must be positive");
  EXPECT_EQ(Refusal("feet:\n  left_foot: {frame: l}\n"
                    "  right_foot: {frame: r, size: [1, 1]}\n"),
            "2: feet.left_foot: must have either size or polygon");
}

TEST(LoadProfile, NamesAFileThatIsNotThere) {
  EXPECT_THROW(LoadProfile("no/such.yaml"), std::invalid_argument);
}

TEST(LoadRobot, LocksJoints) {
  const Robot robot = LoadRobot(kUrdf, Parse("locked: {neck_yaw: 0.1}"));
  EXPECT_EQ(robot.model.tree.num_joints(), 49);
  EXPECT_FALSE(robot.model.tree.FindJoint("neck_yaw").has_value());
}

// Of two joints, one follows the other.
TEST(LoadRobot, DoesWithMimicsAsTheProfileSays) {
  std::ifstream stream(kUrdf);
  std::string urdf((std::istreambuf_iterator<char>(stream)), {});
  const std::string axis = "<axis xyz=\"0 0 1\"/>";
  const size_t at = urdf.find(axis, urdf.find("joint name=\"neck_yaw\""));
  urdf.insert(at, "<mimic joint='chest_yaw' multiplier='2' offset='0.5'/>");
  const auto file = TestFile("mimic.urdf", urdf);
  EXPECT_TRUE(LoadRobot(file, Parse("mimic: free")).model.mimics.empty());
  EXPECT_TRUE(LoadRobot(file).model.mimics.empty());
  const Robot coupled = LoadRobot(file, Parse("mimic: coupled"));
  ASSERT_EQ(coupled.model.mimics.size(), 1u);
  EXPECT_EQ(coupled.model.mimics[0].multiplier, 2);
  const Robot locked = LoadRobot(
      file, Parse("mimic: locked\nposture: {joints: {chest_yaw: 0.1}}"));
  EXPECT_EQ(locked.model.tree.num_joints(), 49);
  EXPECT_TRUE(locked.model.mimics.empty());
  const Frame& neck =
      locked.model.tree.frames()[locked.model.tree.FindFrame("neck").value()];
  EXPECT_LT((neck.X_BF.R - RotationFromRpy({0, 0, 2 * 0.1 + 0.5})).norm(),
            1e-12);
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

TEST(SaveProfile, KeepsWhatTheProfileSaid) {
  const Profile profile = Parse(
      "locked: {neck_yaw: 0.25}\nmimic: coupled\ntasks: {com: {rank: 4}}");
  const auto file = TestFile("saved.yaml", "");
  SaveProfile(LoadRobot(kUrdf, profile), profile, file);
  const Profile again = LoadProfile(file);
  EXPECT_FALSE(again.base_xyz.has_value());
  EXPECT_EQ(again.locked.at("neck_yaw").value, 0.25);
  EXPECT_EQ(again.mimic, MimicPolicy::kCoupled);
  EXPECT_EQ(again.tasks["com"]["rank"].as<int>(), 4);
}

TEST(Rpy, TurnsAboutXThenYThenZ) {
  Eigen::Matrix3d R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // About z.
  EXPECT_LT((RotationFromRpy({0, 0, M_PI / 2}) - R).norm(), 1e-15);
  // Roll first: x stays, y becomes z; then yaw leaves z.
  const Eigen::Vector3d y = RotationFromRpy({M_PI / 2, 0, 1}).col(1);
  EXPECT_LT((y - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Rpy, ComesBack) {
  for (const double pitch : {-M_PI / 2, -1.0, 0.0, 0.5, M_PI / 2}) {
    const Eigen::Matrix3d R = RotationFromRpy({0.4, pitch, -2});
    EXPECT_LT((RotationFromRpy(RpyFromRotation(R)) - R).norm(), 1e-12) << pitch;
  }
  const Eigen::Vector3d rpy(0.4, 0.5, -2);
  EXPECT_LT((RpyFromRotation(RotationFromRpy(rpy)) - rpy).norm(), 1e-14);
}

}  // namespace
}  // namespace poise
