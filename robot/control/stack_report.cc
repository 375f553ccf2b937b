// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Stack reports solutions and names its rows here; stack.cc writes the rows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/robot/control/stack.h"

namespace poise {
namespace {

// Multipliers and slacks below this are rounding.
constexpr double kNoticeable = 1e-6;

// A target with a residual above this is reported as lost, in the scale of its
// row.
constexpr double kNoticeableLoss = 1e-4;

// Returns the name of an inequality row that is active on a side.
std::string SidedName(const Task& task, int row, Side side) {
  const std::string& name = task.inequality_names()[row];
  if (!task.is_two_sided()) return name;
  return name + (side == Side::kLower ? ".min" : ".max");
}

}  // namespace

void Stack::Resize(TickReport* report) const {
  int equalities = 0;
  int inequalities = 0;
  for (const Entry& entry : entries_) {
    equalities += static_cast<int>(entry.task->equality_names().size());
    inequalities += static_cast<int>(entry.task->inequality_names().size());
  }
  report->y = Eigen::VectorXd::Zero(num_variables_);
  report->tasks.assign(num_tasks(), {});
  report->gap.assign(kMaxLevel, std::numeric_limits<double>::quiet_NaN());
  report->active.clear();
  report->active.reserve(inequalities);
  report->lost.clear();
  report->lost.reserve(equalities);
}

void Stack::Report(const Solution& solution,
                   TickReport* report) const noexcept {
  report->y = solution.y;
  report->solver_status = solution.status;
  report->iterations = solution.iterations;
  report->failed_level =
      solution.failed_level < 0 ? 0 : priority_level_[solution.failed_level];
  std::fill(report->gap.begin(), report->gap.end(),
            std::numeric_limits<double>::quiet_NaN());
  for (int level = 0; level < num_levels_; ++level) {
    report->gap[priority_level_[level] - 1] = solution.levels[level].gap;
  }
  report->active.clear();
  report->lost.clear();
  for (int i = 0; i < num_tasks(); ++i) {
    const Entry& entry = entries_[i];
    TaskReport& out = report->tasks[i];
    out = {entry.settings.enabled, entry.settings.level, 0, 0};
    if (!entry.takes_part) continue;
    const int rows = static_cast<int>(entry.task->equality_names().size());
    out.residual = solution.levels[entry.hierarchy_level]
                       .equality_residual.segment(entry.equality_start, rows)
                       .norm();
    ReportInequalities(i, solution, report);
    if (entry.hierarchy_level + 1 == num_levels_) continue;
    for (int row = 0; row < rows; ++row) {
      const double residual =
          solution.levels[entry.hierarchy_level]
              .equality_residual[entry.equality_start + row];
      if (std::abs(residual) < kNoticeableLoss) continue;
      report->lost.push_back(
          {i, row, residual * entry.task->equality_scale(row)});
    }
  }
}

void Stack::ReportInequalities(int i, const Solution& solution,
                               TickReport* report) const noexcept {
  const Entry& entry = entries_[i];
  const LevelSolution& level = solution.levels[entry.hierarchy_level];
  const double scale = std::sqrt(RowWeight(entry));
  const int rows = static_cast<int>(entry.task->inequality_names().size());
  const int solved =
      solution.failed_level < 0 ? num_levels_ : solution.failed_level;
  for (int row = 0; row < rows; ++row) {
    const int index = entry.inequality_start + row;
    // The multiplier of a level on a row of the same level is the slack.
    ActiveRow active{i,
                     row,
                     level.active[index],
                     entry.settings.level,
                     level.slack[index],
                     level.slack[index] / scale};
    // The first level with a multiplier counts. It already holds the row, so
    // the multipliers of lower levels may have any size. So may those of levels
    // without an optimum.
    for (int k = entry.hierarchy_level + 1;
         k < solved && active.multiplier <= kNoticeable; ++k) {
      const double multiplier = solution.levels[k]
                                    .multipliers[entry.hierarchy_level]
                                    .inequality[index];
      if (std::abs(multiplier) <= kNoticeable) continue;
      active.multiplier = std::abs(multiplier);
      active.pressing_level = priority_level_[k];
      active.side = multiplier > 0 ? Side::kUpper : Side::kLower;
    }
    report->tasks[i].slack = std::max(report->tasks[i].slack, active.slack);
    if (active.multiplier > kNoticeable) report->active.push_back(active);
  }
}

std::string Stack::RowName(const ActiveRow& row) const {
  return SidedName(task(row.task), row.row, row.side);
}

std::string Stack::RowName(int hierarchy_level, int row, bool is_equality,
                           Side side) const {
  for (const Entry& entry : entries_) {
    if (!entry.takes_part || entry.hierarchy_level != hierarchy_level) continue;
    const Task& task = *entry.task;
    const auto& names =
        is_equality ? task.equality_names() : task.inequality_names();
    const int i =
        row - (is_equality ? entry.equality_start : entry.inequality_start);
    if (i < 0 || i >= static_cast<int>(names.size())) continue;
    return is_equality ? names[i] : SidedName(task, i, side);
  }
  return "";
}

std::vector<StackRow> Stack::DescribeRows() const {
  std::vector<StackRow> rows;
  for (const Entry& entry : entries_) {
    const Task& task = *entry.task;
    for (const RowDescription& row : task.equalities()) {
      rows.push_back({task.name(), row});
    }
    for (size_t i = 0; i < task.inequalities().size(); ++i) {
      const RowDescription& row = task.inequalities()[i];
      if (!task.is_two_sided()) {
        rows.push_back({task.name(), row});
        continue;
      }
      for (const Side side : {Side::kLower, Side::kUpper}) {
        RowDescription sided = row;
        sided.name = SidedName(task, static_cast<int>(i), side);
        if (!row.phrase.empty()) {
          sided.phrase += side == Side::kLower ? " at its lower limit"
                                               : " at its upper limit";
        }
        rows.push_back({task.name(), sided});
      }
    }
  }
  return rows;
}

}  // namespace poise
