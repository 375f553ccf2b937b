// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/energy.h"
#include "poise/dynamics/kinematics.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

CenterOfMass Com(PythonTree* self, py::handle q, py::handle v) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  CenterOfMass out(tree);
  if (v.is_none()) {
    ComputeCenterOfMass(tree, VectorOf(a), Eigen::VectorXd::Zero(tree.nv()),
                        &self->recursion, &out);
  } else {
    const DoubleArray b = AsVector(v, "v", tree.nv());
    ComputeCenterOfMass(tree, VectorOf(a), VectorOf(b), &self->recursion, &out);
  }
  return out;
}

CentroidalMomentum Centroidal(PythonTree* self, py::handle q, py::handle v) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  CentroidalMomentum out(tree);
  ComputeCentroidalMomentum(tree, VectorOf(a), VectorOf(b), &self->recursion,
                            &out);
  return out;
}

double Kinetic(PythonTree* self, py::handle q, py::handle v) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  ComputePoses(tree, VectorOf(a), &self->X_WB);
  ComputeVelocities(tree, self->X_WB, VectorOf(b), &self->V_WB_W);
  return KineticEnergy(tree, self->X_WB, self->V_WB_W, VectorOf(b));
}

double Potential(PythonTree* self, py::handle q) {
  const DoubleArray a = AsVector(q, "q", self->tree().nq());
  ComputePoses(self->tree(), VectorOf(a), &self->X_WB);
  return PotentialEnergy(self->tree(), self->X_WB);
}

}  // namespace

void AddMomentum(TreeClass* tree) {
  tree->def("com", Com, py::arg("q"), py::arg("v") = py::none(),
            "Returns the CenterOfMass at (q, v); v is zero if it is None.");
  tree->def("centroidal", Centroidal, py::arg("q"), py::arg("v"),
            "Returns the CentroidalMomentum at (q, v).");
  tree->def("kinetic_energy", Kinetic, py::arg("q"), py::arg("v"),
            "Returns v' M v / 2, J.");
  tree->def("potential_energy", Potential, py::arg("q"),
            "Returns the energy of gravity, J; 0 with the center of mass at "
            "the world's origin.");
}

}  // namespace poise
