// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/find_feet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "robot/feet.h"
#include "robot/knee.h"
#include "robot/limits.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Corners this close to a plane lie in it, m: drawings are rounded to 1 mm.
constexpr double kFlat = 2e-3;
// Bodies this close to the lowest one stand on the ground too, m.
constexpr double kLevel = 0.03;
// A sole's steepest normal and most turned axis at q = 0, rad.
constexpr double kSteepest = 0.6;
constexpr double kMostTurned = 0.3;
constexpr double kSameAxis = 1e-6;
// To lay a sole flat anywhere takes six.
constexpr int kMotorsOfALeg = 6;
// Of a body with very many shapes, the first ones' axes will do.
constexpr size_t kMostAxes = 64;

// What of a body may touch the ground.
struct Corner {
  int frame;
  Vector3d p;     // In the body.
  double radius;  // Of a ball about it.
};

struct Outline {
  std::vector<Corner> corners;
  std::vector<Vector3d> axes;  // Of the body and of the shapes, in the body.
};

// A flat underside of a body.
struct Sole {
  int frame = 0;
  Vector3d normal;               // In the body, out of the ground.
  std::vector<Vector3d> points;  // In the body, all in one plane.
  double area = 0;               // m2.
};

// Curved rims become 16 points.
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
    return;  // Any axis is as good.
  } else {
    return;  // A mesh is not opened.
  }
  if (outline->axes.size() >= kMostAxes) return;
  for (int i = 0; i < 3; ++i) outline->axes.push_back(X_BS.R.col(i));
}

