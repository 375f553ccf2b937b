// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/simple_robots.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/urdf_writer.h"

namespace poise {
namespace {

// The tolerance covers rounding: each entry is computed from sines and cosines
// of three angles and from a product of rotations.
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

// Describes the first difference of two models, or returns "". Names and
// numbers must be equal; frames and inertias may differ by rounding errors.
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

// A link and the joint that connects it to its parent.
struct LinkCase {
  int back;  // The parent is this many links before the last one.
  bool is_prismatic;
  Pose X_PF;
  Eigen::Vector3d axis;
  Inertia M;
  Eigen::VectorXd numbers;  // For limits and mimic coupling.
};

void showValue(const LinkCase& link, std::ostream& os) {
  os << "back " << link.back << (link.is_prismatic ? " prismatic " : " ");
  showValue(link.X_PF, os);
  os << " axis " << link.axis.transpose() << ' ';
  showValue(link.M, os);
  os << " numbers " << link.numbers.transpose();
}

// Draws links. A failure shrinks to fewer links, and each link to a simpler
// one.
rc::Gen<std::vector<LinkCase>> Links() {
  const rc::Gen<LinkCase> link = rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(0, 6), rc::gen::inRange(0, 5), Poses(),
                     Vectors(), Inertias(), VectorsXd(6, 1)),
      [](const std::tuple<int, int, Pose, Eigen::Vector3d, Inertia,
                          Eigen::VectorXd>& x) -> LinkCase {
        const auto& [back, kind, X_PF, axis, M, numbers] = x;
        return {back, kind == 4, X_PF, axis, M, numbers};
      });
  // Up to 40 links. The inner scale 2.5 cancels the outer 0.4, so that each
  // link is drawn at full size.
  return rc::gen::scale(0.4, rc::gen::container<std::vector<LinkCase>>(
                                 rc::gen::scale(2.5, link)));
}

// Makes the model. Joints 2, 4, 6, ... mimic joint 0.
RobotModel MakeModel(const Inertia& base, const std::vector<LinkCase>& links) {
  const auto name = [](const char* what, int i) {
    return what + std::to_string(i);
  };
  TreeBuilder builder;
  builder.AddLink(name("link", 0), base);
  for (int i = 0; i < static_cast<int>(links.size()); ++i) {
    const LinkCase& link = links[i];
    builder.AddLink(name("link", i + 1), link.M);
    JointSpec joint;
    joint.name = name("joint", i + 1);
    joint.type =
        link.is_prismatic ? JointType::kPrismatic : JointType::kRevolute;
    joint.parent = name("link", std::max(0, i - link.back));
    joint.child = name("link", i + 1);
    joint.X_PF = link.X_PF;
    joint.axis_F =
        link.axis.isZero() ? Eigen::Vector3d::UnitZ() : link.axis.normalized();
    builder.AddJoint(joint);
  }
  RobotModel model = MakeRobot(builder.Build()).model;
  model.name = "random";
  for (int i = 0; i < static_cast<int>(links.size()); ++i) {
    // The tree has its joints in another order than the links.
    const int j = *model.tree.FindJoint(name("joint", i + 1));
    // The reader takes a velocity limit of 0 as unknown.
    Eigen::VectorXd x = links[i].numbers.cwiseAbs();
    x[2] = std::max(x[2], 1e-3);
    model.limits[j] = {-x[0], x[1], 10 * x[2], 100 * x[3], x[4], x[5]};
  }
  for (int j = 2; j < model.tree.num_joints(); j += 2) {
    const Eigen::VectorXd& x = links[j].numbers;
    model.mimics.push_back({j, 0, x[0] - x[1], x[2]});
  }
  return model;
}

RC_GTEST_PROP(UrdfRoundTrip, PreservesAnyTree, ()) {
  const RobotModel model = MakeModel(*Inertias(), *Links());
  RC_ASSERT(Difference(ParseUrdf(WriteUrdf(model), "written"), model) == "");
}

TEST(UrdfRoundTrip, PreservesTheHumanoidAndItsFrames) {
  const RobotModel model = LoadUrdf("robot/models/humanoid.urdf");
  ASSERT_GT(model.tree.frames().size(), model.tree.inertias().size());
  EXPECT_EQ(Difference(ParseUrdf(WriteUrdf(model), "written"), model), "");
}

TEST(UrdfRoundTrip, DetectsDifferentModels) {
  const Inertia M{1, {0.1, 0, 0}, Eigen::Matrix3d::Identity()};
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(6, 0.1, 0.6);
  std::vector<LinkCase> links(3, {0, false, Pose(), {0, 0, 1}, M, numbers});
  const RobotModel model = MakeModel(M, links);
  RobotModel other = model;
  other.limits[1].upper += 1e-12;
  EXPECT_EQ(Difference(other, model), "limits of joint2");
  other = model;
  other.mimics[0].offset += 1e-12;
  EXPECT_EQ(Difference(other, model), "mimics");
  links[2].X_PF.p.x() += 1e-12;
  EXPECT_EQ(Difference(MakeModel(M, links), model), "pose of joint3");
  links[1].back = 1;
  EXPECT_NE(Difference(MakeModel(M, links), model), "");
}

}  // namespace
}  // namespace poise
