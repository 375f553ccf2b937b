// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/find_posture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/math/so3.h"
#include "poise/robot/control/posture/ankle_reach.h"
#include "poise/robot/control/posture/joint_range.h"
#include "poise/robot/control/posture/sole_rows.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kBent = 0.3;        // A knee beyond is bent already, rad.
constexpr double kKneeWeight = 100;  // Large, so that hip and ankle adapt.
// Smallest gap between the soles, m: kFootGap, but at most kFootGapOfLeg of the
// leg's length.
constexpr double kFootGap = 0.02;
constexpr double kFootGapOfLeg = 0.03;
constexpr double kLongestStep = 0.3;  // Per iteration, rad or m.
// After kFullSteps iterations, each step is bounded by kShrink times the bound
// of the step before, so that the search cannot cycle.
constexpr int kFullSteps = 30;
constexpr double kShrink = 0.6;
// Iterations of a step's solve, and per variable. A step need not be optimal,
// but the search cannot converge if most bounds remain unvisited.
constexpr int kSolverIterations = 60;
constexpr int kIterationsPerVariable = 4;
// The search ends once a step is shorter than this, rad or m.
constexpr double kConverged = 1e-9;
// Tolerances of the result: distance of the center of mass from its target, at
// most kCentered m and kCenteredOfSole of the sole's half width; tilt and
// position error of the soles, rad and m.
constexpr double kCentered = 5e-3;
constexpr double kCenteredOfSole = 0.2;
constexpr double kFlat = 1e-6;
// If the target cannot be reached, this fraction of the way from the target to
// the edge of the soles is accepted.
constexpr double kNearTarget = 0.5;

std::vector<int> FeetFrames(const Robot& robot) {
  return {robot.feet[0].frame, robot.feet[1].frame};
}

// Returns the coordinate axis that is nearest to v, or the direction of v if no
// axis is within `near`, rad.
Vector3d Snap(const Vector3d& v, double near) {
  int i = 0;
  v.cwiseAbs().maxCoeff(&i);
  const Vector3d axis = Vector3d::Unit(i) * (v[i] > 0 ? 1 : -1);
  return axis.dot(v) > std::cos(near) * v.norm() ? axis : v.normalized();
}

// The inverse-kinematics problem of FindPosture().
class Search {
 public:
  Search(const Robot& robot, const PostureGoal& goal);

  // Iterates until the posture converges.
  Posture Solve();

 private:
  void Evaluate();

  // Sets the first posture of the search for a robot on both feet.
  void Place();

  // Target of the center of mass: distance in front of the middle of sole i, m.
  // It is 0, or nearer to the ankle if the ankle is too weak to hold the robot
  // on that foot alone.
  double Forward(int i) const;

  // Returns the length of the leg that ends in foot i, m.
  double LegLength(int i) const;

  // Bends the knee of the leg with the foot `body`, if the knee is straight.
  void BendKnee(int body);

  // Error of the center of mass, m: horizontal, and vertical if it has a target
  // there.
  VectorXd OffBalance() const;

  void AddBalance(Hierarchy* hierarchy) const;

  void AddPosture(Hierarchy* hierarchy) const;

  // Returns the error of the soles, rad and m, and its description.
  std::pair<double, std::string> ErrorOfSole(int i) const;

  // Returns whether the center of mass is near enough to its target.
  bool IsBalanced() const;

  Posture Result() const;

  const Robot& robot_;
  const Tree& tree_;
  const PostureGoal& goal_;
  Tick tick_;
  const VectorXd zero_;
  VectorXd q_, q_wanted_;
  const JointRange range_;
  VectorXd posture_weight_;  // By joint.
  SoleState feet_[2];
  Pose X_WC_wanted_[2];  // Only on one foot.
  Matrix3d R_WB_;
  std::vector<int> columns_;            // Indices in v of the variables.
  std::vector<int> column_of_;          // By joint; -1 if the joint is fixed.
  double least_apart_;                  // Smallest distance of the feet, m.
  double distance_ = 0;                 // Between the feet, m.
  Vector2d target_ = Vector2d::Zero();  // For the center of mass, m.
};

