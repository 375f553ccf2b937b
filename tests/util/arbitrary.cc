// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/arbitrary.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "poise/math/so3.h"

namespace poise {
namespace {

// Maps 0, 1, 2, 3, ... to 0, -1, 1, -2, ... so that numbers shrink to 0:
// inRange() shrinks to its lower end.
double Unfold(int folded) {
  return folded % 2 == 0 ? folded / 2 : -(folded + 1) / 2;
}

// Prints a vector as [1 2 3].
void Print(const Eigen::VectorXd& x, std::ostream& os) {
  os << '[' << x.transpose() << ']';
}

}  // namespace

rc::Gen<double> Numbers(double bound) {
  return rc::gen::map(rc::gen::inRange(0, 2001), [bound](int folded) -> double {
    return bound * Unfold(folded) / 1000;
  });
}

rc::Gen<Eigen::VectorXd> VectorsXd(int size, double bound) {
  return rc::gen::map(
      rc::gen::container<std::vector<int>>(size, rc::gen::inRange(0, 2001)),
      [bound](const std::vector<int>& folded) -> Eigen::VectorXd {
        Eigen::VectorXd x(folded.size());
        for (int i = 0; i < x.size(); ++i) {
          x[i] = bound * Unfold(folded[i]) / 1000;
        }
        return x;
      });
}

rc::Gen<Eigen::Vector3d> Vectors() {
  return rc::gen::map(
      VectorsXd(3, 10),
      [](const Eigen::VectorXd& x) -> Eigen::Vector3d { return x; });
}

rc::Gen<Eigen::Vector3d> RotationVectors(double bound) {
  const auto norms = rc::gen::oneOf(
      rc::gen::element(0.0, 1e-300, 1e-160, 1e-8, 1e-4, 1.5811, 1.5812,
                       M_PI - 1e-8, M_PI),
      rc::gen::map(rc::gen::inRange(0, 1001), [bound](int thousandths) {
        return bound * thousandths / 1000;
      }));
  const auto directions = rc::gen::oneOf(
      Vectors(),
      rc::gen::element(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                       Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, -1, 0)));
  return rc::gen::map(
      rc::gen::pair(norms, directions),
      [bound](const std::pair<double, Eigen::Vector3d>& x) -> Eigen::Vector3d {
        return std::min(x.first, bound) * x.second.normalized();
      });
}

rc::Gen<Eigen::Matrix3d> Rotations() {
  return rc::gen::map(
      RotationVectors(M_PI),
      [](const Eigen::Vector3d& w) -> Eigen::Matrix3d { return ExpSo3(w); });
}

rc::Gen<Pose> Poses() {
  return rc::gen::map(
      rc::gen::pair(Rotations(), Vectors()),
      [](const std::pair<Eigen::Matrix3d, Eigen::Vector3d>& x) -> Pose {
        return {x.first, x.second};
      });
}

rc::Gen<SpatialMotion> Motions() {
  return rc::gen::map(VectorsXd(6, 10),
                      [](const Eigen::VectorXd& x) -> SpatialMotion {
                        return SpatialMotion(Vector6d(x));
                      });
}

rc::Gen<SpatialForce> Forces() {
  return rc::gen::map(VectorsXd(6, 10),
                      [](const Eigen::VectorXd& x) -> SpatialForce {
                        return SpatialForce(Vector6d(x));
                      });
}

rc::Gen<Inertia> Inertias() {
  // Second moments s >= 0 of the mass in three directions give the principal
  // moments s_y + s_z, s_z + s_x and s_x + s_y. These are exactly the moments
  // that a body can have.
  return rc::gen::map(
      rc::gen::tuple(
          rc::gen::inRange(1, 1001), Vectors(),
          rc::gen::container<std::vector<int>>(3, rc::gen::inRange(0, 1000)),
          Rotations()),
      [](const std::tuple<int, Eigen::Vector3d, std::vector<int>,
                          Eigen::Matrix3d>& x) -> Inertia {
        const auto& [mass, p_BoG_B, s, R] = x;
        const Eigen::Vector3d moments(s[1] + s[2], s[2] + s[0], s[0] + s[1]);
        const Eigen::Matrix3d I =
            R * (moments / 1000).asDiagonal() * R.transpose();
        return {mass / 100.0, p_BoG_B / 10, 0.5 * (I + I.transpose())};
      });
}

void showValue(const Pose& X, std::ostream& os) {
  os << "log R ";
  Print(LogSo3(X.R), os);
  os << " p ";
  Print(X.p, os);
}

void showValue(const SpatialMotion& V, std::ostream& os) {
  Print(V.vector(), os);
}

void showValue(const SpatialForce& F, std::ostream& os) {
  Print(F.vector(), os);
}

void showValue(const Inertia& M, std::ostream& os) {
  os << "mass " << M.mass << " p_BoG_B ";
  Print(M.p_BoG_B, os);
  os << " I_G_B\n" << M.I_G_B;
}

}  // namespace poise
