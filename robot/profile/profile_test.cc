// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "poise/math/rpy.h"
#include "poise/robot/standing.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

const char kUrdf[] = "robot/models/humanoid.urdf";

Profile Parse(const std::string& text) {
  return LoadProfile(TestFile("profile.yaml", text));
}

// Returns the message without the file's name: it begins with the line number.
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

TEST(LoadProfile, ReadsEveryKey) {
  const Profile profile = Parse(R"(
feet:
  left_foot: {frame: l_foot, xyz: [1, 2, 3], rpy: [0.1, 0.2, 0.3], size: [0.4, 0.2]}
  right_foot: {frame: r_foot, polygon: [[0, 0], [1, 0], [0, 1]]}
posture:
  found: somehow
  base: {xyz: [0, 0, 0.7], rpy: [0, 0.1, 0]}
  joints: {l_knee: 0.5}
forward: -y
left: l_foot
right: r_foot
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
  EXPECT_EQ(left.X_FS.R, MatrixFromRpy({0.1, 0.2, 0.3}));
  ASSERT_EQ(left.sole_S.size(), 4u);
  EXPECT_EQ(left.sole_S[0], Eigen::Vector2d(-0.2, -0.1));
  EXPECT_EQ(left.sole_S[3], Eigen::Vector2d(0.2, 0.1));
  EXPECT_EQ(profile.feet[1].sole_S.size(), 3u);
  EXPECT_EQ(profile.base_xyz.value(), Eigen::Vector3d(0, 0, 0.7));
  EXPECT_EQ(profile.base_rpy, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(profile.posture_found, "somehow");
  EXPECT_EQ(profile.joints.at("l_knee").value, 0.5);
  EXPECT_EQ(profile.sides.forward.text, "-y");
  EXPECT_EQ(profile.sides.forward.line, 9);
  EXPECT_EQ(profile.sides.left.text, "l_foot");
  EXPECT_EQ(profile.sides.right.line, 11);
  EXPECT_EQ(profile.locked.at("neck_yaw").value, 0.25);
  EXPECT_EQ(profile.mimic, MimicPolicy::kCoupled);
  EXPECT_EQ(profile.tasks["com"]["rank"].as<int>(), 4);
  EXPECT_EQ(profile.tasks["com"].Mark().line + 1, 15);
}

// Two soles for the humanoid.
const std::string kFeet =
    "feet:\n"
    "  left_foot: {frame: l_sole, size: [0.2, 0.1]}\n"
    "  right_foot: {frame: r_sole, size: [0.2, 0.1]}\n";

// Returns two soles for the humanoid, with the given left foot in line 2.
std::string LeftFoot(const std::string& foot) {
  return "feet:\n  left_foot: {" + foot +
         "}\n  right_foot: {frame: r_sole, size: [0.2, 0.1]}\n";
}

TEST(LoadProfile, NamesTheLineOfAnError) {
  EXPECT_EQ(Refusal("\nfeets: {}"),
            "2: a profile: unknown key 'feets', must be one of feet forward "
            "left locked mimic posture right tasks");
  EXPECT_EQ(Refusal("a"), "1: a profile is 'a', must be a map");
  EXPECT_EQ(Refusal(""), " is empty, must be a map");
  EXPECT_EQ(Refusal("feet:\n  left_foot: {frame: l_sole, size: [1, 1]}"),
            "2: feet: has no right_foot");
  EXPECT_EQ(Refusal("feet: {left_foot: {size: [1, 1]}}"),
            "1: feet.left_foot: has no frame, must have the name of a link");
  EXPECT_EQ(Refusal(kFeet + "mimic: maybe"),
            "4: mimic is 'maybe', must be free, coupled or locked");
  EXPECT_EQ(Refusal(kFeet + "locked:\n  neck_yaw: a"),
            "5: locked: 'neck_yaw' is 'a', must be a finite number");
  EXPECT_EQ(Refusal(kFeet + "locked:\n  neck_yaw: 1e7"),
            "5: locked: 'neck_yaw' is '1e7', must be between -1e6 and 1e6");
  EXPECT_EQ(Refusal(kFeet + "locked:\n  neck_yaw: 9"),
            "5: locked: 'neck_yaw' is at 9, must be inside its limits, -1.4 "
            "to 1.4");
  EXPECT_EQ(Refusal(kFeet + "locked:\n  neck: 0"),
            "5: locked: the robot has no moving joint 'neck'");
  EXPECT_EQ(Refusal(kFeet + "posture:\n  joints:\n    l_knee: .nan"),
            "6: posture.joints: 'l_knee' is '.nan', must be a finite number");
  EXPECT_EQ(Refusal(kFeet + "posture:\n  joints: {no_joint: 0}"),
            "5: posture.joints: the robot has no moving joint 'no_joint'");
  EXPECT_EQ(Refusal(kFeet + "posture:\n  joints: {neck_yaw: 9}"),
            "5: posture.joints: 'neck_yaw' is at 9, must be inside its limits, "
            "-1.4 to 1.4");
  EXPECT_EQ(Refusal(kFeet + "locked: {neck_yaw: 0}\nposture:\n"
                            "  joints: {neck_yaw: 0}"),
            "6: posture.joints: 'neck_yaw' is locked, must not be in the "
            "posture");
  EXPECT_EQ(Refusal(kFeet + "posture:\n  base: {rpy: [0, 0, 0]}"),
            "5: posture.base: has no xyz, must have xyz");
  EXPECT_EQ(Refusal(kFeet + "posture:\n  base: {xyz: [0, 0]}"),
            "5: posture.base.xyz is the list '[0, 0]', must be 3 numbers");
}

TEST(LoadProfile, NamesAnUnknownOrInvalidFoot) {
  EXPECT_EQ(Refusal(LeftFoot("frame: l, size: [0.2, 0.1]")),
            "2: feet.left_foot: the robot has no link 'l'");
  EXPECT_EQ(Refusal(LeftFoot("frame: r_foot, size: [0.2, 0.1]")),
            "3: feet.right_foot: is on the same body as left_foot, must be on "
            "another");
  EXPECT_EQ(
      Refusal("feet:\n  left_foot: {frame: r_sole, size: [0.2, 0.1]}\n"
              "  right_foot: {frame: l_sole, size: [0.2, 0.1]}\n"),
      "2: feet: left_foot is to the right of right_foot when looking along the "
      "soles' x axes, must be to the left");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [1, 0]")),
            "2: feet.left_foot.size is [1, 0], must be positive");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [a, 0]")),
            "2: feet.left_foot.size is 'a', must be a finite number");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [100, 1]")),
            "2: feet.left_foot.size reaches over 1 m from the center, must be "
            "at most 1 m");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, polygon: [[0, 0], [1, 1]]")),
            "2: feet.left_foot: its sole is under 1 mm wide or long, must be "
            "larger");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, polygon: {a: 1}")),
            "2: feet.left_foot.polygon is a map, must be a list of corners");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole")),
            "2: feet.left_foot: must have one of size and polygon");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, polygon: [[0, 0], [0.2, 0.1], "
                             "[0.2, 0], [0, 0.1]]")),
            "2: feet.left_foot.polygon is not convex, must be convex with its "
            "corners in order");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [0.2, 0.1], normal: "
                             "[0, 0, -1]")),
            "2: feet: the normals of the two soles point in opposite "
            "directions, both must point out of the ground");
  EXPECT_EQ(
      Refusal(LeftFoot("frame: l_sole, size: [1, 1], rpy: [0, 0, 90]")),
      "2: feet.left_foot.rpy is more than one turn, must be in rad: is it "
      "in degrees?");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [1, 1], rpy: [0, 0, 0], "
                             "normal: [0, 0, 1]")),
            "2: feet.left_foot: has rpy and normal, must have one of them");
  EXPECT_EQ(Refusal(LeftFoot("frame: l_sole, size: [1, 1], "
                             "normal: [0, 0, 0]")),
            "2: feet.left_foot.normal is zero, must be a direction");
}

