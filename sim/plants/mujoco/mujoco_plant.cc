// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/mujoco/mujoco_plant.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>

#include "poise/dynamics/conventions.h"
#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"
#include "poise/sim/plants/mujoco/load_mujoco.h"
#include "poise/sim/plants/mujoco/mujoco_model.h"

namespace poise {

namespace {

// Body i of the tree is MuJoCo's body i + 1. MuJoCo's body 0 is the world.
constexpr int kWorld = 0;

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

MujocoPlant::MujocoPlant(const Robot& robot, const PlantSettings& settings)
    : robot_(robot), settings_(settings) {
  Validate(settings);
  if (settings.restitution > 0) {
    throw InputError("plant.restitution",
                     "plant: restitution is " +
                         std::to_string(settings.restitution) +
                         ", must be 0 in a MuJoCo plant");
  }
  const Tree& tree = robot_.model.tree;
  state_.q.resize(tree.nq());
  state_.v.resize(tree.nv());
  state_.vdot.resize(tree.nv());
  state_.tau.resize(tree.num_joints());
  state_.F_Co_C.resize(robot_.feet.size());
  state_.contact_points.resize(robot_.feet.size());
  pushes_.resize(tree.nv());
  Reset(tree.MakeNeutral(), Eigen::VectorXd::Zero(tree.nv()));
}

void MujocoPlant::Load(const std::vector<std::pair<int, int>>& excluded) {
  std::string error;
  model_ = LoadMujoco(MakeMujocoXml(robot_, settings_, excluded), &error);
  if (model_ == nullptr) {
    const std::string line = error.substr(0, error.find('\n'));
    throw std::invalid_argument("robot " + Quoted(robot_.model.name) +
                                ": MuJoCo rejects the model: " + OneLine(line));
  }
  data_.reset(mj_makeData(model_.get()));
}

Pose MujocoPlant::X_WB(int body) const {
  return {Eigen::Map<const RowMajor3>(data_->xmat + 9 * (body + 1)),
          ConstVector3(data_->xpos + 3 * (body + 1))};
}

void MujocoPlant::Place(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  mj_resetData(model_.get(), data_.get());
  const Tree& tree = robot_.model.tree;
  ExportConfiguration(Library::kMujoco, tree, q,
                      Eigen::Map<Eigen::VectorXd>(data_->qpos, model_->nq));
  ExportVelocity(Library::kMujoco, tree, q, v,
                 Eigen::Map<Eigen::VectorXd>(data_->qvel, model_->nv));
  mj_forward(model_.get(), data_.get());
}

std::vector<std::pair<int, int>> MujocoPlant::FindTouching() const {
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const int a = model_->geom_bodyid[contact.geom1];
    const int b = model_->geom_bodyid[contact.geom2];
    if (a == kWorld || b == kWorld) continue;
    pairs.emplace(std::min(a, b) - 1, std::max(a, b) - 1);
  }
  return {pairs.begin(), pairs.end()};
}

void MujocoPlant::Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Load({});
  Place(q, v);
  const auto touching = FindTouching();
  if (!touching.empty()) {
    Load(touching);
    Place(q, v);
  }
  state_.time = 0;
  state_.q = q;
  state_.v = v;
  state_.vdot.setZero();
  state_.tau.setZero();
  for (auto& F_Co_C : state_.F_Co_C) F_Co_C.setZero();
  for (int& points : state_.contact_points) points = 0;
  state_.other_force_W.setZero();
  state_.self_contacts.clear();
  pushes_.setZero();
  steps_ = 0;
}

void MujocoPlant::Apply(const AppliedForce& force) {
  const Eigen::Vector3d p_WQ = X_WB(force.body) * force.p_BoQ_B;
  mj_applyFT(model_.get(), data_.get(), force.force_W.data(),
             force.torque_W.data(), p_WQ.data(), force.body + 1,
             pushes_.data());
}

void MujocoPlant::Step(const Eigen::VectorXd& tau) {
  const int n = robot_.model.tree.num_joints();
  for (int j = 0; j < n; ++j) {
    const double limit = settings_.torque_scale * robot_.model.limits[j].effort;
    state_.tau[j] = std::clamp(tau[j], -limit, limit);
  }
  pushes_.tail(n) += state_.tau;
  std::copy(pushes_.data(), pushes_.data() + pushes_.size(),
            data_->qfrc_applied);
  pushes_.setZero();
  state_.vdot = Eigen::Map<Eigen::VectorXd>(data_->qvel, model_->nv);

  mj_step(model_.get(), data_.get());

  state_.time = ++steps_ * settings_.dt;
  ReadContacts();
  ReadState();
  // Updates the poses to the new state, because Apply() and X_WB() use them.
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
}

void MujocoPlant::ReadState() {
  const Tree& tree = robot_.model.tree;
  const Eigen::Map<const Eigen::VectorXd> qpos(data_->qpos, model_->nq);
  const Eigen::Map<const Eigen::VectorXd> qvel(data_->qvel, model_->nv);
  // MuJoCo integrates the angular velocity in the axes of the base at the start
  // of the step, which state_.q still has.
  const Eigen::VectorXd vdot_theirs = (qvel - state_.vdot) / settings_.dt;
  ImportAcceleration(Library::kMujoco, tree, state_.q, state_.v, vdot_theirs,
                     state_.vdot);
  ImportConfiguration(Library::kMujoco, tree, qpos, state_.q);
  ImportVelocity(Library::kMujoco, tree, state_.q, qvel, state_.v);
}

void MujocoPlant::ReadContacts() {
  for (auto& F_Co_C : state_.F_Co_C) F_Co_C.setZero();
  for (int& points : state_.contact_points) points = 0;
  state_.other_force_W.setZero();
  std::set<std::pair<int, int>> self_contacts;
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    double F_contact[6];
    mj_contactForce(model_.get(), data_.get(), i, F_contact);
    if (F_contact[0] <= 0) continue;
    const int a = model_->geom_bodyid[contact.geom1];
    const int b = model_->geom_bodyid[contact.geom2];
    if (a != kWorld && b != kWorld) {
      self_contacts.emplace(std::min(a, b) - 1, std::max(a, b) - 1);
      continue;
    }
    // The rows of contact.frame are the axes of the contact frame. The contact
    // force acts on the second geom.
    const Eigen::Vector3d on_second_W =
        Eigen::Map<const RowMajor3>(contact.frame).transpose() *
        ConstVector3(F_contact);
    const Eigen::Vector3d force_W = a == kWorld ? on_second_W : -on_second_W;
    const int body = std::max(a, b) - 1;
    const auto foot =
        std::find_if(robot_.feet.begin(), robot_.feet.end(),
                     [body](const Foot& f) { return f.body == body; });
    if (foot == robot_.feet.end()) {
      state_.other_force_W += force_W;
      continue;
    }
    const auto at = foot - robot_.feet.begin();
    const Pose X_WC = X_WB(body) * foot->X_BC;
    const Eigen::Vector3d p_CQ_C = X_WC.Inverse() * ConstVector3(contact.pos);
    const Eigen::Vector3d force_C = X_WC.R.transpose() * force_W;
    state_.F_Co_C[at].head<3>() += p_CQ_C.cross(force_C);
    state_.F_Co_C[at].tail<3>() += force_C;
    ++state_.contact_points[at];
  }
  state_.self_contacts.assign(self_contacts.begin(), self_contacts.end());
}

}  // namespace poise
