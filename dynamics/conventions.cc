// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/conventions.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

#include "poise/math/quaternion.h"

namespace poise {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using VectorIn = Eigen::Ref<const Eigen::VectorXd>;

// BaseMap is the part of X for the six velocities of the base. For a fixed base
// it has no use, and is made with the identity rotation.
class BaseMap {
 public:
  BaseMap(Library library, const Tree& tree, const VectorIn& q)
      : library_(library), R_WB_(Quaterniond::Identity()) {
    if (tree.is_floating()) R_WB_ = Normalize(Quaterniond(q.segment<4>(3)));
  }

  // Returns X x, of x = [angular; linear] in world axes.
  Vector6d Export(const Vector6d& x) const {
    const Vector3d angular = x.head<3>(), linear = x.tail<3>();
    const Quaterniond R_BW = R_WB_.conjugate();
    Vector6d y = x;
    if (library_ == Library::kPinocchio) y << R_BW * linear, R_BW * angular;
    if (library_ == Library::kMujoco) y << linear, R_BW * angular;
    return y;
  }

  // Returns X' y.
  Vector6d Import(const Vector6d& y) const {
    const Vector3d first = y.head<3>(), second = y.tail<3>();
    Vector6d x = y;
    if (library_ == Library::kPinocchio) x << R_WB_ * second, R_WB_ * first;
    if (library_ == Library::kMujoco) x << R_WB_ * second, first;
    return x;
  }

 private:
  Library library_;
  Quaterniond R_WB_;
};

// Returns X'Ẋ v in its only nonzero entries, those of the linear velocity:
// d/dt (R' v) = R' (v̇ - w x v).
Vector3d TurningOfAxes(Library library, const VectorIn& v) {
  if (library != Library::kPinocchio) return Vector3d::Zero();
  return -v.head<3>().cross(v.segment<3>(3));
}

Vector6d SwapHalves(const Vector6d& x) {
  return (Vector6d() << x.tail<3>(), x.head<3>()).finished();
}

bool LinearFirst(Library library) { return library != Library::kDrake; }

}  // namespace

int ConfigurationSize(Library library, const Tree& tree) noexcept {
  int size = tree.nq();
  if (library != Library::kPinocchio) return size;
  for (const Joint& joint : tree.joints()) {
    size += joint.type == JointType::kContinuous;
  }
  return size;
}

void ExportConfiguration(Library library, const Tree& tree, const VectorIn& q,
                         Eigen::Ref<Eigen::VectorXd> q_theirs) noexcept {
  assert(q_theirs.size() == ConfigurationSize(library, tree));
  if (tree.is_floating()) {
    const Vector3d p = q.head<3>();
    const Quaterniond R_WB = Normalize(Quaterniond(q.segment<4>(3)));
    const Eigen::Vector4d wxyz = WxyzFromQuaternion(R_WB);
    if (library == Library::kPinocchio) q_theirs.head<7>() << p, R_WB.coeffs();
    if (library == Library::kDrake) q_theirs.head<7>() << wxyz, p;
    if (library == Library::kMujoco) q_theirs.head<7>() << p, wxyz;
  }
  int k = tree.q_start();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double angle = q[tree.q_start() + j];
    if (library == Library::kPinocchio &&
        tree.joints()[j].type == JointType::kContinuous) {
      q_theirs[k++] = std::cos(angle);
      q_theirs[k++] = std::sin(angle);
    } else {
      q_theirs[k++] = angle;
    }
  }
}

void ImportConfiguration(Library library, const Tree& tree,
                         const VectorIn& q_theirs,
                         Eigen::Ref<Eigen::VectorXd> q) noexcept {
  assert(q_theirs.size() == ConfigurationSize(library, tree));
  if (tree.is_floating()) {
    const bool drake = library == Library::kDrake;
    const Vector3d p = q_theirs.segment<3>(drake ? 4 : 0);
    const Eigen::Vector4d four = q_theirs.segment<4>(drake ? 0 : 3);
    q.head<3>() = p;
    q.segment<4>(3) = library == Library::kPinocchio
                          ? four
                          : QuaternionFromWxyz(four).coeffs();
  }
  int k = tree.q_start();
  for (int j = 0; j < tree.num_joints(); ++j) {
    double angle = q_theirs[k++];
    if (library == Library::kPinocchio &&
        tree.joints()[j].type == JointType::kContinuous) {
      const double cosine = angle;
      angle = std::atan2(q_theirs[k++], cosine);
    }
    q[tree.q_start() + j] = angle;
  }
}

void ExportVelocity(Library library, const Tree& tree, const VectorIn& q,
                    const VectorIn& v,
                    Eigen::Ref<Eigen::VectorXd> v_theirs) noexcept {
  v_theirs = v;
  if (!tree.is_floating()) return;
  v_theirs.head<6>() = BaseMap(library, tree, q).Export(v.head<6>());
}

void ImportVelocity(Library library, const Tree& tree, const VectorIn& q,
                    const VectorIn& v_theirs,
                    Eigen::Ref<Eigen::VectorXd> v) noexcept {
  v = v_theirs;
  if (!tree.is_floating()) return;
  v.head<6>() = BaseMap(library, tree, q).Import(v_theirs.head<6>());
}