// Of each body, by its collision shapes or, where it has none that say
// anything, by its visual ones.
std::vector<Outline> MakeOutlines(const RobotModel& model) {
  const std::vector<Frame>& frames = model.tree.frames();
  std::vector<Outline> outlines(model.tree.num_bodies());
  for (Outline& outline : outlines) {
    for (int i = 0; i < 3; ++i) outline.axes.push_back(Vector3d::Unit(i));
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

// The bodies' poses in the base's axes, with the joints as near 0 as they go.
std::vector<Pose> RestPoses(const RobotModel& model) {
  const Tree& tree = model.tree;
  const Eigen::VectorXd q_rest = RestConfiguration(model);
  std::vector<Pose> X_WB(1);
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const double q = q_rest[tree.q_start() + j];
    const Pose X_FB =
        joint.type == JointType::kPrismatic
            ? Pose{Eigen::Matrix3d::Identity(), q * joint.axis_F}
            : Pose{Eigen::AngleAxisd(q, joint.axis_F).toRotationMatrix(),
                   Vector3d::Zero()};
    X_WB.push_back(X_WB[joint.parent] * joint.X_PF * X_FB);
  }
  return X_WB;
}

// How far down each body reaches, with its shapes and its links' origins.
std::vector<double> Reach(const RobotModel& model,
                          const std::vector<Outline>& outlines,
                          const std::vector<Pose>& X_WB) {
  std::vector<double> low(X_WB.size());
  for (size_t b = 0; b < X_WB.size(); ++b) {
    low[b] = X_WB[b].p.z();
    for (const Corner& corner : outlines[b].corners) {
      low[b] = std::min(low[b], (X_WB[b] * corner.p).z() - corner.radius);
    }
  }
  for (const Frame& frame : model.tree.frames()) {
    low[frame.body] =
        std::min(low[frame.body], (X_WB[frame.body] * frame.X_BF.p).z());
  }
  return low;
}

double Area(const Sole& sole) {
  const Eigen::Quaterniond R_SB =
      Eigen::Quaterniond::FromTwoVectors(sole.normal, Vector3d::UnitZ());
  std::vector<Vector2d> points;
  for (const Vector3d& p : sole.points) points.push_back((R_SB * p).head<2>());
  const std::vector<Vector2d> hull = ConvexHull(std::move(points));
  double area = 0;
  for (size_t i = 2; i < hull.size(); ++i) {
    const Vector2d a = hull[i - 1] - hull[0];
    const Vector2d b = hull[i] - hull[0];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

// The largest flat underside; without points where there is none.
Sole FindSole(const Outline& outline, const Vector3d& up) {
  std::vector<Vector3d> normals;
  const auto add = [&](const Vector3d& axis) {
    const Vector3d normal = axis.dot(up) < 0 ? Vector3d(-axis) : axis;
    if (normal.dot(up) < std::cos(kSteepest)) return;
    for (const Vector3d& other : normals) {
      if ((normal - other).norm() < kSameAxis) return;
    }
    normals.push_back(normal);
  };
  for (const Vector3d& axis : outline.axes) add(axis);
  add(up);
  Sole best;
  for (const Vector3d& normal : normals) {
    double height = std::numeric_limits<double>::infinity();
    for (const Corner& corner : outline.corners) {
      height = std::min(height, normal.dot(corner.p) - corner.radius);
    }
    Sole sole;
    sole.normal = normal;
    for (const Corner& corner : outline.corners) {
      const double above = normal.dot(corner.p) - height;
      if (above - corner.radius > kFlat) continue;
      sole.frame = corner.frame;
      sole.points.push_back(corner.p - above * normal);
    }
    sole.area = Area(sole);
    // The same plane again, up to rounding, is no better.
    if (sole.area > 1.01 * best.area) best = std::move(sole);
  }
  return best.area > kFlat * kFlat ? best : Sole{};
}

// The frame at the body's origin with z along the sole's normal and x forward:
// along an axis of the foot if one is near.
Pose MakeSoleAxes(const Sole& sole, const Outline& outline,
                  const Vector3d& forward) {
  const Vector3d z = sole.normal;
  const auto in_plane = [&](const Vector3d& a) -> Vector3d {
    return (a - a.dot(z) * z).normalized();
  };
  const Vector3d wanted = in_plane(forward);
  Vector3d x = wanted;
  double best = std::cos(kMostTurned);
  for (const Vector3d& axis : outline.axes) {
    if (std::abs(axis.dot(z)) > 0.5) continue;  // Not in the plane.
    const double along = in_plane(axis).dot(wanted);
    if (std::abs(along) > best + 1e-9) {
      best = std::abs(along);
      x = along > 0 ? in_plane(axis) : -in_plane(axis);
    }
  }
  Pose X_BS;
  X_BS.R << x, z.cross(x), z;
  X_BS.p = sole.points[0].dot(z) * z;
  return X_BS;
}

// The joints between the base and a body that have a motor.
int NumMotors(const RobotModel& model, int body) {
  int motors = 0;
  for (int b = body; b > 0; b = model.tree.joints()[b - 1].parent) {
    motors += model.limits[b - 1].effort > 0;
  }
  return motors;
}

// The bodies on the ground: of each chain of them, the one with the largest
// sole or, if none has any, the first with six motors.
std::vector<int> BodiesOnGround(const RobotModel& model,
                                const std::vector<double>& low,
                                const std::vector<Sole>& soles) {
  const double ground = *std::min_element(low.begin(), low.end());
  std::vector<int> chain(low.size(), -1);  // Index into bodies.
  std::vector<int> bodies;
  for (int b = 0; b < static_cast<int>(low.size()); ++b) {
    if (low[b] > ground + kLevel) continue;
    const int parent = b > 0 ? model.tree.joints()[b - 1].parent : -1;
    if (parent >= 0 && chain[parent] >= 0) {
      chain[b] = chain[parent];
      int& body = bodies[chain[b]];
      if (soles[b].area > soles[body].area ||
          (soles[body].points.empty() &&
           NumMotors(model, body) < kMotorsOfALeg)) {
        body = b;
      }
    } else {
      chain[b] = static_cast<int>(bodies.size());
      bodies.push_back(b);
    }
  }
  return bodies;
}

// The first link of a body.
std::string LinkOf(const RobotModel& model, int body) {
  for (const Frame& frame : model.tree.frames()) {
    if (frame.body == body) return frame.name;
  }
  return "";
}

// How far below the body's origin the sole is likely to be, along up.
double EstimateDepth(const RobotModel& model, int body, const Vector3d& up,
                     double leg, int* frame) {
  constexpr double kNone = 0.01;  // A link at the ankle says nothing, m.
  double depth = 0;
  for (int i = 0; i < static_cast<int>(model.tree.frames().size()); ++i) {
    const Frame& link = model.tree.frames()[i];
    if (link.body != body) continue;
    const double below = -up.dot(link.X_BF.p);
    const bool is_sole = link.name.find("sole") != std::string::npos;
    if (below > std::max(depth, kNone) || (is_sole && below > kNone)) {
      depth = below;
      *frame = i;
      if (is_sole) return depth;
    }
  }
  return depth > 0 ? depth : 0.1 * leg;
}

// A small sole where the file has only meshes; see FindFeet().
Sole EstimateSole(const RobotModel& model, int body,
                  const std::vector<Pose>& X_WB, const Vector3d& forward,
                  std::vector<Finding>* findings) {
  const std::string link = LinkOf(model, body);
  const int motors = NumMotors(model, body);
  if (motors < kMotorsOfALeg) {
    throw std::invalid_argument("robot " + Quoted(model.name) +
                                " has no flat sole on link " + Quoted(link) +
                                ", nor motors to lay one flat: the leg has " +
                                std::to_string(motors) + ", must have 6");
  }
  int hip = body;
  while (model.tree.joints()[hip - 1].parent > 0) {
    hip = model.tree.joints()[hip - 1].parent;
  }
  const double leg = X_WB[hip].p.z() - X_WB[body].p.z();
  const Matrix3d R_BW = X_WB[body].R.transpose();
  const Vector3d up = R_BW.col(2);
  Sole sole;
  sole.frame = model.tree.FindFrame(link).value();
  sole.normal = up;
  const double depth = EstimateDepth(model, body, up, leg, &sole.frame);
  const Vector3d side = up.cross(R_BW * forward);
  for (const double x : {-0.07, 0.15}) {
    for (const double y : {-0.06, 0.06}) {
      sole.points.push_back(leg * (x * (R_BW * forward) + y * side) -
                            depth * up);
    }
  }
  if (findings != nullptr) {
    findings->push_back({Severity::kWarn, "sole of link " + Quoted(link),
                         "is taken for " + PrintNumber(0.22 * leg) + " x " +
                             PrintNumber(0.12 * leg) + " m, " +
                             PrintNumber(depth) + " m below the ankle",
                         "as the file has only meshes: give it in a profile"});
  }
  return sole;
}

// How far the sole reaches before its ankle, less how far behind, m.
double Toes(const Sole& sole, const Vector3d& forward_B) {
  if (sole.points.empty()) return 0;
  double front = -std::numeric_limits<double>::infinity();
  double back = -front;
  for (const Vector3d& p : sole.points) {
    front = std::max(front, p.dot(forward_B));
    back = std::min(back, p.dot(forward_B));
  }
  return front + back;
}

// How far the knee above a foot goes forward, less how far backward, rad. To
// turn about the left moves what is below backward: the knee forward.
double KneeRange(const RobotModel& model, int body,
                 const std::vector<Pose>& X_WB, const Vector3d& forward) {
  const auto knee =
      FindKnee(model.tree, body, X_WB, Vector3d::UnitZ().cross(forward));
  if (!knee) return 0;
  const JointLimits& limits = model.limits[knee->joint];
  const double range = knee->sign * (limits.lower + limits.upper);
  return std::isfinite(range) ? range : 0;
}

}  // namespace

std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings) {
  const std::vector<Outline> outlines = MakeOutlines(model);
  const std::vector<Pose> X_WB = RestPoses(model);
  const std::vector<double> low = Reach(model, outlines, X_WB);
  const double ground = *std::min_element(low.begin(), low.end());
  std::vector<Sole> soles(X_WB.size());
  for (size_t b = 0; b < X_WB.size(); ++b) {
    if (low[b] > ground + kLevel) continue;
    soles[b] = FindSole(outlines[b], X_WB[b].R.row(2).transpose());
  }
  const std::vector<int> bodies = BodiesOnGround(model, low, soles);
  if (bodies.size() != 2) {
    throw std::invalid_argument(
        "robot " + Quoted(model.name) + " reaches the ground with " +
        std::to_string(bodies.size()) +
        (bodies.size() == 1 ? " body" : " bodies") + ", must be two feet");
  }

  // The feet stand side by side: along y or, in some robots, along x.
  const Vector3d across = X_WB[bodies[1]].p - X_WB[bodies[0]].p;
  Vector3d forward = std::abs(across.y()) >= std::abs(across.x())
                         ? Vector3d::UnitX()
                         : Vector3d::UnitY();
  double toes = 0;
  double knees = 0;
  for (const int body : bodies) {
    toes += Toes(soles[body], X_WB[body].R.transpose() * forward);
    knees += KneeRange(model, body, X_WB, forward);
  }
  if (std::abs(toes) > kFlat ? toes < 0 : knees < 0) forward = -forward;

  std::vector<Foot> feet;
  const bool first_is_left = across.dot(Vector3d::UnitZ().cross(forward)) < 0;
  for (const bool left : {true, false}) {
    const int body = bodies[left == first_is_left ? 0 : 1];
    const Sole sole = soles[body].points.empty()
                          ? EstimateSole(model, body, X_WB, forward, findings)
                          : soles[body];
    const Pose X_BS =
        MakeSoleAxes(sole, outlines[body], X_WB[body].R.transpose() * forward);
    std::vector<Vector2d> points;
    for (const Vector3d& p : sole.points) {
      points.push_back((X_BS.Inverse() * p).head<2>());
    }
    const Pose& X_BF = model.tree.frames()[sole.frame].X_BF;
    auto foot = MakeFoot(model, left ? "left_foot" : "right_foot", sole.frame,
                         X_BF.Inverse() * X_BS, points);
    if (!foot) {
      throw std::invalid_argument("robot " + Quoted(model.name) +
                                  " has hardly a sole on link " +
                                  Quoted(LinkOf(model, body)));
    }
    feet.push_back(*std::move(foot));
  }
  return feet;
}

}  // namespace poise
