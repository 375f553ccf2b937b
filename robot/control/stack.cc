// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stack.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "poise/robot/finding.h"

namespace poise {
namespace {

bool IsValidWeight(double weight) {
  return weight >= Stack::kLeastWeight && weight <= Stack::kMostWeight;
}

// Adds the numbers of rows of a task to a sum.
void AddRows(const Task& task, LevelCapacity* sum) {
  sum->equalities += static_cast<int>(task.equality_names().size());
  sum->inequalities += static_cast<int>(task.inequality_names().size());
}

}  // namespace

Stack::Stack(int num_variables)
    : num_variables_(num_variables),
      easing_(num_variables),
      before_(num_variables, {}) {}

void Stack::Add(std::unique_ptr<Task> task, const TaskSettings& settings) {
  const std::string what = "task " + Quoted(task->name()) + ": ";
  if (Find(task->name())) {
    throw std::invalid_argument(what + "exists already, must have a new name");
  }
  if (settings.level < 1 || settings.level > kMaxLevel) {
    throw std::invalid_argument(what + "level is " +
                                std::to_string(settings.level) +
                                ", must be 1 to " + std::to_string(kMaxLevel));
  }
  if (!IsValidWeight(settings.weight)) {
    throw std::invalid_argument(
        what + "weight is " + PrintNumber(settings.weight) + ", must be " +
        PrintNumber(kLeastWeight) + " to " + PrintNumber(kMostWeight));
  }
  Entry entry;
  entry.task = std::move(task);
  entry.settings = settings;
  entry.parameters_before.resize(entry.task->parameters().size());
  const int equalities = static_cast<int>(entry.task->equality_names().size());
  const int inequalities =
      static_cast<int>(entry.task->inequality_names().size());
  entry.eased_rows = easing_.AddTask(equalities, inequalities);
  if (equalities > 0) {
    most_rows_.equalities = std::max(most_rows_.equalities, equalities);
    most_rows_.inequalities = std::max(most_rows_.inequalities, inequalities);
    before_ = Hierarchy(num_variables_, {most_rows_});
  }
  entries_.push_back(std::move(entry));
}

std::optional<int> Stack::Find(std::string_view name) const noexcept {
  for (int i = 0; i < num_tasks(); ++i) {
    if (entries_[i].task->name() == name) return i;
  }
  return std::nullopt;
}

bool Stack::Enable(std::string_view name, bool enabled) noexcept {
  const auto i = Find(name);
  if (!i) return false;
  Entry& entry = entries_[*i];
  if (entry.settings.enabled == enabled) return true;
  // In one weighted QP, a level that is added or removed changes the weights of
  // all levels above it.
  if (!enabled || weighted_) Loosen(entry.settings.level);
  entry.was_switched_on |= enabled && !entry.takes_part;
  entry.settings.enabled = enabled;
  return true;
}

bool Stack::SetLevel(std::string_view name, int level) noexcept {
  const auto i = Find(name);
  if (!i || level < 1 || level > kMaxLevel) return false;
  Entry& entry = entries_[*i];
  if (entry.settings.level == level) return true;
  entry.was_moved = true;
  Loosen(std::min(entry.settings.level, level));
  entry.settings.level = level;
  return true;
}

bool Stack::SetWeight(std::string_view name, double weight) noexcept {
  const auto i = Find(name);
  if (!i || !IsValidWeight(weight)) return false;
  if (entries_[*i].settings.weight != weight) Tune(&entries_[*i]);
  entries_[*i].settings.weight = weight;
  return true;
}

bool Stack::SetParameter(std::string_view name, std::string_view parameter,
                         double value) noexcept {
  const auto i = Find(name);
  if (!i) return false;
  for (const Parameter& each : entries_[*i].task->parameters()) {
    if (each.name != parameter) continue;
    if (!(value >= each.lower && value <= each.upper)) return false;
    if (*each.value != value) Tune(&entries_[*i]);
    *each.value = value;
    return true;
  }
  return false;
}

std::optional<double> Stack::GetParameter(
    std::string_view name, std::string_view parameter) const noexcept {
  const auto i = Find(name);
  if (!i) return std::nullopt;
  for (const Parameter& each : entries_[*i].task->parameters()) {
    if (each.name == parameter) return *each.value;
  }
  return std::nullopt;
}

bool Stack::set_weighted(bool weighted, double ratio) noexcept {
  if (!(ratio >= 1 && ratio <= kMostRatio)) return false;
  weighted_ = weighted;
  level_ratio_ = ratio;
  return true;
}

bool Stack::set_ramp(double seconds) noexcept {
  if (!(seconds >= 0 && std::isfinite(seconds))) return false;
  easing_.set_duration(seconds);
  return true;
}

void Stack::Tune(Entry* entry) noexcept {
  if (entry->was_tuned) return;
  entry->was_tuned = true;
  entry->weight_before = entry->settings.weight;
  const std::vector<Parameter>& parameters = entry->task->parameters();
  for (size_t i = 0; i < parameters.size(); ++i) {
    entry->parameters_before[i] = *parameters[i].value;
  }
  // A tuned limit may be wider than before.
  if (entry->settings.enabled && !entry->task->inequality_names().empty()) {
    Loosen(entry->settings.level);
  }
}

void Stack::Loosen(int level) noexcept {
  loose_from_ = std::min(loose_from_, weighted_ ? std::min(level, 2) : level);
}

std::vector<LevelCapacity> Stack::capacity() const {
  LevelCapacity all = total_capacity();
  all.equalities -= num_variables_;
  std::vector<LevelCapacity> levels(kMaxLevel, all);
  levels.push_back({num_variables_, 0});
  return levels;
}

LevelCapacity Stack::total_capacity() const {
  LevelCapacity total{num_variables_, 0};  // Easing::Hold().
  for (const Entry& entry : entries_) AddRows(*entry.task, &total);
  return total;
}

int Stack::max_leading_rows() const {
  const LevelCapacity total = total_capacity();
  return total.equalities - num_variables_ + total.inequalities;
}

double Stack::RowWeight(const Entry& entry) const noexcept {
  if (!weighted_ || entry.settings.level == 1) return entry.settings.weight;
  int below = 0;
  for (int level = entry.settings.level + 1; level <= kMaxLevel; ++level) {
    below += std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.takes_part && e.settings.level == level;
    });
  }
  return entry.settings.weight * std::pow(level_ratio_, below);
}

