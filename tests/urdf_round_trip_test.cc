// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <string>

#include "robot/urdf.h"
#include "tests/util/random_tree.h"
#include "tests/util/simple_robots.h"
#include "tests/util/tolerance.h"
#include "tests/util/urdf_writer.h"

namespace poise {
namespace {

// An entry goes through sine and cosine of three angles, and a product of
// rotations.
bool IsNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() <= Rounding(1 + b.norm(), 9);
}

bool IsNear(const Pose& a, const Pose& b) {
  return IsNear(a.R, b.R) && IsNear(a.p, b.p);
}

bool IsNear(const Inertia& a, const Inertia& b) {
  return a.mass == b.mass && IsNear(a.p_BoG_B, b.p_BoG_B) &&
         IsNear(a.I_G_B, b.I_G_B);
}

bool IsSame(const JointLimits& a, const JointLimits& b) {
  return a.lower == b.lower && a.upper == b.upper && a.velocity == b.velocity &&
         a.effort == b.effort && a.damping == b.damping &&
         a.friction == b.friction;
}

bool IsSame(const MimicCoupling& a, const MimicCoupling& b) {
  return a.joint == b.joint && a.source == b.source &&
         a.multiplier == b.multiplier && a.offset == b.offset;
}

// Names and numbers the same, frames and inertias to rounding: what first
// differs, or nothing.
std::string Difference(const RobotModel& read, const RobotModel& written) {
  const Tree &a = read.tree, &b = written.tree;
  if (read.name != written.name) return "name";
  if (a.num_joints() != b.num_joints()) return "number of joints";
  for (int j = 0; j < b.num_joints(); ++j) {
    const Joint &joint = a.joints()[j], &wanted = b.joints()[j];
    if (joint.name != wanted.name) return "order at " + wanted.name;
    if (joint.type != wanted.type) return "type of " + wanted.name;
    if (joint.parent != wanted.parent) return "parent of " + wanted.name;
    if (!IsNear(joint.X_PF, wanted.X_PF)) return "pose of " + wanted.name;
    if (!IsNear(joint.axis_F, wanted.axis_F)) return "axis of " + wanted.name;
    if (!IsSame(read.limits[j], written.limits[j])) {
      return "limits of " + wanted.name;
    }
  }
  for (int body = 0; body < b.num_bodies(); ++body) {
    if (!IsNear(a.inertias()[body], b.inertias()[body])) {
      return "inertia of body " + std::to_string(body);
    }
  }
  if (a.frames().size() != b.frames().size()) return "number of frames";
  for (const Frame& wanted : b.frames()) {
    const auto index = a.FindFrame(wanted.name);
    if (!index) return "no frame " + wanted.name;
    const Frame& frame = a.frames()[*index];
    if (frame.body != wanted.body) return "body of frame " + wanted.name;
    if (!IsNear(frame.X_BF, wanted.X_BF)) return "pose of frame " + wanted.name;
  }
  if (read.mimics.size() != written.mimics.size()) return "number of mimics";
  for (std::size_t i = 0; i < written.mimics.size(); ++i) {
    if (!IsSame(read.mimics[i], written.mimics[i])) return "mimics";
  }
  return "";
}

// Limits of any size; the joints of even number mimic the first.
RobotModel RandomModel(int num_joints, std::mt19937* draw) {
  RobotModel model = MakeRobot(MakeRandomTree(num_joints, draw)).model;
  model.name = "random";
  for (int j = 0; j < num_joints; ++j) {
    const Eigen::VectorXd x = MakeRandomVector(6, draw).cwiseAbs();
    model.limits[j] = {-x[0], x[1], 10 * x[2], 100 * x[3], x[4], x[5]};
    if (j % 2 == 0 && j > 0) model.mimics.push_back({j, 0, x[0] - x[1], x[2]});
  }
  return model;
}

RC_GTEST_PROP(UrdfRoundTrip, AnyTreeComesBack, ()) {
  const int num_joints = *rc::gen::inRange(0, 40);
  std::mt19937 draw(*rc::gen::inRange<unsigned>(0, 1u << 30));
  const RobotModel model = RandomModel(num_joints, &draw);
  RC_ASSERT(Difference(ParseUrdf(WriteUrdf(model), "written"), model) == "");
}

TEST(UrdfRoundTrip, TheHumanoidComesBackWithItsFrames) {
  const RobotModel model = LoadUrdf("robot/models/humanoid.urdf");
  ASSERT_GT(model.tree.frames().size(), model.tree.inertias().size());
  EXPECT_EQ(Difference(ParseUrdf(WriteUrdf(model), "written"), model), "");
}

TEST(UrdfRoundTrip, NoticesAnotherModel) {
  std::mt19937 draw(1);
  const RobotModel model = RandomModel(3, &draw);
  RobotModel other = model;
  other.limits[1].upper += 1e-12;
  EXPECT_EQ(Difference(other, model), "limits of joint2");
  other = model;
  other.mimics[0].offset += 1e-12;
  EXPECT_EQ(Difference(other, model), "mimics");
  other.tree = MakeRandomTree(3, &draw);
  EXPECT_NE(Difference(other, model), "");
}

}  // namespace
}  // namespace poise
