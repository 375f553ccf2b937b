// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/find_feet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/feet/sole.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A sole tells forward from backward if its reaches differ by at least this, m.
constexpr double kToes = 2e-3;
// A body at most this far above the lowest body is also on the ground, m.
constexpr double kLevel = 0.03;
// A leg needs six motors to place its sole flat at any position and heading.
constexpr int kMotorsOfALeg = 6;

// Returns the poses of the bodies relative to the base, in the configuration at
// rest.
std::vector<Pose> RestPoses(const RobotModel& model) {
  std::vector<Pose> X_WB(model.tree.num_bodies());
  ComputePoses(model.tree, RestConfiguration(model), &X_WB);
  return X_WB;
}

// Returns the height [m] of the lowest point of each body. The points are those
// of its shapes, the origins of links with shapes (because meshes are not
// opened), and the joint that moves the body. A link without shapes is ignored,
// because `world` and `base_footprint` are often below the feet.
std::vector<double> Reach(const RobotModel& model,
                          const std::vector<Outline>& outlines,
                          const std::vector<Pose>& X_WB) {
  std::vector<double> low(X_WB.size(), std::numeric_limits<double>::infinity());
  for (size_t b = 0; b < X_WB.size(); ++b) {
    if (b > 0) low[b] = X_WB[b].p.z();
    for (const Outline::Corner& corner : outlines[b].corners) {
      low[b] = std::min(low[b], (X_WB[b] * corner.p_B).z() - corner.radius);
    }
  }
  for (const std::vector<Shape>* shapes : {&model.visuals, &model.collisions}) {
    for (const Shape& shape : *shapes) {
      const Frame& frame = model.tree.frames()[shape.frame];
      low[frame.body] =
          std::min(low[frame.body], (X_WB[frame.body] * frame.X_BF.p).z());
    }
  }
  return low;
}

// Returns the number of motorized joints between the base and a body.
int NumMotors(const RobotModel& model, int body) {
  int motors = 0;
  for (int b = body; b > 0; b = model.tree.joints()[b - 1].parent) {
    motors += model.limits[b - 1].effort > 0;
  }
  return motors;
}

