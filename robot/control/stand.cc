// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/math/so3.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Margin to each joint limit: kMarginFraction of the range, but at most
// kLargestMargin, rad or m.
constexpr double kMarginFraction = 0.05;
constexpr double kLargestMargin = 0.05;
constexpr double kKneeBend = 0.6;     // rad.
constexpr double kKneeWeight = 100;   // Large, so that hip and ankle adapt.
constexpr double kFootGap = 0.02;     // Smallest gap between the soles, m.
constexpr double kLongestStep = 0.3;  // Per iteration, rad or m.
// After kFullSteps iterations, each step is bounded by kShrink times the bound
// of the step before, so that the search cannot cycle.
constexpr int kFullSteps = 30;
constexpr double kShrink = 0.6;
// A step need not be optimal: the next one corrects it.
constexpr int kSolverIterations = 60;
// Fraction of the ankle torque that may hold the robot on one foot. The rest is
// kept for motion.
constexpr double kAnkleShare = 0.5;
// The search ends once a step is shorter than this, rad or m.
constexpr double kConverged = 1e-9;
// Tolerances of the result: distance of the center of mass from its target, m;
// tilt and position error of the soles, rad and m.
constexpr double kCentered = 5e-3;
constexpr double kFlat = 1e-6;

// Pose of a foot in the world, and its Jacobian.
struct FootState {
  Pose X_WC;
  MatrixXd J_WC_W;  // 6 x nv.
};

std::vector<int> FeetFrames(const Robot& robot) {
  return {robot.feet[0].frame, robot.feet[1].frame};
}

FootState StateOf(const Robot& robot, const Tick& tick, int i) {
  const FrameTick& F = tick.frames[i];
  const Foot& foot = robot.feet[i];
  const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
  FootState state{X_WC, F.J_WF_W};
  state.J_WC_W.bottomRows<3>() -=
      Hat(X_WC.p - F.X_WF.p) * F.J_WF_W.topRows<3>();
  return state;
}

// Returns the coordinate axis that is nearest to v, or the direction of v if no
// axis is within kNear.
Vector3d Snap(const Vector3d& v) {
  constexpr double kNear = 0.35;  // rad.
  int i = 0;
  v.cwiseAbs().maxCoeff(&i);
  const Vector3d axis = Vector3d::Unit(i) * (v[i] > 0 ? 1 : -1);
  return axis.dot(v) > std::cos(kNear) * v.norm() ? axis : v.normalized();
}

// The inverse-kinematics problem of StandUp().
class Standing {
 public:
  // Straight knees are bent to the angle `bend`, rad; positive: knees forward.
  Standing(const Robot& robot, double bend);

  // Iterates until the posture converges. Returns the error in words, or an
  // empty text if the robot stands.
  std::string Solve();

  const VectorXd& q() const { return q_; }

 private:
  void Evaluate();

  // Target of the center of mass: distance in front of the middle of sole i, m.
  // It is 0, or nearer to the ankle if the ankle is too weak to hold the robot
  // on that foot alone.
  double Forward(int i) const;

  // Sets the range of each joint. A joint outside moves to the nearest end.
  void SetLimits();

  // Bends the knee of the leg with the foot `body`, if the knee is straight.
  void BendKnee(int body, double bend);

  void AddLimits(double longest, Hierarchy* hierarchy) const;

  // Adds the rows that put the soles flat on the ground, facing +x, side by
  // side, with their middle at the origin.
  void AddFeet(Hierarchy* hierarchy) const;

  // Horizontal error of the center of mass, m.
  Eigen::Vector2d OffBalance() const {
    return tick_.p_WG.head<2>() - Eigen::Vector2d(forward_, 0);
  }

  void AddBalance(Hierarchy* hierarchy) const;

  void AddPosture(Hierarchy* hierarchy) const;

  // Returns the remaining error in words; empty if the robot stands.
  std::string Lack() const;

  const Robot& robot_;
  const Tree& tree_;
  Tick tick_;
  const VectorXd zero_;
  VectorXd q_, q_wanted_;
  VectorXd lower_, upper_;
  VectorXd posture_weight_;  // By joint.
  FootState feet_[2];
  Matrix3d R_WB_;
  double distance_;
  double forward_ = 0;  // x of the target of the center of mass, m.
};

