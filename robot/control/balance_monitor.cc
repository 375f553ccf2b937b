// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/balance_monitor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/support_box.h"

namespace poise {
namespace {

// Below this height of the center of mass above the soles, the robot has
// fallen, and the pendulum model is invalid.
constexpr double kMinHeight = 0.05;  // m.

// Lower bound on the way from the reference of xi to an edge. It is scaled to
// the robot, as kSlow is.
constexpr double kLeastWay = 0.01;  // m.

// Lower bound on the width of the blend, full - from, so that gains do not
// jump.
constexpr double kLeastWidth = 1e-3;

// Fraction of the soles in contact to which the target of the center of mass is
// clamped while a foot is in the air.
constexpr double kMiddle = 0.5;

// A foot is released if it carries less than kUnloaded of the weight, another
// foot more than kLoaded, and the share of the other side is above kReleasing.
constexpr double kUnloaded = 0.03;
constexpr double kLoaded = 0.5;
constexpr double kReleasing = 0.5;

// The push is over once all shares are 0, the base is within kUprightBase of
// its reference, and the center of mass is slower than kSlow.
constexpr double kUprightBase = 0.4;  // rad.
constexpr double kSlow = 0.3;         // m/s.

}  // namespace

double PendulumFrequency(double gravity, double height) noexcept {
  return std::sqrt(gravity / std::max(kMinHeight, height));
}

Eigen::Vector3d FindComTarget(const std::vector<Foot>& feet,
                              const std::vector<ContactTick>& contacts,
                              const Reference& reference) noexcept {
  int standing = 0;
  for (const ContactTick& contact : contacts) {
    standing += contact.in_contact ? 1 : 0;
  }
  if (standing == 0 || standing == static_cast<int>(feet.size())) {
    return reference.p_WG;
  }
  const Pose X_WMid = MidFeet(contacts);
  const Pose X_MidW = X_WMid.Inverse();
  const auto reach = [&](SupportSide side) {
    return kMiddle * SupportReach(feet, contacts, X_MidW, side);
  };
  Eigen::Vector3d p = X_MidW * reference.p_WG;
  p.x() = std::clamp(p.x(), -reach(kBack), reach(kFront));
  p.y() = std::clamp(p.y(), -reach(kRight), reach(kLeft));
  return X_WMid * p;
}

BalanceMonitor::BalanceMonitor(const Tree& tree, const std::vector<Foot>& feet,
                               const FroudeScale& scale)
    : mass_(tree.total_mass() > 0 ? tree.total_mass() : 1),
      gravity_(tree.gravity_W().norm()),
      weight_(tree.total_mass() * tree.gravity_W().norm()),
      least_way_(kLeastWay * scale.length),
      slow_(kSlow * scale.speed()),
      feet_(feet) {
  balance_.feet.resize(feet.size());
}

void BalanceMonitor::Update(const Tick& tick,
                            const std::vector<ContactTick>& contacts,
                            const Reference& reference,
                            const CaptureSettings& settings,
                            const Eigen::VectorXd& normal_force) noexcept {
  X_MidW_ = MidFeet(contacts).Inverse();
  FindShares(tick, contacts, reference, settings);
  JudgeFeet(tick, contacts, reference, normal_force);
}

void BalanceMonitor::FindShares(const Tick& tick,
                                const std::vector<ContactTick>& contacts,
                                const Reference& reference,
                                const CaptureSettings& settings) noexcept {
  const double height = std::max(kMinHeight, (X_MidW_ * tick.p_WG).z());
  const double w = PendulumFrequency(gravity_, height);
  const Eigen::Vector3d k_W = tick.L_G.head<3>();
  const Eigen::Vector3d given_back_W =
      k_W.cross(Eigen::Vector3d::UnitZ()) / (mass_ * height);
  const Eigen::Vector3d xi =
      X_MidW_ * (tick.p_WG + (tick.v_WG + given_back_W) / w);
  const Eigen::Vector3d xi_ref =
      X_MidW_ *
      (FindComTarget(feet_, contacts, reference) + reference.v_WG / w);

  const auto share = [&](SupportSide to, double farther) {
    const int axis = to == kFront || to == kBack ? 0 : 1;
    const int side = to == kFront || to == kLeft ? 1 : -1;
    const double reach = SupportReach(feet_, contacts, X_MidW_, to);
    const double whole = std::max(least_way_, reach - side * xi_ref[axis]);
    const double way = side * (xi - xi_ref)[axis] / (farther * whole);
    return settings.capture *
           std::clamp((way - settings.from) /
                          std::max(kLeastWidth, settings.full - settings.from),
                      0.0, 1.0);
  };
  balance_.xi_Mid = xi;
  balance_.left = share(kLeft, settings.sideways);
  balance_.right = share(kRight, settings.sideways);
  balance_.capture = std::max(
      {balance_.left, balance_.right, share(kFront, 1), share(kBack, 1)});
}

void BalanceMonitor::JudgeFeet(const Tick& tick,
                               const std::vector<ContactTick>& contacts,
                               const Reference& reference,
                               const Eigen::VectorXd& normal_force) noexcept {
  const double turned =
      LogSo3(reference.R_WB * tick.X_WB[0].R.transpose()).norm();
  const bool is_over = balance_.capture == 0 && turned < kUprightBase &&
                       tick.v_WG.norm() < slow_;
  const bool stands = normal_force.maxCoeff() > kLoaded * weight_;
  for (int foot = 0; foot < static_cast<int>(contacts.size()); ++foot) {
    const bool is_left = (X_MidW_ * contacts[foot].X_WC.p).y() > 0;
    const double away = is_left ? balance_.right : balance_.left;
    const double towards = is_left ? balance_.left : balance_.right;
    Balance::FootVerdict& verdict = balance_.feet[foot];
    verdict.comes_back = is_over || towards > 0;
    verdict.is_released = reference.may_release && away > kReleasing &&
                          stands && normal_force[foot] < kUnloaded * weight_;
  }
}

}  // namespace poise
