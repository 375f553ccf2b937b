// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stand.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/tick.h"
#include "poise/robot/collision/collision_model.h"
#include "poise/robot/control/posture/biped_fixture.h"
#include "poise/robot/standing.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/shared_data.h"

namespace poise {
namespace {

// Largest error of a feasible target after StandUp(), m or rad.
constexpr double kMet = 1e-6;

void ExpectStands(const Robot& robot) {
  EXPECT_TRUE(robot.can_stand);
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv()), &tick);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Foot& foot : robot.feet) {
    const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
    EXPECT_LT((X_WC.R - Eigen::Matrix3d::Identity()).norm(), kMet);
    EXPECT_NEAR(X_WC.p.z(), 0, kMet);
    EXPECT_NEAR(X_WC.p.x(), 0, kMet);
    middle += 0.5 * X_WC.p;
  }
  EXPECT_LT(middle.norm(), kMet);
  EXPECT_LT(tick.p_WG.head<2>().norm(), 5e-3);  // As StandUp() accepts.
  EXPECT_GT(tick.p_WG.z(), 0.2);
  const double left =
      (tick.X_WB[robot.feet[0].body] * robot.feet[0].X_BC).p.y();
  EXPECT_GT(left, robot.feet[0].half_size.y());
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double q = robot.q_nominal[tree.q_start() + j];
    EXPECT_GE(q, robot.model.limits[j].lower) << tree.joints()[j].name;
    EXPECT_LE(q, robot.model.limits[j].upper) << tree.joints()[j].name;
  }
}

TEST(StandUp, StandsHumanoidUpWithBentKnees) {
  const Robot robot = LoadStandingRobot("robot/models/humanoid.urdf");
  ExpectStands(robot);
  const int knee = robot.model.tree.FindJoint("l_knee").value();
  EXPECT_NEAR(robot.q_nominal[7 + knee], 0.6, 0.05);
}

TEST(StandUp, StaysNearPostureOfProfile) {
  Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  const Robot given = LoadStandingRobot("robot/models/humanoid.urdf", profile);
  profile.base_xyz.reset();
  const Robot found = LoadStandingRobot("robot/models/humanoid.urdf", profile);
  ExpectStands(found);
  EXPECT_LT((found.q_nominal - given.q_nominal).norm(), kMet);
}

Robot StandBiped(const ArmsCase& from, const Profile& profile = {}) {
  return MakeStandingRobot(UrdfDocument(BipedText(from), "biped.urdf"),
                           profile);
}

// The bounds of 102 joints need more iterations of the solver than those of 50.
TEST(StandUp, StandsUpWith102Joints) {
  ArmsCase from;
  from.fingers = 6;
  from.phalanges = 6;
  const Robot robot = StandBiped(from);
  EXPECT_EQ(robot.model.tree.num_joints(), 102);
  ExpectStands(robot);
}

// Returns the smallest distance between a forearm and a leg, m.
double ArmDistance(const Robot& robot) {
  std::vector<Pose> X_WB(robot.model.tree.num_bodies());
  ComputePoses(robot.model.tree, robot.q_nominal, &X_WB);
  const CollisionModel collision = MakeCollisionModel(robot.model);
  double distance = 1;
  for (const CollisionPair& pair : collision.pairs) {
    if (collision.names[pair.b].find("arm4") == std::string::npos) continue;
    if (collision.names[pair.a].find("hip_pitch") == std::string::npos) {
      continue;
    }
    distance = std::min(distance,
                        ComputePairDistance(collision, pair, X_WB, 0).distance);
  }
  return distance;
}

double AngleOf(const Robot& robot, const std::string& joint) {
  return robot.q_nominal[7 + robot.model.tree.FindJoint(joint).value()];
}

// With these shoulders, the forearms are 10 mm beside the thighs.
TEST(StandUp, AbductsShouldersUntilNothingTouches) {
  ArmsCase narrow;
  narrow.shoulder = 0.2;
  const Robot spread = StandBiped(narrow);
  ExpectStands(spread);
  EXPECT_GE(ArmDistance(spread), 0.02);
  EXPECT_LT(ArmDistance(spread), 1);
  EXPECT_GT(AngleOf(spread, "l_arm1"), 0.04);
  EXPECT_LT(AngleOf(spread, "r_arm1"), -0.04);
  for (const char* other : {"l_arm0", "l_arm2", "r_arm0", "r_arm2"}) {
    EXPECT_NEAR(AngleOf(spread, other), 0, 0.02) << other;
  }
  // Arms with enough distance stay.
  EXPECT_NEAR(AngleOf(StandBiped({}), "l_arm1"), 0, 0.02);
}

TEST(StandUp, KeepsArmsOfTheProfile) {
  ArmsCase narrow;
  narrow.shoulder = 0.2;
  Profile profile;
  for (const char* joint : {"l_arm0", "l_arm1", "l_arm3"}) {
    profile.joints[joint] = {joint == std::string("l_arm3") ? -0.1 : 0., 1};
  }
  const Robot robot = StandBiped(narrow, profile);
  EXPECT_NEAR(AngleOf(robot, "l_arm1"), 0, 1e-3);
  EXPECT_LT(AngleOf(robot, "r_arm1"), -0.04);
}

