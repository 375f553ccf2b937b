// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/find_feet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/feet/legs.h"
#include "poise/robot/feet/no_feet.h"
#include "poise/robot/feet/sole.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/feet/surrounding_rectangle.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Five motors lay a sole flat at any position; with six also at any heading.
// With four, the sole is flat only in some postures.
constexpr int kEnoughMotors = 5;
constexpr int kFewestMotors = 4;
// A sole shorter than this part of the leg is suspect, also one that is longer
// than the leg.
constexpr double kShortSole = 0.1;

void Warn(std::vector<Finding>* findings, std::string where, std::string what,
          std::string why) {
  if (findings == nullptr) return;
  findings->push_back(
      {Severity::kWarn, std::move(where), std::move(what), std::move(why)});
}

// Returns the orientation of the root link with `up_B` along the world's z
// axis. The x axes are the same if this is possible.
Matrix3d Upright(const Vector3d& up_B) {
  const Vector3d front_B =
      std::abs(up_B.x()) < 0.5 ? Vector3d::UnitX() : Vector3d::UnitY();
  Matrix3d R_WB;
  R_WB.row(0) = front_B;
  R_WB.row(1) = up_B.cross(front_B);
  R_WB.row(2) = up_B;
  return R_WB;
}

// Returns the poses of the bodies in the configuration at rest, with the root
// link at the origin.
std::vector<Pose> PosesAtRest(const RobotModel& model, const Matrix3d& R_WB) {
  Eigen::VectorXd q = RestConfiguration(model);
  q.segment<4>(3) = Eigen::Quaterniond(R_WB).coeffs();
  std::vector<Pose> X_WB(model.tree.num_bodies());
  ComputePoses(model.tree, q, &X_WB);
  return X_WB;
}

// Throws if a leg has too few motors to lay its sole flat. A joint without
// effort has no motor.
void CheckMotors(const RobotModel& model, int hip, int foot,
                 std::vector<Finding>* findings) {
  constexpr int kNamed = 3;
  int motors = 0;
  int idle = 0;
  std::string names;
  for (int b = foot; b >= hip; b = model.tree.joints()[b - 1].parent) {
    const bool is_motor = model.limits[b - 1].effort > 0;
    motors += is_motor;
    idle += !is_motor;
    if (is_motor || idle > kNamed) continue;
    names += (idle > 1 ? ", " : "") + Quoted(model.tree.joints()[b - 1].name);
  }
  if (idle > kNamed) names += ", ...";
  const std::string leg = "leg of link " + Quoted(LinkOf(model, foot));
  const std::string has = "has " + std::to_string(motors) + " motors";
  if (motors < kFewestMotors) {
    const std::string what =
        "robot " + Quoted(model.name) + ": " + leg + " " + has +
        " (joints with an effort above 0), must have at least 5, or 4 with a "
        "warning, to lay a sole flat: ";
    if (motors + idle < kFewestMotors) {
      throw std::invalid_argument(what + "give the feet in a profile");
    }
    throw NoFeet(FeetDefect::kNoEffort,
                 what + "correct <limit effort=\"0\"> of " +
                     (idle == 1 ? "joint " : "joints ") + names);
  }
  if (motors < kEnoughMotors) {
    Warn(findings, leg, has,
         "five lay a sole flat in any posture, four only in some");
  }
}

// Estimates the sole of a foot that has only meshes, as FindFeet() describes.
Sole SoleWithoutShape(const RobotModel& model, int body, const Outline& outline,
                      const std::vector<Pose>& X_WB, const Vector3d& forward,
                      double leg, std::vector<Finding>* findings) {
  const Vector3d left = Vector3d::UnitZ().cross(forward);
  const Vector3d up_B = X_WB[body].R.row(2).transpose();
  const Vector3d forward_B = X_WB[body].R.transpose() * forward;
  const Vector3d p_BA_B =
      X_WB[body].Inverse() * AnklePosition(model.tree, body, X_WB, left);
  const Sole sole = EstimateSole(model, body, up_B, forward_B, p_BA_B, leg);
  const Vector3d diagonal = sole.points_B.back() - sole.points_B.front();
  Warn(findings, "sole of link " + Quoted(LinkOf(model, body)),
       "is estimated as " + PrintNumber(std::abs(diagonal.dot(forward_B))) +
           " x " + PrintNumber(std::abs(diagonal.dot(up_B.cross(forward_B)))) +
           " m, " + PrintNumber(-up_B.dot(sole.points_B[0])) +
           " m below the ankle",
       WhyEstimated(outline));
  return sole;
}

// Warns if a sole is short, because the found part may be a heel or a bracket,
// or if a sole is longer or wider than the leg is long.
void CheckSize(const RobotModel& model, const Foot& foot, double leg,
               std::vector<Finding>* findings) {
  const TurnedRectangle sole = SurroundingRectangle(foot.polygon_C);
  const auto warn = [&](const std::string& what) {
    Warn(findings, "sole of link " + Quoted(LinkOf(model, foot.body)),
         what + " the leg (" + PrintNumber(leg) + " m)",
         "the shapes may not be the sole: give the sole in a profile");
  };
  const double length = 2 * sole.half_size.x();
  const double width = 2 * sole.half_size.y();
  if (length < kShortSole * leg) {
    warn("is " + PrintNumber(length) + " m long, less than a tenth of");
  }
  if (length > leg) warn("is " + PrintNumber(length) + " m long, longer than");
  if (width > leg) {
    warn("is " + PrintNumber(width) + " m wide, more than the length of");
  }
}