// Returns one body for each chain of connected bodies on the ground. It is the
// body with the largest sole. If no body of the chain has a sole, it is the
// first body with six motors above it.
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
          (soles[body].points_B.empty() &&
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

// Returns the name of the first link of a body.
std::string LinkOf(const RobotModel& model, int body) {
  for (const Frame& frame : model.tree.frames()) {
    if (frame.body == body) return frame.name;
  }
  return "";
}

// Returns the first body of the leg that ends in a foot: a child of the base.
int HipOf(const RobotModel& model, int foot) {
  int hip = foot;
  while (model.tree.joints()[hip - 1].parent > 0) {
    hip = model.tree.joints()[hip - 1].parent;
  }
  return hip;
}

// Returns the position of a foot's ankle or, if no ankle is found, the position
// of the foot's origin.
Vector3d AnkleOf(const RobotModel& model, int foot,
                 const std::vector<Pose>& X_WB, const Vector3d& forward) {
  const auto ankle =
      FindAnkle(model.tree, foot, X_WB, Vector3d::UnitZ().cross(forward));
  return X_WB[ankle ? *ankle + 1 : foot].p;
}

// Estimates the sole of a foot that has only meshes, as FindFeet() describes.
Sole SoleWithoutShape(const RobotModel& model, int body, const Outline& outline,
                      const std::vector<Pose>& X_WB, const Vector3d& forward,
                      std::vector<Finding>* findings) {
  const std::string link = LinkOf(model, body);
  const int motors = NumMotors(model, body);
  if (motors < kMotorsOfALeg) {
    throw std::invalid_argument(
        "robot " + Quoted(model.name) + " has no flat sole on link " +
        Quoted(link) + ", and its leg has " + std::to_string(motors) +
        " motors, must have 6 to lay a sole flat: give the feet in a profile");
  }
  const double leg = X_WB[HipOf(model, body)].p.z() - X_WB[body].p.z();
  const Vector3d up_B = X_WB[body].R.row(2).transpose();
  const Vector3d forward_B = X_WB[body].R.transpose() * forward;
  const Vector3d p_BA_B =
      X_WB[body].Inverse() * AnkleOf(model, body, X_WB, forward);
  const Sole sole = EstimateSole(model, body, up_B, forward_B, p_BA_B, leg);
  if (findings != nullptr) {
    findings->push_back({Severity::kWarn, "sole of link " + Quoted(link),
                         "is estimated as " + PrintNumber(0.22 * leg) + " x " +
                             PrintNumber(0.085 * leg) + " m, " +
                             PrintNumber(-up_B.dot(sole.points_B[0])) +
                             " m below the ankle",
                         WhyEstimated(outline)});
  }
  return sole;
}

// Returns the reach of a sole in front of the ankle minus its reach behind, m.
double Toes(const RobotModel& model, int foot, const std::vector<Pose>& X_WB,
            const Sole& sole, const Vector3d& forward) {
  if (sole.points_B.empty()) return 0;
  const Vector3d p_WA = AnkleOf(model, foot, X_WB, forward);
  double front = -std::numeric_limits<double>::infinity();
  double back = -front;
  for (const Vector3d& p_B : sole.points_B) {
    const double ahead = (X_WB[foot] * p_B - p_WA).dot(forward);
    front = std::max(front, ahead);
    back = std::min(back, ahead);
  }
  return front + back;
}

// Returns the range of a knee forward minus its range backward, plus twice its
// bend at rest, in rad. A positive rotation about the axis to the left moves
// the shank backward, so that the knee points forward.
double KneeRange(const RobotModel& model, int body,
                 const std::vector<Pose>& X_WB, const Vector3d& forward) {
  const auto knee =
      FindKnee(model.tree, body, X_WB, Vector3d::UnitZ().cross(forward));
  if (!knee) return 0;
  const JointLimits& limits = model.limits[knee->joint];
  const double range = knee->sign * (limits.lower + limits.upper);
  const Vector3d p_WK = X_WB[knee->joint + 1].p;
  const auto ahead = [&](const Vector3d& down) {
    return std::atan2(down.dot(forward), -down.z());
  };
  const double bend =
      ahead(p_WK - X_WB[HipOf(model, body)].p) - ahead(X_WB[body].p - p_WK);
  return 2 * bend + (std::isfinite(range) ? range : 0);
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
        (bodies.size() == 1 ? " body" : " bodies") +
        ", must be two feet: give the feet in a profile");
  }

  // The feet are apart along y or, in some robots, along x.
  const Vector3d across = X_WB[bodies[1]].p - X_WB[bodies[0]].p;
  Vector3d forward = std::abs(across.y()) >= std::abs(across.x())
                         ? Vector3d::UnitX()
                         : Vector3d::UnitY();
  double toes = 0;
  double knees = 0;
  for (const int body : bodies) {
    toes += Toes(model, body, X_WB, soles[body], forward);
    knees += KneeRange(model, body, X_WB, forward);
  }
  if (std::abs(toes) > kToes ? toes < 0 : knees < 0) forward = -forward;

  std::vector<Foot> feet;
  const bool first_is_left = across.dot(Vector3d::UnitZ().cross(forward)) < 0;
  for (const bool left : {true, false}) {
    const int body = bodies[left == first_is_left ? 0 : 1];
    const Sole sole = soles[body].points_B.empty()
                          ? SoleWithoutShape(model, body, outlines[body], X_WB,
                                             forward, findings)
                          : soles[body];
    const Pose X_BS =
        MakeSoleAxes(sole, outlines[body], X_WB[body].R.transpose() * forward);
    std::vector<Vector2d> points;
    for (const Vector3d& p : sole.points_B) {
      points.push_back((X_BS.Inverse() * p).head<2>());
    }
    const Pose& X_BF = model.tree.frames()[sole.frame].X_BF;
    auto foot = MakeFoot(model, left ? "left_foot" : "right_foot", sole.frame,
                         X_BF.Inverse() * X_BS, points);
    if (!foot) {
      throw std::invalid_argument("robot " + Quoted(model.name) +
                                  " has a sole under 1 mm wide or long, give "
                                  "the sole in a profile: link " +
                                  Quoted(LinkOf(model, body)));
    }
    feet.push_back(*std::move(foot));
  }
  return feet;
}

}  // namespace poise