TEST(LoadProfile, NamesAnInvalidSide) {
  EXPECT_EQ(Refusal("mimic: free\nforward: front"),
            "2: forward is 'front', must be one of +x -x +y -y +z -z");
  EXPECT_EQ(
      Refusal("forward: [1, 0]"),
      "1: forward is the list '[1, 0]', must be one of +x -x +y -y +z -z");
  EXPECT_EQ(Refusal("forward: +y"),
            "1: forward is '+y', must be +x or -x, across the line between "
            "the feet");
  EXPECT_EQ(Refusal("left: l_foot"),
            "1: left: there is no right, must be given together");
  EXPECT_EQ(Refusal("left: l_foot\nright: nothing"),
            "2: right: the robot has no link 'nothing'");
  EXPECT_EQ(Refusal("left: pelvis\nright: r_foot"),
            "1: left: 'pelvis' is fixed to the root link, must be the last "
            "link of a leg");
  EXPECT_EQ(Refusal("left: l_foot\nright: l_sole"),
            "2: right: 'l_sole' is on the same body as left, must be on "
            "another");
  EXPECT_EQ(Refusal("left: l_foot\nright: l_shank"),
            "1: left and right: link 'l_shank' carries the other foot, must "
            "be at the end of another leg");
  EXPECT_EQ(Refusal("left: l_foot\nright: r_foot\nforward: -x"),
            "3: forward is '-x', must be +x to agree with left and right");
  EXPECT_EQ(Refusal(kFeet + "forward: -x"),
            "4: forward is '-x', must be +x to agree with feet");
  EXPECT_EQ(Refusal(kFeet + "left: r_foot\nright: l_foot"),
            "4: left: 'r_foot' is not on the body of left_foot, must agree "
            "with feet");
}

