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

/// Place of a task in the hierarchy.
struct TaskSettings {
  bool enabled = true;
  int level = 1;      ///< 1 is the highest; at most Stack::kMaxLevel.
  double weight = 1;  ///< Among the tasks of its level; see Stack::kMostWeight.
};

/// A row of a stack under the name that the log uses, and its task.
struct StackRow {
  std::string task;
  RowDescription row;
};

/// The tasks of a controller in their order of priority. Any of them may be
/// switched, moved to another level, weighted or tuned by name between two
/// ticks: that takes effect at the next Write(), and does not allocate.
class Stack {
 public:
  static constexpr int kMaxLevel = 8;
  /// Weights outside [1e-6, 1e6] lose all digits to rounding and slow the active-set
  /// search.
  static constexpr double kLeastWeight = 1e-6;
  static constexpr double kMostWeight = 1e6;
  static constexpr double kMostRatio = 1e6;  ///< For set_weighted().

  /// Makes a stack for rows in num_variables variables.
  explicit Stack(int num_variables);

  /// Adds a task; only before the first tick. Throws std::invalid_argument if the
  /// name exists already or a setting is out of range.
  void Add(std::unique_ptr<Task> task, const TaskSettings& settings);

  int num_tasks() const { return static_cast<int>(entries_.size()); }
  const Task& task(int i) const { return *entries_[i].task; }
  const TaskSettings& settings(int i) const { return entries_[i].settings; }
  std::optional<int> Find(std::string_view name) const noexcept;

  /// Each returns false, and changes nothing, if the task or parameter does not exist
  /// or the value is out of its range.
  [[nodiscard]] bool Enable(std::string_view name, bool enabled) noexcept;
  [[nodiscard]] bool SetLevel(std::string_view name, int level) noexcept;
  [[nodiscard]] bool SetWeight(std::string_view name, double weight) noexcept;
  [[nodiscard]] bool SetParameter(std::string_view name,
                                  std::string_view parameter,
                                  double value) noexcept;
  std::optional<double> GetParameter(std::string_view name,
                                     std::string_view parameter) const noexcept;

  /// One weighted QP below level 1 instead of a hierarchy: each level counts
  /// `ratio` times the next. False, and nothing happens, if that is not 1 to
  /// kMostRatio.
  [[nodiscard]] bool set_weighted(bool weighted, double ratio = 100) noexcept;

  /// Sets the time in which later changes of tasks take effect, s, see Easing.
  /// Unchanged rows, references and limits are not delayed. With 0, the default,
  /// a change acts at once. Returns false, and changes nothing, if `seconds` is
  /// negative or not finite.
  [[nodiscard]] bool set_ramp(double seconds) noexcept;

  /// A tick of dt has found this for the last Write(), or nothing: then what is
  /// changed next is changed at once.
  void Advance(double dt, const Solution& solution) noexcept;
  void EndRamp() noexcept { easing_.End(); }
  bool is_eased() const { return easing_.is_on(); }

  /// Returns the capacity of a Hierarchy and its solver that suffices for every
  /// setting of the tasks.
  std::vector<LevelCapacity> capacity() const;

  /// Clears the hierarchy and writes the rows of the tasks that are on.
  void Write(const TaskInput& input, Hierarchy* hierarchy) noexcept;

  /// Sizes the members of a report that depend on the tasks.
  void Resize(TickReport* report) const;

  /// Copies into the report what became of the rows of the last Write().
  void Report(const Solution& solution, TickReport* report) const noexcept;

  /// An inequality row by name; of a row with two sides, which one:
  /// "left_foot.cop.x_max", "torque.l_knee.min", "left_foot.unilateral.fz.max".
  /// Allocates.
  std::string RowName(const ActiveRow& row) const;

  /// A row of the last Write() by name, an equality or, as it acts on a side, an
  /// inequality; empty if there is none. Allocates.
  std::string RowName(int hierarchy_level, int row, bool is_equality,
                      Side side) const;

  /// The rows of all tasks, by the names that RowName() and equality_names() have:
  /// a row with two sides is there twice, as .min and .max. Allocates.
  std::vector<StackRow> DescribeRows() const;

  /// Priority level, 1 to kMaxLevel, of the rows that the last Write() put into a
  /// level of the hierarchy, an index from 0. Rows that a ramp holds below all
  /// priority levels have kMaxLevel + 1.
  int priority_level(int hierarchy_level) const {
    return priority_level_[hierarchy_level];
  }

 private:
  struct Entry {
    std::unique_ptr<Task> task;
    TaskSettings settings;
    int eased_rows = 0;  // First index, see Easing.
    // Changes since the last Write(), and the settings before.
    bool was_switched_on = false;
    bool was_moved = false;
    bool was_tuned = false;
    std::vector<double> parameters_before;
    double weight_before = 1;
    // Rows of the last Write().
    bool takes_part = false;
    int hierarchy_level = -1;
    int equality_start = 0;
    int inequality_start = 0;
  };

  void Tune(Entry* entry) noexcept;
  void Loosen(int level) noexcept;
  void BeginEasing(const TaskInput& input, const EqualityBlock& equalities,
                   const InequalityBlock& inequalities, Entry* entry) noexcept;
  EqualityBlock RowsBefore(const TaskInput& input, Entry* entry) noexcept;
  double RowWeight(const Entry& entry) const noexcept;
  void ReportInequalities(int i, const Solution& solution,
                          TickReport* report) const noexcept;

  // First priority level that may be less constrained since the last Write(), as
  // a task or limit above was switched off or widened; kTight if none.
  static constexpr int kTight = kMaxLevel + 1;

  int num_variables_;
  Easing easing_;
  int loose_from_ = kTight;
  LevelCapacity most_rows_;  // Largest task.
  Hierarchy before_;         // One task's rows before a change.
  bool weighted_ = false;
  double level_ratio_ = 100;
  std::vector<Entry> entries_;
  int priority_level_[kMaxLevel + 1] = {};
  int num_levels_ = 0;
};

}  // namespace poise