TEST(StandUp, KeepsMimicCouplings) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  const int chest = robot.model.tree.FindJoint("chest_yaw").value();
  const int neck = robot.model.tree.FindJoint("neck_yaw").value();
  robot.model.mimics.push_back({neck, chest, 2, 0.3});
  StandUp(&robot);
  ExpectStands(robot);
  EXPECT_NEAR(robot.q_nominal[7 + neck], 2 * robot.q_nominal[7 + chest] + 0.3,
              kMet);
}

// With the center of mass above the middle of the soles, weak ankles could not
// hold the robot on one foot.
TEST(StandUp, MovesCenterOfMassNearerToWeakAnkles) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  const Tree& tree = robot.model.tree;
  const double reach = 0.01;  // Lever arm for half of the ankle torque, m.
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  for (const char* ankle : {"l_ankle_pitch", "r_ankle_pitch"}) {
    robot.model.limits[tree.FindJoint(ankle).value()].effort =
        2 * reach * weight;
  }
  StandUp(&robot);
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv()), &tick);
  const int ankle = tree.FindJoint("l_ankle_pitch").value() + 1;  // A body.
  const double behind = tick.X_WB[ankle].p.x();
  ASSERT_LT(behind + reach, 0);
  EXPECT_NEAR(tick.p_WG.x(), behind + reach, kMet);
}

// Feet that toe out by 0.1 rad cannot be parallel if the legs do not turn.
TEST(StandUp, StandsOnSolesThatCannotBeParallel) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  for (const int i : {0, 1}) {
    const double turn = i == 0 ? 0.1 : -0.1;
    robot.feet[i].X_BC.R *=
        Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const std::string joint = i == 0 ? "l_hip_yaw" : "r_hip_yaw";
    const int j = robot.model.tree.FindJoint(joint).value();
    robot.model.limits[j].lower = robot.model.limits[j].upper = 0;
  }
  StandUp(&robot);
  EXPECT_EQ(WhyNotStanding(robot), "");
}

// The soles are on the upper sides of the feet. With stiff legs, the robot can
// only hang from the ground. Its soles are flat then, and its center of mass is
// over them in plan view.
TEST(StandUp, RejectsACenterOfMassBelowTheSoles) {
  Robot robot = MakeRobot(UrdfDocument(BipedText({}), "biped.urdf"), {});
  const Eigen::AngleAxisd over(M_PI, Eigen::Vector3d::UnitX());
  for (Foot& foot : robot.feet) foot.X_BC.R *= over.toRotationMatrix();
  std::swap(robot.feet[0], robot.feet[1]);  // Left of a robot upside down.
  for (JointLimits& limits : robot.model.limits) {
    limits.lower = std::max(limits.lower, -0.3);
    limits.upper = std::min(limits.upper, 0.3);
  }
  try {
    StandUp(&robot);
    ADD_FAILURE() << "StandUp() did not throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("m below the soles"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(robot.can_stand);
}

TEST(StandUp, ReportsWhyRobotCannotStand) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  // The legs are rigid, and their soles are not parallel.
  for (const std::string side : {"l_", "r_"}) {
    for (const char* name : {"hip_yaw", "hip_roll", "hip_pitch", "knee",
                             "ankle_pitch", "ankle_roll"}) {
      const int j = robot.model.tree.FindJoint(side + name).value();
      const bool is_roll = name == std::string("ankle_roll");
      JointLimits& limits = robot.model.limits[j];
      limits.lower = limits.upper = !is_roll ? 0 : side == "l_" ? 0.2 : -0.2;
    }
  }
  try {
    StandUp(&robot);
    ADD_FAILURE() << "StandUp() did not throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("'humanoid': no standing posture within the joint limits"),
        std::string::npos)
        << error.what();
    for (const char* part :
         {"remains rotated by 0.", "at or near their limits are 'l_",
          "starts were tried"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << error.what();
    }
  }
  EXPECT_FALSE(robot.can_stand);
  robot.feet.clear();
  EXPECT_THROW(StandUp(&robot), std::invalid_argument);
}

TEST(StandUp, StandsRealRobotsUp) {
  const auto folder = SharedData("robots");
  if (!folder) return;
  const struct {
    const char* urdf;
    const char* profile;
  } robots[] = {{"talos_reduced", "talos"},
                {"jvrc1", "jvrc1"},
                {"icub_erd_reduced", "icub"},
                {"hrp4c", "hrp4c"},
                {"atlas", "atlas"},
                {"booster_t1", "t1"},
                {"draco3", "draco3"},
                {"g1_29dof", "g1"},
                {"atlas", ""},
                {"booster_t1", ""},
                {"draco3", ""},
                {"g1_29dof", ""},
                {"nao_v50", ""},
                {"talos_reduced", ""},
                {"jvrc1", ""},
                {"icub_erd_reduced", ""}};
  for (const auto& robot : robots) {
    SCOPED_TRACE(std::string(robot.urdf) + " " + robot.profile);
    const std::string profile = robot.profile;
    ExpectStands(LoadStandingRobot(
        *folder / (std::string(robot.urdf) + ".urdf"),
        profile.empty() ? Profile{}
                        : LoadProfile("robot/profiles/" + profile + ".yaml")));
  }
  EXPECT_THROW(LoadStandingRobot(*folder / "solo12.urdf"),
               std::invalid_argument);
}

}  // namespace
}  // namespace poise
