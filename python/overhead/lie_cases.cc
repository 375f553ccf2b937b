// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>

#include "poise/math/pose.h"
#include "poise/math/quaternion.h"
#include "poise/math/rpy.h"
#include "poise/math/se3.h"
#include "poise/math/se3_jacobian.h"
#include "poise/math/so3.h"
#include "poise/math/so3_jacobian.h"
#include "poise/math/spatial.h"
#include "poise/python/overhead/cases.h"

namespace poise {
namespace {

// Appends a function of one argument.
template <typename Function, typename Argument>
void Add(const char* name, Function function, const Argument& argument,
         std::vector<TimedCase>* cases) {
  cases->push_back({name, [function, argument] { Keep(function(argument)); }});
}

void AddSo3(std::vector<TimedCase>* cases) {
  const Eigen::Vector3d w(0.3, -0.5, 0.8);
  const Eigen::Matrix3d R = ExpSo3(w);
  const Eigen::Quaterniond quaternion = QuaternionFromMatrix(R);
  Add("so3.hat", Hat, w, cases);
  Add("so3.vee", Vee, R, cases);
  Add("so3.exp", ExpSo3, w, cases);
  Add("so3.log", LogSo3, R, cases);
  Add("so3.project", ProjectToSo3, R, cases);
  Add("so3.left_jacobian", LeftJacobianSo3, w, cases);
  Add("so3.right_jacobian", RightJacobianSo3, w, cases);
  Add("so3.inverse_left_jacobian", InverseLeftJacobianSo3, w, cases);
  Add("so3.inverse_right_jacobian", InverseRightJacobianSo3, w, cases);
  Add("so3.quaternion", QuaternionFromMatrix, R, cases);
  cases->push_back({"so3.matrix", [quaternion] {
                      Keep(MatrixFromQuaternion(Normalize(quaternion)));
                    }});
  Add("so3.from_rpy", MatrixFromRpy, w, cases);
  Add("so3.rpy", RpyFromMatrix, R, cases);
  cases->push_back({"so3.interpolate",
                    [R] { Keep(InterpolateSo3(R, R.transpose(), 0.5)); }});
}

void AddSe3(std::vector<TimedCase>* cases) {
  Vector6d x;
  x << 0.3, -0.5, 0.8, 1, 2, -0.4;
  const Pose X = ExpSe3(x);
  const Eigen::Matrix4d W = HatSe3(x);
  Add("se3.hat", HatSe3, x, cases);
  Add("se3.vee", VeeSe3, W, cases);
  Add("se3.exp", ExpSe3, x, cases);
  Add("se3.log", LogSe3, X, cases);
  cases->push_back({"se3.inverse", [X] { Keep(X.Inverse()); }});
  cases->push_back(
      {"se3.interpolate", [X] { Keep(InterpolateSe3(X, X.Inverse(), 0.5)); }});
  Add("se3.adjoint", Adjoint, X, cases);
  Add("se3.dual_adjoint", DualAdjoint, X, cases);
  Add("se3.left_jacobian", LeftJacobianSe3, x, cases);
  Add("se3.right_jacobian", RightJacobianSe3, x, cases);
  Add("se3.inverse_left_jacobian", InverseLeftJacobianSe3, x, cases);
  Add("se3.inverse_right_jacobian", InverseRightJacobianSe3, x, cases);
}

}  // namespace

void AddLieCases(std::vector<TimedCase>* cases) {
  AddSo3(cases);
  AddSe3(cases);
}

}  // namespace poise
