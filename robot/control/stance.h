// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/contacts.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/robot.h"

namespace poise {

/// Contact phase of a foot.
enum class ContactPhase {
  kDown,       ///< In contact.
  kUnloading,  ///< In contact; the force fades out, then the foot is lifted.
  kUp,         ///< In the air, on command.
  kLanding,    ///< In the air, moving down.
  kLoading,    ///< In contact; the force fades in, then the phase is kDown.
  kLost,       ///< Commanded to be in contact, but not on the ground.
  kFree,       ///< Released: in the air, without a reference.
  kReturning,  ///< In the air, moving back to or above its take-off place.
  kStepping,   ///< In the air, on a path that the caller writes.
};

/// Times and heights of a Stance. A time of 0 means: within one tick. The
/// defaults hold for robot/models/humanoid.urdf; the constructor of Stance
/// scales them to the robot.
struct StanceSettings {
  double fade_time = 0.3;    ///< Time for a force to fade in or out, s.
  double swing_time = 0.8;   ///< Time to lift a foot or to put it down, s.
  double return_time = 0.5;  ///< Time for a released foot to come back, s.
  /// A rising sole leaves the ground with its lowest corner at this height, m.
  double lost_above = 0.01;
  /// Debounce time: contact is lost only after this long, s, so that one bad
  /// sample cannot drop a foot. A foot that was not seen on the ground since
  /// Reset() is lost at once.
  double lost_after = 0.003;
  /// A descending sole is on the ground with its center at this height, m.
  double found_below = 0.004;
};

/// Decides which feet are in contact. On command, the force of a foot fades out
/// before the foot is lifted, and fades in after the foot is put down. Without
/// a command, contact is detected by geometry with hysteresis, never by force:
/// a foot that is assumed to be in the air carries no load, so a force test
/// would never find its contact again. A foot that stands on its edge stays in
/// contact. A foot that is landing, lost or returning is in contact again when
/// its sole lies on the ground. While no foot is in contact, all feet move with
/// the body without a reference. In this case, a foot is in contact as soon as
/// an edge touches the ground, with its full normal force.
///
/// After Reset(), the feet count as in contact before one touches the ground,
/// so that the legs reach for it. Until then, ContactTick::wrench_share is
/// small: a moment on a foot in the air would turn the foot.
class Stance {
 public:
  /// Range of the height argument of Lift(), m.
  static constexpr double kLeastHeight = 1e-3;
  static constexpr double kMostHeight = 1;

  static constexpr double kMostTime = 60;        ///< Upper bound of times, s.
  static constexpr double kMostThreshold = 0.5;  ///< Upper bound of heights, m.

  /// All feet start in contact. `weight` is the weight of the robot, N; `scale`
  /// fits the settings and all other lengths, times and speeds to its size.
  Stance(const std::vector<Foot>& feet, double weight,
         const FroudeScale& scale = {});

  /// Throws std::invalid_argument, and changes nothing, if a time is not 0 to
  /// kMostTime, or a height not 0 to kMostThreshold. Call only between ticks.
  void Configure(const StanceSettings& settings);
  const StanceSettings& settings() const { return settings_; }

  /// Sets all feet to kDown at once.
  void Reset() noexcept;

  /// Fades the force of a foot out and then lifts the foot by height, m. A foot
  /// already in the air moves to that height. A released or stepping foot moves
  /// from its present pose to that height above the place where it took off.
  /// Returns false, and does nothing, if the height is out of its range.
  [[nodiscard]] bool Lift(int foot, double height) noexcept;

  /// Puts a foot down at the place where it took off; a released or stepping
  /// foot returns there first. A foot that is still unloading is loaded again.
  void PutDown(int foot) noexcept;

  /// Releases a foot at once: its reference is switched off, and the foot moves
  /// with the body until PutDown() or Lift() brings it back. A foot that was in
  /// contact at the last Update() has not moved yet: for these calls it is in
  /// contact.
  void LetGo(int foot) noexcept;

  /// Lifts a foot at once. The caller writes Reference::feet in each tick; the
  /// foot is in contact again, with full force, when its sole lies on the
  /// ground. Lift() and PutDown() end the step, LetGo() releases the foot.
  void Step(int foot) noexcept;

  ContactPhase phase(int foot) const {
    return feet_[static_cast<size_t>(foot)].phase;
  }
  /// Whether the foot is commanded to be in contact (kDown, kLost, kLoading).
  bool is_meant_down(int foot) const;

  /// Advances by dt: writes in_contact and max_normal_force of the contacts,
  /// and moves the references of the feet in the air.
  /// @param normal_force  by foot, of the last solution, N.
  /// Does not allocate.
  void Update(double dt, const Eigen::VectorXd& normal_force,
              std::vector<ContactTick>* contacts,
              Reference* reference) noexcept;

 private:
  struct FootState {
    ContactPhase phase = ContactPhase::kDown;
    double since = 0;         // Time in this phase, s.
    double left_for = 0;      // Time off the ground, s.
    double force = 0;         // Normal force at the start of the phase, N.
    Pose X_WC;                // Take-off pose, made upright.
    Pose X_WC_away;           // Pose at the start of kReturning.
    Vector6d V_WC_away;       // Twist at the start of kReturning, world axes.
    double from = 0, to = 0;  // Start and end height of the swing, m.
    bool has_risen = false;   // Off the ground once in kStepping.
    bool has_flown = false;   // No foot was in contact at a time in this phase.
    bool has_taken_off = false;  // In the air since an Update(); X_WC is set.
    std::vector<Eigen::Vector2d> polygon_C;
  };

  // Clearance of a point of a sole.
  struct Clearance {
    double height;  // Above the ground, m.
    double rising;  // m/s.
  };

  // Vertical motion of a sole above the ground, in m, m/s and m/s2.
  struct VerticalMotion {
    double height, speed, acceleration;
    bool is_over;
  };

  static Clearance LowestCorner(const FootState& foot,
                                const ContactTick& contact,
                                double ground_z) noexcept;
  static Clearance Middle(const ContactTick& contact, double ground_z) noexcept;
  bool HasTouched(const FootState& foot, const ContactTick& contact,
                  double ground_z) const noexcept;
  bool HasLeft(const Clearance& lowest) const noexcept;
  bool HasLanded(const Clearance& sole) const noexcept;
  bool IsStopped(const FootState& foot, const Clearance& sole) const noexcept;
  bool flies() const noexcept;
  static bool Lands(const FootState& foot) noexcept;
  void CallBack(FootState* foot) noexcept;
  void Swing(FootState* foot, double height) noexcept;
  bool HasSteppedDown(double dt, const ContactTick& contact, double ground_z,
                      double reference_speed, FootState* foot) const noexcept;
  void ChangePhase(double dt, const ContactTick& contact,
                   const Reference& reference, double reference_speed,
                   FootState* foot) noexcept;
  double MaxNormalForce(double normal_force, FootState* foot) const noexcept;
  VerticalMotion VerticalMotionOf(const FootState& foot) const noexcept;
  void Guide(const FootState& foot, FrameReference* target) const noexcept;
  void Return(const FootState& foot, FrameReference* target) const noexcept;
  void Enter(FootState* foot, ContactPhase phase) noexcept;
  void TakeOff(FootState* foot, const ContactTick& contact,
               const Reference& reference) noexcept;

  double Duration(const FootState& foot) const noexcept;

  double weight_;
  double length_, time_, speed_;  // Ratios, see FroudeScale.
  StanceSettings settings_;
  std::vector<FootState> feet_;
  bool has_touched_ = false;  // A foot touched the ground since Reset().
};

}  // namespace poise
