// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stand.h"

#include <gtest/gtest.h>

#include <string>

#include "poise/dynamics/tick.h"
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

TEST(StandUp, ReportsWhyRobotCannotStand) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  // The fixed joints of the two legs need opposite roll angles of the base.
  for (const std::string name : {"ankle_roll", "hip_roll"}) {
    for (const std::string side : {"l_", "r_"}) {
      const double roll = side == "l_" ? 0.2 : -0.2;
      const auto joint = robot.model.tree.FindJoint(side + name);
      robot.model.limits[joint.value()].lower = roll;
      robot.model.limits[joint.value()].upper = roll;
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
