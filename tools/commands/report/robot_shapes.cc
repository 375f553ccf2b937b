// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/robot_shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "poise/dynamics/kinematics.h"

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
// A half axis may be this fraction of the robot's size.
constexpr double kLargestPart = 0.15;

// Primitives with less than this fraction of the ellipsoid's volume cannot be
// the whole body.
constexpr double kTooSmall = 0.05;

struct KindAndSize {
  BodyShapeKind kind;
  Eigen::Vector3d size;
  std::shared_ptr<const TriangleMesh> mesh = nullptr;
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
  const auto& mesh = std::get<Mesh>(geometry);
  if (mesh.surface == nullptr) return std::nullopt;
  return KindAndSize{BodyShapeKind::kMesh, Eigen::Vector3d::Zero(),
                     mesh.surface};
}

// Returns the volume of a shape, m³. The volume of a mesh is a rough estimate:
// half of its bounding box.
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
    case BodyShapeKind::kMesh: {
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3f& p : shape.mesh->vertices) {
        box.extend(p.cast<double>());
      }
      return box.isEmpty() ? 0 : 0.5 * box.volume();
    }
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
    const BodyShape drawn{
        body,       link.X_BF * shape.X_FS, primitive->kind, primitive->size,
        shape.rgba, primitive->mesh};
    if (Volume(drawn) > 0) primitives.push_back(drawn);
  }
  return primitives;
}

// Returns the uniform ellipsoid with the inertia of a body. With half axes a,
// b, c, mass m and principal moments I, I_x = m (b^2 + c^2) / 5, and so on.
//
// @param most  bound on the half axes, m.
std::optional<BodyShape> EllipsoidOf(const Inertia& inertia, int body,
                                     double most) {
  if (!(inertia.mass > 0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia.I_G_B);
  const Eigen::Vector3d& I = eigen.eigenvalues();
  Eigen::Matrix3d R_BS = eigen.eigenvectors();
  if (R_BS.determinant() < 0) R_BS.col(0) *= -1;
  const Eigen::Vector3d squares =
      2.5 / inertia.mass * (Eigen::Vector3d::Constant(I.sum()) - 2 * I);
  const Eigen::Vector3d half_axes =
      squares.cwiseMax(0).cwiseSqrt().cwiseMin(most).cwiseMax(
          kSmallestHalfAxis);
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

// Returns the size of a robot with all joints at zero: the diagonal of the box
// around the bodies' origins, m.
double SizeOf(const RobotModel& robot) {
  std::vector<Pose> X_WB(robot.tree.num_bodies());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.tree.nq());
  if (robot.tree.is_floating()) q[6] = 1;  // The base's quaternion.
  ComputePoses(robot.tree, q, &X_WB);
  Eigen::AlignedBox3d box;
  for (const Pose& X : X_WB) box.extend(X.p);
  return box.diagonal().norm();
}

// Returns the distance from a body's center of mass to the farthest of its
// joints, m.
double ReachOf(const Tree& tree, int body) {
  const Eigen::Vector3d& p_BoG_B = tree.inertias()[body].p_BoG_B;
  double reach = p_BoG_B.norm();
  for (const Joint& joint : tree.joints()) {
    if (joint.parent != body) continue;
    reach = std::max(reach, (joint.X_PF.p - p_BoG_B).norm());
  }
  return reach;
}

// Returns whether a point is inside a shape, or less than 5 mm outside.
bool Covers(const BodyShape& shape, const Eigen::Vector3d& p_B) {
  constexpr double kNear = 5e-3;
  const Eigen::Vector3d p = shape.X_BS.Inverse() * p_B;
  const Eigen::Vector3d& s = shape.size;
  switch (shape.kind) {
    case BodyShapeKind::kBox:
      return (p.cwiseAbs() - 0.5 * s).maxCoeff() < kNear;
    case BodyShapeKind::kEllipsoid:
      return p.cwiseQuotient((s.array() + kNear).matrix()).norm() < 1;
    case BodyShapeKind::kCylinder:
    case BodyShapeKind::kCapsule:
      return p.head<2>().norm() < s.x() + kNear &&
             std::abs(p.z()) < 0.5 * s.y() + kNear;
    case BodyShapeKind::kMesh:
      break;
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& q : shape.mesh->vertices) {
    box.extend(q.cast<double>());
  }
  return box.exteriorDistance(p) < kNear;
}

// Returns whether a part of the line from a body's origin to p_BF_B is in none
// of the shapes.
bool HasGap(const std::vector<BodyShape>& shapes,
            const Eigen::Vector3d& p_BF_B) {
  constexpr int kSamples = 20;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector3d p = i * p_BF_B / kSamples;
    const auto covers = [&](const BodyShape& shape) {
      return Covers(shape, p);
    };
    if (std::none_of(shapes.begin(), shapes.end(), covers)) return true;
  }
  return false;
}

// Returns for each body whether one of its meshes has not been read.
std::vector<bool> LackMeshes(const RobotModel& robot) {
  std::vector<bool> lack(robot.tree.num_bodies(), false);
  for (const Shape& shape : robot.visuals) {
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr || mesh->surface != nullptr) continue;
    lack[robot.tree.frames()[shape.frame].body] = true;
  }
  return lack;
}

bool HasMesh(const std::vector<BodyShape>& shapes) {
  return std::any_of(shapes.begin(), shapes.end(), [](const BodyShape& shape) {
    return shape.kind == BodyShapeKind::kMesh;
  });
}

}  // namespace

std::vector<BodyShape> MakeBodyShapes(const RobotModel& robot) {
  const Tree& tree = robot.tree;
  const std::vector<bool> lack_meshes = LackMeshes(robot);
  const double size = SizeOf(robot);
  std::vector<BodyShape> shapes;
  for (int body = 0; body < tree.num_bodies(); ++body) {
    std::vector<BodyShape> drawn = PrimitivesOf(robot.visuals, tree, body);
    const size_t num_visuals = drawn.size();
    if (drawn.empty()) drawn = PrimitivesOf(robot.collisions, tree, body);
    double volume = 0;
    for (const BodyShape& shape : drawn) volume += Volume(shape);
    const double most = std::min(
        kLargestHalfAxis, std::max(kLargestPart * size, ReachOf(tree, body)));
    const auto ellipsoid = EllipsoidOf(tree.inertias()[body], body, most);
    // A mesh is the picture that the robot's author made, however small.
    const bool is_whole = !lack_meshes[body] && HasMesh(drawn);
    const bool is_part =
        drawn.empty() ||
        (!is_whole && ellipsoid && volume < kTooSmall * Volume(*ellipsoid));
    if (is_part && ellipsoid) drawn.push_back(*ellipsoid);
    const std::vector<BodyShape> other = drawn;
    for (const Joint& joint : tree.joints()) {
      if (joint.parent != body) continue;
      const Eigen::Vector3d& p_BF_B = joint.X_PF.p;
      if (!is_part && !(lack_meshes[body] && HasGap(other, p_BF_B))) continue;
      const auto bone = BoneTo(p_BF_B, body);
      if (bone) drawn.push_back(*bone);
    }
    for (size_t i = num_visuals; i < drawn.size(); ++i) {
      drawn[i].is_stand_in = true;
    }
    shapes.insert(shapes.end(), drawn.begin(), drawn.end());
  }
  return shapes;
}

}  // namespace poise
