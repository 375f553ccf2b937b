// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/measure_accuracy.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <map>
#include <ostream>
#include <random>
#include <unsupported/Eigen/MPRealSupport>

#include "poise/math/quaternion.h"
#include "poise/math/se3.h"
#include "poise/math/se3_jacobian.h"
#include "poise/math/so3.h"
#include "poise/math/so3_jacobian.h"

namespace poise {
namespace {

using mpfr::mpreal;
using MatrixXmp = Eigen::Matrix<mpreal, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double kPi = M_PI;

// Returns the sum of A^n / (n + shift)! for n = 0, 1, ...
MatrixXmp PowerSeries(const MatrixXmp& A, int shift) {
  const int size = static_cast<int>(A.rows());
  MatrixXmp term = MatrixXmp::Identity(size, size) * (1 / mpfr::fac_ui(shift));
  MatrixXmp sum = term;
  // |A| <= 4 π + |v|: from n = 25 on each term is at most half the one before.
  for (int n = 1; n < 25 || term.squaredNorm() > 1e-100; ++n) {
    term = (term.lazyProduct(A) / mpreal(n + shift)).eval();
    sum += term;
  }
  return sum;
}

MatrixXmp HatExactly(const Eigen::Vector3d& w) { return Hat(w).cast<mpreal>(); }

MatrixXmp AdExactly(const Vector6d& x) {
  MatrixXmp ad = MatrixXmp::Zero(6, 6);
  ad.topLeftCorner(3, 3) = HatExactly(x.head<3>());
  ad.bottomRightCorner(3, 3) = HatExactly(x.head<3>());
  ad.bottomLeftCorner(3, 3) = HatExactly(x.tail<3>());
  return ad;
}

// Returns |actual - exact| / scale, in eps.
template <typename Actual>
double Error(const Actual& actual, const MatrixXmp& exact,
             const mpreal& scale) {
  const MatrixXmp difference = actual.template cast<mpreal>() - exact;
  // The difference is scaled first, since the square of 1e-300 underflows.
  return (difference / scale).norm().toDouble() /
         std::numeric_limits<double>::epsilon();
}

template <typename Actual>
double Error(const Actual& actual, const MatrixXmp& exact) {
  return Error(actual, exact, exact.norm());
}

struct Range {
  double from, to;
};

constexpr Range kRanges[] = {
    {1e-300, 1e-150},
    {1e-150, 1e-16},
    {1e-16, 1e-8},
    {1e-8, 1e-2},
    {1e-2, 1},
    {1, 1.58},
    {1.58, 1.582},
    {1.582, 3},
    {3, kPi},
    {kPi - 1e-6, kPi},
    {kPi, 6},
    {6, 2 * kPi - 1e-3},
    {2 * kPi - 1e-3, 2 * kPi - 1e-6},
    {2 * kPi - 1e-6, 2 * kPi},
    {2 * kPi, 2 * kPi + 0.1},
    {2 * kPi + 0.1, 4 * kPi},
};

// Sampler draws random arguments of the maps.
class Sampler {
 public:
  double Angle(const Range& range) {
    const double t = uniform_(generator_);
    return range.to <= 1 ? range.from * std::pow(range.to / range.from, t)
                         : range.from + t * (range.to - range.from);
  }

  Eigen::Vector3d Direction() {
    Eigen::Vector3d d(normal_(generator_), normal_(generator_),
                      normal_(generator_));
    const int i = static_cast<int>(3 * uniform_(generator_));
    const double kind = uniform_(generator_);
    if (kind < 0.15) d[i] = 0;
    if (kind > 0.85) d[i] *= 1e-6;
    return d.normalized();
  }

  Eigen::Vector3d LinearVelocity(const Eigen::Vector3d& axis) {
    Eigen::Vector3d d = Direction();
    const double kind = uniform_(generator_);
    if (kind < 0.25) d = axis.cross(d).normalized();
    if (kind > 0.75) d = axis + 1e-6 * d;
    return std::pow(10, 12 * uniform_(generator_) - 6) * d;
  }

