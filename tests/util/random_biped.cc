// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tests/util/random_biped.h"

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "tests/util/random_tree.h"

namespace poise {
namespace {

class BipedMaker {
 public:
  explicit BipedMaker(std::mt19937* draw) : draw_(draw) {}

  Robot Make() {
    mass_ = Between(20, 80);
    shank_ = Between(0.25, 0.5);
    thigh_ = shank_ * Between(0.9, 1.1);
    ankle_ = Between(0.05, 0.12);
    hip_ = Between(0.07, 0.12);
    const double trunk = Between(0.2, 0.6);
    builder_.AddLink("pelvis", Box(0.2, {0.1, 0.1, 0.05}));
    AddLeg("l_", hip_);
    AddLeg("r_", -hip_);
    AddChain(static_cast<int>((*draw_)() % 8), trunk);

    Robot robot{{"biped", builder_.Build(), {}, {}, {}, {}, 0}, {}, {}, true};
    robot.model.root_frame = *robot.model.tree.FindFrame("pelvis");
    robot.model.limits.assign(robot.model.tree.num_joints(),
                              {-2.5, 2.5, 20, 6 * mass_});
    for (const char* side : {"l_", "r_"})
      robot.feet.push_back(MakeFoot(robot, side));
    robot.q_nominal = Stand(robot.model.tree);
    return robot;
  }

 private:
  double Between(double low, double high) {
    return low + (high - low) * 0.5 * (1 + MakeRandomVector(1, draw_)[0]);
  }

  // A box of a share of the mass, with half sides, about its center.
  Inertia Box(double share, const Eigen::Vector3d& half) {
    Inertia M;
    M.mass = share * mass_;
    const Eigen::Vector3d squares = half.cwiseAbs2();
    M.I_G_B =
        (M.mass / 3 * (squares.sum() - squares.array())).matrix().asDiagonal();
    return M;
  }

  void AddJoint(const std::string& name, const std::string& parent,
                const std::string& child, const Eigen::Vector3d& p_PF,
                const Eigen::Vector3d& axis, const Inertia& M) {
    builder_.AddLink(child, M);
    JointSpec joint;
    joint.name = name;
    joint.type = JointType::kRevolute;
    joint.parent = parent;
    joint.child = child;
    joint.X_PF.p = p_PF;
    joint.axis_F = axis;
    builder_.AddJoint(joint);
  }

  void AddLeg(const std::string& side, double y) {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    const Eigen::Vector3d X = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d Y = Eigen::Vector3d::UnitY();
    const Inertia small = Box(0.01, {0.03, 0.03, 0.03});
    Inertia thigh = Box(0.1, {0.05, 0.05, thigh_ / 2});
    thigh.p_BoG_B.z() = -thigh_ / 2;
    Inertia shank = Box(0.05, {0.04, 0.04, shank_ / 2});
    shank.p_BoG_B.z() = -shank_ / 2;
    AddJoint(side + "hip_yaw", "pelvis", side + "hip_1", {0, y, 0},
             Eigen::Vector3d::UnitZ(), small);
    AddJoint(side + "hip_roll", side + "hip_1", side + "hip_2", zero, X, small);
    AddJoint(side + "hip_pitch", side + "hip_2", side + "thigh", zero, Y,
             thigh);
    AddJoint(side + "knee", side + "thigh", side + "shank", {0, 0, -thigh_}, Y,
             shank);
    AddJoint(side + "ankle_pitch", side + "shank", side + "ankle",
             {0, 0, -shank_}, Y, small);
    AddJoint(side + "ankle_roll", side + "ankle", side + "foot", zero, X,
             Box(0.02, {0.1, 0.05, 0.02}));
  }

  // A trunk on the pelvis, and a chain about any axes upon it.
  void AddChain(int num_joints, double trunk) {
    Inertia M = Box(0.3, {0.1, 0.15, trunk / 2});
    M.p_BoG_B.z() = trunk / 2;
    AddJoint("chest", "pelvis", "trunk", {0, 0, 0.05}, Eigen::Vector3d::UnitZ(),
             M);
    std::string parent = "trunk";
    for (int i = 0; i < num_joints; ++i) {
      const std::string child = "chain_" + std::to_string(i);
      AddJoint("joint_" + std::to_string(i), parent, child,
               {0, 0, i == 0 ? trunk : 0.1},
               MakeRandomVector(3, draw_).normalized(),
               Box(0.02, {0.05, 0.05, 0.05}));
      parent = child;
    }
  }

  Foot MakeFoot(const Robot& robot, const std::string& side) {
    const Tree& tree = robot.model.tree;
    const double x = 0.11, y = 0.06;
    Foot foot;
    foot.name = side == "l_" ? "left_foot" : "right_foot";
    foot.frame = *tree.FindFrame(side + "foot");
    foot.body = tree.frames()[foot.frame].body;
    foot.X_BC.p << 0.02, 0, -ankle_;
    foot.half_size << x, y;
    foot.polygon_C = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
    return foot;
  }

  // Soles flat on the ground, as the angles of a leg add up to zero; the ankles
  // below the hips, by the sine rule.
  Eigen::VectorXd Stand(const Tree& tree) {
    const double knee = Between(0.3, 1);
    const double hip =
        -std::atan2(shank_ * std::sin(knee), thigh_ + shank_ * std::cos(knee));
    Eigen::VectorXd q = tree.MakeNeutral();
    const auto set = [&](const std::string& name, double angle) {
      q[tree.q_start() + *tree.FindJoint(name)] = angle;
    };
    for (const std::string side : {"l_", "r_"}) {
      set(side + "hip_pitch", hip);
      set(side + "knee", knee);
      set(side + "ankle_pitch", -hip - knee);
    }
    q[2] = thigh_ * std::cos(hip) + shank_ * std::cos(hip + knee) + ankle_;
    return q;
  }

  std::mt19937* draw_;
  TreeBuilder builder_;
  double mass_, thigh_, shank_, ankle_, hip_;
};

}  // namespace

Robot MakeRandomBiped(std::mt19937* draw) { return BipedMaker(draw).Make(); }

}  // namespace poise
