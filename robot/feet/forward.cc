// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/forward.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/dynamics/tree.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/feet/leg_names.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A sole tells forward from backward if its reaches in front of the ankle and
// behind it differ by this part of its length.
constexpr double kToes = 0.05;
// A knee tells forward from backward by this angle, rad.
constexpr double kKnees = 0.2;
// An axis is nearer than the others by far. Soles may be tilted and turned by
// up to 0.6 rad at rest.
constexpr double kNearAxis = 0.7;  // rad.

int Sign(double value, double least) {
  return std::abs(value) > least ? (value > 0 ? 1 : -1) : 0;
}

// Returns the reach of the soles in front of the ankles minus their reach
// behind them, as a part of the sum of both.
double Toes(const RobotModel& model, const Legs& legs,
            const std::array<Sole, 2>& soles, const std::vector<Pose>& X_WB,
            const Vector3d& forward) {
  double ahead = 0;
  double length = 0;
  for (const int i : {0, 1}) {
    if (soles[i].points_B.empty()) continue;
    const Vector3d p_WA = AnklePosition(model.tree, legs.feet[i], X_WB,
                                        Vector3d::UnitZ().cross(forward));
    double front = -std::numeric_limits<double>::infinity();
    double back = -front;
    for (const Vector3d& p_B : soles[i].points_B) {
      const double x = (X_WB[legs.feet[i]] * p_B - p_WA).dot(forward);
      front = std::max(front, x);
      back = std::min(back, x);
    }
    ahead += front + back;
    length += front - back;
  }
  return length > 0 ? ahead / length : 0;
}

// Returns the range of a knee forward minus its range backward, plus twice its
// bend at rest, in rad. A positive rotation about the axis to the left moves
// the shank backward, so that the knee points forward.
double KneeRange(const RobotModel& model, int hip, int foot,
                 const std::vector<Pose>& X_WB, const Vector3d& forward) {
  const auto knee =
      FindKnee(model.tree, foot, X_WB, Vector3d::UnitZ().cross(forward));
  if (!knee) return 0;
  const JointLimits& limits = model.limits[knee->joint];
  const double range = knee->sign * (limits.lower + limits.upper);
  const Vector3d p_WK = X_WB[knee->joint + 1].p;
  const auto ahead = [&](const Vector3d& down) {
    return std::atan2(down.dot(forward), -down.z());
  };
  const double bend = ahead(p_WK - X_WB[hip].p) - ahead(X_WB[foot].p - p_WK);
  return 2 * bend + (std::isfinite(range) ? range : 0);
}

// The signs that the sources of evidence give to a direction. 1: forward, -1:
// backward, 0: no decision.
struct Evidence {
  int names = 0, toes = 0, knees = 0, prior = 0;
  bool names_contradict = false;
};

// Warns if evidence contradicts the sign, or if there is none.
void WarnOfDoubt(const Evidence& evidence, int sign, const Vector3d& forward_B,
                 const std::string& root, std::vector<Finding>* findings) {
  const std::string taken = NameOfAxis(forward_B);
  const std::string other = NameOfAxis(-forward_B);
  std::string why = evidence.names != 0   ? "by the names of the legs"
                    : evidence.toes != 0  ? "because the toes point there"
                    : evidence.prior != 0 ? "by REP 103"
                    : evidence.knees != 0 ? "because the knees point there"
                                          : "by chance, nothing decides";
  std::string against;
  const auto add = [&](const std::string& text) {
    against += (against.empty() ? ", but " : " and ") + text;
  };
  if (evidence.names_contradict) add("the names of left and right are mixed");
  if (evidence.toes == -sign) add("the toes point to " + other);
  // Knees of many robots with names point backward, as a bird's ankles do.
  if (evidence.names == 0 && evidence.toes == 0 && evidence.knees == -sign) {
    add("the knees point to " + other);
  }
  if (evidence.prior != sign) add("REP 103 says +x");
  // A root link that is turned by half a turn would look the same.
  if (against.empty() && evidence.names == 0 && evidence.toes == 0 &&
      evidence.knees == 0) {
    against = " alone: names, toes and knees do not tell";
  }
  if (against.empty()) return;
  findings->push_back(
      {Severity::kWarn, "forward direction",
       "is taken as " + taken + " of link " + Quoted(root) + ", " + why +
           against,
       "if the robot faces the other way, write 'forward: " + other +
           "' in the profile; if not, 'forward: " + taken + "' to confirm"});
}

}  // namespace

