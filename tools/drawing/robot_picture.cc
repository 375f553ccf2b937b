// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/robot_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "poise/dynamics/kinematics.h"
#include "poise/tools/commands/report/robot_shapes.h"
#include "poise/tools/drawing/raster.h"
#include "poise/tools/drawing/solid.h"

namespace poise {
namespace {

const Eigen::Vector3d kToSun = Eigen::Vector3d(0.55, -0.5, 1.1).normalized();
constexpr double kAmbient = 0.46;
constexpr double kExposure = 1.12;
const Color kShadow(0.1, 0.12, 0.16, 0.2);
constexpr double kMetersPerNewton = 0.0042;
constexpr double kArrowAway = 0.25;  // From an arrow's tip to its point, m.
constexpr double kMargin = 0.06;     // Fraction of the width and height.

// Projects points in the world onto the canvas, as a pinhole camera.
class Projection {
 public:
  Projection(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
             const Camera& camera)
      : eye_(camera.eye), middle_(corner + size / 2) {
    const Eigen::Vector3d forward = camera.target - camera.eye;
    R_CW_.row(2) = forward.normalized();
    R_CW_.row(0) = R_CW_.row(2).cross(Eigen::RowVector3d::UnitZ()).normalized();
    R_CW_.row(1) = R_CW_.row(2).cross(R_CW_.row(0));
    scale_ = size.y() * forward.norm() / camera.height;
  }

  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d p_C = R_CW_ * (p - eye_);
    return middle_ + scale_ * p_C.head<2>() / std::max(0.05, p_C.z());
  }
  // Returns the projected point with a depth that is linear over the picture.
  Eigen::Vector3d WithDepth(const Eigen::Vector3d& p) const {
    const double distance = R_CW_.row(2).dot(p - eye_);
    Eigen::Vector3d on;
    on << (*this)(p), -1 / std::max(0.05, distance);
    return on;
  }
  const Eigen::Vector3d& eye() const { return eye_; }

 private:
  Eigen::Vector3d eye_;
  Eigen::Vector2d middle_;
  Eigen::Matrix3d R_CW_;
  double scale_;
};

// Draws shapes, and their shadows on the floor, as a camera sees them.
class Model {
 public:
  Model(const Projection& to, Raster* raster) : to_(to), raster_(*raster) {}

  void Add(const BodyShape& shape, const Pose& X_WS) {
    for (const Facet& facet : MakeFacets(shape)) {
      std::vector<Eigen::Vector3d> corners;
      for (const Eigen::Vector3d& corner : facet.corners) {
        corners.push_back(X_WS * corner);
      }
      const Eigen::Vector3d normal = X_WS.R * facet.normal;
      if (normal.dot(to_.eye() - corners[0]) > 0) {
        const double light =
            kAmbient + (1 - kAmbient) * std::max(0.0, normal.dot(kToSun));
        Color color = shape.rgba;
        color.head<3>() = (light * kExposure * color.head<3>()).cwiseMin(1);
        Fan(corners, color);
      }
      if (normal.dot(kToSun) > 0) {
        for (Eigen::Vector3d& corner : corners) corner = ShadowOf(corner);
        Fan(corners, kShadow);
      }
    }
  }

 private:
  static Eigen::Vector3d ShadowOf(const Eigen::Vector3d& p) {
    const double height = std::max(0.0, p.z());
    Eigen::Vector3d on = p - kToSun * (height / kToSun.z());
    // The shadow is slightly below the floor, so that the soles hide it.
    on.z() = -0.002;
    return on;
  }

  void Fan(const std::vector<Eigen::Vector3d>& corners, const Color& color) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      raster_.Triangle(to_.WithDepth(corners[0]), to_.WithDepth(corners[i - 1]),
                       to_.WithDepth(corners[i]), color);
    }
  }

  const Projection& to_;
  Raster& raster_;
};