Search::Search(const Robot& robot, const PostureGoal& goal)
    : robot_(robot),
      tree_(robot.model.tree),
      goal_(goal),
      tick_(tree_, FeetFrames(robot)),
      zero_(VectorXd::Zero(tree_.nv())),
      q_(robot.q_nominal),
      range_(RangeInside(robot.model)),
      posture_weight_(VectorXd::Ones(tree_.num_joints())),
      column_of_(tree_.num_joints(), -1),
      least_apart_(robot.feet[0].half_size.y() + robot.feet[1].half_size.y()) {
  for (int i = 0; i < tree_.v_start(); ++i) columns_.push_back(i);
  for (int j = 0; j < tree_.num_joints(); ++j) {
    if (!goal.fixed.empty() && goal.fixed[j]) continue;
    column_of_[j] = static_cast<int>(columns_.size());
    columns_.push_back(tree_.v_start() + j);
  }
  if (goal.joints.size() > 0) q_.tail(tree_.num_joints()) = goal.joints;
  q_ = Clamp(range_, robot_.model, q_);
  if (goal.support) {
    Evaluate();
    for (const int i : {0, 1}) X_WC_wanted_[i] = feet_[i].X_WC;
    const int i = goal.support->foot;
    X_WC_wanted_[1 - i].p.z() += goal.support->lift;
    const Vector2d G = goal.support->G;
    target_ = (X_WC_wanted_[i] * Vector3d(G.x(), G.y(), 0)).head<2>();
    R_WB_ = ExpSo3(-goal.support->lean * X_WC_wanted_[i].R.col(0)) *
            tick_.X_WB[0].R;
    q_wanted_ = q_;
  } else {
    Place();
  }
}

void Search::Place() {
  q_.head<7>() << 0, 0, 0, 0, 0, 0, 1;
  // The base is upright when the soles are level with the joints at rest.
  Evaluate();
  constexpr double kNear = 0.35;  // rad.
  const double near = goal_.is_base_upright ? M_PI_2 : kNear;
  const Vector3d up =
      Snap(feet_[0].X_WC.R.col(2) + feet_[1].X_WC.R.col(2), near);
  Vector3d front = feet_[0].X_WC.R.col(0) + feet_[1].X_WC.R.col(0);
  front = Snap((front - front.dot(up) * up).normalized(), near);
  R_WB_.row(0) = front;
  R_WB_.row(1) = up.cross(front);
  R_WB_.row(2) = up;
  q_.segment<4>(3) = Eigen::Quaterniond(R_WB_).coeffs();
  Evaluate();
  const double gap =
      std::min(kFootGap, kFootGapOfLeg * std::min(LegLength(0), LegLength(1)));
  distance_ =
      std::max((feet_[0].X_WC.p - feet_[1].X_WC.p).y(), least_apart_ + gap);
  for (const int i : {0, 1}) target_.x() += 0.5 * Forward(i);
  q_wanted_ = q_;
  for (const Foot& foot : robot_.feet) BendKnee(foot.body);
  q_ = q_wanted_;
  if (goal_.start.size() > 0) q_.tail(tree_.num_joints()) = goal_.start;
  q_ = Clamp(range_, robot_.model, q_);
  Evaluate();
  q_.head<3>() -= 0.5 * (feet_[0].X_WC.p + feet_[1].X_WC.p);
  Evaluate();
}