std::string NameOfAxis(const Vector3d& v) {
  int i = 0;
  v.cwiseAbs().maxCoeff(&i);
  if (!(std::abs(v[i]) > std::cos(kNearAxis) * v.norm())) return "";
  return std::string(v[i] > 0 ? "+" : "-") + "xyz"[i];
}

std::optional<Vector3d> AxisOfName(const std::string& name) {
  for (int i = 0; i < 3; ++i) {
    for (const double sign : {1, -1}) {
      const Vector3d axis = sign * Vector3d::Unit(i);
      if (name == NameOfAxis(axis)) return axis;
    }
  }
  return std::nullopt;
}

std::string ForwardAxis(const Robot& robot) {
  const std::vector<Pose> X_BB = RestPoses(robot.model);
  Vector3d forward_B = Vector3d::Zero();
  for (const Foot& foot : robot.feet) {
    forward_B += X_BB[foot.body].R * foot.X_BC.R.col(0);
  }
  return NameOfAxis(forward_B);
}

int LeftByNames(const RobotModel& model, const Legs& legs, bool* contradict) {
  const Tree& tree = model.tree;
  std::array<std::vector<int>, 2> bodies;  // From the feet up.
  for (const int i : {0, 1}) {
    for (int b = legs.feet[i]; b >= legs.hips[i];
         b = tree.joints()[b - 1].parent) {
      bodies[i].push_back(b);
    }
  }
  std::vector<std::string> link(tree.num_bodies());
  for (const Frame& frame : tree.frames()) {
    if (link[frame.body].empty()) link[frame.body] = frame.name;
  }
  int first = 0;
  int second = 0;
  const auto count = [&](const std::string& a, const std::string& b) {
    const int side = CompareSides(a, b);
    first += side > 0;
    second += side < 0;
  };
  for (size_t k = 0; k < std::min(bodies[0].size(), bodies[1].size()); ++k) {
    const int a = bodies[0][k];
    const int b = bodies[1][k];
    count(tree.joints()[a - 1].name, tree.joints()[b - 1].name);
    count(link[a], link[b]);
  }
  *contradict = first > 0 && second > 0;
  return *contradict ? 0 : Sign(first - second, 0);
}

Facing FindFacing(const RobotModel& model, const Legs& legs,
                  const std::array<Sole, 2>& soles,
                  const std::vector<Pose>& X_WB, const FeetHints& hints,
                  std::vector<Finding>* findings) {
  // The legs are apart along y or, in some robots, along x.
  const Vector3d apart = X_WB[legs.feet[0]].p - X_WB[legs.feet[1]].p +
                         X_WB[legs.hips[0]].p - X_WB[legs.hips[1]].p;
  const Vector3d ahead = std::abs(apart.y()) >= std::abs(apart.x())
                             ? Vector3d::UnitX()
                             : Vector3d::UnitY();
  const Eigen::Matrix3d& R_WB = X_WB[0].R;
  const Vector3d ahead_B = R_WB.transpose() * ahead;
  // The sign of the forward direction if the first leg is the left one.
  const int if_first = apart.dot(Vector3d::UnitZ().cross(ahead)) > 0 ? 1 : -1;
  const auto facing = [&](int sign) {
    return Facing{sign * ahead, sign == if_first ? 0 : 1};
  };
  if (hints.feet) {
    return facing((*hints.feet)[0] == legs.feet[0] ? if_first : -if_first);
  }
  if (hints.forward_B) {
    const int sign = Sign(hints.forward_B->dot(ahead_B), 0.5);
    if (sign != 0) return facing(sign);
  }

  Evidence evidence;
  evidence.names =
      if_first * LeftByNames(model, legs, &evidence.names_contradict);
  evidence.toes = Sign(Toes(model, legs, soles, X_WB, ahead), kToes);
  double knees = 0;
  for (const int i : {0, 1}) {
    knees += 0.5 * KneeRange(model, legs.hips[i], legs.feet[i], X_WB, ahead);
  }
  evidence.knees = Sign(knees, kKnees);
  evidence.prior = Sign(ahead_B.x(), 0.5);
  int sign = 1;
  for (const int decision :
       {evidence.knees, evidence.prior, evidence.toes, evidence.names}) {
    if (decision != 0) sign = decision;
  }
  if (findings != nullptr) {
    WarnOfDoubt(evidence, sign, sign * ahead_B,
                model.tree.frames()[model.root_frame].name, findings);
  }
  return facing(sign);
}

}  // namespace poise
