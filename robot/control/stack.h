// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/robot/control/easing/easing.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tick_report.h"

namespace poise {

/// Settings of a task in the hierarchy.
struct TaskSettings {
  bool enabled = true;
  int level = 1;      ///< 1 is the highest; at most Stack::kMaxLevel.
  double weight = 1;  ///< Weight within its level; see Stack::kMostWeight.
};

/// A row of a stack, with its name in the log, and the name of its task.
struct StackRow {
  std::string task;
  RowDescription row;
};

/// The tasks of a controller with their priority levels. Between two ticks, any
/// task can be switched, moved to another level, weighted or tuned by its name.
/// The change takes effect at the next Write() and does not allocate.
class Stack {
 public:
  static constexpr int kMaxLevel = 8;
  /// Range of a weight. Weights outside [1e-6, 1e6] lose all digits to rounding
  /// and cost the active-set search hundreds of steps.
  static constexpr double kLeastWeight = 1e-6;
  static constexpr double kMostWeight = 1e6;
  static constexpr double kMostRatio = 1e6;  ///< For set_weighted().

  /// Creates an empty stack. Its rows have num_variables columns.
  explicit Stack(int num_variables);

  /// Adds a task. Call this only before the first tick. Throws
  /// std::invalid_argument if the name exists already or a setting is out of
  /// range.
  void Add(std::unique_ptr<Task> task, const TaskSettings& settings);

  int num_tasks() const { return static_cast<int>(entries_.size()); }
  const Task& task(int i) const {
    return *entries_[static_cast<size_t>(i)].task;
  }
  const TaskSettings& settings(int i) const {
    return entries_[static_cast<size_t>(i)].settings;
  }
  /// Returns the index of a task, or nullopt if no task has this name.
  std::optional<int> Find(std::string_view name) const noexcept;

  /// These four return false and change nothing if there is no such task or
  /// parameter, or the value is out of its range.
  [[nodiscard]] bool Enable(std::string_view name, bool enabled) noexcept;
  [[nodiscard]] bool SetLevel(std::string_view name, int level) noexcept;
  [[nodiscard]] bool SetWeight(std::string_view name, double weight) noexcept;
  [[nodiscard]] bool SetParameter(std::string_view name,
                                  std::string_view parameter,
                                  double value) noexcept;
  std::optional<double> GetParameter(std::string_view name,
                                     std::string_view parameter) const noexcept;

  /// Replaces the levels below level 1 by one weighted QP, in which the weight
  /// of each level is `ratio` times that of the next one. Returns false and
  /// changes nothing if `ratio` is not 1 to kMostRatio.
  [[nodiscard]] bool set_weighted(bool weighted, double ratio = 100) noexcept;

  /// Sets the duration of a ramp: later changes of tasks take effect gradually
  /// in this time, see Easing. Pushes, references and unchanged limits still
  /// act in full. With 0, the default, a change takes effect at once. Returns
  /// false and changes nothing if `seconds` is negative or not finite.
  [[nodiscard]] bool set_ramp(double seconds) noexcept;

  /// Advances the ramp by dt, and records the solution of the last Write(). The
  /// next change is eased from this solution.
  void Advance(double dt, const Solution& solution) noexcept;
  /// Ends the ramp, for a tick without a solution. A change before the next
  /// Advance() takes effect at once.
  void EndRamp() noexcept { easing_.End(); }
  bool is_eased() const { return easing_.is_on(); }

  /// Returns the capacity that a Hierarchy and its solver need, whatever the
  /// settings of the tasks are: each level may have all rows. The last level is
  /// for Easing::Hold().
  std::vector<LevelCapacity> capacity() const;

  /// Returns the largest numbers of rows of all levels together, as each task
  /// is on one level only.
  LevelCapacity total_capacity() const;
  /// Returns the sum of both without the rows of Easing::Hold(): the argument
  /// max_leading_rows of Solver.
  int max_leading_rows() const;

  /// Clears the hierarchy and writes the rows of all enabled tasks.
  void Write(const TaskInput& input, Hierarchy* hierarchy) noexcept;

  /// Sizes the members of a report that depend on the tasks.
  void Resize(TickReport* report) const;

  /// Writes residuals, slacks and active rows of the last Write() to the
  /// report.
  void Report(const Solution& solution, TickReport* report) const noexcept;

  /// Returns the name of an inequality row; for a two-sided row, with the
  /// suffix of the active side: "left_foot.cop.x_max", "torque.l_knee.min",
  /// "left_foot.unilateral.fz.max". Allocates.
  std::string RowName(const ActiveRow& row) const;

  /// Returns the name of a row of the last Write(): an equality, or an
  /// inequality that is active on `side`. Empty if there is no such row.
  /// Allocates.
  std::string RowName(int hierarchy_level, int row, bool is_equality,
                      Side side) const;

  /// Returns the rows of all tasks, with the names of RowName() and
  /// equality_names(). A two-sided row appears twice, as .min and .max.
  /// Allocates.
  std::vector<StackRow> DescribeRows() const;

  /// Returns the priority level, 1 to kMaxLevel, of a level of the hierarchy,
  /// an index from 0, at the last Write(). The rows of Easing::Hold(), below
  /// all priority levels, have kMaxLevel + 1.
  int priority_level(int hierarchy_level) const {
    return priority_level_[hierarchy_level];
  }

 private:
  struct Entry {
    std::unique_ptr<Task> task;
    TaskSettings settings;
    int eased_rows = 0;  // Index of the first row in easing_.
    // Changes since the last Write(), and the values before them.
    bool was_switched_on = false;
    bool was_moved = false;
    bool was_tuned = false;
    std::vector<double> parameters_before;
    double weight_before = 1;
    // Whether and where the task has rows in the hierarchy of the last Write().
    bool takes_part = false;
    int hierarchy_level = -1;
    int equality_start = 0;
    int inequality_start = 0;
  };

  void ReserveRows(Hierarchy* hierarchy) const noexcept;
  void Tune(Entry* entry) noexcept;
  void Loosen(int level) noexcept;
  void BeginEasing(const TaskInput& input, const EqualityBlock& equalities,
                   const InequalityBlock& inequalities, Entry* entry) noexcept;
  EqualityBlock RowsBefore(const TaskInput& input, Entry* entry) noexcept;
  double RowWeight(const Entry& entry) const noexcept;
  void ReportInequalities(int i, const Solution& solution,
                          TickReport* report) const noexcept;

  // First priority level that may be less constrained since the last Write(),
  // because a task or limit at or above it was switched off, moved or tuned.
  // kTight means: no level.
  static constexpr int kTight = kMaxLevel + 1;

  int num_variables_;
  Easing easing_;
  int loose_from_ = kTight;
  // Largest numbers of rows of a task with equalities.
  LevelCapacity most_rows_;
  Hierarchy before_;  // Rows of one task before it was tuned.
  bool weighted_ = false;
  double level_ratio_ = 100;
  std::vector<Entry> entries_;
  int priority_level_[kMaxLevel + 1] = {};
  int num_levels_ = 0;
};

}  // namespace poise
