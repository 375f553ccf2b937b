// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/mujoco/mujoco_plant.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>

#include "poise/math/quaternion.h"
#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"
#include "poise/sim/plants/mujoco/mujoco_model.h"

namespace poise {

static_assert(sizeof(mjtNum) == sizeof(double), "link a double MuJoCo");

namespace {

// Body i of the tree is MuJoCo's body i + 1. MuJoCo's body 0 is the world.
constexpr int kWorld = 0;

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Silences MuJoCo, which would warn of a diverging simulation on stderr and in
// a file of the current folder. The judge of the run reports the divergence.
[[maybe_unused]] const bool kIsQuiet = (
    mju_user_warning = [](const char*) {}, true);

// Loads a model through MuJoCo's virtual file system: MuJoCo has no function
// that reads XML from a string.
mjModel* LoadXml(const std::string& xml, std::string* error) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kName = "robot.xml";
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
  const int index = mj_findFileVFS(files.get(), kName);
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[index]));
  char message[500] = "";
  mjModel* model = mj_loadXML(kName, files.get(), message, sizeof(message));
  *error = message;
  mj_deleteVFS(files.get());
  return model;
}

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
  model_.reset(LoadXml(MakeMujocoXml(robot_, settings_, excluded), &error));
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
  const int n = robot_.model.tree.num_joints();
  double *qpos = data_->qpos, *qvel = data_->qvel;
  if (robot_.model.tree.is_floating()) {
    const Eigen::Quaterniond R_WB =
        Eigen::Quaterniond(q.segment<4>(3)).normalized();
    const Eigen::Vector3d w_WB_B = R_WB.inverse() * v.head<3>();
    const Eigen::Vector4d wxyz = WxyzFromQuaternion(R_WB);
    const double twist[] = {v[3],       v[4],       v[5],
                            w_WB_B.x(), w_WB_B.y(), w_WB_B.z()};
    qpos = std::copy(q.data(), q.data() + 3, qpos);
    qpos = std::copy(wxyz.data(), wxyz.data() + 4, qpos);
    qvel = std::copy(std::begin(twist), std::end(twist), qvel);
  }
  std::copy(q.data() + q.size() - n, q.data() + q.size(), qpos);
  std::copy(v.data() + v.size() - n, v.data() + v.size(), qvel);
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
  const int n = robot_.model.tree.num_joints();
  const double *qpos = data_->qpos, *qvel = data_->qvel;
  Eigen::VectorXd& q = state_.q;
  Eigen::VectorXd& v = state_.v;
  state_.vdot =
      (Eigen::Map<const Eigen::VectorXd>(qvel, model_->nv) - state_.vdot) /
      settings_.dt;
  if (robot_.model.tree.is_floating()) {
    // MuJoCo integrates the angular velocity in the body's axes at the start of
    // the step. In world axes the angular acceleration is R alpha_B, because
    // the cross product of w with itself is 0.
    const Eigen::Vector3d a_W = state_.vdot.head<3>();
    const Eigen::Vector3d alpha_B = state_.vdot.segment<3>(3);
    state_.vdot.head<3>() = X_WB(0).R * alpha_B;
    state_.vdot.segment<3>(3) = a_W;
    q.head<3>() = ConstVector3(qpos);
    const Eigen::Quaterniond R_WB =
        QuaternionFromWxyz(Eigen::Vector4d(qpos + 3));
    q.segment<4>(3) = R_WB.coeffs();
    v.head<3>() = R_WB * ConstVector3(qvel + 3);
    v.segment<3>(3) = ConstVector3(qvel);
    qpos += 7;
    qvel += 6;
  }
  std::copy(qpos, qpos + n, q.data() + q.size() - n);
  std::copy(qvel, qvel + n, v.data() + v.size() - n);
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