Standing::Standing(const Robot& robot, double bend)
    : robot_(robot),
      tree_(robot.model.tree),
      tick_(tree_, FeetFrames(robot)),
      zero_(VectorXd::Zero(tree_.nv())) {
  q_ = robot.q_nominal;
  q_.head<7>() << 0, 0, 0, 0, 0, 0, 1;
  SetLimits();
  // The base is upright when the soles are level with the joints at rest.
  Evaluate();
  const Vector3d up = Snap(feet_[0].X_WC.R.col(2) + feet_[1].X_WC.R.col(2));
  Vector3d front = feet_[0].X_WC.R.col(0) + feet_[1].X_WC.R.col(0);
  front = Snap((front - front.dot(up) * up).normalized());
  R_WB_.row(0) = front;
  R_WB_.row(1) = up.cross(front);
  R_WB_.row(2) = up;
  q_.segment<4>(3) = Eigen::Quaterniond(R_WB_).coeffs();
  Evaluate();
  distance_ = std::max(
      (feet_[0].X_WC.p - feet_[1].X_WC.p).y(),
      robot.feet[0].half_size.y() + robot.feet[1].half_size.y() + kFootGap);
  for (const int i : {0, 1}) forward_ += 0.5 * Forward(i);
  q_wanted_ = q_;
  posture_weight_ = VectorXd::Ones(tree_.num_joints());
  for (const Foot& foot : robot.feet) BendKnee(foot.body, bend);
  q_ = q_wanted_;
  Evaluate();
  q_.head<3>() -= 0.5 * (feet_[0].X_WC.p + feet_[1].X_WC.p);
  Evaluate();
}

std::string Standing::Solve() {
  const int n = tree_.num_joints();
  const int nv = tree_.nv();
  const std::vector<LevelCapacity> capacity = {
      {static_cast<int>(robot_.model.mimics.size()) + n, nv},
      {11, 0},
      {2, 0},
      {4, 0},
      {n, 0}};
  Hierarchy hierarchy(nv, capacity);
  Solution solution(nv, capacity);
  Solver solver(nv, capacity);
  solver.max_iterations = kSolverIterations;
  int i = 0;
  for (double longest = kLongestStep; longest > kConverged; ++i) {
    if (i >= kFullSteps) longest *= kShrink;
    hierarchy.Clear(static_cast<int>(capacity.size()));
    AddLimits(longest, &hierarchy);
    AddFeet(&hierarchy);
    AddBalance(&hierarchy);
    AddPosture(&hierarchy);
    const Status status = solver.Solve(hierarchy, &solution);
    if (status != Status::kOptimal && status != Status::kIterationLimit) {
      return "the solver failed in a step of the inverse kinematics";
    }
    Integrate(tree_, q_, solution.y, 1, q_);
    Evaluate();
    if (solution.y.lpNorm<Eigen::Infinity>() < kConverged) break;
  }
  return Lack();
}

void Standing::Evaluate() {
  ComputeTick(tree_, q_, zero_, &tick_);
  for (const int i : {0, 1}) feet_[i] = StateOf(robot_, tick_, i);
}

double Standing::Forward(int i) const {
  const Pose& X_WC = feet_[i].X_WC;
  const auto ankle =
      FindAnkle(tree_, robot_.feet[i].body, tick_.X_WB, X_WC.R.col(1));
  if (!ankle) return 0;
  const double effort = robot_.model.limits[*ankle].effort;
  if (!(effort >= 0)) return 0;  // The robot file gives no effort limit.
  const double weight = tree_.total_mass() * tree_.gravity_W().norm();
  const double reach = kAnkleShare * effort / weight;
  const double x = (X_WC.Inverse() * tick_.X_WB[*ankle + 1].p).x();
  return std::clamp(0., x - reach, x + reach);
}

void Standing::SetLimits() {
  const int n = tree_.num_joints();
  lower_.resize(n);
  upper_.resize(n);
  for (int j = 0; j < n; ++j) {
    const JointLimits& limits = robot_.model.limits[j];
    const double margin = std::min(
        kLargestMargin, kMarginFraction * (limits.upper - limits.lower));
    lower_[j] = limits.lower + margin;
    upper_[j] = limits.upper - margin;
    double& q = q_[tree_.q_start() + j];
    q = std::max(lower_[j], std::min(q, upper_[j]));
  }
}

void Standing::BendKnee(int body, double bend) {
  const auto knee = FindKnee(tree_, body, tick_.X_WB, Vector3d::UnitY());
  if (!knee) return;
  const int j = knee->joint;
  double& q = q_wanted_[tree_.q_start() + j];
  if (std::abs(q) > 0.5 * kKneeBend) return;  // It is bent already.
  q = std::max(lower_[j], std::min(knee->sign * bend, upper_[j]));
  posture_weight_[j] = kKneeWeight;
}

