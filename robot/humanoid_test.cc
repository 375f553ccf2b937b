// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

// Checks the project's own humanoid model. It has the paper's 50 joints and the
// proportions of HRP-4.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/dynamics/tick.h"
#include "poise/math/inertia.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Tolerance on lengths [m], above their rounding in the file.
constexpr double kWritten = 1e-7;

class Humanoid : public testing::Test {
 protected:
  // Returns a tick with the state of every link, in the order of
  // Tree::frames().
  static Tick TickAt(const Robot& robot, const Eigen::VectorXd& q) {
    std::vector<int> frames(robot.model.tree.frames().size());
    for (size_t i = 0; i < frames.size(); ++i) frames[i] = static_cast<int>(i);
    Tick tick(robot.model.tree, frames);
    ComputeTick(robot.model.tree, q,
                Eigen::VectorXd::Zero(robot.model.tree.nv()), &tick);
    return tick;
  }

  Eigen::Vector3d Position(const Tick& tick, const char* link) const {
    return tick.frames[robot_.model.tree.FindFrame(link).value()].X_WF.p;
  }

  const JointLimits& LimitsOf(const std::string& joint) const {
    return robot_.model.limits[robot_.model.tree.FindJoint(joint).value()];
  }

  const Robot robot_ = LoadHumanoid();
};

TEST_F(Humanoid, HasFiftyRevoluteJointsOnAFloatingBase) {
  const Tree& tree = robot_.model.tree;
  EXPECT_TRUE(tree.is_floating());
  EXPECT_EQ(tree.num_joints(), 50);
  int fingers = 0;
  for (const Joint& joint : tree.joints()) {
    EXPECT_EQ(joint.type, JointType::kRevolute) << joint.name;
    for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
      fingers += joint.name.find(finger) != std::string::npos;
    }
  }
  EXPECT_EQ(fingers, 20);
  EXPECT_TRUE(robot_.model.mimics.empty());
}

TEST_F(Humanoid, HasTheProportionsOfHrp4) {
  const Tick tick = TickAt(robot_, robot_.model.tree.MakeNeutral());
  EXPECT_GT(robot_.model.tree.total_mass(), 38);
  EXPECT_LT(robot_.model.tree.total_mass(), 39);
  for (const double side : {1, -1}) {
    const std::string s = side > 0 ? "l_" : "r_";
    const auto at = [&](const char* link) {
      return Position(tick, (s + link).c_str());
    };
    const Eigen::Vector3d hip = at("thigh");
    EXPECT_NEAR(hip.y(), side * 0.0875, kWritten);
    const Eigen::Vector3d thigh = at("shank") - hip;
    EXPECT_NEAR(thigh.y(), -side * 0.019, kWritten);
    EXPECT_NEAR(thigh.z(), -0.358, kWritten);
    const Eigen::Vector3d shank = at("foot") - at("shank");
    EXPECT_NEAR(shank.z(), -0.341, kWritten);
    const Eigen::Vector3d sole = at("sole") - at("foot");
    EXPECT_NEAR(sole.y(), side * 0.010, kWritten);
    EXPECT_NEAR(sole.z(), -0.093, kWritten);
  }
}

TEST_F(Humanoid, HasSolesOf23By13Centimeters) {
  ASSERT_EQ(robot_.feet.size(), 2u);
  const Tick tick = TickAt(robot_, robot_.q_nominal);
  for (const Foot& foot : robot_.feet) {
    EXPECT_NEAR(foot.half_size.x(), 0.115, kWritten);
    EXPECT_NEAR(foot.half_size.y(), 0.065, kWritten);
    const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
    EXPECT_NEAR(X_WC.p.y(), foot.name == "left_foot" ? 0.0785 : -0.0785,
                kWritten);
  }
}

TEST_F(Humanoid, HasExpectedEffortLimits) {
  for (const std::string side : {"l_", "r_"}) {
    EXPECT_EQ(LimitsOf(side + "hip_roll").effort, 225);
    EXPECT_EQ(LimitsOf(side + "hip_pitch").effort, 115);
    EXPECT_EQ(LimitsOf(side + "knee").effort, 243);
    EXPECT_EQ(LimitsOf(side + "ankle_pitch").effort, 163);
    EXPECT_EQ(LimitsOf(side + "ankle_roll").effort, 42);
  }
  for (const JointLimits& limits : robot_.model.limits) {
    EXPECT_TRUE(std::isfinite(limits.lower) && std::isfinite(limits.upper));
    EXPECT_LT(limits.lower, 0);
    EXPECT_GT(limits.upper, 0);
    EXPECT_GT(limits.velocity, 0);
    EXPECT_LT(limits.velocity, 20);
    EXPECT_GT(limits.effort, 0);
  }
}

TEST_F(Humanoid, HasPhysicalInertias) {
  const Tree& tree = robot_.model.tree;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    SCOPED_TRACE(b == 0 ? "base" : tree.joints()[b - 1].name);
    const Inertia& M = tree.inertias()[b];
    EXPECT_GE(M.mass, 0.004 * (1 - 1e-9));  // The mass of a finger link.
    const Eigen::Vector3d moments = PrincipalMoments(M.I_G_B);
    EXPECT_GT(moments[0], 0);
    EXPECT_GT(moments[0] + moments[1], moments[2]);
  }
}

