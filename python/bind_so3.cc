// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/quaternion.h"
#include "poise/math/rpy.h"
#include "poise/math/so3.h"
#include "poise/math/so3_jacobian.h"
#include "poise/python/add_function.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"

namespace poise {
namespace {

// Adds a function of a rotation vector.
template <typename Function>
void AddOfVector(const char* name, Function function, const char* doc,
                 py::module_* so3) {
  AddFunction<AsVector3>(name, "w", function, doc, so3);
}

// Adds a function of a matrix of shape (3, 3).
template <typename Function>
void AddOfMatrix(const char* name, Function function, const char* doc,
                 py::module_* so3) {
  AddFunction<AsMatrix3>(name, "R", function, doc, so3);
}

void AddGroup(py::module_* so3) {
  AddOfVector(
      "hat", Hat,
      "Returns the matrix (3, 3) of the cross product: hat(w) @ v = w x v.",
      so3);
  AddOfMatrix("vee", Vee,
              "Returns the vector (3,) of the antisymmetric part of a matrix "
              "(3, 3), the inverse of hat().",
              so3);
  AddOfVector("exp", ExpSo3,
              "Returns the rotation (3, 3) by |w| rad about w, shape (3,).",
              so3);
  AddOfMatrix(
      "log", LogSo3,
      "Returns the rotation vector (3,), rad, of a rotation (3, 3). Its "
      "norm is at most pi. The result is undefined if R is not a "
      "rotation.",
      so3);
  AddOfMatrix("project", ProjectToSo3,
              "Returns the rotation (3, 3) nearest to a matrix (3, 3).", so3);
  so3->def(
      "interpolate",
      [](py::handle R_0, py::handle R_1, py::handle t) {
        return ToArray(InterpolateSo3(AsMatrix3(R_0, "R_0"),
                                      AsMatrix3(R_1, "R_1"), AsNumber(t, "t")));
      },
      py::arg("R_0"), py::arg("R_1"), py::arg("t"),
      "Returns the rotation (3, 3) at fraction t of the shorter arc from R_0 "
      "(t = 0) to R_1 (t = 1).");
}

void AddJacobians(py::module_* so3) {
  AddOfVector("left_jacobian", LeftJacobianSo3,
              "Returns J (3, 3) with exp(w + d) = exp(J d) exp(w) + O(d^2).",
              so3);
  AddOfVector("right_jacobian", RightJacobianSo3,
              "Returns J (3, 3) with exp(w + d) = exp(w) exp(J d) + O(d^2).",
              so3);
  AddOfVector("inverse_left_jacobian", InverseLeftJacobianSo3,
              "Returns the inverse of left_jacobian(w), for |w| < 2 pi.", so3);
  AddOfVector("inverse_right_jacobian", InverseRightJacobianSo3,
              "Returns the inverse of right_jacobian(w), for |w| < 2 pi.", so3);
}

void AddCharts(py::module_* so3) {
  AddOfMatrix(
      "quaternion",
      [](const Eigen::Matrix3d& R) -> Eigen::Vector4d {
        return QuaternionFromMatrix(R).coeffs();
      },
      "Returns the unit quaternion (4,) of a rotation (3, 3), in the order x, "
      "y, z, w, with w >= 0.",
      so3);
  so3->def(
      "matrix",
      [](py::handle quaternion) {
        const DoubleArray xyzw = AsVector(quaternion, "quaternion", 4);
        const double* x = xyzw.data();
        return ToArray(MatrixFromQuaternion(
            Normalize(Eigen::Quaterniond(x[3], x[0], x[1], x[2]))));
      },
      py::arg("quaternion"),
      "Returns the rotation (3, 3) of a quaternion (4,) in the order x, y, z, "
      "w, of any norm but 0. Zero gives NaN.");
  AddFunction<AsVector3>(
      "from_rpy", "rpy", MatrixFromRpy,
      "Returns the rotation (3, 3) of roll, pitch and yaw (3,), rad, as in a "
      "URDF: Rz(yaw) Ry(pitch) Rx(roll).",
      so3);
  AddOfMatrix("rpy", RpyFromMatrix,
              "Returns roll, pitch and yaw (3,), rad, the inverse of "
              "from_rpy().",
              so3);
}

}  // namespace

void BindSo3(py::module_* module) {
  py::module_ so3 = module->def_submodule(
      "so3",
      "SO(3), the group of rotations R_AB with v_A = R_AB v_B. Angles are in "
      "rad. Arrays are copied: they have at most nine entries. NaN in an input "
      "gives NaN."
      "\n\n"
      ">>> w = np.array([0.1, -0.2, 0.3])\n"
      ">>> bool(np.allclose(poise.so3.log(poise.so3.exp(w)), w))\n"
      "True\n");
  AddGroup(&so3);
  AddJacobians(&so3);
  AddCharts(&so3);
}

}  // namespace poise