// Adds an arrow of a shaft and a head. The tip is kArrowAway before the point
// of application.
void AddArrow(const PushArrow& push, Model* model) {
  constexpr double kRadius = 0.013, kHead = 0.085;
  const Color red(0.85, 0.16, 0.12, 1);
  const double shaft = kMetersPerNewton * push.force.norm() - kHead;
  if (shaft < 0.02) return;
  const Eigen::Vector3d z = push.force.normalized();
  const Eigen::Vector3d x = z.unitOrthogonal();
  Pose X_WS;
  X_WS.R << x, z.cross(x), z;
  const Eigen::Vector3d tip = push.point - kArrowAway * z;
  X_WS.p = tip - (kHead + shaft / 2) * z;
  model->Add({0, {}, BodyShapeKind::kCylinder, {kRadius, shaft, 0}, red}, X_WS);
  // The head is a cone, drawn as a stack of disks with decreasing radius.
  constexpr int kDisks = 40;
  for (int i = 0; i < kDisks; ++i) {
    X_WS.p = tip - kHead * (i + 0.5) / kDisks * z;
    const double radius = 2.7 * kRadius * (i + 0.5) / kDisks;
    model->Add(
        {0, {}, BodyShapeKind::kCylinder, {radius, kHead / kDisks, 0}, red},
        X_WS);
  }
}

void DrawFloor(const Projection& to, const Eigen::Vector3d& around,
               Canvas* canvas) {
  constexpr double kStep = 0.25, kReach = 2.5;
  const double x0 = kStep * std::round(around.x() / kStep);
  const double y0 = kStep * std::round(around.y() / kStep);
  for (double a = -kReach; a <= kReach; a += kStep) {
    // The lines are drawn in pieces that fade towards the horizon.
    for (double b = -kReach; b < kReach; b += kStep) {
      const double far = std::hypot(a, b) / kReach;
      Color line = HexColor(0x8a95a1);
      line[3] = 0.55 * std::max(0.0, 1 - far);
      if (line[3] <= 0) continue;
      canvas->Line({to({x0 + a, y0 + b, 0}), to({x0 + a, y0 + b + kStep, 0})},
                   line, 0.6);
      canvas->Line({to({x0 + b, y0 + a, 0}), to({x0 + b + kStep, y0 + a, 0})},
                   line, 0.6);
    }
  }
}

}  // namespace

void DrawRobot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const RobotModel& robot, const Eigen::VectorXd& q,
               const std::vector<PushArrow>& pushes, const Camera& camera,
               Canvas* canvas) {
  canvas->Clipped(corner, size, [&] {
    DrawFloor(Projection(corner, size, camera), camera.target, canvas);
  });

  Raster raster(static_cast<int>(kPixelsPerPoint * size.x()),
                static_cast<int>(kPixelsPerPoint * size.y()));
  const Projection to({0, 0}, kPixelsPerPoint * size, camera);
  Model model(to, &raster);
  std::vector<Pose> X_WB(robot.tree.num_bodies());
  ComputePoses(robot.tree, q, &X_WB);
  for (const BodyShape& shape : MakeBodyShapes(robot)) {
    model.Add(shape, X_WB[shape.body] * shape.X_BS);
  }
  for (const PushArrow& push : pushes) AddArrow(push, &model);
  canvas->Image(corner, size, raster.width(), raster.height(), raster.Pixels());
}

Camera FitCamera(const Eigen::Vector2d& size, const RobotModel& robot,
                 const Eigen::VectorXd& q, const std::vector<PushArrow>& pushes,
                 Camera camera) {
  const Projection to({0, 0}, size, camera);
  std::vector<Pose> X_WB(robot.tree.num_bodies());
  ComputePoses(robot.tree, q, &X_WB);
  std::vector<Eigen::Vector3d> points;
  for (const BodyShape& shape : MakeBodyShapes(robot)) {
    points.push_back((X_WB[shape.body] * shape.X_BS).p);
  }
  for (const PushArrow& push : pushes) {
    points.push_back(push.point - kMetersPerNewton * push.force -
                     kArrowAway * push.force.normalized());
  }
  // The visible area grows in proportion to the height, about its center.
  double zoom = 1;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d off = to(point) - size / 2;
    zoom = std::max(
        zoom, off.cwiseAbs().cwiseQuotient((0.5 - kMargin) * size).maxCoeff());
  }
  camera.height *= zoom;
  return camera;
}

}  // namespace poise