// Warns if a mesh of the foot is not part of the sole, because the other shapes
// may be much smaller than the foot.
void CheckMesh(const RobotModel& model, const Foot& foot,
               const Outline& outline, std::vector<Finding>* findings) {
  if (outline.mesh_refusal.empty()) return;
  const TurnedRectangle sole = SurroundingRectangle(foot.polygon_C);
  Warn(findings, "sole of link " + Quoted(LinkOf(model, foot.body)),
       "is " + PrintNumber(2 * sole.half_size.x()) + " x " +
           PrintNumber(2 * sole.half_size.y()) +
           " m without a mesh of the foot",
       WhyWithoutMesh(outline));
}

// Keeps why a mesh is not read if the outline of other shapes replaces this
// one.
void KeepRefusal(const Outline& from, Outline* to) {
  if (from.mesh_refusal.empty()) return;
  to->mesh_refusal = from.mesh_refusal;
  to->mesh_is_missing = from.mesh_is_missing;
}

// Returns the sole of a foot. If the collision shapes have none, uses the
// visual shapes: a foot may have one sphere for collisions. A short underside
// of the visual shapes is no sole, but the end of a leg with a point foot.
Sole FindSoleOf(const RobotModel& model, int body, const Vector3d& up_B,
                double leg, Outline* outline) {
  const Sole sole = FindSole(*outline, up_B, leg);
  if (!sole.points_B.empty() || outline->corners.empty()) return sole;
  Outline visual = MakeVisualOutline(model, body);
  const Sole seen = FindSole(visual, up_B, leg);
  double length = 0;
  for (const Vector3d& a : seen.points_B) {
    for (const Vector3d& b : seen.points_B) {
      length = std::max(length, (a - b).norm());
    }
  }
  const bool is_short = length < kShortSole * leg;
  KeepRefusal(is_short ? visual : *outline, is_short ? outline : &visual);
  if (is_short) return sole;
  *outline = visual;
  return seen;
}

}  // namespace

std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings,
                           const FeetHints& hints) {
  std::vector<Outline> outlines = MakeOutlines(model);
  const Legs legs = hints.feet ? FindLegsOf(model, *hints.feet)
                               : FindLegs(model, outlines, findings);
  if (legs.up_B != Vector3d::UnitZ()) {
    Warn(findings,
         "root link " + Quoted(model.tree.frames()[model.root_frame].name),
         "points up with its " + NameOfAxis(legs.up_B) +
             " axis, because the legs hang down along this axis",
         "REP 103 wants +z up: check the robot's pose in the report");
  }
  const std::vector<Pose> X_WB = PosesAtRest(model, Upright(legs.up_B));
  std::array<Sole, 2> soles;
  for (const int i : {0, 1}) {
    const int body = legs.feet[i];
    CheckMotors(model, legs.hips[i], body, findings);
    soles[i] = FindSoleOf(model, body, X_WB[body].R.row(2).transpose(),
                          legs.length, &outlines[body]);
  }
  const Facing facing = FindFacing(model, legs, soles, X_WB, hints, findings);
  const Vector3d& forward = facing.forward_W;

  std::vector<Foot> feet;
  for (const int i : {facing.left, 1 - facing.left}) {
    const int body = legs.feet[i];
    const double leg = X_WB[legs.hips[i]].p.z() - X_WB[body].p.z();
    const bool is_guess = soles[i].points_B.empty();
    const Sole sole = is_guess ? SoleWithoutShape(model, body, outlines[body],
                                                  X_WB, forward, leg, findings)
                               : soles[i];
    // An estimated sole is a rectangle along the forward direction, so the
    // axes of the foot's shapes do not turn it.
    const Pose X_BS = MakeSoleAxes(sole, is_guess ? Outline{} : outlines[body],
                                   X_WB[body].R.transpose() * forward);
    std::vector<Vector2d> points;
    for (const Vector3d& p : sole.points_B) {
      points.push_back((X_BS.Inverse() * p).head<2>());
    }
    const int frame = *model.tree.FindFrame(LinkOf(model, body));
    const Pose& X_BF = model.tree.frames()[frame].X_BF;
    auto foot = MakeFoot(model, feet.empty() ? "left_foot" : "right_foot",
                         frame, X_BF.Inverse() * X_BS, points);
    if (!foot) {
      throw std::invalid_argument("robot " + Quoted(model.name) +
                                  " has a sole under 1 mm wide or long, give "
                                  "the sole in a profile: link " +
                                  Quoted(LinkOf(model, body)));
    }
    foot->source = sole.source;
    CheckSize(model, *foot, leg, findings);
    if (!is_guess) CheckMesh(model, *foot, outlines[body], findings);
    feet.push_back(*std::move(foot));
  }
  return feet;
}

}  // namespace poise