 private:
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

using Errors = std::map<std::string, double>;

void MeasureSo3(const Eigen::Vector3d& w, Errors* errors) {
  const double angle = w.stableNorm();
  const double condition = angle > kPi ? angle : 1;
  const MatrixXmp R = PowerSeries(HatExactly(w), 0);
  const Eigen::Matrix3d actual = ExpSo3(w);
  (*errors)["ExpSo3"] = Error(actual, R) / condition;
  const MatrixXmp actual_exactly = actual.cast<mpreal>();
  (*errors)["ExpSo3, antisymmetric part"] =
      Error(((actual_exactly - actual_exactly.transpose()) / 2).eval(),
            (R - R.transpose()) / 2, angle) /
      condition;
  const Eigen::Quaterniond q = ExpQuaternion(w);
  const MatrixXmp half = PowerSeries(HatExactly(w) / 2, 0);
  // The series of w/2 gives cos(angle/2), and sin(angle/2) times the direction.
  MatrixXmp q_exact(4, 1);
  q_exact << (half(2, 1) - half(1, 2)) / 2, (half(0, 2) - half(2, 0)) / 2,
      (half(1, 0) - half(0, 1)) / 2, (half.trace() - 1) / 2;
  (*errors)["ExpQuaternion"] = Error(q.coeffs(), q_exact) / condition;

  const Eigen::Matrix3d R_rounded = R.cast<double>();
  if (angle <= kPi) {
    const MatrixXmp w_exact = w.cast<mpreal>();
    (*errors)["LogSo3"] = Error(LogSo3(R_rounded), w_exact, angle);
    const Eigen::Vector4d q_rounded = q_exact.cast<double>();
    (*errors)["LogQuaternion"] =
        Error(LogQuaternion(Eigen::Quaterniond(q_rounded)), w_exact, angle);
  }
}

void MeasureSo3Jacobians(const Eigen::Vector3d& w, Errors* errors) {
  const double angle = w.stableNorm();
  const MatrixXmp J = PowerSeries(HatExactly(w), 1);
  (*errors)["LeftJacobianSo3"] = Error(LeftJacobianSo3(w), J);
  (*errors)["RightJacobianSo3"] = Error(RightJacobianSo3(w), J.transpose());
  if (angle < 2 * kPi) {
    const double condition = std::max(1.0, angle / (2 * kPi - angle));
    const MatrixXmp inverse = J.inverse();
    (*errors)["InverseLeftJacobianSo3"] =
        Error(InverseLeftJacobianSo3(w), inverse) / condition;
    (*errors)["InverseRightJacobianSo3"] =
        Error(InverseRightJacobianSo3(w), inverse.transpose()) / condition;
  }
}

void MeasureSe3(const Vector6d& x, Errors* errors) {
  const Eigen::Vector3d w = x.head<3>(), v = x.tail<3>();
  const double angle = w.stableNorm();
  const MatrixXmp J = PowerSeries(HatExactly(w), 1);
  const MatrixXmp R = PowerSeries(HatExactly(w), 0);
  const MatrixXmp p = J * v.cast<mpreal>();
  const Pose X = ExpSe3(x);
  const double condition = angle > kPi ? angle : 1;
  (*errors)["ExpSe3, rotation"] = Error(X.R, R) / condition;
  (*errors)["ExpSe3, translation"] = Error(X.p, p) / condition;
  if (angle <= kPi) {
    const Vector6d log = LogSe3({R.cast<double>(), p.cast<double>()});
    (*errors)["LogSe3, rotation"] =
        Error(log.head<3>().eval(), w.cast<mpreal>(), angle);
    (*errors)["LogSe3, translation"] =
        Error(log.tail<3>().eval(), v.cast<mpreal>());
  }

  const MatrixXmp J6 = PowerSeries(AdExactly(x), 1);
  (*errors)["LeftJacobianSe3"] = Error(LeftJacobianSe3(x), J6);
  (*errors)["RightJacobianSe3"] =
      Error(RightJacobianSe3(x), PowerSeries(-AdExactly(x), 1));
  if (angle < 2 * kPi) {
    const double condition_of_inverse =
        std::max(1.0, angle / (2 * kPi - angle));
    (*errors)["InverseLeftJacobianSe3"] =
        Error(InverseLeftJacobianSe3(x), J6.inverse()) / condition_of_inverse;
    (*errors)["InverseRightJacobianSe3"] =
        Error(InverseRightJacobianSe3(-x), J6.inverse()) / condition_of_inverse;
  }
}

}  // namespace

std::vector<Accuracy> MeasureAccuracy(int samples) {
  mpreal::set_default_prec(400);
  Sampler sampler;
  std::map<std::string, std::vector<Accuracy>> by_map;
  for (const Range& range : kRanges) {
    std::map<std::string, Accuracy> worst;
    for (int i = 0; i < samples; ++i) {
      const double angle = sampler.Angle(range);
      Vector6d x;
      const Eigen::Vector3d axis = sampler.Direction();
      x << angle * axis, sampler.LinearVelocity(axis);
      Errors errors;
      MeasureSo3(x.head<3>(), &errors);
      MeasureSo3Jacobians(x.head<3>(), &errors);
      MeasureSe3(x, &errors);
      for (const auto& [map, error] : errors) {
        Accuracy& a = worst[map];
        // The condition is not (error > a.error), because a NaN must be
        // reported.
        if (i == 0 || !(error <= a.error)) {
          const bool is_jacobian = map.find("Jacobian") != std::string::npos;
          a = {map,  range.from, range.to, error, is_jacobian ? 8.0 : 4.0,
               angle};
        }
      }
    }
    for (const auto& [map, accuracy] : worst) by_map[map].push_back(accuracy);
  }
  std::vector<Accuracy> all;
  for (const auto& [map, rows] : by_map) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

void WriteAccuracy(const std::vector<Accuracy>& accuracy, std::ostream& os) {
  os << "| map | angles | error | at most | met at |\n|---|---|---|---|---|\n";
  for (const Accuracy& a : accuracy) {
    os << "| " << a.map << " | " << std::setprecision(8) << a.from << " ... "
       << a.to << " | " << std::fixed << std::setprecision(2) << a.error
       << std::defaultfloat << " | " << a.bar << " | " << std::setprecision(5)
       << a.angle << " |\n";
  }
}

}  // namespace poise
