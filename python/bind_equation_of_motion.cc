// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <stdexcept>
#include <string>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/rnea.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

// Names the joints without inertia: M has a zero on their diagonal.
[[noreturn]] void RefuseSingular(const Tree& tree,
                                 const Eigen::Ref<const Eigen::VectorXd>& q) {
  Recursion scratch(tree);
  Eigen::MatrixXd M(tree.nv(), tree.nv());
  ComputeCrba(tree, q, &scratch, M);
  const double none = 1e-13 * M.diagonal().maxCoeff();
  std::string joints, locked;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const int i = tree.v_start() + j;
    if (M(i, i) > none) continue;
    const std::string name = "'" + tree.joints()[j].name + "'";
    joints += (joints.empty() ? "" : ", ") + name;
    locked += (locked.empty() ? "" : ", ") + name + ": 0";
  }
  throw std::invalid_argument(
      joints.empty()
          ? "aba: the joint-space inertia is singular at this q: give the "
            "light bodies more mass"
          : "aba: the joint-space inertia is singular, because no mass moves "
            "with joint " +
                joints +
                ": give the body a mass, or load the tree with locked={" +
                locked + "}");
}

py::array Rnea(PythonTree* self, py::handle q, py::handle v, py::handle vdot,
               py::handle forces) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(vdot, "vdot", tree.nv());
  const auto F_Bo_W = AsForces(forces, tree.num_bodies());
  const auto q_map = VectorOf(a), v_map = VectorOf(b), vdot_map = VectorOf(c);
  py::array_t<double> tau = NewVector(tree.nv());
  auto to = Writable(&tau);
  self->Run(&PythonTree::recursion, [&](Recursion* scratch) {
    ComputeRnea(tree, q_map, v_map, vdot_map, F_Bo_W, scratch, to);
  });
  return std::move(tau);
}

py::array Bias(PythonTree* self, py::handle q, py::handle v,
               py::handle gravity) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const auto q_map = VectorOf(a), v_map = VectorOf(b);
  py::array_t<double> N = NewVector(tree.nv());
  auto to = Writable(&N);
  const auto compute =
      AsFlag(gravity, "gravity") ? ComputeBias : ComputeCoriolis;
  self->Run(&PythonTree::recursion, [&](Recursion* scratch) {
    compute(tree, q_map, v_map, scratch, to);
  });
  return std::move(N);
}

py::array Crba(PythonTree* self, py::handle q) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const auto q_map = VectorOf(a);
  FortranArray M = NewMatrix(tree.nv(), tree.nv());
  auto to = Writable(&M);
  self->Run(&PythonTree::recursion,
            [&](Recursion* scratch) { ComputeCrba(tree, q_map, scratch, to); });
  return std::move(M);
}

py::array Aba(PythonTree* self, py::handle q, py::handle v, py::handle tau,
              py::handle forces) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(tau, "tau", tree.nv());
  const auto F_Bo_W = AsForces(forces, tree.num_bodies());
  const auto q_map = VectorOf(a), v_map = VectorOf(b), tau_map = VectorOf(c);
  py::array_t<double> vdot = NewVector(tree.nv());
  auto to = Writable(&vdot);
  const AbaStatus status =
      self->Run(&PythonTree::aba, [&](AbaScratch* scratch) {
        return ComputeAba(tree, q_map, v_map, tau_map, F_Bo_W, scratch, to);
      });
  if (status == AbaStatus::kSingular) RefuseSingular(tree, q_map);
  return std::move(vdot);
}

}  // namespace

void AddEquationOfMotion(TreeClass* tree) {
  tree->def(
      "rnea", Rnea, py::arg("q"), py::arg("v"), py::arg("vdot"),
      py::arg("forces") = py::none(),
      "Returns the generalized forces tau (nv,) = M vdot + N - sum of J' "
      "F by the recursive Newton-Euler algorithm: [torque about the "
      "base's origin; force; joints], N m and N.\n\n"
      "q (nq,), v (nv,), vdot (nv,): see Tree. forces (bodies, 6): rows "
      "[torque; force] on each body about its origin, world axes; copied.");
  tree->def("bias", Bias, py::arg("q"), py::arg("v"), py::arg("gravity") = true,
            "Returns the bias forces N (nv,), N m and N: Coriolis, centrifugal "
            "and gravity; without gravity if gravity is False.");
  tree->def("crba", Crba, py::arg("q"),
            "Returns the joint-space inertia M (nv, nv), symmetric, in Fortran "
            "order, by the composite-rigid-body algorithm.");
  tree->def("aba", Aba, py::arg("q"), py::arg("v"), py::arg("tau"),
            py::arg("forces") = py::none(),
            "Returns the acceleration vdot (nv,) = M^-1 (tau - N + sum of J' "
            "F), rad/s2 and m/s2, by the articulated-body algorithm. Raises "
            "poise.InputError if M is singular.\n\n"
            "tau (nv,) and forces (bodies, 6): see rnea().");
}

}  // namespace poise
