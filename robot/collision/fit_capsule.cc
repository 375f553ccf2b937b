// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/fit_capsule.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Points of a ring around a cylinder. They lie outside of it, so that their
// polygon contains its circle.
constexpr int kRing = 12;

// Larger radii to try. A thicker capsule may be shorter, because its caps reach
// over the corners of a box.
constexpr double kRadii[] = {1, 1.03, 1.08, 1.15, 1.25, 1.4};

// Steps towards the smallest circle. Its radius is then within a few percent of
// the smallest one, and the circle contains all circles after any number of
// steps.
constexpr int kCircleSteps = 64;

struct Circle {
  Vector2d center;
  double radius;
};

// Returns a circle around circles of given centers and radii, near the smallest
// one: the center moves towards the farthest circle by shrinking steps
// (Badoiu and Clarkson, 2003).
Circle SurroundingCircle(const std::vector<Vector2d>& centers,
                         const std::vector<Ball>& balls) {
  Vector2d lower = centers[0], upper = centers[0];
  for (const Vector2d& c : centers) {
    lower = lower.cwiseMin(c);
    upper = upper.cwiseMax(c);
  }
  Vector2d center = (lower + upper) / 2;
  Circle best{center, INFINITY};
  for (int step = 0; step < kCircleSteps; ++step) {
    double radius = -1;
    size_t farthest = 0;
    for (size_t i = 0; i < centers.size(); ++i) {
      const double reach = (centers[i] - center).norm() + balls[i].radius;
      if (reach > radius) {
        radius = reach;
        farthest = i;
      }
    }
    if (radius < best.radius) best = {center, radius};
    center += (centers[farthest] - center) / (step + 2);
  }
  return best;
}

// Returns the shortest capsule along an axis that contains the balls, for the
// best of kRadii. The columns of R are the axis and two normals.
Capsule FitAlong(const Eigen::Matrix3d& R, const std::vector<Ball>& balls) {
  std::vector<Vector2d> across;
  for (const Ball& ball : balls) {
    across.push_back(R.rightCols<2>().transpose() * ball.center);
  }
  const Circle circle = SurroundingCircle(across, balls);
  Capsule best;
  double least = INFINITY;
  for (const double factor : kRadii) {
    const double radius = factor * circle.radius;
    double first = INFINITY, last = -INFINITY;
    for (size_t i = 0; i < balls.size(); ++i) {
      const double z = R.col(0).dot(balls[i].center);
      const double room = radius - balls[i].radius;
      const double off = (across[i] - circle.center).norm();
      // The ball is inside the capsule if and only if the segment has a point
      // within `room` of its center. Along the segment, this is `reach`.
      const double reach = std::sqrt(std::max(room * room - off * off, 0.0));
      first = std::min(first, z + reach);
      last = std::max(last, z - reach);
    }
    // The segment may be a single point if each point from `last` to `first` is
    // within reach of all balls.
    if (first > last) first = last = (first + last) / 2;
    const Vector3d base = R.rightCols<2>() * circle.center;
    const Capsule capsule{base + first * R.col(0), base + last * R.col(0),
                          radius};
    if (Volume(capsule) < least) {
      least = Volume(capsule);
      best = capsule;
    }
  }
  return best;
}

// Returns a rotation whose first column is along an axis.
Eigen::Matrix3d WithFirstColumn(const Vector3d& axis) {
  const Vector3d x = axis.normalized();
  Eigen::Matrix3d R;
  R.col(0) = x;
  R.col(1) = x.unitOrthogonal();
  R.col(2) = x.cross(R.col(1));
  return R;
}

std::vector<Ball> Points(const std::vector<Vector3d>& points, const Pose& X) {
  std::vector<Ball> balls;
  for (const Vector3d& p : points) balls.push_back({X * p, 0});
  return balls;
}

}  // namespace

double Volume(const Capsule& capsule) {
  const double r = capsule.radius;
  const double length = (capsule.end - capsule.start).norm();
  return M_PI * r * r * (length + 4 * r / 3);
}

std::vector<Ball> BallsOfShape(const Geometry& geometry, const Pose& X) {
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    return {{X.p, sphere->radius}};
  }
  std::vector<Vector3d> points;
  if (const auto* box = std::get_if<Box>(&geometry)) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d sides(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      points.push_back(sides.cwiseProduct(box->size) / 2);
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    const double r = cylinder->radius / std::cos(M_PI / kRing);
    for (int i = 0; i < kRing; ++i) {
      const double angle = 2 * M_PI * i / kRing;
      for (const double z : {-cylinder->length / 2, cylinder->length / 2}) {
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  }
  return Points(points, X);
}

Capsule FitCapsule(const std::vector<Ball>& balls) {
  Vector3d mean = Vector3d::Zero();
  for (const Ball& ball : balls) {
    if (!ball.center.allFinite() || !(ball.radius >= 0) ||
        !std::isfinite(ball.radius)) {
      throw std::invalid_argument(
          "capsule: a point or radius of a shape is not finite");
    }
    mean += ball.center / static_cast<double>(balls.size());
  }
  if (balls.empty()) {
    throw std::invalid_argument(
        "capsule: there are no points, must be one or more");
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vector3d farthest = Vector3d::Zero();
  for (const Ball& ball : balls) {
    const Vector3d off = ball.center - mean;
    spread += off * off.transpose();
    if (off.norm() > farthest.norm()) farthest = off;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::vector<Eigen::Matrix3d> frames;
  for (int i = 2; i >= 0; --i) {
    frames.push_back(WithFirstColumn(axes.eigenvectors().col(i)));
  }
  if (farthest.norm() > 0) frames.push_back(WithFirstColumn(farthest));
  Capsule best;
  double least = INFINITY;
  for (const Eigen::Matrix3d& R : frames) {
    const Capsule capsule = FitAlong(R, balls);
    // An axis counts only if it is better by more than rounding, so that the
    // choice does not depend on the compiler.
    if (Volume(capsule) < least * (1 - 1e-9)) {
      least = Volume(capsule);
      best = capsule;
    }
  }
  return best;
}

}  // namespace poise