Posture Search::Solve() {
  const int n = tree_.num_joints();
  const int nv = static_cast<int>(columns_.size());
  VectorXd step = zero_;
  const std::vector<LevelCapacity> capacity = {
      {static_cast<int>(robot_.model.mimics.size()) + n, nv},
      {12, 1},
      {3, 0},
      {8, 0},
      {n, 0}};
  Hierarchy hierarchy(nv, capacity);
  Solution solution(nv, capacity);
  Solver solver(nv, capacity);
  solver.max_iterations = kSolverIterations + kIterationsPerVariable * nv;
  int i = 0;
  for (double longest = kLongestStep; longest > kConverged; ++i) {
    if (i >= kFullSteps) longest *= kShrink;
    hierarchy.Clear(static_cast<int>(capacity.size()));
    AddStepLimits(range_, robot_.model, q_, column_of_, nv, longest,
                  &hierarchy);
    if (goal_.support) {
      AddSupportRows(feet_, X_WC_wanted_, goal_.support->foot,
                     goal_.support->keeps_other, &hierarchy);
    } else if (goal_.are_soles_parallel) {
      AddSoleRows(feet_, &hierarchy);
    } else {
      AddMeanSoleRows(feet_, least_apart_, &hierarchy);
    }
    AddBalance(&hierarchy);
    AddPosture(&hierarchy);
    const Status status = solver.Solve(hierarchy, &solution);
    if (status != Status::kOptimal && status != Status::kIterationLimit) {
      return {q_,
              "the solver failed in a step of the inverse kinematics",
              std::numeric_limits<double>::infinity(),
              false,
              {}};
    }
    for (int k = 0; k < nv; ++k) step[columns_[k]] = solution.y[k];
    Integrate(tree_, q_, step, 1, q_);
    Evaluate();
    if (solution.y.lpNorm<Eigen::Infinity>() < kConverged) break;
  }
  return Result();
}

void Search::Evaluate() {
  ComputeTick(tree_, q_, zero_, &tick_);
  for (const int i : {0, 1}) {
    const Foot& foot = robot_.feet[i];
    feet_[i] = StateOf(foot, tick_, i, columns_);
  }
}

double Search::Forward(int i) const {
  const Pose& X_WC = feet_[i].X_WC;
  const auto ankle =
      FindAnkle(tree_, robot_.feet[i].body, tick_.X_WB, X_WC.R.col(1));
  if (!ankle) return 0;
  const double reach = AnkleReach(robot_, *ankle);
  const double x = (X_WC.Inverse() * tick_.X_WB[*ankle + 1].p).x();
  return std::clamp(0., x - reach, x + reach);
}

double Search::LegLength(int i) const {
  double hip = feet_[i].X_WC.p.z();
  for (int b = robot_.feet[i].body; b > 0; b = tree_.joints()[b - 1].parent) {
    hip = std::max(hip, tick_.X_WB[b].p.z());
  }
  return hip - feet_[i].X_WC.p.z();
}

void Search::BendKnee(int body) {
  const auto knee = FindKnee(tree_, body, tick_.X_WB, Vector3d::UnitY());
  if (!knee) return;
  const int j = knee->joint;
  double& q = q_wanted_[tree_.q_start() + j];
  if (std::abs(q) > kBent) return;
  q = std::max(range_.lower[j],
               std::min(knee->sign * goal_.knee_bend, range_.upper[j]));
  posture_weight_[j] = kKneeWeight;
}

VectorXd Search::OffBalance() const {
  const Vector2d off = tick_.p_WG.head<2>() - target_;
  if (!goal_.support || !goal_.support->height) return off;
  const double ground = X_WC_wanted_[goal_.support->foot].p.z();
  return Vector3d(off.x(), off.y(),
                  tick_.p_WG.z() - ground - *goal_.support->height);
}

void Search::AddBalance(Hierarchy* hierarchy) const {
  const VectorXd off = OffBalance();
  const int rows = static_cast<int>(off.size());
  EqualityBlock com = hierarchy->AddEqualities(2, rows);
  com.B =
      tick_.H_G.middleRows(3, rows)(Eigen::all, columns_) / tree_.total_mass();
  com.b = off;
  EqualityBlock lean = hierarchy->AddEqualities(3, 3);
  lean.B.leftCols<3>().setIdentity();
  lean.b = LogSo3(tick_.X_WB[0].R * R_WB_.transpose());
  if (goal_.support) return;
  EqualityBlock apart = hierarchy->AddEqualities(3, 1);
  apart.B.row(0) = feet_[0].J_WC_W.row(4) - feet_[1].J_WC_W.row(4);
  apart.b[0] = feet_[0].X_WC.p.y() - feet_[1].X_WC.p.y() - distance_;
}

