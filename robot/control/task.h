// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/reference.h"

namespace poise {

/// Input of a task.
struct TaskInput {
  const State& state;
  const Tick& tick;
  const std::vector<ContactTick>& contacts;  ///< By foot of the robot.
  const Reference& reference;
  /// Unmodelled part of v̇, nv, see UnmodelledAcceleration.
  const Eigen::VectorXd& unmodelled_vdot;
  /// Acceleration of the center of mass against model errors, in addition to its
  /// reference, m/s2; see Disturbance.
  Eigen::Vector3d correction_W = Eigen::Vector3d::Zero();
  /// Capture blend, 0 to 1, see Balance::capture.
  double capture = 0;
};

/// A number of a task that profiles and callers set by name: a gain, a margin, a
/// coefficient.
struct Parameter {
  std::string name;
  double* value;
  double lower;  ///< Its range, both ends allowed.
  double upper;
};

/// Kinds of rows, by the quantity that a row sets or bounds.
enum class RowKind {
  kTarget,            ///< An equality: the target of a task.
  kDynamics,          ///< An equality: a law of physics.
  kTorqueLimit,       ///< Torque of an actuator.
  kJointLimit,        ///< Position or velocity of a joint.
  kCopLimit,          ///< Center of pressure at an edge.
  kFrictionLimit,     ///< Tangential force on a foot.
  kYawLimit,          ///< Moment about a foot's normal.
  kNormalForceLimit,  ///< Normal force on a foot.
  kLimit,             ///< Any other inequality.
};

/// "target", "dynamics", "torque_limit", ...: the name of a kind in files.
constexpr std::string_view RowKindName(RowKind kind) {
  switch (kind) {
    case RowKind::kTarget:
      return "target";
    case RowKind::kDynamics:
      return "dynamics";
    case RowKind::kTorqueLimit:
      return "torque_limit";
    case RowKind::kJointLimit:
      return "joint_limit";
    case RowKind::kCopLimit:
      return "cop_limit";
    case RowKind::kFrictionLimit:
      return "friction_limit";
    case RowKind::kYawLimit:
      return "yaw_limit";
    case RowKind::kNormalForceLimit:
      return "normal_force_limit";
    case RowKind::kLimit:
      return "limit";
  }
  return "";
}

/// Description of a row for the user; every output of a row uses this text.
struct RowDescription {
  std::string name;  ///< "left_foot.cop.x_max", as in the log.
  /// Unit of the bounded quantity or, of an equality, of the residual times
  /// Task::equality_scale(): "N m".
  std::string unit;
  /// "the CoP of the left foot at its front edge", as the row is active; of a
  /// row with two sides the quantity alone, "the torque of l knee". May be empty.
  std::string phrase;
  RowKind kind = RowKind::kTarget;
};

/// A goal or a constraint: rows in y = [v̇ (nv); λ (6 per foot)], (1) and (2). The
/// rows of a task and their names are fixed. Unused rows, as of a foot in the air,
/// stay zero and unbounded.
class Task {
 public:
  virtual ~Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  const std::string& name() const { return name_; }
  const std::vector<RowDescription>& equalities() const { return equalities_; }
  const std::vector<RowDescription>& inequalities() const {
    return inequalities_;
  }
  /// Returns the names of the rows, in their order.
  const std::vector<std::string>& equality_names() const {
    return equality_names_;
  }
  const std::vector<std::string>& inequality_names() const {
    return inequality_names_;
  }
  const std::vector<Parameter>& parameters() const { return parameters_; }

  /// Returns whether the task has rows in this tick. If not, Write() is not called.
  virtual bool HasRows(const TaskInput&) const noexcept { return true; }

  /// Returns whether the inequality rows have two bounds, so that their names get a
  /// suffix for the active bound, .min or .max. The name of a row with one
  /// bound already names the bound, or needs no suffix.
  virtual bool is_two_sided() const noexcept { return false; }

  /// Factor that brings the residual of an equality row to the row's unit, see
  /// RowDescription.
  virtual double equality_scale(int) const noexcept { return 1; }

  /// Writes the rows B y + b = 0 and lower <= C y <= upper of this tick.
  /// @param equalities    as many rows as equality_names(), B and b zero.
  /// @param inequalities  as many rows as inequality_names(), C zero,
  /// unbounded. Does not allocate.
  virtual void Write(const TaskInput& input, EqualityBlock* equalities,
                     InequalityBlock* inequalities) const noexcept = 0;

 protected:
  Task(std::string name, std::vector<RowDescription> equalities,
       std::vector<RowDescription> inequalities)
      : name_(std::move(name)),
        equalities_(std::move(equalities)),
        inequalities_(std::move(inequalities)) {
    for (const auto& row : equalities_) equality_names_.push_back(row.name);
    for (const auto& row : inequalities_) inequality_names_.push_back(row.name);
  }

  void AddParameter(std::string name, double* value, double lower,
                    double upper) {
    parameters_.push_back({std::move(name), value, lower, upper});
  }

 private:
  std::string name_;
  std::vector<RowDescription> equalities_;
  std::vector<RowDescription> inequalities_;
  std::vector<std::string> equality_names_;
  std::vector<std::string> inequality_names_;
  std::vector<Parameter> parameters_;
};

}  // namespace poise
