// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "poise/robot/control/tasks/loop_closure.h"
#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

// A joint that is slower than this, rad/s, may still accelerate and brake like
// one of this speed. Some files have limits of 0.5 rad/s in the legs. Their
// soles could not stay on the ground: w q̇_max would be 20 rad/s². This holds
// for robot/models/humanoid.urdf and is scaled to other robots.
constexpr double kFast = 5;

// Bound on the braking of a joint that is faster than its limit, over omega
// times the limit. An impact leaves a leg far above a small limit. The braking
// of all joints at once would make the robot fall.
constexpr double kBrake = 0.25;

// An impact tilts a sole about as many joints of its leg, those next to it.
constexpr size_t kAnkleJoints = 2;

// Returns the largest acceleration towards a limit that is critically damped. d
// is the distance from the limit, and v the velocity towards it.
double Damped(double w, double d, double v) { return w * w * d - 2 * w * v; }

// Returns the largest acceleration towards a limit that stops at the limit. A
// joint that would brake more by Damped() brakes at a constant rate. The two
// are equal at v = (2 - sqrt(2)) w d. `most` bounds the brake of a joint that
// is almost at its limit.
double Stopping(double w, double d, double v) {
  if (v <= 0 || v <= (2 - M_SQRT2) * w * d) return Damped(w, d, v);
  const double most = 4 * w * v - w * w * d;
  return v * v < 2 * d * most ? -v * v / (2 * d) : -most;
}

}  // namespace

JointLimitsTask::JointLimitsTask(const RobotModel& model,
                                 const std::vector<Foot>& feet,
                                 const FroudeScale& scale)
    : Task("joint_limits", {},
           JointRows(model.tree, "joint", RowKind::kJointLimit,
                     {"", "rad", "the angle of %"},
                     {"", "m", "the position of %"})),
      q_start_(model.tree.q_start()),
      v_start_(model.tree.v_start()),
      lower_(model.tree.num_joints()),
      upper_(model.tree.num_joints()),
      velocity_(model.tree.num_joints()),
      fast_(model.tree.num_joints()),
      is_passive_(model.tree.num_joints()),
      foot_(model.tree.num_joints(), -1) {
  for (size_t i = 0; i < feet.size(); ++i) {
    const std::vector<int> joints = JointsTo(model.tree, feet[i].body);
    for (size_t k = 0; k < std::min(kAnkleJoints, joints.size()); ++k) {
      foot_[joints[k]] = static_cast<int>(i);
    }
  }
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const JointLimits& limits = model.limits[j];
    lower_[j] = limits.lower;
    upper_[j] = limits.upper;
    const bool is_slider = model.tree.joints()[j].type == JointType::kPrismatic;
    const bool is_known = limits.velocity > 0 && std::isfinite(limits.velocity);
    velocity_[j] = is_known ? limits.velocity : kAssumedVelocity;
    if (!is_slider) velocity_[j] = std::max(velocity_[j], kSlowestVelocity);
    fast_[j] =
        is_slider ? velocity_[j] : std::max(velocity_[j], kFast / scale.time());
    is_passive_[j] = limits.effort == 0;
  }
  AddParameter("omega", &omega_, 1, 1000);
  AddParameter("margin", &margin_, 0, 1);
}

void JointLimitsTask::Write(const TaskInput& input, EqualityBlock*,
                            InequalityBlock* inequalities) const noexcept {
  const double w = omega_;
  const double scale = 1 / (w * w);
  for (int j = 0; j < static_cast<int>(lower_.size()); ++j) {
    if (is_passive_[j]) continue;
    const double q = input.state.q[q_start_ + j];
    const double v = input.state.v[v_start_ + j];
    const bool stands = foot_[j] >= 0 && input.contacts[foot_[j]].in_contact;
    const auto bound = stands ? Stopping : Damped;
    double lower = -bound(w, -(lower_[j] + margin_ - q), -v);
    double upper = bound(w, upper_[j] - margin_ - q, v);
    // A range that is narrower than its margins shrinks to its middle.
    if (lower > upper) lower = upper = (lower + upper) / 2;
    const double unmodelled_vdot = input.unmodelled_vdot[v_start_ + j];
    inequalities->SetSingle(j, v_start_ + j, scale);
    // Clamping, instead of max and min, lets the position limit win on either
    // side if position and velocity limits contradict each other.
    const double most = velocity_[j];
    const double fast = fast_[j];
    const double rate = w * (fast / most);
    const double brake = kBrake * w * fast;
    inequalities->lower[j] =
        scale * (std::clamp(std::min(rate * (-most - v), brake), lower, upper) -
                 unmodelled_vdot);
    inequalities->upper[j] =
        scale * (std::clamp(std::max(rate * (most - v), -brake), lower, upper) -
                 unmodelled_vdot);
  }
}

}  // namespace poise
