// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/robot_shapes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Default colors, for shapes whose color the robot file does not give: grey for
// ellipsoids, and darker grey for the capsules between joints.
const Eigen::Vector4d kEllipsoidColor{0.66, 0.70, 0.76, 1};
const Eigen::Vector4d kBoneColor{0.42, 0.46, 0.52, 1};

// Range of half axes, m. Smaller ones would be invisible, larger ones would
// fill the scene.
constexpr double kSmallestHalfAxis = 0.004;
constexpr double kLargestHalfAxis = 0.4;

// Primitives with less than this fraction of the ellipsoid's volume cannot be
// the whole body.
constexpr double kTooSmall = 0.05;

struct KindAndSize {
  BodyShapeKind kind;
  Eigen::Vector3d size;
};

std::optional<KindAndSize> AsPrimitive(const Geometry& geometry) {
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    return KindAndSize{BodyShapeKind::kEllipsoid,
                       Eigen::Vector3d::Constant(sphere->radius)};
  }
  if (const auto* box = std::get_if<Box>(&geometry)) {
    return KindAndSize{BodyShapeKind::kBox, box->size};
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    return KindAndSize{BodyShapeKind::kCylinder,
                       {cylinder->radius, cylinder->length, 0}};
  }
  return std::nullopt;
}

double Volume(const BodyShape& shape) {
  const Eigen::Vector3d& s = shape.size;
  switch (shape.kind) {
    case BodyShapeKind::kBox:
      return s.prod();
    case BodyShapeKind::kEllipsoid:
      return 4.0 / 3.0 * kPi * s.prod();
    case BodyShapeKind::kCylinder:
      return kPi * s.x() * s.x() * s.y();
    case BodyShapeKind::kCapsule:
      return kPi * s.x() * s.x() * (s.y() + 4.0 / 3.0 * s.x());
  }
  return 0;
}

std::vector<BodyShape> PrimitivesOf(const std::vector<Shape>& shapes,
                                    const Tree& tree, int body) {
  std::vector<BodyShape> primitives;
  for (const Shape& shape : shapes) {
    const Frame& link = tree.frames()[shape.frame];
    if (link.body != body) continue;
    const auto primitive = AsPrimitive(shape.geometry);
    if (!primitive) continue;
    const BodyShape drawn{body, link.X_BF * shape.X_FS, primitive->kind,
                          primitive->size, shape.rgba};
    if (Volume(drawn) > 0) primitives.push_back(drawn);
  }
  return primitives;
}

// Returns the uniform ellipsoid with the inertia of a body. With half axes a,
// b, c, mass m and principal moments I, I_x = m (b^2 + c^2) / 5, and so on.
std::optional<BodyShape> EllipsoidOf(const Inertia& inertia, int body) {
  if (!(inertia.mass > 0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia.I_G_B);
  const Eigen::Vector3d& I = eigen.eigenvalues();
  Eigen::Matrix3d R_BS = eigen.eigenvectors();
  if (R_BS.determinant() < 0) R_BS.col(0) *= -1;
  const Eigen::Vector3d squares =
      2.5 / inertia.mass * (Eigen::Vector3d::Constant(I.sum()) - 2 * I);
  const Eigen::Vector3d half_axes = squares.cwiseMax(0)
                                        .cwiseSqrt()
                                        .cwiseMax(kSmallestHalfAxis)
                                        .cwiseMin(kLargestHalfAxis);
  return BodyShape{body,
                   {R_BS, inertia.p_BoG_B},
                   BodyShapeKind::kEllipsoid,
                   half_axes,
                   kEllipsoidColor};
}

// Returns a capsule from a body's origin to p_BF_B, or nothing if it would be
// too short to be visible.
std::optional<BodyShape> BoneTo(const Eigen::Vector3d& p_BF_B, int body) {
  const double length = p_BF_B.norm();
  if (length < 2 * kSmallestHalfAxis) return std::nullopt;
  const double radius = std::clamp(0.1 * length, kSmallestHalfAxis, 0.025);
  const Eigen::Vector3d z = p_BF_B / length;
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Matrix3d R_BS;
  R_BS << x, z.cross(x), z;
  return BodyShape{body,
                   {R_BS, p_BF_B / 2},
                   BodyShapeKind::kCapsule,
                   {radius, length, 0},
                   kBoneColor};
}

}  // namespace

std::vector<BodyShape> MakeBodyShapes(const RobotModel& robot) {
  const Tree& tree = robot.tree;
  std::vector<BodyShape> shapes;
  for (int body = 0; body < tree.num_bodies(); ++body) {
    std::vector<BodyShape> drawn = PrimitivesOf(robot.visuals, tree, body);
    if (drawn.empty()) drawn = PrimitivesOf(robot.collisions, tree, body);
    double volume = 0;
    for (const BodyShape& shape : drawn) volume += Volume(shape);
    const auto ellipsoid = EllipsoidOf(tree.inertias()[body], body);
    if (drawn.empty() ||
        (ellipsoid && volume < kTooSmall * Volume(*ellipsoid))) {
      if (ellipsoid) drawn.push_back(*ellipsoid);
      for (const Joint& joint : tree.joints()) {
        if (joint.parent != body) continue;
        const auto bone = BoneTo(joint.X_PF.p, body);
        if (bone) drawn.push_back(*bone);
      }
    }
    shapes.insert(shapes.end(), drawn.begin(), drawn.end());
  }
  return shapes;
}

}  // namespace poise
