// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/integrate.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/math/quaternion.h"

namespace poise {
namespace {

Eigen::Quaterniond BaseRotation(const Eigen::Ref<const Eigen::VectorXd>& q) {
  return Normalize(Eigen::Quaterniond(q[6], q[3], q[4], q[5]));
}

}  // namespace

void Integrate(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
               const Eigen::Ref<const Eigen::VectorXd>& v, double dt,
               Eigen::Ref<Eigen::VectorXd> q_out) noexcept {
  assert(q.size() == tree.nq() && v.size() == tree.nv());
  assert(q_out.size() == tree.nq());
  if (tree.is_floating()) {
    const Eigen::Vector3d w_WB = v.head<3>();
    const Eigen::Quaterniond R = ExpQuaternion(dt * w_WB) * BaseRotation(q);
    q_out.head<3>() = q.head<3>() + dt * v.segment<3>(3);
    q_out.segment<4>(3) = Normalize(R).coeffs();
  }
  const int n = tree.num_joints();
  q_out.tail(n) = q.tail(n) + dt * v.tail(n);
}

void Difference(const Tree& tree,
                const Eigen::Ref<const Eigen::VectorXd>& q_from,
                const Eigen::Ref<const Eigen::VectorXd>& q_to,
                Eigen::Ref<Eigen::VectorXd> v) noexcept {
  assert(q_from.size() == tree.nq() && q_to.size() == tree.nq());
  assert(v.size() == tree.nv());
  if (tree.is_floating()) {
    v.head<3>() =
        LogQuaternion(BaseRotation(q_to) * BaseRotation(q_from).conjugate());
    v.segment<3>(3) = q_to.head<3>() - q_from.head<3>();
  }
  const int n = tree.num_joints();
  v.tail(n) = q_to.tail(n) - q_from.tail(n);
}

}  // namespace poise
