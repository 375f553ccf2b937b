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

py::array FramePoseOf(PythonTree* self, py::handle q, py::handle frame) {
  const Tree& tree = self->tree();
  const int index = self->FindFrame(frame);
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const auto q_map = VectorOf(a);
  return ToArray(
      self->Run(&PythonTree::kinematics, [&](KinematicsScratch* scratch) {
        ComputePoses(tree, q_map, &scratch->X_WB);
        return FramePose(tree, scratch->X_WB, index);
      }));
}

py::array Jacobian(PythonTree* self, py::handle q, py::handle frame,
                   py::handle axes) {
  const int index = self->FindFrame(frame);
  const Axes which = ToAxes(axes);
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const auto q_map = VectorOf(a);
  FortranArray J = NewMatrix(6, tree.nv());
  Eigen::Map<Matrix6Xd> to(J.mutable_data(), 6, tree.nv());
  self->Run(&PythonTree::kinematics, [&](KinematicsScratch* scratch) {
    ComputePoses(tree, q_map, &scratch->X_WB);
    ComputeFrameJacobian(tree, scratch->X_WB, index, which, to);
  });
  return std::move(J);
}

py::array JacobianBias(PythonTree* self, py::handle q, py::handle v,
                       py::handle frame, py::handle axes) {
  const Tree& tree = self->tree();
  const int index = self->FindFrame(frame);
  const Axes which = ToAxes(axes);
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const auto q_map = VectorOf(a), v_map = VectorOf(b);
  const Vector6d bias =
      self->Run(&PythonTree::kinematics, [&](KinematicsScratch* scratch) {
        auto& [X_WB, V_WB_W, A_WB_W] = *scratch;
        ComputePoses(tree, q_map, &X_WB);
        ComputeVelocities(tree, X_WB, v_map, &V_WB_W);
        ComputeAccelerations(tree, X_WB, V_WB_W, v_map,
                             Eigen::VectorXd::Zero(tree.nv()), &A_WB_W);
        return Vector6d(
            FrameBias(FrameAcceleration(tree, X_WB, V_WB_W, A_WB_W, index),
                      FrameVelocity(tree, X_WB, V_WB_W, index),
                      FramePose(tree, X_WB, index).R, which));
      });
  return ToArray(bias);
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