void Stack::Write(const TaskInput& input, Hierarchy* hierarchy) noexcept {
  for (Entry& entry : entries_) {
    entry.hierarchy_level = -1;
    entry.takes_part = entry.settings.enabled && entry.task->HasRows(input);
  }
  // Each priority level in use becomes one level of the hierarchy. With one
  // weighted QP there are two levels: level 1 and the rest.
  num_levels_ = 0;
  for (int level = 1; level <= kMaxLevel; ++level) {
    bool used = false;
    for (Entry& entry : entries_) {
      if (entry.settings.level != level || !entry.takes_part) continue;
      entry.hierarchy_level =
          weighted_ ? std::min(num_levels_, 1) : num_levels_;
      used = true;
    }
    if (!used || (weighted_ && num_levels_ == 2)) continue;
    priority_level_[num_levels_++] = level;
  }

  const bool eases = easing_.IsPossible();
  if (eases && loose_from_ < kTight) easing_.KeepFree();
  ReserveRows(hierarchy);
  for (Entry& entry : entries_) {
    if (!entry.takes_part) continue;
    const Task& task = *entry.task;
    entry.equality_start = hierarchy->num_equalities(entry.hierarchy_level);
    entry.inequality_start = hierarchy->num_inequalities(entry.hierarchy_level);
    EqualityBlock equalities = hierarchy->AddEqualities(
        entry.hierarchy_level, static_cast<int>(task.equality_names().size()));
    InequalityBlock inequalities = hierarchy->AddInequalities(
        entry.hierarchy_level,
        static_cast<int>(task.inequality_names().size()));
    task.Write(input, &equalities, &inequalities);
    if (eases) BeginEasing(input, equalities, inequalities, &entry);
    if (easing_.is_on()) {
      // Equalities of level 1 are never eased; inequalities of level 1 may be.
      if (entry.settings.level > 1) easing_.Ease(entry.eased_rows, &equalities);
      easing_.Ease(entry.eased_rows, static_cast<int>(equalities.b.size()),
                   &inequalities);
    }
    const double weight = RowWeight(entry);
    if (weight == 1) continue;
    equalities.weight *= weight;
    // The solver has no weights for slacks: the row is scaled instead.
    const double scale = std::sqrt(weight);
    inequalities.C *= scale;
    inequalities.lower *= scale;
    inequalities.upper *= scale;
  }
  if (easing_.holds()) {
    priority_level_[num_levels_] = kMaxLevel + 1;
    EqualityBlock held = hierarchy->AddEqualities(num_levels_, num_variables_);
    easing_.Hold(&held);
  }
  hierarchy->FindSpans();
  loose_from_ = kTight;
  for (Entry& entry : entries_) {
    entry.was_switched_on = entry.was_moved = entry.was_tuned = false;
  }
}

