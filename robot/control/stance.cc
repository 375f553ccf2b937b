// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "poise/math/so3.h"
#include "poise/robot/control/easing/minimum_jerk.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Lengths, times and speeds below hold for robot/models/humanoid.urdf; Stance
// multiplies them by the ratios of the robot.

// The reference of a landing foot ends kReach below the ground, so that the
// foot reaches the ground. Below ground level, the reference sinks over
// kSinkTime, so that the foot does not hit the ground hard.
constexpr double kReach = 0.005;   // m.
constexpr double kSinkTime = 0.4;  // s.

// The ground has stopped a descending sole if the sole is slower than kStopped
// times its reference. This test needs a reference faster than kTelling.
constexpr double kStopped = 0.5;
constexpr double kTelling = 0.01;  // m/s.

// A sole that rises faster than this is leaving the ground.
constexpr double kSeparating = 0.02;  // m/s.

// A returning foot is level and above its place after this fraction of
// return_time; only its height still changes then.
constexpr double kThereAfter = 0.7;

// Replaces a duration of 0: the motion then ends within one tick, and nothing
// is divided by zero.
constexpr double kInstant = 1e-9;  // s.

// Rounding error of a sum of several control periods, s.
constexpr double kRounding = 1e-9;

// Speed at which a foot moves down after it has lost the ground, and the
// shortest time of this motion.
constexpr double kSearchSpeed = 0.2;  // m/s.
constexpr double kSearchTime = 0.05;  // s.

// A step has left the ground with its lowest corner above kStepRisen. It lands
// with its middle below kStepFlat, if its lowest corner is below the ground
// within kStepSoon: between kStepLow and kStepTouch above it. A slow foot that
// counted as landed too early would pull the body down to it.
constexpr double kStepRisen = 0.006;  // m.
constexpr double kStepFlat = 0.005;   // m.
constexpr double kStepSoon = 0.005;   // s.
constexpr double kStepLow = 0.0001;   // m.
constexpr double kStepTouch = 0.001;  // m.

// A step has also landed if its path sinks faster than kStepSinking, and the
// sole has been stopped for kStepStopped, below kStepNear.
constexpr double kStepSinking = 0.1;    // m/s.
constexpr double kStepStopped = 0.008;  // s.
constexpr double kStepNear = 0.03;      // m.

// Before the first touch, see ContactTick::wrench_share. With 0.3, two of 15
// runs of robots with light feet end in a fall from 2 mm. With 0, the solver
// needs 28 iterations in place of one.
constexpr double kUntouchedShare = 0.1;

// A sole touches the ground with its lowest corner below kTouch. If the ground
// is higher than its estimate, the sole is slower than kFalling after
// kFallTime: a foot that nothing holds then falls twice as fast.
constexpr double kTouch = 0.0001;    // m.
constexpr double kFalling = 0.015;   // m/s.
constexpr double kFallTime = 0.003;  // s.

// While a foot is loading, the bound on its normal force rises to this many
// times the weight of the robot.
constexpr double kFullLoad = 1.5;

bool Bears(ContactPhase phase) {
  return phase == ContactPhase::kDown || phase == ContactPhase::kUnloading ||
         phase == ContactPhase::kLoading;
}

// Whether Stance does not know the path of a foot in this phase. Only a return
// from the measured pose brings the foot back.
bool IsAway(ContactPhase phase) {
  return phase == ContactPhase::kFree || phase == ContactPhase::kStepping;
}

// Returns the orientation with z up and the heading of R_WC.
Eigen::Matrix3d Upright(const Eigen::Matrix3d& R_WC) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(1) = z.cross(R_WC.col(0)).normalized();
  R.col(0) = R.col(1).cross(z);
  R.col(2) = z;
  return R;
}

}  // namespace

Stance::Stance(const std::vector<Foot>& feet, double weight,
               const FroudeScale& scale)
    : weight_(weight),
      length_(scale.length),
      time_(scale.time()),
      speed_(scale.speed()),
      feet_(feet.size()) {
  for (double* time : {&settings_.fade_time, &settings_.swing_time,
                       &settings_.return_time, &settings_.lost_after}) {
    *time = std::min(kMostTime, time_ * *time);
  }
  for (double* height : {&settings_.lost_above, &settings_.found_below}) {
    *height = std::min(kMostThreshold, length_ * *height);
  }
  for (size_t i = 0; i < feet.size(); ++i) {
    feet_[i].polygon_C = feet[i].polygon_C;
  }
  Reset();
}