// A reflection in the plane y = 0 maps each left link to its right counterpart.
TEST_F(Humanoid, IsMirrorSymmetric) {
  const Tree& tree = robot_.model.tree;
  const Tick tick = TickAt(robot_, tree.MakeNeutral());
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  int pairs = 0;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& left = tree.joints()[j];
    if (left.name.substr(0, 2) != "l_") continue;
    SCOPED_TRACE(left.name);
    ++pairs;
    const int k = tree.FindJoint("r_" + left.name.substr(2)).value();
    const Joint& right = tree.joints()[k];
    EXPECT_LT((tick.X_WB[j + 1].p - mirror * tick.X_WB[k + 1].p).norm(),
              Rounding(2, 20));
    const Inertia& M_l = tree.inertias()[j + 1];
    const Inertia& M_r = tree.inertias()[k + 1];
    EXPECT_EQ(M_l.mass, M_r.mass);
    EXPECT_LT((M_l.p_BoG_B - mirror * M_r.p_BoG_B).norm(), Rounding(1, 10));
    EXPECT_LT((M_l.I_G_B - mirror * M_r.I_G_B * mirror).norm(),
              Rounding(M_l.I_G_B.norm(), 10));
    // The reflection keeps the sign of a rotation about y, and changes the sign
    // of a rotation about x or z.
    EXPECT_EQ(left.axis_F, right.axis_F);
    const JointLimits& limits_l = robot_.model.limits[j];
    const JointLimits& limits_r = robot_.model.limits[k];
    const bool pitch = left.axis_F.y() != 0;
    EXPECT_EQ(limits_l.lower, pitch ? limits_r.lower : -limits_r.upper);
    EXPECT_EQ(limits_l.upper, pitch ? limits_r.upper : -limits_r.lower);
    EXPECT_EQ(limits_l.effort, limits_r.effort);
    EXPECT_EQ(limits_l.velocity, limits_r.velocity);
  }
  EXPECT_EQ(pairs, 23);
}

TEST_F(Humanoid, HasNoMeshes) {
  EXPECT_GT(robot_.model.visuals.size(), 50u);
  EXPECT_GT(robot_.model.collisions.size(), 10u);
  for (const auto* shapes : {&robot_.model.visuals, &robot_.model.collisions}) {
    for (const Shape& shape : *shapes) {
      EXPECT_EQ(std::get_if<Mesh>(&shape.geometry), nullptr);
    }
  }
}

TEST_F(Humanoid, StandsInItsNominalPosture) {
  EXPECT_TRUE(robot_.can_stand);
  const Tick tick = TickAt(robot_, robot_.q_nominal);
  const double written = 1e-6;  // The profile has seven decimals.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Foot& foot : robot_.feet) {
    const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
    EXPECT_LT((X_WC.R - Eigen::Matrix3d::Identity()).norm(), written);
    EXPECT_NEAR(X_WC.p.z(), 0, written);
    middle += 0.5 * X_WC.p;
  }
  EXPECT_LT(middle.norm(), written);
  EXPECT_LT(tick.p_WG.head<2>().norm(), written);
  EXPECT_NEAR(tick.p_WG.z(), 0.79, 0.01);  // From a prototype, m.
  for (int j = 0; j < 50; ++j) {
    const double q = robot_.q_nominal[7 + j];
    EXPECT_GE(q, robot_.model.limits[j].lower);
    EXPECT_LE(q, robot_.model.limits[j].upper);
  }
  EXPECT_EQ(robot_.q_nominal[7 + robot_.model.tree.FindJoint("l_knee").value()],
            0.7);
  // The push acts at the torso's center of mass. Its expected height of 1.16 m
  // comes from a prototype with the same robot.
  const int torso = robot_.model.tree.FindFrame("torso").value();
  const int body = robot_.model.tree.frames()[torso].body;
  const Eigen::Vector3d p =
      tick.X_WB[body] * robot_.model.tree.inertias()[body].p_BoG_B;
  EXPECT_NEAR(p.z(), 1.16, 0.01);
}

// FindFeet() returns the same feet as the profile.
TEST_F(Humanoid, HasFeetThatAreFoundWithoutAProfile) {
  const Robot found = LoadRobot("robot/models/humanoid.urdf");
  EXPECT_FALSE(found.can_stand);
  ASSERT_EQ(found.feet.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const Foot& foot = found.feet[i];
    EXPECT_EQ(foot.name, robot_.feet[i].name);
    EXPECT_EQ(foot.body, robot_.feet[i].body);
    EXPECT_LT((foot.half_size - robot_.feet[i].half_size).norm(), 1e-9);
    EXPECT_LT((foot.X_BC.p - robot_.feet[i].X_BC.p).norm(), 1e-9);
    EXPECT_LT((foot.X_BC.R - robot_.feet[i].X_BC.R).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace poise