void ExportAcceleration(Library library, const Tree& tree, const VectorIn& q,
                        const VectorIn& v, const VectorIn& vdot,
                        Eigen::Ref<Eigen::VectorXd> vdot_theirs) noexcept {
  vdot_theirs = vdot;
  if (!tree.is_floating()) return;
  Vector6d base = vdot.head<6>();
  base.tail<3>() += TurningOfAxes(library, v);
  vdot_theirs.head<6>() = BaseMap(library, tree, q).Export(base);
}

void ImportAcceleration(Library library, const Tree& tree, const VectorIn& q,
                        const VectorIn& v, const VectorIn& vdot_theirs,
                        Eigen::Ref<Eigen::VectorXd> vdot) noexcept {
  ImportVelocity(library, tree, q, vdot_theirs, vdot);
  if (tree.is_floating()) vdot.segment<3>(3) -= TurningOfAxes(library, v);
}

void ExportForces(Library library, const Tree& tree, const VectorIn& q,
                  const VectorIn& tau,
                  Eigen::Ref<Eigen::VectorXd> tau_theirs) noexcept {
  ExportVelocity(library, tree, q, tau, tau_theirs);
}

void ImportForces(Library library, const Tree& tree, const VectorIn& q,
                  const VectorIn& tau_theirs,
                  Eigen::Ref<Eigen::VectorXd> tau) noexcept {
  ImportVelocity(library, tree, q, tau_theirs, tau);
}

void ExportMassMatrix(Library library, const Tree& tree, const VectorIn& q,
                      const Eigen::Ref<const Eigen::MatrixXd>& M,
                      Eigen::Ref<Eigen::MatrixXd> M_theirs) noexcept {
  M_theirs = M;
  if (!tree.is_floating()) return;
  const BaseMap X(library, tree, q);
  for (int i = 0; i < tree.nv(); ++i) {
    M_theirs.col(i).head<6>() = X.Export(M_theirs.col(i).head<6>());
  }
  for (int i = 0; i < tree.nv(); ++i) {
    M_theirs.row(i).head<6>() = X.Export(M_theirs.row(i).head<6>());
  }
}

void ImportMassMatrix(Library library, const Tree& tree, const VectorIn& q,
                      const Eigen::Ref<const Eigen::MatrixXd>& M_theirs,
                      Eigen::Ref<Eigen::MatrixXd> M) noexcept {
  M = M_theirs;
  if (!tree.is_floating()) return;
  const BaseMap X(library, tree, q);
  for (int i = 0; i < tree.nv(); ++i) {
    M.col(i).head<6>() = X.Import(M.col(i).head<6>());
  }
  for (int i = 0; i < tree.nv(); ++i) {
    M.row(i).head<6>() = X.Import(M.row(i).head<6>());
  }
}

void ExportBias(Library library, const Tree& tree, const VectorIn& q,
                const VectorIn& v, const Eigen::Ref<const Eigen::MatrixXd>& M,
                const VectorIn& N,
                Eigen::Ref<Eigen::VectorXd> N_theirs) noexcept {
  N_theirs = N;
  if (!tree.is_floating()) return;
  N_theirs.noalias() -= M.middleCols<3>(3) * TurningOfAxes(library, v);
  const Vector6d base = N_theirs.head<6>();
  N_theirs.head<6>() = BaseMap(library, tree, q).Export(base);
}

void ImportBias(Library library, const Tree& tree, const VectorIn& q,
                const VectorIn& v, const Eigen::Ref<const Eigen::MatrixXd>& M,
                const VectorIn& N_theirs,
                Eigen::Ref<Eigen::VectorXd> N) noexcept {
  ImportForces(library, tree, q, N_theirs, N);
  if (!tree.is_floating()) return;
  N.noalias() += M.middleCols<3>(3) * TurningOfAxes(library, v);
}

void ExportJacobian(Library library, const Tree& tree, const VectorIn& q,
                    const Eigen::Ref<const Matrix6Xd>& J,
                    Eigen::Ref<Matrix6Xd> J_theirs) noexcept {
  J_theirs = J;
  if (tree.is_floating()) {
    const BaseMap X(library, tree, q);
    for (int i = 0; i < 6; ++i) {
      J_theirs.row(i).head<6>() = X.Export(J.row(i).head<6>());
    }
  }
  if (!LinearFirst(library)) return;
  for (int i = 0; i < tree.nv(); ++i) {
    J_theirs.col(i) = SwapHalves(J_theirs.col(i));
  }
}

void ImportJacobian(Library library, const Tree& tree, const VectorIn& q,
                    const Eigen::Ref<const Matrix6Xd>& J_theirs,
                    Eigen::Ref<Matrix6Xd> J) noexcept {
  J = J_theirs;
  if (tree.is_floating()) {
    const BaseMap X(library, tree, q);
    for (int i = 0; i < 6; ++i) {
      J.row(i).head<6>() = X.Import(J_theirs.row(i).head<6>());
    }
  }
  if (!LinearFirst(library)) return;
  for (int i = 0; i < tree.nv(); ++i) J.col(i) = SwapHalves(J.col(i));
}

}  // namespace poise
