// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/observation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/gait/dcm.h"
#include "poise/robot/nominal_tick.h"

namespace poise {

namespace {

// Below this normal force, in N, a CoP has no meaning.
constexpr double kNoForce = 1;

// Returns the angle between two unit vectors, rad. Near 0, acos() would lose
// all digits.
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<int> FootFrames(const Robot& robot) {
  std::vector<int> frames;
  for (const Foot& foot : robot.feet) frames.push_back(foot.frame);
  return frames;
}

}  // namespace

double StandingHeight(const Robot& robot) {
  const Tick tick = NominalTick(robot);
  double ground = std::numeric_limits<double>::infinity();
  for (const Foot& foot : robot.feet) {
    ground = std::min(ground, (tick.X_WB[foot.body] * foot.X_BC).p.z());
  }
  return tick.p_WG.z() - (robot.feet.empty() ? 0 : ground);
}

Observer::Observer(const Robot& robot, const Ground& ground)
    : robot_(robot),
      normal_W_(GroundNormal(ground)),
      mass_(robot.model.tree.total_mass()),
      gravity_(robot.model.tree.gravity_W().norm()),
      tick_(robot.model.tree, FootFrames(robot)),
      contacts_(robot.feet.size()),
      put_down_(robot.feet.size()),
      was_down_(robot.feet.size(), false) {
  observation_.feet.resize(robot.feet.size());
}

void Observer::ObserveState(const PlantState& state,
                            const std::vector<bool>& down,
                            const Eigen::Vector3d& com_ref) {
  ComputeTick(robot_.model.tree, state.q, state.v, &tick_);
  Observation& now = observation_;
  now.time = state.time;
  now.X_WB = tick_.X_WB[0];
  if (first_) standing_z_B_ = now.X_WB.R.transpose() * normal_W_;
  first_ = false;
  now.base_tilt = AngleBetween(now.X_WB.R * standing_z_B_, normal_W_);
  now.com = tick_.p_WG;
  now.com_velocity = tick_.v_WG;
  now.com_ref = com_ref;
  now.com_height = normal_W_.dot(tick_.p_WG);
  now.xi = ComputeDcm(tick_, mass_, now.com_height,
                      PendulumFrequency(gravity_, now.com_height), 1);
  for (size_t i = 0; i < robot_.feet.size(); ++i) {
    FootObservation& foot = now.feet[i];
    foot.X_WC = tick_.X_WB[robot_.feet[i].body] * robot_.feet[i].X_BC;
    foot.down = down.empty() || down[i];
    if (foot.down && !was_down_[i]) put_down_[i] = foot.X_WC;
    was_down_[i] = foot.down;
    foot.tilt = 0;
    foot.slide = 0;
    if (!foot.down) continue;
    const Eigen::Vector3d way = foot.X_WC.p - put_down_[i].p;
    foot.tilt = AngleBetween(foot.X_WC.R.col(2), put_down_[i].R.col(2));
    foot.slide = (way - normal_W_.dot(way) * normal_W_).norm();
  }
}

void Observer::MoveComReference(const std::vector<ContactTick>& believed) {
  Observation& now = observation_;
  for (size_t i = 0; i < now.feet.size(); ++i) {
    now.com_ref.head<2>() +=
        (now.feet[i].X_WC.p - believed[i].X_WC.p).head<2>() /
        static_cast<double>(now.feet.size());
  }
}

void Observer::ObserveForces(
    const std::vector<Eigen::Matrix<double, 6, 1>>& F_Co_C) {
  Observation& now = observation_;
  for (size_t i = 0; i < now.feet.size(); ++i) {
    now.feet[i].F_Co_C = F_Co_C[i];
    now.feet[i].in_contact = F_Co_C[i][5] > 0;
    contacts_[i].X_WC = now.feet[i].X_WC;
    contacts_[i].in_contact = now.feet[i].in_contact;
  }
  const Pose X_WM = MidFeet(contacts_);
  // The total wrench about the origin of M, in the axes of M.
  Eigen::Vector3d moment_M = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_M = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < now.feet.size(); ++i) {
    const Pose X_MC = X_WM.Inverse() * now.feet[i].X_WC;
    const Eigen::Vector3d force = X_MC.R * F_Co_C[i].tail<3>();
    moment_M += X_MC.R * F_Co_C[i].head<3>() + X_MC.p.cross(force);
    force_M += force;
  }
  if (force_M.z() > kNoForce) {
    now.cop = {-moment_M.y() / force_M.z(), moment_M.x() / force_M.z()};
  } else {
    now.cop.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace poise