// Clears the hierarchy, with room for the rows that Write() adds.
void Stack::ReserveRows(Hierarchy* hierarchy) const noexcept {
  LevelCapacity rows[kMaxLevel + 1];
  for (const Entry& entry : entries_) {
    if (entry.takes_part) AddRows(*entry.task, &rows[entry.hierarchy_level]);
  }
  if (easing_.holds()) rows[num_levels_].equalities = num_variables_;
  hierarchy->Clear(num_levels_ + (easing_.holds() ? 1 : 0), rows);
}

void Stack::BeginEasing(const TaskInput& input, const EqualityBlock& equalities,
                        const InequalityBlock& inequalities,
                        Entry* entry) noexcept {
  const int rows = entry->eased_rows;
  const int num_equalities = static_cast<int>(equalities.b.size());
  if (entry->settings.level > 1) {
    if (entry->settings.level >= loose_from_) {
      easing_.KeepResiduals(rows, num_equalities);
    }
    if (entry->was_switched_on) {
      easing_.BeginAtLast(rows, equalities);
    } else if (entry->was_tuned && num_equalities > 0) {
      easing_.BeginAsBefore(rows, equalities, RowsBefore(input, entry),
                            entry->weight_before / entry->settings.weight);
    }
  }
  if (entry->was_switched_on || entry->was_moved || entry->was_tuned) {
    easing_.BeginInside(rows, num_equalities, inequalities);
  }
}

// Returns the rows that the task would write now if it had not been tuned.
// pre: the task has equalities.
EqualityBlock Stack::RowsBefore(const TaskInput& input, Entry* entry) noexcept {
  const Task& task = *entry->task;
  const auto exchange = [&] {
    for (size_t i = 0; i < task.parameters().size(); ++i) {
      std::swap(*task.parameters()[i].value, entry->parameters_before[i]);
    }
  };
  before_.Clear(1);
  EqualityBlock equalities =
      before_.AddEqualities(0, static_cast<int>(task.equality_names().size()));
  InequalityBlock inequalities = before_.AddInequalities(
      0, static_cast<int>(task.inequality_names().size()));
  exchange();
  task.Write(input, &equalities, &inequalities);
  exchange();
  return equalities;
}

void Stack::Advance(double dt, const Solution& solution) noexcept {
  easing_.Advance(dt, solution.y);
  for (const Entry& entry : entries_) {
    if (!entry.takes_part) continue;
    const LevelSolution& level = solution.levels[entry.hierarchy_level];
    const int equalities =
        static_cast<int>(entry.task->equality_names().size());
    const int inequalities =
        static_cast<int>(entry.task->inequality_names().size());
    easing_.Remember(
        entry.eased_rows,
        level.equality_residual.segment(entry.equality_start, equalities),
        level.slack.segment(entry.inequality_start, inequalities),
        std::sqrt(RowWeight(entry)));
  }
}

}  // namespace poise
