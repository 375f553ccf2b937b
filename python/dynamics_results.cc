// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <string>

#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/derivatives.h"
#include "poise/python/add_view.h"
#include "poise/python/bind_dynamics.h"
#include "poise/robot/finding.h"

namespace poise {

void BindDynamicsResults(py::module_* module) {
  py::class_<CenterOfMass> com(
      *module, "CenterOfMass",
      "The motion of the center of mass G in world axes. Arrays are read-only, "
      "without a copy.");
  AddView("p", &CenterOfMass::p_WG, "(3,) Position, m.", &com);
  AddView("v", &CenterOfMass::v_WG, "(3,) Velocity J v, m/s.", &com);
  AddView("J", &CenterOfMass::J_WG, "(3, nv) Jacobian.", &com);
  AddView("bias", &CenterOfMass::bias,
          "(3,) The acceleration is J vdot + bias, m/s2.", &com);
  com.def("__repr__", [](const CenterOfMass& self) {
    return "<poise.CenterOfMass at (" + PrintNumber(self.p_WG.x()) + ", " +
           PrintNumber(self.p_WG.y()) + ", " + PrintNumber(self.p_WG.z()) +
           ") m>";
  });

  py::class_<CentroidalMomentum> momentum(
      *module, "CentroidalMomentum",
      "The momentum L_G = H v about the center of mass G, world axes, angular "
      "part first. Arrays are read-only, without a copy.");
  AddView("H", &CentroidalMomentum::H_G,
          "(6, nv) The centroidal momentum matrix.", &momentum);
  AddView("bias", &CentroidalMomentum::bias,
          "(6,) The rate of L_G is H vdot + bias.", &momentum);
  momentum.def("__repr__", [](const CentroidalMomentum& self) {
    return "<poise.CentroidalMomentum, H of shape (6, " +
           std::to_string(self.H_G.cols()) + ")>";
  });

  py::class_<RneaDerivatives> derivatives(
      *module, "Derivatives",
      "The derivatives of rnea(). Arrays are read-only, without a copy.");
  AddView(
      "dq", &RneaDerivatives::dtau_dq,
      "(nv, nv) The derivative of tau by d at q = integrate(q, d, 1), d = 0.",
      &derivatives);
  AddView("dv", &RneaDerivatives::dtau_dv,
          "(nv, nv) The derivative of tau by v.", &derivatives);
  AddView("dvdot", &RneaDerivatives::dtau_dvdot,
          "(nv, nv) The derivative of tau by vdot, which is M.", &derivatives);
  derivatives.def("__repr__", [](const RneaDerivatives& self) {
    return "<poise.Derivatives, nv = " + std::to_string(self.dtau_dq.cols()) +
           ">";
  });
}

}  // namespace poise