TEST(LoadRobot, FollowsTheSidesOfTheProfile) {
  const auto left_foot = [](const std::string& text) {
    const Robot robot = LoadRobot(kUrdf, Parse(text));
    return robot.model.tree.frames()[robot.feet[0].frame].name;
  };
  EXPECT_EQ(left_foot("mimic: free"), "l_foot");
  EXPECT_EQ(left_foot("forward: +x"), "l_foot");
  EXPECT_EQ(left_foot("forward: -x"), "r_foot");
  EXPECT_EQ(left_foot("left: r_sole\nright: l_sole"), "r_foot");
  EXPECT_EQ(left_foot("left: l_foot\nright: r_foot\nforward: +x"), "l_foot");
  EXPECT_EQ(left_foot(kFeet + "forward: +x\nleft: l_sole\nright: r_foot"),
            "l_sole");
}

TEST(LoadProfile, AlignsTheZAxisOfTheSoleWithTheNormal) {
  const auto axes = [](const std::string& normal) {
    return Parse(LeftFoot("frame: l, size: [0.2, 0.1], normal: " + normal))
        .feet[0]
        .X_FS.R;
  };
  EXPECT_LT((axes("[0, 0, 2]") - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  Eigen::Matrix3d R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // z is -y, x is kept.
  EXPECT_LT((axes("[0, -1, 0]") - R).norm(), 1e-15);
  R << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // z is x, so x changes.
  EXPECT_LT((axes("[1, 0, 0]").col(2) - R.col(2)).norm(), 1e-15);
  EXPECT_NEAR(axes("[1, 0, 0]").determinant(), 1, 1e-15);
  EXPECT_LT((axes("[1, 0, 0]").col(0) - Eigen::Vector3d::UnitZ()).norm(),
            1e-15);
}

// If a posture has a base, the robot must be able to stand in the posture.
TEST(LoadRobot, RejectsAPostureThatDoesNotStand) {
  std::ifstream stream("robot/profiles/humanoid.yaml");
  const std::string good((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_EQ(Refusal(good), "accepted");
  const auto refusal = [&](const std::string& old_text,
                           const std::string& new_text) {
    std::string text = good;
    const size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    text.replace(at, old_text.size(), new_text);
    const std::string message = Refusal(text);
    return message.substr(message.find(' ') + 1);
  };
  const Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  const double x = profile.base_xyz->x();
  const double z = profile.base_xyz->z();
  YAML::Node yaml = YAML::Load(good);
  const auto with_base = [&](double forward, double height, double pitch) {
    YAML::Node base;
    for (const double value : {forward, 0.0, height})
      base["xyz"].push_back(value);
    for (const double value : {0.0, pitch, 0.0}) base["rpy"].push_back(value);
    yaml["posture"]["base"] = base;
    YAML::Emitter emitter;
    emitter << yaml;
    const std::string message = Refusal(emitter.c_str());
    return message.substr(message.find(' ') + 1);
  };
  EXPECT_EQ(with_base(x, z, 0), "accepted");
  EXPECT_EQ(with_base(x + 5, z, 0)
                .find("posture: the midpoint of the feet is at x = 5"),
            0u);
  EXPECT_EQ(with_base(x, z + 1, 0),
            "posture: left_foot is 1 m above the ground, must be on the ground "
            "(z = 0)");
  EXPECT_EQ(with_base(x, z - 0.01, 0).find("posture: left_foot is -0.0"), 0u);
  EXPECT_NE(with_base(x, z, 0.1).find("left_foot is "), std::string::npos);
  EXPECT_EQ(refusal("l_sole", "r_sole").find("feet.right_foot: is on the"), 0u);
}

TEST(LoadRobot, RejectsAPostureThatDoesNotFaceX) {
  Robot robot = LoadRobot(kUrdf, LoadProfile("robot/profiles/humanoid.yaml"));
  const Eigen::Quaterniond turned(MatrixFromRpy({0, 0, 1}));
  robot.q_nominal.segment<4>(3) = turned.coeffs();
  robot.q_nominal.head<3>() = turned * robot.q_nominal.head<3>();
  EXPECT_EQ(WhyNotStanding(robot),
            "the feet are turned by 1 rad about z, must point along x");
}

TEST(LoadRobot, RejectsSwappedFeetAndAFallingPosture) {
  Robot robot = LoadRobot(kUrdf, LoadProfile("robot/profiles/humanoid.yaml"));
  EXPECT_EQ(WhyNotStanding(robot), "");
  std::swap(robot.feet[0], robot.feet[1]);
  EXPECT_EQ(WhyNotStanding(robot),
            "left_foot is to the right of right_foot when looking along the "
            "soles' x axes, must be to the left");
  std::swap(robot.feet[0], robot.feet[1]);
  // Move the soles behind the center of mass.
  for (Foot& foot : robot.feet) {
    for (Eigen::Vector2d& corner : foot.polygon_C) corner.x() -= 0.3;
  }
  EXPECT_EQ(WhyNotStanding(robot),
            "the center of mass is not over the soles: the robot would fall");
  robot.q_nominal[robot.model.tree.q_start()] = 9;
  EXPECT_NE(WhyNotStanding(robot).find("must be inside its limits"),
            std::string::npos);
}

// The soles are turned over, so that the robot hangs below the ground. All
// other conditions hold.
TEST(LoadRobot, RejectsAPostureBelowItsSoles) {
  Robot robot = LoadRobot(kUrdf, LoadProfile("robot/profiles/humanoid.yaml"));
  const Eigen::AngleAxisd over(M_PI, Eigen::Vector3d::UnitX());
  for (Foot& foot : robot.feet) foot.X_BC.R *= over.toRotationMatrix();
  const Eigen::Quaterniond base(robot.q_nominal.segment<4>(3).data());
  robot.q_nominal.segment<4>(3) = Eigen::Quaterniond(over * base).coeffs();
  robot.q_nominal.head<3>() = over * robot.q_nominal.head<3>();
  std::swap(robot.feet[0], robot.feet[1]);
  const std::string reason = WhyNotStanding(robot);
  EXPECT_EQ(reason.find("the center of mass is 0.7"), 0u) << reason;
  EXPECT_NE(reason.find("m below the soles"), std::string::npos) << reason;
}

TEST(LoadProfile, ThrowsIfTheFileIsMissing) {
  EXPECT_THROW(LoadProfile("no/such.yaml"), std::invalid_argument);
}

TEST(LoadRobot, LocksJoints) {
  const Robot robot = LoadRobot(kUrdf, Parse("locked: {neck_yaw: 0.1}"));
  EXPECT_EQ(robot.model.tree.num_joints(), 49);
  EXPECT_FALSE(robot.model.tree.FindJoint("neck_yaw").has_value());
}

// In the nominal posture, a mimic joint has the value that follows from its
// source, unless the profile gives another value.
TEST(LoadRobot, CouplesMimicsInThePosture) {
  std::ifstream stream(kUrdf);
  std::string urdf((std::istreambuf_iterator<char>(stream)), {});
  const std::string axis = "<axis xyz=\"0 0 1\"/>";
  const size_t at = urdf.find(axis, urdf.find("joint name=\"neck_yaw\""));
  urdf.insert(at, "<mimic joint='chest_yaw' multiplier='2' offset='0.25'/>");
  const auto file = TestFile("coupled.urdf", urdf);
  std::ifstream profile_stream("robot/profiles/humanoid.yaml");
  const std::string good((std::istreambuf_iterator<char>(profile_stream)), {});
  const Robot robot = LoadRobot(file, Parse(good + "mimic: coupled\n"));
  EXPECT_TRUE(robot.can_stand);
  const Tree& tree = robot.model.tree;
  const int neck = tree.q_start() + tree.FindJoint("neck_yaw").value();
  EXPECT_EQ(robot.q_nominal[neck], 0.25);
  Robot broken = robot;
  broken.q_nominal[neck] = 0;
  EXPECT_EQ(WhyNotStanding(broken),
            "'neck_yaw' is at 0, must be at 0.25 because it is coupled to "
            "'chest_yaw'");
}

// In this URDF, neck_yaw mimics chest_yaw.
TEST(LoadRobot, AppliesTheMimicPolicyOfTheProfile) {
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
  EXPECT_LT((neck.X_BF.R - MatrixFromRpy({0, 0, 2 * 0.1 + 0.5})).norm(), 1e-12);
}

// Returns a URDF in which neck_yaw mimics chest_yaw, and neck_pitch mimics
// neck_yaw.
std::filesystem::path ChainOfMimics() {
  std::ifstream stream(kUrdf);
  std::string urdf((std::istreambuf_iterator<char>(stream)), {});
  for (const std::string name : {"neck_yaw", "neck_pitch"}) {
    const size_t at =
        urdf.find("<axis", urdf.find("joint name=\"" + name + "\""));
    urdf.insert(at, name == "neck_yaw"
                        ? "<mimic joint='chest_yaw' multiplier='2'/>"
                        : "<mimic joint='neck_yaw' offset='0.1'/>");
  }
  return TestFile("chain.urdf", urdf);
}

using Values = std::map<std::string, double>;

TEST(LoadRobot, LocksMimicJointsOfLockedSources) {
  const auto file = ChainOfMimics();
  const auto locked = [&](const std::string& text) {
    const Profile profile = Parse(text);
    Values values;
    for (const auto& [name, joint] : LockedJoints(LoadUrdf(file), profile)) {
      values[name] = joint.value;
    }
    // If the result is written to `locked`, the same joints are locked.
    Profile written = profile;
    written.locked = LockedJoints(LoadUrdf(file), profile);
    EXPECT_EQ(LockedJoints(LoadUrdf(file), written).size(), values.size());
    EXPECT_EQ(LoadRobot(file, profile).model.tree.num_joints(),
              50 - static_cast<int>(values.size()));
    return values;
  };
  EXPECT_EQ(locked("mimic: free\nlocked: {chest_yaw: 0.1}"),
            (Values{{"chest_yaw", 0.1}}));
  EXPECT_EQ(locked("mimic: locked"),
            (Values{{"neck_yaw", 0}, {"neck_pitch", 0.1}}));
  EXPECT_EQ(locked("mimic: locked\nposture: {joints: {chest_yaw: 0.1}}"),
            (Values{{"neck_yaw", 0.2}, {"neck_pitch", 0.2 + 0.1}}));
  const Values all = {
      {"chest_yaw", 0.1}, {"neck_yaw", 0.2}, {"neck_pitch", 0.2 + 0.1}};
  EXPECT_EQ(locked("mimic: locked\nlocked: {chest_yaw: 0.1}"), all);
  // A mimic joint of a locked source is locked as well.
  EXPECT_EQ(locked("mimic: coupled\nlocked: {chest_yaw: 0.1}"), all);
  EXPECT_EQ(locked("mimic: locked\nlocked: {neck_yaw: 0.3}"),
            (Values{{"neck_yaw", 0.3}, {"neck_pitch", 0.3 + 0.1}}));
  EXPECT_EQ(locked("mimic: coupled"), Values{});
  EXPECT_EQ(LoadRobot(file, Parse("mimic: coupled")).model.mimics.size(), 2u);
  try {
    locked("mimic: coupled\nlocked: {neck_yaw: 0.3}");
    ADD_FAILURE() << "accepted a locked mimic joint with a moving source";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what())
                  .find("profile.yaml:2: locked: 'neck_yaw' is coupled to "
                        "'chest_yaw': lock the source joint instead"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace poise
