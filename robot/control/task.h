// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/tick.h"
#include "hqp/hierarchy.h"
#include "robot/control/contacts.h"
#include "robot/control/measurement.h"
#include "robot/control/reference.h"

namespace poise {

/// All that a task may read to write its rows.
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

/// A number of a task that may be set by name, in a profile or between two
/// ticks: a gain, a margin, a coefficient.
struct Parameter {
  std::string name;
  double* value;
  double lower;  ///< Its range, both ends allowed.
  double upper;
};

/// One thing to do or to respect: rows in y = [v̇ (nv); λ (6 per foot)], see
/// (1) and (2). A task has always the same rows, named once, here; rows that do
/// not matter in a tick (of a foot in the air) stay zero and unbounded.
class Task {
 public:
  virtual ~Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  const std::string& name() const { return name_; }
  const std::vector<std::string>& equality_names() const {
    return equality_names_;
  }
  const std::vector<std::string>& inequality_names() const {
    return inequality_names_;
  }
  const std::vector<Parameter>& parameters() const { return parameters_; }

  /// Whether it has rows at all in this tick; if not, Write() is left out.
  virtual bool HasRows(const TaskInput&) const noexcept { return true; }

  /// Whether its inequality rows are bounded on both sides, so that their names
  /// get the one on which they act, .min or .max; what is bounded on one side only
  /// says so in its name, or has no other.
  virtual bool is_two_sided() const noexcept { return false; }

  /// What the residual of an equality row is multiplied with to be in the unit
  /// that a person thinks in: N or N m for forces and momenta; accelerations are in
  /// m/s2 or rad/s2 as they are.
  virtual double equality_scale(int) const noexcept { return 1; }

  /// Writes the rows B y + b = 0 and lower <= C y <= upper of this tick.
  /// @param equalities    as many rows as equality_names(), B and b zero.
  /// @param inequalities  as many rows as inequality_names(), C zero,
  /// unbounded. Does not allocate.
  virtual void Write(const TaskInput& input, EqualityBlock* equalities,
                     InequalityBlock* inequalities) const noexcept = 0;

 protected:
  Task(std::string name, std::vector<std::string> equality_names,
       std::vector<std::string> inequality_names)
      : name_(std::move(name)),
        equality_names_(std::move(equality_names)),
        inequality_names_(std::move(inequality_names)) {}

  void AddParameter(std::string name, double* value, double lower,
                    double upper) {
    parameters_.push_back({std::move(name), value, lower, upper});
  }

 private:
  std::string name_;
  std::vector<std::string> equality_names_;
  std::vector<std::string> inequality_names_;
  std::vector<Parameter> parameters_;
};

}  // namespace poise
