// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/rnea.h"

#include <cassert>

#include "poise/dynamics/simd/sweeps.h"

namespace poise {
namespace {

// Computes the generalized forces with gravity g_W, without armatures.
void Compute(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
             const Eigen::Ref<const Eigen::VectorXd>& v,
             const Eigen::Ref<const Eigen::VectorXd>& vdot,
             const Eigen::Vector3d& g_W,
             const std::vector<SpatialForce>* F_Bo_W, Recursion* scratch,
             Eigen::Ref<Eigen::VectorXd> tau) {
  SweepPoses(tree, q, scratch);
  SweepAccelerations(tree, v, vdot, g_W, scratch);
  SweepInertias(tree, scratch);
  SweepForces(tree, scratch);
  if (F_Bo_W != nullptr) {
    for (int b = 0; b < tree.num_bodies(); ++b) {
      scratch->F_W.Set(b, scratch->F_W[b] - ToForce3((*F_Bo_W)[b]));
    }
  }
  SumForces(tree, scratch);
  ProjectForces(tree, *scratch, tau);
}

}  // namespace

void ComputeRnea(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 const Eigen::Ref<const Eigen::VectorXd>& vdot,
                 const std::vector<SpatialForce>& F_Bo_W, Recursion* scratch,
                 Eigen::Ref<Eigen::VectorXd> tau) noexcept {
  assert(F_Bo_W.empty() ||
         static_cast<int>(F_Bo_W.size()) == tree.num_bodies());
  Compute(tree, q, v, vdot, tree.gravity_W(),
          F_Bo_W.empty() ? nullptr : &F_Bo_W, scratch, tau);
  const std::vector<double>& armature = tree.joint_maps().armature;
  for (int j = 0; j < tree.num_joints(); ++j) {
    tau[tree.v_start() + j] += armature[j + 1] * vdot[tree.v_start() + j];
  }
}

void ComputeBias(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v, Recursion* scratch,
                 Eigen::Ref<Eigen::VectorXd> N) noexcept {
  Compute(tree, q, v, scratch->zero, tree.gravity_W(), nullptr, scratch, N);
}

void ComputeCoriolis(const Tree& tree,
                     const Eigen::Ref<const Eigen::VectorXd>& q,
                     const Eigen::Ref<const Eigen::VectorXd>& v,
                     Recursion* scratch,
                     Eigen::Ref<Eigen::VectorXd> c) noexcept {
  Compute(tree, q, v, scratch->zero, Eigen::Vector3d::Zero(), nullptr, scratch,
          c);
}

}  // namespace poise
