// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/se3.h"
#include "poise/math/se3_jacobian.h"
#include "poise/python/add_function.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"

namespace poise {
namespace {

// Adds a function of a tangent vector of shape (6,).
template <typename Function>
void AddOfVector(const char* name, Function function, const char* doc,
                 py::module_* se3) {
  AddFunction<AsVector6>(name, "x", function, doc, se3);
}

// Adds a function of a pose of shape (4, 4).
template <typename Function>
void AddOfPose(const char* name, Function function, const char* doc,
               py::module_* se3) {
  AddFunction<AsPose>(name, "X", function, doc, se3);
}

void AddGroup(py::module_* se3) {
  AddOfVector("hat", HatSe3,
              "Returns the matrix [hat(w) v; 0 0], (4, 4), of x = [w; v].",
              se3);
  se3->def(
      "vee",
      [](py::handle W) {
        return ToArray(VeeSe3(MatrixOf(AsArray(W, "W", {4, 4}))));
      },
      py::arg("W"),
      "Returns the tangent vector (6,) of a matrix (4, 4), the inverse of "
      "hat().");
  AddOfVector("exp", ExpSe3,
              "Returns the pose (4, 4) reached in unit time from the identity "
              "at the constant twist x = [w; v], (6,).",
              se3);
  AddOfPose("log", LogSe3,
            "Returns the twist [w; v], (6,), of a pose (4, 4), with |w| <= pi.",
            se3);
  AddOfPose(
      "inverse", [](const Pose& X) { return X.Inverse(); },
      "Returns X_BA (4, 4) of X_AB (4, 4).", se3);
  se3->def(
      "interpolate",
      [](py::handle X_0, py::handle X_1, py::handle t) {
        return ToArray(InterpolateSe3(AsPose(X_0, "X_0"), AsPose(X_1, "X_1"),
                                      AsNumber(t, "t")));
      },
      py::arg("X_0"), py::arg("X_1"), py::arg("t"),
      "Returns the pose (4, 4) at fraction t of the screw from X_0 (t = 0) to "
      "X_1 (t = 1).");
}

void AddMatrices(py::module_* se3) {
  AddOfPose("adjoint", Adjoint,
            "Returns the matrix (6, 6) that maps a twist [w; v] at the origin "
            "and in the axes of B to those of A, for X = X_AB.",
            se3);
  AddOfPose("dual_adjoint", DualAdjoint,
            "Returns the matrix (6, 6) that maps a wrench [moment; force] from "
            "B to A, for X = X_AB.",
            se3);
  AddOfVector("left_jacobian", LeftJacobianSe3,
              "Returns J (6, 6) with exp(x + d) = exp(J d) exp(x) + O(d^2).",
              se3);
  AddOfVector("right_jacobian", RightJacobianSe3,
              "Returns J (6, 6) with exp(x + d) = exp(x) exp(J d) + O(d^2).",
              se3);
  AddOfVector("inverse_left_jacobian", InverseLeftJacobianSe3,
              "Returns the inverse of left_jacobian(x), for |w| < 2 pi.", se3);
  AddOfVector("inverse_right_jacobian", InverseRightJacobianSe3,
              "Returns the inverse of right_jacobian(x), for |w| < 2 pi.", se3);
}

}  // namespace

void BindSe3(py::module_* module) {
  py::module_ se3 = module->def_submodule(
      "se3",
      "SE(3), the group of poses X_AB as homogeneous matrices [R p; 0 0 0 1]. "
      "A tangent vector is x = [w; v], angular part first, in rad and m. "
      "Arrays are copied: they have at most 36 entries. NaN in an input gives "
      "NaN."
      "\n\n"
      ">>> X = poise.se3.exp([0, 0, np.pi / 2, 1, 0, 0])\n"
      ">>> bool(np.allclose(poise.se3.inverse(X) @ X, np.eye(4)))\n"
      "True\n");
  AddGroup(&se3);
  AddMatrices(&se3);
}

}  // namespace poise