void Standing::AddLimits(double longest, Hierarchy* hierarchy) const {
  const int nv = tree_.nv();
  InequalityBlock steps = hierarchy->AddInequalities(0, nv);
  steps.C.setIdentity();
  steps.lower.setConstant(-longest);
  steps.upper.setConstant(longest);
  for (int j = 0; j < tree_.num_joints(); ++j) {
    const double q = q_[tree_.q_start() + j];
    const int row = tree_.v_start() + j;
    steps.lower[row] = std::max(-longest, std::min(0., lower_[j] - q));
    steps.upper[row] = std::min(longest, std::max(0., upper_[j] - q));
    if (lower_[j] < upper_[j]) continue;
    hierarchy->AddEqualities(0, 1).B(0, row) = 1;  // No range: fixed joint.
  }
  for (const MimicCoupling& mimic : robot_.model.mimics) {
    const auto q = [&](int j) { return q_[tree_.q_start() + j]; };
    EqualityBlock coupling = hierarchy->AddEqualities(0, 1);
    coupling.B(0, tree_.v_start() + mimic.joint) = 1;
    coupling.B(0, tree_.v_start() + mimic.source) = -mimic.multiplier;
    coupling.b[0] =
        q(mimic.joint) - mimic.multiplier * q(mimic.source) - mimic.offset;
  }
}

void Standing::AddFeet(Hierarchy* hierarchy) const {
  for (const FootState& foot : feet_) {
    EqualityBlock rows = hierarchy->AddEqualities(1, 5);
    rows.B.topRows<3>() = foot.J_WC_W.topRows<3>();
    rows.b.head<3>() = LogSo3(foot.X_WC.R);
    rows.B.row(3) = foot.J_WC_W.row(3);
    rows.b[3] = foot.X_WC.p.x();
    rows.B.row(4) = foot.J_WC_W.row(5);
    rows.b[4] = foot.X_WC.p.z();
  }
  EqualityBlock middle = hierarchy->AddEqualities(1, 1);
  middle.B.row(0) = feet_[0].J_WC_W.row(4) + feet_[1].J_WC_W.row(4);
  middle.b[0] = feet_[0].X_WC.p.y() + feet_[1].X_WC.p.y();
}

void Standing::AddBalance(Hierarchy* hierarchy) const {
  EqualityBlock com = hierarchy->AddEqualities(2, 2);
  com.B = tick_.H_G.middleRows<2>(3) / tree_.total_mass();
  com.b = OffBalance();
  EqualityBlock lean = hierarchy->AddEqualities(3, 3);
  lean.B.leftCols<3>().setIdentity();
  lean.b = LogSo3(tick_.X_WB[0].R * R_WB_.transpose());
  EqualityBlock apart = hierarchy->AddEqualities(3, 1);
  apart.B.row(0) = feet_[0].J_WC_W.row(4) - feet_[1].J_WC_W.row(4);
  apart.b[0] = feet_[0].X_WC.p.y() - feet_[1].X_WC.p.y() - distance_;
}

void Standing::AddPosture(Hierarchy* hierarchy) const {
  const int n = tree_.num_joints();
  EqualityBlock posture = hierarchy->AddEqualities(4, n);
  posture.B.rightCols(n).setIdentity();
  posture.b = q_.tail(n) - q_wanted_.tail(n);
  posture.weight = posture_weight_;
}

std::string Standing::Lack() const {
  for (const int i : {0, 1}) {
    const Pose& X_WC = feet_[i].X_WC;
    const std::string stays = robot_.feet[i].name + " remains ";
    const double tilt = LogSo3(X_WC.R).norm();
    if (!(tilt <= kFlat)) {
      return stays + "rotated by " + PrintNumber(tilt) + " rad";
    }
    const double off = std::hypot(X_WC.p.x(), X_WC.p.z());
    if (!(off <= kFlat)) {
      return stays + PrintNumber(off) + " m from its target";
    }
  }
  const double off = OffBalance().norm();
  if (off <= kCentered) return "";
  return "the center of mass remains " + PrintNumber(off) +
         " m from its target above the soles";
}

}  // namespace

void StandUp(Robot* robot) {
  if (robot->feet.size() != 2 || !(robot->model.tree.total_mass() > 0)) {
    throw std::invalid_argument("robot " + Quoted(robot->model.name) +
                                " cannot stand: it must have two feet and "
                                "a mass");
  }
  // Tries bent knees: forward, then unchanged, then backward.
  std::string first;
  for (const double bend : {kKneeBend, 0., -kKneeBend}) {
    Standing standing(*robot, bend);
    const std::string lack = standing.Solve();
    if (lack.empty()) {
      robot->q_nominal = standing.q();
      robot->can_stand = true;
      return;
    }
    if (first.empty()) first = lack;
  }
  throw std::invalid_argument(
      "robot " + Quoted(robot->model.name) +
      ": no standing posture within the joint limits: " + first);
}

Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile,
                        std::vector<Finding>* findings) {
  try {
    Robot robot = MakeRobot(urdf, profile, findings);
    if (!robot.can_stand) StandUp(&robot);
    return robot;
  } catch (const Refusal&) {  // Its message already names the file.
    throw;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(urdf.source() + ": " + error.what());
  }
}

Robot LoadStandingRobot(const std::filesystem::path& urdf,
                        const Profile& profile,
                        std::vector<Finding>* findings) {
  return MakeStandingRobot(UrdfDocument(urdf, findings), profile, findings);
}

}  // namespace poise
