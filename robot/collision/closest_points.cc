// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/closest_points.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// Segments whose angle has a squared sine below this count as parallel; the
// quotient of the unconstrained minimum would be rounding.
constexpr double kParallel = 1e-12;

// A segment with a squared length below this counts as a point, m2.
constexpr double kPoint = 1e-18;

// Returns where a convex function of one variable has its minimum in [0, 1]:
// its derivative is curvature s - slope.
double Minimize(double slope, double curvature) {
  return curvature > kPoint ? std::clamp(slope / curvature, 0.0, 1.0) : 0.5;
}

}  // namespace

ClosestPoints ComputeClosestPoints(const Capsule& A, const Capsule& B,
                                   double softness) noexcept {
  const Eigen::Vector3d u = A.end - A.start;
  const Eigen::Vector3d w = B.end - B.start;
  const Eigen::Vector3d r = A.start - B.start;
  const double a = u.squaredNorm();
  const double b = u.dot(w);
  const double e = w.squaredNorm();
  // Half of the derivatives by s and t are
  //     aa s - b t - alpha   and   -b s + ee t - beta.
  const double aa = (1 + softness) * a;
  const double ee = (1 + softness) * e;
  const double alpha = softness * a / 2 - u.dot(r);
  const double beta = softness * e / 2 + w.dot(r);
  const double determinant = aa * ee - b * b;

  double s = 0.5;
  if (determinant > kParallel * aa * ee) {
    s = std::clamp((alpha * ee + b * beta) / determinant, 0.0, 1.0);
  } else if (e <= kPoint) {
    s = Minimize(alpha, aa);
  }
  const double t = Minimize(beta + b * s, ee);
  // On a bound of t the best s is another one; inside [0, 1], s stays.
  s = Minimize(alpha + b * t, aa);

  ClosestPoints closest;
  closest.p_A = A.start + s * u;
  closest.p_B = B.start + t * w;
  const Eigen::Vector3d x = closest.p_A - closest.p_B;
  const double squared = x.squaredNorm();
  const double bulge = softness * (a * s * (1 - s) + e * t * (1 - t));
  // The axes of deeply overlapping capsules may cross; D is then bounded from
  // below, so that the gradient stays below 2.
  const bool is_bounded = squared - bulge < squared / 4;
  const double D = std::sqrt(is_bounded ? squared / 4 : squared - bulge);
  closest.distance = D - A.radius - B.radius;
  // dD = x · dx / D; on the bound D = |x| / 2, so dD = x · dx / (4 D).
  const double slope = is_bounded ? 0.25 : 1;
  closest.gradient.setZero();
  if (D > 0) closest.gradient = slope / D * x;
  return closest;
}

}  // namespace poise
