// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/push.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/finding.h"

namespace poise {

namespace {

constexpr double kPi = 3.14159265358979323846;

// Returns the integral of a profile up to a fraction x of its duration, divided
// by the duration.
double IntegralTo(PushProfile profile, double x) {
  x = std::clamp(x, 0.0, 1.0);
  return profile == PushProfile::kHalfSine ? (1 - std::cos(kPi * x)) / kPi : x;
}

void RequireFinite(const char* what, const Eigen::Vector3d& values) {
  for (const double value : values) {
    if (std::isfinite(value)) continue;
    throw std::invalid_argument(std::string(what) + " of a push is " +
                                std::to_string(value) + ", must be finite");
  }
}

}  // namespace

const char* NameOf(PushProfile profile) {
  switch (profile) {
    case PushProfile::kBox:
      return "box";
    case PushProfile::kHalfSine:
      return "half_sine";
    case PushProfile::kImpulse:
      return "impulse";
  }
  return "";
}

void SetForce(const Eigen::Vector3d& force, Push* push) {
  push->force = force;
  push->impulse_fraction.reset();
  push->elsewhere.reset();
}

double ProfileIntegral(const Push& push, double until) {
  const double time = until - push.start;
  if (!(time > 0)) return 0;
  const bool is_whole =
      push.profile == PushProfile::kImpulse || time >= push.duration;
  return push.duration *
         IntegralTo(push.profile, is_whole ? 1 : time / push.duration);
}

double ImpulseOf(const Push& push, double until) {
  return ProfileIntegral(push, until) * push.force.norm();
}

const Push* LargestPush(const std::vector<Push>& pushes, double until) {
  const Push* largest = nullptr;
  double most = 0;
  for (const Push& push : pushes) {
    const double impulse = ImpulseOf(push, until);
    if (impulse <= most) continue;
    most = impulse;
    largest = &push;
  }
  return largest;
}

double MeanOfProfile(const Push& push, double time, double dt) {
  if (push.profile == PushProfile::kImpulse) {
    // The impulse acts in the step whose start is nearest to the push's start.
    // So rounding at the border between two steps cannot lose the impulse.
    const double begin = time - dt / 2, end = time + dt / 2;
    return begin <= push.start && push.start < end ? push.duration / dt : 0;
  }
  if (push.duration <= 0) return 0;
  const auto integral = [&push](double t) {
    return IntegralTo(push.profile, (t - push.start) / push.duration);
  };
  return push.duration * (integral(time + dt) - integral(time)) / dt;
}

int FindTorso(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  std::vector<bool> is_leg(tree.num_bodies(), false);
  for (const Foot& foot : robot.feet) {
    for (int i = foot.body; i != 0; i = tree.joints()[i - 1].parent) {
      is_leg[i] = true;
    }
  }
  int torso = 0;
  for (int i = 1; i < tree.num_bodies(); ++i) {
    if (!is_leg[i] && tree.inertias()[i].mass > tree.inertias()[torso].mass) {
      torso = i;
    }
  }
  return torso;
}

bool IsZero(const Push& push) {
  return push.duration == 0 || (push.force.isZero(0) && push.moment.isZero(0));
}

double TimeAfterPushes(const std::vector<Push>& pushes, double until) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Push& push : pushes) {
    if (IsZero(push) || !(push.start < until)) continue;
    const bool is_instant = push.profile == PushProfile::kImpulse;
    const double end = push.start + (is_instant ? 0 : push.duration);
    shortest = std::min(shortest, until - end);
  }
  return shortest;
}

PushOnRobot::PushOnRobot(const Robot& robot, const Push& push)
    : push_(push), R_BF_(Eigen::Matrix3d::Identity()) {
  const Tree& tree = robot.model.tree;
  RequireFinite("force", push.force);
  RequireFinite("moment", push.moment);
  RequireFinite("point", push.point.value_or(Eigen::Vector3d::Zero()));
  RequireFinite("start", Eigen::Vector3d::Constant(push.start));
  if (!(push.duration >= 0) || std::isinf(push.duration)) {
    throw std::invalid_argument("duration of a push is " +
                                std::to_string(push.duration) +
                                ", must be at least 0 s");
  }
  Pose X_BF;
  if (push.link.empty()) {
    body_ = FindTorso(robot);
  } else {
    const auto frame = tree.FindFrame(push.link);
    if (!frame) {
      throw std::invalid_argument("link " + Quoted(push.link) +
                                  " is unknown, must be a link of robot " +
                                  Quoted(robot.model.name));
    }
    body_ = tree.frames()[*frame].body;
    X_BF = tree.frames()[*frame].X_BF;
  }
  R_BF_ = X_BF.R;
  p_BoQ_B_ = push.point ? X_BF * *push.point : tree.inertias()[body_].p_BoG_B;
}

Eigen::Vector3d PushOnRobot::force() const {
  return push_.frame == PushFrame::kWorld ? push_.force : R_BF_ * push_.force;
}

std::optional<AppliedForce> PushOnRobot::At(double time, double dt,
                                            const Eigen::Matrix3d& R_WB) const {
  const double mean = MeanOfProfile(push_, time, dt);
  if (mean == 0) return std::nullopt;
  const Eigen::Matrix3d R_W = push_.frame == PushFrame::kWorld
                                  ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                  : Eigen::Matrix3d(R_WB * R_BF_);
  return AppliedForce{body_, p_BoQ_B_, R_W * push_.moment * mean,
                      R_W * push_.force * mean};
}

}  // namespace poise