void Stance::Reset() noexcept {
  for (FootState& foot : feet_) {
    Enter(&foot, ContactPhase::kDown);
    foot.left_for = kInfinity;
  }
  has_touched_ = false;
}

void Stance::Configure(const StanceSettings& settings) {
  const struct {
    const char* name;
    double value, most;
    const char* unit;
  } fields[] = {{"fade_time", settings.fade_time, kMostTime, "s"},
                {"swing_time", settings.swing_time, kMostTime, "s"},
                {"return_time", settings.return_time, kMostTime, "s"},
                {"lost_above", settings.lost_above, kMostThreshold, "m"},
                {"lost_after", settings.lost_after, kMostTime, "s"},
                {"found_below", settings.found_below, kMostThreshold, "m"}};
  for (const auto& field : fields) {
    if (field.value >= 0 && field.value <= field.most) continue;
    throw std::invalid_argument(std::string("stance: ") + field.name + " is " +
                                PrintNumber(field.value) + " " + field.unit +
                                ", must be 0 to " + PrintNumber(field.most) +
                                " " + field.unit);
  }
  settings_ = settings;
}

Stance::Clearance Stance::LowestCorner(const FootState& foot,
                                       const ContactTick& contact,
                                       double ground_z) noexcept {
  Clearance lowest{kInfinity, 0};
  const Eigen::RowVector3d z_C = contact.X_WC.R.row(2);
  for (const Eigen::Vector2d& corner : foot.polygon_C) {
    const Eigen::Vector3d p_C(corner.x(), corner.y(), 0);
    const double height = contact.X_WC.p.z() + z_C.dot(p_C) - ground_z;
    if (height >= lowest.height) continue;
    const Eigen::Vector3d v_C =
        contact.V_WC_C.tail<3>() + contact.V_WC_C.head<3>().cross(p_C);
    lowest = {height, z_C.dot(v_C)};
  }
  return lowest;
}

Stance::Clearance Stance::Middle(const ContactTick& contact,
                                 double ground_z) noexcept {
  return {contact.X_WC.p.z() - ground_z,
          contact.X_WC.R.row(2).dot(contact.V_WC_C.tail<3>())};
}

// Before the first touch, all feet are kDown since Reset().
bool Stance::HasTouched(const FootState& foot, const ContactTick& contact,
                        double ground_z) const noexcept {
  if (foot.phase != ContactPhase::kDown) return true;
  const Clearance lowest = LowestCorner(foot, contact, ground_z);
  return lowest.height < length_ * kTouch ||
         (foot.since > time_ * kFallTime && lowest.rising > -speed_ * kFalling);
}

bool Stance::HasLeft(const Clearance& lowest) const noexcept {
  return lowest.height > 2 * settings_.lost_above ||
         (lowest.height > settings_.lost_above &&
          lowest.rising > speed_ * kSeparating);
}

bool Stance::HasLanded(const Clearance& sole) const noexcept {
  return sole.height < settings_.found_below &&
         sole.rising < speed_ * kSeparating;
}

// Whether the ground has stopped a descending sole. If contact were declared
// while the sole still descends, the controller would push on thin air: the
// foot would tilt and land on one corner after another. While the reference
// itself is nearly at rest, a slow sole proves nothing; then only the end of
// the motion counts.
bool Stance::IsStopped(const FootState& foot,
                       const Clearance& sole) const noexcept {
  if (foot.phase != ContactPhase::kLanding) return true;
  const VerticalMotion motion = VerticalMotionOf(foot);
  return motion.speed < -speed_ * kTelling
             ? sole.rising > kStopped * motion.speed
             : motion.is_over;
}

// Whether no foot is in contact: the robot is in flight.
bool Stance::flies() const noexcept {
  return std::none_of(feet_.begin(), feet_.end(),
                      [](const FootState& foot) { return Bears(foot.phase); });
}

