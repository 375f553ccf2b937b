// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/sole.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "poise/robot/feet/feet.h"
#include "poise/robot/feet/resting_normal.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A height above a plane, m. A leg much shorter or longer than a human's bounds
// the height, as fractions of the leg's length.
struct Band {
  double height, least, most;
  double For(double leg) const {
    return std::max(least * leg, std::min(height, most * leg));
  }
};

// A corner at most this far above a plane belongs to the plane. Drawings are
// often rounded to 1 mm.
constexpr Band kFlat{2e-3, 0.002, 0.01};
// A vertex of a mesh at most this far above the sole belongs to it.
constexpr Band kMeshBand{6e-3, 0.006, 0.03};
// Bounds for a sole in the configuration at rest, rad. kSteepest: angle between
// the normal and the vertical. kMostTurned: angle between the x axis and the
// forward direction.
constexpr double kSteepest = 0.6;
constexpr double kMostTurned = 0.3;
constexpr double kSameAxis = 1e-6;
// A square of this side, as a fraction of the leg, is too small for a sole.
constexpr double kSmall = 0.05;

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

// Returns the sole in the lowest plane with this normal.
//
// @param flat       largest height of a corner above the plane, m.
// @param mesh_band  largest height of a mesh's vertex above the plane, m.
Sole SoleAlong(const Outline& outline, const Vector3d& normal, double flat,
               double mesh_band) {
  double height = std::numeric_limits<double>::infinity();
  for (const Outline::Corner& corner : outline.corners) {
    height = std::min(height, normal.dot(corner.p_B) - corner.radius);
  }
  Sole sole;
  sole.normal_B = normal;
  for (const Outline::Corner& corner : outline.corners) {
    const double above = normal.dot(corner.p_B) - height;
    if (above - corner.radius > (corner.is_mesh ? mesh_band : flat)) continue;
    if (corner.is_mesh) sole.source = SoleSource::kMesh;
    sole.frame = corner.frame;
    sole.points_B.push_back(corner.p_B - above * normal);
  }
  sole.area = Area(sole);
  return sole;
}

// Estimates the depth of the sole below the body's origin, along up_B, and the
// link that carries the sole.
double EstimateDepth(const RobotModel& model, int body, const Vector3d& up_B,
                     double leg, int* frame) {
  // A link less than this below the body's origin is not at the sole.
  constexpr Band kNone{0.01, 0.01, 0.05};
  const double none = kNone.For(leg);
  double depth = 0;
  for (int i = 0; i < static_cast<int>(model.tree.frames().size()); ++i) {
    const Frame& link = model.tree.frames()[i];
    if (link.body != body) continue;
    if (*frame < 0) *frame = i;
    const double below = -up_B.dot(link.X_BF.p);
    const bool is_sole = link.name.find("sole") != std::string::npos;
    if (below > std::max(depth, none) || (is_sole && below > none)) {
      depth = below;
      *frame = i;
      if (is_sole) return depth;
    }
  }
  return depth > 0 ? depth : 0.1 * leg;
}

// Returns the shapes of an outline as a text: "1 sphere, 3 mesh vertices".
std::string ListOf(const Outline& outline) {
  int spheres = 0, vertices = 0, points = 0;
  for (const Outline::Corner& corner : outline.corners) {
    ++(corner.is_mesh ? vertices : corner.radius > 0 ? spheres : points);
  }
  std::string list;
  const auto add = [&](int count, const char* one, const char* many) {
    if (count == 0) return;
    list += (list.empty() ? "" : ", ") + std::to_string(count) +
            (count == 1 ? one : many);
  };
  add(spheres, " sphere", " spheres");
  add(vertices, " mesh vertex", " mesh vertices");
  add(points, " corner of a box or cylinder",
      " corners of boxes and cylinders");
  return list;
}

}  // namespace

Sole FindSole(const Outline& outline, const Vector3d& up_B, double leg) {
  const double flat = kFlat.For(leg);
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
  const auto add_resting = [&](bool only_meshes) {
    const auto normal = RestingNormal(outline, up_B, only_meshes);
    if (normal) add(*normal);
  };
  add_resting(/*only_meshes=*/true);
  Sole best;
  const auto find_largest = [&] {
    for (const Vector3d& normal : normals) {
      Sole sole = SoleAlong(outline, normal, flat, flat);
      // The factor 1.01 prefers the first plane if areas are equal up to
      // rounding.
      if (sole.area > 1.01 * best.area) best = std::move(sole);
    }
  };
  find_largest();
  if (best.area < kSmall * kSmall * leg * leg) {
    // Points of contact may lie on a plane that is tilted to the shapes.
    add_resting(/*only_meshes=*/false);
    find_largest();
  }
  if (best.area <= flat * flat) return {};
  return best.source == SoleSource::kMesh
             ? SoleAlong(outline, best.normal_B, flat, kMeshBand.For(leg))
             : best;
}

Sole EstimateSole(const RobotModel& model, int body, const Vector3d& up_B,
                  const Vector3d& forward_B, const Vector3d& p_BA_B,
                  double leg) {
  Sole sole;
  sole.frame = -1;
  const double depth = EstimateDepth(model, body, up_B, leg, &sole.frame);
  sole.normal_B = up_B;
  sole.source = SoleSource::kGuess;
  const Vector3d side_B = up_B.cross(forward_B);
  // The foot's origin may lie anywhere along the axis of its joint. So the sole
  // is placed relative to the ankle (forward) and the center of mass
  // (sideways).
  const double ankle = forward_B.dot(p_BA_B);
  const double middle = side_B.dot(model.tree.inertias()[body].p_BoG_B);
  // The width is below that of any known robot's foot: a sole that is wider
  // than the foot would let the robot tip over its edge.
  for (const double x : {-0.07, 0.15}) {
    for (const double y : {-0.0425, 0.0425}) {
      sole.points_B.push_back((ankle + x * leg) * forward_B +
                              (middle + y * leg) * side_B - depth * up_B);
    }
  }
  return sole;
}

std::string WhyWithoutMesh(const Outline& outline) {
  const std::string sole = "the sole in a profile";
  if (!outline.mesh_is_missing) {
    return "because " + outline.mesh_refusal + "; correct the mesh, or give " +
           sole;
  }
  const bool is_of_package =
      outline.mesh_refusal.find("package://") != std::string::npos;
  return "because " + outline.mesh_refusal +
         (is_of_package ? ": give --package-path DIR, in Python "
                          "packages=[DIR], or " +
                              sole
                        : ": put the file there, or give " + sole);
}

std::string WhyEstimated(const Outline& outline) {
  if (!outline.mesh_refusal.empty()) return WhyWithoutMesh(outline);
  const std::string remedy = ": give the sole in a profile";
  if (outline.corners.empty()) {
    return "because the foot has no shape" + remedy;
  }
  return "because the shapes of the foot have no flat underside (they are " +
         ListOf(outline) + ")" + remedy;
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
