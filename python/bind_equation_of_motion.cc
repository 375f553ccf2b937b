// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <stdexcept>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/rnea.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

py::array Rnea(PythonTree* self, py::handle q, py::handle v, py::handle vdot,
               py::handle forces) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(vdot, "vdot", tree.nv());
  const auto F_Bo_W = AsForces(forces, tree.num_bodies());
  py::array_t<double> tau = NewVector(tree.nv());
  ComputeRnea(tree, VectorOf(a), VectorOf(b), VectorOf(c), F_Bo_W,
              &self->recursion, Writable(&tau));
  return std::move(tau);
}

py::array Bias(PythonTree* self, py::handle q, py::handle v,
               py::handle gravity) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  py::array_t<double> N = NewVector(tree.nv());
  const auto compute =
      AsFlag(gravity, "gravity") ? ComputeBias : ComputeCoriolis;
  compute(tree, VectorOf(a), VectorOf(b), &self->recursion, Writable(&N));
  return std::move(N);
}

py::array Crba(PythonTree* self, py::handle q) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  FortranArray M = NewMatrix(tree.nv(), tree.nv());
  ComputeCrba(tree, VectorOf(a), &self->recursion, Writable(&M));
  return std::move(M);
}

py::array Aba(PythonTree* self, py::handle q, py::handle v, py::handle tau,
              py::handle forces) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(tau, "tau", tree.nv());
  const auto F_Bo_W = AsForces(forces, tree.num_bodies());
  py::array_t<double> vdot = NewVector(tree.nv());
  const AbaStatus status =
      ComputeAba(tree, VectorOf(a), VectorOf(b), VectorOf(c), F_Bo_W,
                 &self->aba, Writable(&vdot));
  if (status == AbaStatus::kSingular) {
    throw std::invalid_argument(
        "aba: the joint-space inertia is singular, because a joint moves no "
        "mass: give the body a mass, or lock the joint in the profile");
  }
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