// Whether the motion of the foot ends on the ground.
bool Stance::Lands(const FootState& foot) noexcept { return foot.to < 0; }

void Stance::Enter(FootState* foot, ContactPhase phase) noexcept {
  foot->phase = phase;
  if (Bears(phase)) foot->has_taken_off = false;
  foot->since = 0;
  foot->left_for = 0;
  foot->has_flown = false;
  foot->has_risen = false;
}

// Ends the release or the step of a foot. A foot that was in contact at the
// last Update() has not moved yet: it is simply down again.
void Stance::CallBack(FootState* foot) noexcept {
  if (!IsAway(foot->phase)) return;
  Enter(foot,
        foot->has_taken_off ? ContactPhase::kReturning : ContactPhase::kDown);
}

bool Stance::Lift(int i, double height) noexcept {
  if (!(height >= kLeastHeight && height <= kMostHeight)) return false;
  CallBack(&feet_[i]);
  Swing(&feet_[i], height);
  return true;
}

// Starts the motion of a foot to a height above the ground, or (negative
// height) to the ground.
void Stance::Swing(FootState* of, double height) noexcept {
  FootState& foot = *of;
  switch (foot.phase) {
    case ContactPhase::kDown:
    case ContactPhase::kLoading:
      Enter(&foot, ContactPhase::kUnloading);
      foot.force = -1;  // Set at the next Update().
      foot.to = height;
      return;
    case ContactPhase::kUnloading:
      foot.to = height;
      return;
    case ContactPhase::kReturning:
      // Restarts the return from the present pose.
      Enter(&foot, ContactPhase::kReturning);
      foot.to = height;
      return;
    default: {
      foot.from = VerticalMotionOf(foot).height;
      foot.to = height;
      Enter(&foot, ContactPhase::kUp);
    }
  }
}

void Stance::Step(int i) noexcept { Enter(&feet_[i], ContactPhase::kStepping); }

void Stance::LetGo(int i) noexcept { Enter(&feet_[i], ContactPhase::kFree); }

void Stance::PutDown(int i) noexcept {
  FootState& foot = feet_[i];
  if (IsAway(foot.phase)) {
    CallBack(&foot);
    foot.to = -length_ * kReach;
  } else if (foot.phase == ContactPhase::kReturning) {
    if (!Lands(foot)) Swing(&foot, -length_ * kReach);
  } else if (foot.phase == ContactPhase::kUnloading) {
    Enter(&foot, ContactPhase::kLoading);
    foot.force = weight_;
  } else if (foot.phase == ContactPhase::kUp) {
    Swing(&foot, -length_ * kReach);
    Enter(&foot, ContactPhase::kLanding);
  }
}

bool Stance::is_meant_down(int i) const {
  const ContactPhase phase = feet_[i].phase;
  return phase == ContactPhase::kDown || phase == ContactPhase::kLost ||
         phase == ContactPhase::kLoading;
}

void Stance::TakeOff(FootState* foot, const ContactTick& contact,
                     const Reference& reference) noexcept {
  foot->X_WC.R = Upright(contact.X_WC.R);
  foot->X_WC.p = contact.X_WC.p;
  foot->X_WC.p.z() = reference.ground_z;
  foot->from = contact.X_WC.p.z() - reference.ground_z;
  foot->has_taken_off = true;
}

