// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_region.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/math/so3.h"

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The search goes outward in steps of this length.
constexpr double kStep = 0.01;  // m.

// A place is reached if the pose of the sole is right to this.
constexpr double kReached = 1e-5;  // m and rad.
constexpr int kIterations = 30;
constexpr double kDamping = 1e-6;

// Inverse kinematics of one leg, with the base fixed and upright.
class Leg {
 public:
  Leg(const Robot& robot, int foot, double margin)
      : robot_(robot),
        foot_(robot.feet[foot]),
        tick_(robot.model.tree, {robot.feet[foot].frame}),
        q_(robot.q_nominal),
        v_(Eigen::VectorXd::Zero(robot.model.tree.nv())) {
    const Tree& tree = robot.model.tree;
    for (int body = foot_.body; body != 0;
         body = tree.joints()[body - 1].parent) {
      const int joint = body - 1;
      const JointLimits& limits = robot.model.limits[joint];
      const double q = q_[tree.q_start() + joint];
      joints_.push_back(joint);
      // The nominal posture may be nearer to a limit than the margin.
      lower_.push_back(std::min(q, limits.lower + margin));
      upper_.push_back(std::max(q, limits.upper - margin));
    }
    const Pose& X_BF = tree.frames()[foot_.frame].X_BF;
    X_FC_ = X_BF.Inverse() * foot_.X_BC;
    J_.resize(6, static_cast<Eigen::Index>(joints_.size()));
    nominal_ = q_;
    ComputeSole();
    p_nominal_WC_ = X_WC_.p;
  }

  // Returns the largest torque of the leg's joints, as a fraction of the effort
  // limit, while the leg alone holds the robot's weight above its nominal place
  // with the base lower by `sink`. Infinite if the leg does not reach the
  // place.
  double Load(double sink) {
    Restart(sink);
    if (!MoveTo(p_nominal_WC_.head<2>())) {
      return std::numeric_limits<double>::infinity();
    }
    const Tree& tree = robot_.model.tree;
    const double weight = tree.total_mass() * tree.gravity_W().norm();
    double most = 0;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const double torque =
          std::abs(J_(5, static_cast<Eigen::Index>(j))) * weight;
      most = std::max(most, torque / robot_.model.limits[joints_[j]].effort);
    }
    return most;
  }

  const Eigen::Vector3d& p_nominal_WC() const { return p_nominal_WC_; }
  double base_height() const { return nominal_[2]; }

  // Returns to the nominal posture, with the base lower by `sink`.
  void Restart(double sink) {
    q_ = nominal_;
    q_[2] -= sink;
  }

  // Moves the sole to a place on the ground, level and along x. Returns false,
  // and keeps the posture of the last success, if the leg does not reach it.
  bool MoveTo(const Eigen::Vector2d& place) {
    const Eigen::VectorXd before = q_;
    const int q_start = robot_.model.tree.q_start();
    for (int i = 0; i < kIterations; ++i) {
      ComputeSole();
      Vector6d e;
      e << -LogSo3(X_WC_.R), place.x() - X_WC_.p.x(), place.y() - X_WC_.p.y(),
          p_nominal_WC_.z() - X_WC_.p.z();
      if (e.cwiseAbs().maxCoeff() < kReached) return true;
      Eigen::Matrix<double, 6, 6> A = J_ * J_.transpose();
      A.diagonal().array() += kDamping;
      const Eigen::VectorXd dq = J_.transpose() * A.ldlt().solve(e);
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        double& q = q_[q_start + joints_[j]];
        q = std::clamp(q + dq[static_cast<Eigen::Index>(j)], lower_[j],
                       upper_[j]);
      }
    }
    q_ = before;
    return false;
  }

 private:
  void ComputeSole() {
    const Tree& tree = robot_.model.tree;
    ComputeTick(tree, q_, v_, &tick_);
    const FrameTick& F = tick_.frames[0];
    X_WC_ = F.X_WF * X_FC_;
    const Eigen::Vector3d p_FC_W = X_WC_.p - F.X_WF.p;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const auto column = F.J_WF_W.col(tree.v_start() + joints_[j]);
      const Eigen::Vector3d w = column.head<3>();
      J_.col(static_cast<Eigen::Index>(j)) << w,
          column.tail<3>() + w.cross(p_FC_W);
    }
  }

  const Robot& robot_;
  const Foot& foot_;
  Tick tick_;
  Eigen::VectorXd q_, v_, nominal_;
  std::vector<int> joints_;
  std::vector<double> lower_, upper_;
  Pose X_FC_, X_WC_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_;
  Eigen::Vector3d p_nominal_WC_;
};

