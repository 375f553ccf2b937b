// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <stdexcept>
#include <string>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

Axes ToAxes(py::handle axes) {
  const std::string name = AsText(axes, "axes");
  if (name == "world") return Axes::kWorld;
  if (name == "frame") return Axes::kFrame;
  throw std::invalid_argument("axes is '" + name +
                              "', must be 'world' or 'frame'");
}

// Computes the poses of the bodies into the scratch memory.
void UpdatePoses(py::handle q, PythonTree* self) {
  const DoubleArray a = AsVector(q, "q", self->tree().nq());
  ComputePoses(self->tree(), VectorOf(a), &self->X_WB);
}

py::array FramePoseOf(PythonTree* self, py::handle q, py::handle frame) {
  const int index = self->FindFrame(frame);
  UpdatePoses(q, self);
  return ToArray(FramePose(self->tree(), self->X_WB, index));
}

py::array Jacobian(PythonTree* self, py::handle q, py::handle frame,
                   py::handle axes) {
  const int index = self->FindFrame(frame);
  const Axes which = ToAxes(axes);
  UpdatePoses(q, self);
  FortranArray J = NewMatrix(6, self->tree().nv());
  Eigen::Map<Matrix6Xd> to(J.mutable_data(), 6, self->tree().nv());
  ComputeFrameJacobian(self->tree(), self->X_WB, index, which, to);
  return std::move(J);
}

py::array JacobianBias(PythonTree* self, py::handle q, py::handle v,
                       py::handle frame, py::handle axes) {
  const Tree& tree = self->tree();
  const int index = self->FindFrame(frame);
  const Axes which = ToAxes(axes);
  const DoubleArray b = AsVector(v, "v", tree.nv());
  UpdatePoses(q, self);
  ComputeVelocities(tree, self->X_WB, VectorOf(b), &self->V_WB_W);
  ComputeAccelerations(tree, self->X_WB, self->V_WB_W, VectorOf(b),
                       Eigen::VectorXd::Zero(tree.nv()), &self->A_WB_W);
  return ToArray(FrameBias(
      FrameAcceleration(tree, self->X_WB, self->V_WB_W, self->A_WB_W, index),
      FrameVelocity(tree, self->X_WB, self->V_WB_W, index),
      FramePose(tree, self->X_WB, index).R, which));
}

py::array IntegrateOf(PythonTree* self, py::handle q, py::handle v,
                      py::handle dt) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const double seconds = AsNumber(dt, "dt");
  py::array_t<double> out = NewVector(tree.nq());
  Integrate(tree, VectorOf(a), VectorOf(b), seconds, Writable(&out));
  return std::move(out);
}

py::array DifferenceOf(PythonTree* self, py::handle q_from, py::handle q_to) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q_from, "q_from", tree.nq());
  const DoubleArray b = AsVector(q_to, "q_to", tree.nq());
  py::array_t<double> v = NewVector(tree.nv());
  Difference(tree, VectorOf(a), VectorOf(b), Writable(&v));
  return std::move(v);
}

}  // namespace

void AddKinematics(TreeClass* tree) {
  tree->def("pose", FramePoseOf, py::arg("q"), py::arg("frame"),
            "Returns the pose X_WF (4, 4) of a frame, given by its name or "
            "index.");
  tree->def("jacobian", Jacobian, py::arg("q"), py::arg("frame"),
            py::arg("axes") = "world",
            "Returns J (6, nv), in Fortran order, with J v = [w; v] of the "
            "frame's origin, rad/s and m/s. axes is 'world' or 'frame'.");
  tree->def("jacobian_bias", JacobianBias, py::arg("q"), py::arg("v"),
            py::arg("frame"), py::arg("axes") = "world",
            "Returns Jdot v (6,), the rate of [w; v] at vdot = 0, rad/s2 and "
            "m/s2.");
  tree->def("integrate", IntegrateOf, py::arg("q"), py::arg("v"), py::arg("dt"),
            "Returns q (nq,) after dt s at a velocity v (nv,) that is constant "
            "in world axes.");
  tree->def("difference", DifferenceOf, py::arg("q_from"), py::arg("q_to"),
            "Returns the v (nv,) that leads from q_from to q_to in 1 s, the "
            "inverse of integrate().");
}

}  // namespace poise