// Moves the target of a returning foot from the pose and twist V at the start
// of the return to the take-off pose, on the ground or at a height above it, by
// the displacement X: x = s X + (1 - s) t V. The foot is above its place, and
// its sole is level, before it reaches the final height.
void Stance::Return(const FootState& foot,
                    FrameReference* target) const noexcept {
  Vector6d whole;
  whole << LogSo3(foot.X_WC.R * foot.X_WC_away.R.transpose()),
      foot.X_WC.p - foot.X_WC_away.p;
  const double fall = foot.X_WC_away.p.z() - foot.X_WC.p.z() + length_ * kReach;
  whole[5] += foot.to;
  const double whole_time = std::max(kInstant, settings_.return_time);
  Vector6d moved;
  for (int i = 0; i < 6; ++i) {
    const double time = i < 5 ? kThereAfter * whole_time : whole_time;
    const double t = std::min(foot.since, time);
    const MinimumJerk s(t / time);
    const double rate = s.rate / time;
    const double acceleration = s.acceleration / (time * time);
    // A foot that falls faster than this would touch the ground before it is
    // above its place.
    const double fastest = i < 5 ? kInfinity : fall / whole_time;
    const double v = std::max(foot.V_WC_away[i], -fastest);
    moved[i] = s.value * whole[i] + (1 - s.value) * t * v;
    target->V_WF_W[i] = rate * whole[i] + (1 - s.value - rate * t) * v;
    target->A_WF_W[i] =
        acceleration * whole[i] - (2 * rate + acceleration * t) * v;
  }
  target->X_WF.R = ExpSo3(moved.head<3>()) * foot.X_WC_away.R;
  target->X_WF.p = foot.X_WC_away.p + moved.tail<3>();
}

void Stance::Update(double dt, const Eigen::VectorXd& normal_force,
                    std::vector<ContactTick>* contacts,
                    Reference* reference) noexcept {
  const int count = static_cast<int>(feet_.size());
  for (int i = 0; i < count; ++i) {
    ChangePhase(dt, (*contacts)[i], *reference, reference->feet[i].V_WF_W[5],
                &feet_[i]);
  }
  for (int i = 0; i < count && !has_touched_; ++i) {
    has_touched_ = HasTouched(feet_[i], (*contacts)[i], reference->ground_z);
  }
  const bool in_flight = flies();
  for (int i = 0; i < count; ++i) {
    FootState& foot = feet_[i];
    ContactTick& contact = (*contacts)[i];
    foot.has_flown |= in_flight;
    contact.is_guided = foot.phase != ContactPhase::kFree && !in_flight;
    contact.in_contact = Bears(foot.phase);
    contact.is_stepping = foot.phase == ContactPhase::kStepping;
    contact.max_normal_force = MaxNormalForce(normal_force[i], &foot);
    contact.wrench_share = has_touched_ ? 1 : kUntouchedShare;
    if (!contact.in_contact) Guide(foot, &reference->feet[i]);
  }
}

// Whether a foot that makes a step has landed: its sole lies on the ground, or
// has been stopped although its path sinks, as on ground that is higher than
// its estimate.
bool Stance::HasSteppedDown(double dt, const ContactTick& contact,
                            double ground_z, double reference_speed,
                            FootState* foot) const noexcept {
  const Clearance lowest = LowestCorner(*foot, contact, ground_z);
  const Clearance middle = Middle(contact, ground_z);
  if (lowest.height > length_ * kStepRisen) foot->has_risen = true;
  if (!foot->has_risen) return false;
  const double near = std::clamp(-time_ * kStepSoon * lowest.rising,
                                 length_ * kStepLow, length_ * kStepTouch);
  const bool touches = lowest.height < near &&
                       middle.height < length_ * kStepFlat &&
                       middle.rising < speed_ * kSeparating;
  const bool is_stopped = reference_speed < -speed_ * kStepSinking &&
                          middle.rising > kStopped * reference_speed &&
                          middle.height < length_ * kStepNear;
  foot->left_for = is_stopped ? foot->left_for + dt : 0;
  return touches || foot->left_for > time_ * kStepStopped;
}

