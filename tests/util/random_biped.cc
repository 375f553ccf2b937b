// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/random_biped.h"

#include <Eigen/Core>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

class BipedMaker {
 public:
  explicit BipedMaker(const BipedCase& from);

  Robot Make();

 private:
  // Returns the inertia of a box about its center. `share` is its part of the
  // total mass; `half` are its half side lengths, m.
  Inertia Box(double share, const Eigen::Vector3d& half);

  void AddJoint(const std::string& name, const std::string& parent,
                const std::string& child, const Eigen::Vector3d& p_PF,
                const Eigen::Vector3d& axis, const Inertia& M);

  void AddLeg(const std::string& side, double y);

  void AddChain();

  Foot MakeFoot(const Robot& robot, const std::string& side);

  // Returns the nominal posture. The pitch angles of each leg add up to zero,
  // so the soles are flat on the ground. By the sine rule the ankles are below
  // the hips.
  Eigen::VectorXd Stand(const Tree& tree);

  BipedCase from_;
  TreeBuilder builder_;
  double mass_, thigh_, shank_, ankle_;
};

BipedMaker::BipedMaker(const BipedCase& from)
    : from_(from),
      mass_(from.mass),
      thigh_(from.thigh),
      shank_(from.shank),
      ankle_(from.ankle) {}

Robot BipedMaker::Make() {
  builder_.AddLink("pelvis", Box(0.2, {0.1, 0.1, 0.05}));
  AddLeg("l_", from_.hip);
  AddLeg("r_", -from_.hip);
  AddChain();

  Robot robot{{"biped", builder_.Build(), {}, {}, {}, {}, 0}, {}, {}, true};
  robot.model.root_frame = *robot.model.tree.FindFrame("pelvis");
  for (const char* side : {"l_", "r_"})
    robot.feet.push_back(MakeFoot(robot, side));
  robot.q_nominal = Stand(robot.model.tree);
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    const double q = robot.q_nominal[robot.model.tree.q_start() + j];
    robot.model.limits.push_back(
        {q - from_.room, q + from_.room, 20, 6 * mass_});
  }
  return robot;
}

Inertia BipedMaker::Box(double share, const Eigen::Vector3d& half) {
  Inertia M;
  M.mass = share * mass_;
  const Eigen::Vector3d squares = half.cwiseAbs2();
  M.I_G_B =
      (M.mass / 3 * (squares.sum() - squares.array())).matrix().asDiagonal();
  return M;
}

void BipedMaker::AddJoint(const std::string& name, const std::string& parent,
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

void BipedMaker::AddLeg(const std::string& side, double y) {
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
  AddJoint(side + "hip_pitch", side + "hip_2", side + "thigh", zero, Y, thigh);
  AddJoint(side + "knee", side + "thigh", side + "shank", {0, 0, -thigh_}, Y,
           shank);
  AddJoint(side + "ankle_pitch", side + "shank", side + "ankle",
           {0, 0, -shank_}, Y, small);
  AddJoint(side + "ankle_roll", side + "ankle", side + "foot", zero, X,
           Box(0.02, {0.1, 0.05, 0.02}));
}

void BipedMaker::AddChain() {
  Inertia M = Box(0.3, {0.1, 0.15, from_.trunk / 2});
  M.p_BoG_B.z() = from_.trunk / 2;
  AddJoint("chest", "pelvis", "trunk", {0, 0, 0.05}, Eigen::Vector3d::UnitZ(),
           M);
  std::string parent = "trunk";
  for (std::size_t i = 0; i < from_.chain.size(); ++i) {
    const std::string child = "chain_" + std::to_string(i);
    AddJoint("joint_" + std::to_string(i), parent, child,
             {0, 0, i == 0 ? from_.trunk : 0.1}, from_.chain[i],
             Box(0.02, {0.05, 0.05, 0.05}));
    parent = child;
  }
}

Foot BipedMaker::MakeFoot(const Robot& robot, const std::string& side) {
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

Eigen::VectorXd BipedMaker::Stand(const Tree& tree) {
  const double knee = from_.knee;
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

Eigen::Vector3d Direction(const Eigen::Vector3d& v) {
  return v.isZero() ? Eigen::Vector3d::UnitX() : v.normalized();
}

}  // namespace

Robot MakeBiped(const BipedCase& from) { return BipedMaker(from).Make(); }

rc::Gen<BipedCase> Bipeds() {
  const auto axes = rc::gen::container<std::vector<Eigen::Vector3d>>(
      rc::gen::map(Vectors(), Direction));
  return rc::gen::map(
      rc::gen::tuple(VectorsXd(8, 1), rc::gen::resize(7, axes)),
      [](const std::tuple<Eigen::VectorXd, std::vector<Eigen::Vector3d>>& x) {
        const auto& [size, chain] = x;
        BipedCase biped;
        biped.mass += 30 * size[0];
        biped.shank += 0.12 * size[1];
        biped.thigh = biped.shank * (1 + 0.1 * size[2]);
        biped.ankle += 0.03 * size[3];
        biped.hip += 0.02 * size[4];
        biped.trunk += 0.2 * size[5];
        biped.knee += 0.35 * size[6];
        biped.room -= 2.25 * std::abs(size[7]);
        biped.chain = chain;
        return biped;
      });
}

void showValue(const BipedCase& biped, std::ostream& os) {
  os << biped.mass << " kg, shank " << biped.shank << " thigh " << biped.thigh
     << " ankle " << biped.ankle << " hip " << biped.hip << " trunk "
     << biped.trunk << " m, knee " << biped.knee << " room " << biped.room
     << " rad, chain";
  for (const Eigen::Vector3d& axis : biped.chain) {
    os << " [" << axis.transpose() << ']';
  }
}

}  // namespace poise