void Search::AddPosture(Hierarchy* hierarchy) const {
  const int base = tree_.v_start();
  const int n = static_cast<int>(columns_.size()) - base;
  EqualityBlock posture = hierarchy->AddEqualities(4, n);
  posture.B.rightCols(n).setIdentity();
  for (int k = 0; k < n; ++k) {
    const int j = columns_[base + k] - base;
    const int i = tree_.q_start() + j;
    posture.b[k] = q_[i] - q_wanted_[i];
    posture.weight[k] = posture_weight_[j];
  }
}

std::pair<double, std::string> Search::ErrorOfSole(int i) const {
  const Pose& X_WC = feet_[i].X_WC;
  const std::string stays = robot_.feet[i].name + " remains ";
  double tilt = 0;
  double off = 0;
  if (goal_.support) {
    const bool is_kept = i == goal_.support->foot || goal_.support->keeps_other;
    const Vector3d p = X_WC.p - X_WC_wanted_[i].p;
    off = is_kept ? p.norm() : std::abs(p.z());
    if (is_kept) tilt = LogSo3(X_WC.R * X_WC_wanted_[i].R.transpose()).norm();
  } else if (goal_.are_soles_parallel) {
    tilt = LogSo3(X_WC.R).norm();
    off = std::hypot(X_WC.p.x(), X_WC.p.z());
  } else {
    const Pose& X_WO = feet_[1 - i].X_WC;
    const double heading = 0.5 * (LogSo3(X_WC.R).z() + LogSo3(X_WO.R).z());
    tilt = std::hypot(LogSo3(X_WC.R).head<2>().norm(), heading);
    off = std::hypot(0.5 * (X_WC.p + X_WO.p).x(), X_WC.p.z());
  }
  std::string lack;
  // The comparisons are false for NaN.
  if (!(off <= kFlat)) lack = stays + PrintNumber(off) + " m from its target";
  if (!(tilt <= kFlat))
    lack = stays + "rotated by " + PrintNumber(tilt) + " rad";
  return {tilt + off, lack};
}

bool Search::IsBalanced() const {
  const VectorXd off = OffBalance();
  const double half_width =
      std::min(robot_.feet[0].half_size.y(), robot_.feet[1].half_size.y());
  if (off.norm() <= std::min(kCentered, kCenteredOfSole * half_width)) {
    return true;
  }
  if (goal_.support || goal_.are_soles_parallel) return false;
  const double half_length =
      std::min(robot_.feet[0].half_size.x(), robot_.feet[1].half_size.x());
  const double apart = (feet_[0].X_WC.p - feet_[1].X_WC.p).y();
  return std::abs(tick_.p_WG.x()) <= kNearTarget * half_length &&
         std::abs(tick_.p_WG.y()) <= kNearTarget * 0.5 * apart;
}

Posture Search::Result() const {
  Posture posture{q_, "", OffBalance().norm(), false, {}};
  for (const int i : {1, 0}) {
    const auto [error, lack] = ErrorOfSole(i);
    posture.error += error;
    if (!lack.empty()) posture.lack = lack;
  }
  const double apart = (feet_[0].X_WC.p - feet_[1].X_WC.p).y();
  if (posture.lack.empty() && !goal_.support &&
      !(apart >= least_apart_ - kFlat)) {
    posture.lack = "the soles overlap: the middle of left_foot is " +
                   PrintNumber(apart) + " m to the left of right_foot's";
    posture.error += 1;  // Any other result tells more.
  }
  if (posture.lack.empty() && !(tick_.p_WG.z() > 0)) {
    posture.lack = "the center of mass remains " +
                   PrintNumber(-tick_.p_WG.z()) + " m below the soles";
    posture.error += 1;
  }
  posture.are_soles_flat = posture.lack.empty();
  if (posture.lack.empty() && !IsBalanced()) {
    posture.lack = "the center of mass remains " +
                   PrintNumber(OffBalance().norm()) +
                   " m from its target above the soles";
  }
  if (!posture.lack.empty()) {
    posture.at_limit = JointsAtLimit(range_, robot_.model, q_, column_of_);
  }
  return posture;
}

}  // namespace

Posture FindPosture(const Robot& robot, const PostureGoal& goal) {
  return Search(robot, goal).Solve();
}

}  // namespace poise