void Stance::ChangePhase(double dt, const ContactTick& contact,
                         const Reference& reference, double reference_speed,
                         FootState* of) noexcept {
  FootState& foot = *of;
  // Records the state at the start of a phase.
  if (!Bears(foot.phase) && !foot.has_taken_off) {
    TakeOff(&foot, contact, reference);
  }
  if (foot.phase == ContactPhase::kReturning && foot.since == 0) {
    foot.X_WC_away = contact.X_WC;
    foot.V_WC_away << contact.X_WC.R * contact.V_WC_C.head<3>(),
        contact.X_WC.R * contact.V_WC_C.tail<3>();
  }
  foot.since += dt;

  // Ends the phase if its end condition is met.
  switch (foot.phase) {
    case ContactPhase::kDown:
    case ContactPhase::kLoading:
      if (!HasLeft(LowestCorner(foot, contact, reference.ground_z))) {
        foot.left_for = 0;
      } else {
        foot.left_for += dt;
      }
      if (foot.left_for > 0 &&
          foot.left_for > settings_.lost_after - kRounding) {
        TakeOff(&foot, contact, reference);
        foot.to = -length_ * kReach;
        Enter(&foot, ContactPhase::kLost);
      } else if (foot.phase == ContactPhase::kLoading &&
                 foot.since > settings_.fade_time) {
        Enter(&foot, ContactPhase::kDown);
      }
      return;
    case ContactPhase::kLost:
    case ContactPhase::kLanding:
    case ContactPhase::kReturning:
      if (!Lands(foot)) {
        if (foot.since > settings_.return_time) {
          foot.from = foot.to;
          Enter(&foot, ContactPhase::kUp);
        }
      } else if (foot.has_flown) {
        // After a flight, each foot must carry load at once, even if not level.
        if (HasLanded(LowestCorner(foot, contact, reference.ground_z))) {
          Enter(&foot, ContactPhase::kDown);
        }
      } else if (const Clearance sole = Middle(contact, reference.ground_z);
                 HasLanded(sole) && IsStopped(foot, sole)) {
        Enter(&foot, ContactPhase::kLoading);
        foot.force = 0;
      }
      return;
    case ContactPhase::kUnloading:
      if (foot.since > settings_.fade_time) {
        TakeOff(&foot, contact, reference);
        Enter(&foot, ContactPhase::kUp);
      }
      return;
    case ContactPhase::kStepping:
      if (HasSteppedDown(dt, contact, reference.ground_z, reference_speed,
                         &foot)) {
        Enter(&foot, ContactPhase::kDown);
      }
      return;
    case ContactPhase::kUp:
    case ContactPhase::kFree:
      return;
  }
}

double Stance::MaxNormalForce(double normal_force,
                              FootState* foot) const noexcept {
  const double fade =
      std::min(1.0, foot->since / std::max(kInstant, settings_.fade_time));
  if (foot->phase == ContactPhase::kUnloading) {
    if (foot->force < 0) foot->force = normal_force;
    return (1 - fade) * foot->force;
  }
  if (foot->phase == ContactPhase::kLoading) {
    return foot->force + fade * (kFullLoad * weight_ - foot->force);
  }
  return kInfinity;
}

// Writes the reference of a foot in the air.
void Stance::Guide(const FootState& foot,
                   FrameReference* target) const noexcept {
  if (foot.phase == ContactPhase::kFree) return;
  if (foot.phase == ContactPhase::kStepping) return;
  if (foot.phase == ContactPhase::kReturning) {
    Return(foot, target);
    return;
  }
  const VerticalMotion motion = VerticalMotionOf(foot);
  target->X_WF = foot.X_WC;
  target->X_WF.p.z() += motion.height;
  target->V_WF_W.setZero();
  target->V_WF_W[5] = motion.speed;
  target->A_WF_W.setZero();
  target->A_WF_W[5] = motion.acceleration;
}

// Returns the duration of the vertical motion of a foot in the air, s.
double Stance::Duration(const FootState& foot) const noexcept {
  if (foot.phase != ContactPhase::kLost) {
    return std::max(kInstant, settings_.swing_time);
  }
  return std::max(time_ * kSearchTime,
                  (foot.from - foot.to) / (speed_ * kSearchSpeed));
}

// A landing foot first comes to rest on the ground; then its reference sinks
// below the ground.
Stance::VerticalMotion Stance::VerticalMotionOf(
    const FootState& foot) const noexcept {
  const double down = Duration(foot);
  const bool lands = foot.phase == ContactPhase::kLanding;
  const bool sinks = lands && foot.since > down;
  const double from = sinks ? 0 : foot.from;
  const double travel = (lands && !sinks ? 0 : foot.to) - from;
  const double sink_time = time_ * kSinkTime;
  const double time = sinks ? sink_time : down;
  const MinimumJerk s(std::min(1.0, (foot.since - (sinks ? down : 0)) / time));
  return {from + travel * s.value, travel / time * s.rate,
          travel / (time * time) * s.acceleration,
          foot.since > down + (lands ? sink_time : 0)};
}

}  // namespace poise
