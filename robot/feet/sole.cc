// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/sole.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "poise/robot/feet/feet.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A corner at most this far from a plane belongs to the plane, m. Drawings are
// often rounded to 1 mm.
constexpr double kFlat = 2e-3;
// Bounds for a sole in the configuration at rest, rad. kSteepest: angle between
// the normal and the vertical. kMostTurned: angle between the x axis and the
// forward direction.
constexpr double kSteepest = 0.6;
constexpr double kMostTurned = 0.3;
constexpr double kSameAxis = 1e-6;
// At most about this many axes of a body are used, so that a body with very
// many shapes does not take long.
constexpr size_t kMostAxes = 64;

// Adds the corners and axes of a shape. A curved rim becomes 16 points.
void AddShape(const Shape& shape, const Pose& X_BF, Outline* outline) {
  const Pose X_BS = X_BF * shape.X_FS;
  const auto add = [&](const Vector3d& p_S, double radius) {
    outline->corners.push_back({shape.frame, X_BS * p_S, radius});
  };
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      add(0.5 * box->size.cwiseProduct(sign), 0);
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    constexpr int kPoints = 16;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * M_PI * i / kPoints;
      for (const double end : {-0.5, 0.5}) {
        add({cylinder->radius * std::cos(angle),
             cylinder->radius * std::sin(angle), end * cylinder->length},
            0);
      }
    }
  } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    add(Vector3d::Zero(), sphere->radius);
    return;  // The axes of a sphere have no meaning.
  } else {
    return;  // Meshes are not opened.
  }
  if (outline->axes_B.size() >= kMostAxes) return;
  for (int i = 0; i < 3; ++i) outline->axes_B.push_back(X_BS.R.col(i));
}

double Area(const Sole& sole) {
  const Vector3d x = sole.normal_B.unitOrthogonal();
  const Vector3d y = sole.normal_B.cross(x);
  std::vector<Vector2d> points;
  for (const Vector3d& p : sole.points_B)
    points.push_back({x.dot(p), y.dot(p)});
  const std::vector<Vector2d> hull = ConvexHull(std::move(points));
  double area = 0;
  for (size_t i = 2; i < hull.size(); ++i) {
    const Vector2d a = hull[i - 1] - hull[0];
    const Vector2d b = hull[i] - hull[0];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

// Estimates the depth of the sole below the body's origin, along up_B, and the
// link that carries the sole.
double EstimateDepth(const RobotModel& model, int body, const Vector3d& up_B,
                     double leg, int* frame) {
  // A link less than this below the body's origin is not at the sole, m.
  constexpr double kNone = 0.01;
  double depth = 0;
  for (int i = 0; i < static_cast<int>(model.tree.frames().size()); ++i) {
    const Frame& link = model.tree.frames()[i];
    if (link.body != body) continue;
    if (*frame < 0) *frame = i;
    const double below = -up_B.dot(link.X_BF.p);
    const bool is_sole = link.name.find("sole") != std::string::npos;
    if (below > std::max(depth, kNone) || (is_sole && below > kNone)) {
      depth = below;
      *frame = i;
      if (is_sole) return depth;
    }
  }
  return depth > 0 ? depth : 0.1 * leg;
}

}  // namespace

std::vector<Outline> MakeOutlines(const RobotModel& model) {
  const std::vector<Frame>& frames = model.tree.frames();
  std::vector<Outline> outlines(model.tree.num_bodies());
  for (Outline& outline : outlines) {
    for (int i = 0; i < 3; ++i) outline.axes_B.push_back(Vector3d::Unit(i));
  }
  for (const std::vector<Shape>* shapes : {&model.collisions, &model.visuals}) {
    std::vector<bool> done;
    for (const Outline& outline : outlines) {
      done.push_back(!outline.corners.empty());
    }
    for (const Shape& shape : *shapes) {
      const Frame& frame = frames[shape.frame];
      if (!done[frame.body]) {
        AddShape(shape, frame.X_BF, &outlines[frame.body]);
      }
    }
  }
  return outlines;
}

Sole FindSole(const Outline& outline, const Vector3d& up_B) {
  std::vector<Vector3d> normals;
  const auto add = [&](const Vector3d& axis) {
    const Vector3d normal = axis.dot(up_B) < 0 ? Vector3d(-axis) : axis;
    if (normal.dot(up_B) < std::cos(kSteepest)) return;
    for (const Vector3d& other : normals) {
      if ((normal - other).norm() < kSameAxis) return;
    }
    normals.push_back(normal);
  };
  for (const Vector3d& axis : outline.axes_B) add(axis);
  add(up_B);
  Sole best;
  for (const Vector3d& normal : normals) {
    double height = std::numeric_limits<double>::infinity();
    for (const Outline::Corner& corner : outline.corners) {
      height = std::min(height, normal.dot(corner.p_B) - corner.radius);
    }
    Sole sole;
    sole.normal_B = normal;
    for (const Outline::Corner& corner : outline.corners) {
      const double above = normal.dot(corner.p_B) - height;
      if (above - corner.radius > kFlat) continue;
      sole.frame = corner.frame;
      sole.points_B.push_back(corner.p_B - above * normal);
    }
    sole.area = Area(sole);
    // The factor 1.01 prefers the first plane if areas are equal up to
    // rounding.
    if (sole.area > 1.01 * best.area) best = std::move(sole);
  }
  return best.area > kFlat * kFlat ? best : Sole{};
}

Sole EstimateSole(const RobotModel& model, int body, const Vector3d& up_B,
                  const Vector3d& forward_B, const Vector3d& p_BA_B,
                  double leg) {
  Sole sole;
  sole.frame = -1;
  const double depth = EstimateDepth(model, body, up_B, leg, &sole.frame);
  sole.normal_B = up_B;
  const Vector3d side_B = up_B.cross(forward_B);
  // The foot's origin may lie anywhere along the axis of its joint. So the sole
  // is placed relative to the ankle (forward) and the center of mass
  // (sideways).
  const double ankle = forward_B.dot(p_BA_B);
  const double middle = side_B.dot(model.tree.inertias()[body].p_BoG_B);
  for (const double x : {-0.07, 0.15}) {
    for (const double y : {-0.06, 0.06}) {
      sole.points_B.push_back((ankle + x * leg) * forward_B +
                              (middle + y * leg) * side_B - depth * up_B);
    }
  }
  return sole;
}

Pose MakeSoleAxes(const Sole& sole, const Outline& outline,
                  const Vector3d& forward_B) {
  const Vector3d z = sole.normal_B;
  const auto in_plane = [&](const Vector3d& a) -> Vector3d {
    return (a - a.dot(z) * z).normalized();
  };
  const Vector3d wanted = in_plane(forward_B);
  Vector3d x = wanted;
  double best = std::cos(kMostTurned);
  for (const Vector3d& axis : outline.axes_B) {
    if (std::abs(axis.dot(z)) > 0.5) continue;  // Far from the plane.
    const double along = in_plane(axis).dot(wanted);
    if (std::abs(along) > best + 1e-9) {
      best = std::abs(along);
      x = along > 0 ? in_plane(axis) : -in_plane(axis);
    }
  }
  Pose X_BS;
  X_BS.R << x, z.cross(x), z;
  X_BS.p = sole.points_B[0].dot(z) * z;
  return X_BS;
}

}  // namespace poise
