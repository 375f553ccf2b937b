// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <memory>

#include "poise/dynamics/derivatives.h"
#include "poise/dynamics/regressor.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

// These two take more than 10 us for a humanoid, so they release Python's lock
// and have scratch memory of their own.
std::unique_ptr<RneaDerivatives> Derivatives(PythonTree* self, py::handle q,
                                             py::handle v, py::handle vdot,
                                             py::handle forces) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(vdot, "vdot", tree.nv());
  const auto F_Bo_W = AsForces(forces, tree.num_bodies());
  const auto q_map = VectorOf(a), v_map = VectorOf(b), vdot_map = VectorOf(c);
  const py::gil_scoped_release release;
  auto out = std::make_unique<RneaDerivatives>(tree);
  ComputeRneaDerivatives(tree, q_map, v_map, vdot_map, F_Bo_W, out.get());
  return out;
}

py::array Regressor(PythonTree* self, py::handle q, py::handle v,
                    py::handle vdot) {
  constexpr int kPerBody = 10;
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const DoubleArray c = AsVector(vdot, "vdot", tree.nv());
  FortranArray Y =
      NewMatrix(tree.nv(), kPerBody * tree.num_bodies() + tree.num_joints());
  const auto q_map = VectorOf(a), v_map = VectorOf(b), vdot_map = VectorOf(c);
  auto to = Writable(&Y);
  {
    const py::gil_scoped_release release;
    Recursion scratch(tree);
    ComputeRegressor(tree, q_map, v_map, vdot_map, &scratch, to);
  }
  return std::move(Y);
}

}  // namespace

void AddDerivatives(TreeClass* tree) {
  tree->def("derivatives", Derivatives, py::arg("q"), py::arg("v"),
            py::arg("vdot"), py::arg("forces") = py::none(),
            "Returns the Derivatives of rnea() at the same arguments. Other "
            "threads run meanwhile.");
  tree->def("regressor", Regressor, py::arg("q"), py::arg("v"), py::arg("vdot"),
            "Returns Y (nv, 10 bodies + joints), in Fortran order, with Y pi = "
            "rnea(q, v, vdot). Other threads run meanwhile.");
  tree->def(
      "inertial_parameters",
      [](const PythonTree& self) {
        return ToArray(MakeInertialParameters(self.tree()));
      },
      "Returns pi (10 bodies + joints,): by body [m; m p_BoG (3); Ixx; Iyy; "
      "Izz; Ixy; Ixz; Iyz] about its origin and in its axes, then the armature "
      "of each joint. kg, kg m, kg m2.");
}

}  // namespace poise