using Places = std::array<Eigen::Vector2d, StepRegion::kSides>;

// Returns the farthest places that a leg reaches on rays from its nominal
// place, shortened by `reach`.
Places SearchPlaces(double sink, double reach, Leg* leg) {
  const Eigen::Vector2d start = leg->p_nominal_WC().head<2>();
  const double far = 2 * leg->base_height();
  Places places;
  for (int ray = 0; ray < StepRegion::kSides; ++ray) {
    leg->Restart(sink);
    Eigen::Vector2d reached = start;
    for (double d = 0; d < far; d += kStep) {
      const Eigen::Vector2d place = start + d * StepRegion::normal(ray);
      if (!leg->MoveTo(place)) break;
      reached = place;
    }
    places[ray] = start + reach * (reached - start);
  }
  return places;
}

// Returns the area of a polygon whose corners go around it.
double Area(const Places& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

}  // namespace

Eigen::Vector2d StepRegion::normal(int side) noexcept {
  const double angle = 2 * kPi * side / kSides;
  return {std::cos(angle), std::sin(angle)};
}

StepRegion::StepRegion(const Robot& robot, int foot, const Settings& settings)
    : max_sink_(0) {
  Leg leg(robot, foot, settings.limit_margin);
  const Eigen::Vector2d base = robot.q_nominal.head<2>();
  double largest = 0;
  for (int k = 1; k < kSinks; ++k) {
    const double sink = settings.max_sink * k / (kSinks - 1);
    if (leg.Load(sink) > settings.load) continue;
    const double area = Area(SearchPlaces(sink, settings.reach, &leg));
    if (area <= largest) continue;
    largest = area;
    max_sink_ = sink;
  }
  for (int k = 0; k < kSinks; ++k) {
    const double sink = max_sink_ * k / (kSinks - 1);
    support_[k].fill(-std::numeric_limits<double>::infinity());
    for (const Eigen::Vector2d& place :
         SearchPlaces(sink, settings.reach, &leg)) {
      for (int side = 0; side < kSides; ++side) {
        support_[k][side] =
            std::max(support_[k][side], normal(side).dot(place - base));
      }
    }
  }
}

double StepRegion::support(int side, double sink) const noexcept {
  if (max_sink_ == 0) return support_[0][side];
  const double x = std::clamp(sink / max_sink_, 0.0, 1.0) * (kSinks - 1);
  const int k = std::min(static_cast<int>(x), kSinks - 2);
  return support_[k][side] +
         (x - k) * (support_[k + 1][side] - support_[k][side]);
}

double StepRegion::SinkFor(const Eigen::Vector2d& u_N) const noexcept {
  double least = 0;
  for (int side = 0; side < kSides; ++side) {
    const double far = normal(side).dot(u_N);
    int k = 0;
    while (k < kSinks && support_[k][side] < far) ++k;
    double share = k;
    if (k == kSinks) {
      share = kSinks - 1;
    } else if (k > 0) {
      const double below = support_[k - 1][side];
      share = k - 1 + (far - below) / (support_[k][side] - below);
    }
    least = std::max(least, share);
  }
  return max_sink_ * least / (kSinks - 1);
}

}  // namespace poise
