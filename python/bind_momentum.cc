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
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(tree.nv());
  if (!v.is_none()) velocity = VectorOf(AsVector(v, "v", tree.nv()));
  const auto q_map = VectorOf(a);
  CenterOfMass out(tree);
  self->Run(&PythonTree::recursion, [&](Recursion* scratch) {
    ComputeCenterOfMass(tree, q_map, velocity, scratch, &out);
  });
  return out;
}

CentroidalMomentum Centroidal(PythonTree* self, py::handle q, py::handle v) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const auto q_map = VectorOf(a), v_map = VectorOf(b);
  CentroidalMomentum out(tree);
  self->Run(&PythonTree::recursion, [&](Recursion* scratch) {
    ComputeCentroidalMomentum(tree, q_map, v_map, scratch, &out);
  });
  return out;
}

double Kinetic(PythonTree* self, py::handle q, py::handle v) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const auto q_map = VectorOf(a), v_map = VectorOf(b);
  return self->Run(&PythonTree::kinematics, [&](KinematicsScratch* scratch) {
    ComputePoses(tree, q_map, &scratch->X_WB);
    ComputeVelocities(tree, scratch->X_WB, v_map, &scratch->V_WB_W);
    return KineticEnergy(tree, scratch->X_WB, scratch->V_WB_W, v_map);
  });
}

double Potential(PythonTree* self, py::handle q) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const auto q_map = VectorOf(a);
  return self->Run(&PythonTree::kinematics, [&](KinematicsScratch* scratch) {
    ComputePoses(tree, q_map, &scratch->X_WB);
    return PotentialEnergy(tree, scratch->X_WB);
  });
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
