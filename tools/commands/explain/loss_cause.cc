// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/commands/explain/loss_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/commands/explain/describe_row.h"

namespace poise {
namespace {

// What contradicts itself is logged once in a while.
constexpr double kConflictLasts = 0.06;  // s.

// The task that a row is of, as its name begins.
std::string TaskOf(const std::string& row) {
  return row.substr(0, row.rfind('.'));
}

Values HardestFirst(Values rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) > std::abs(b.second);
  });
  return rows;
}

// Of rows that contradict each other, those that bound, each as it acts: a
// conflict does not say how hard, nor, in older logs, on which side.
Values Constraints(const Values& rows, const Values& acting) {
  Values bounds;
  for (const auto& [name, rank] : rows) {
    if (DescribeRow(name) == name) continue;
    bounds.emplace_back(name, 0);
    for (const auto& acts : acting) {
      if (acts.first == name || acts.first == name + ".min" ||
          acts.first == name + ".max") {
        bounds.back() = acts;
      }
    }
  }
  return HardestFirst(bounds);
}

// The rank of a task among rows that contradict each other.
std::optional<double> RankOf(const std::string& task, const Values& rows) {
  for (const auto& [name, rank] : rows) {
    if (TaskOf(name) == task) return rank;
  }
  return std::nullopt;
}

// The nearest conflict that the task of a loss is part of or, where there is none,
// the nearest of all: it is of the highest rank that was not met, and what comes
// after that is left with less, too.
const LoggedConflict* FindNearest(const Span& loss, const RunStory& story) {
  const std::string task = TaskOf(loss.name);
  for (const bool is_part : {true, false}) {
    const LoggedConflict* nearest = nullptr;
    double least = kConflictLasts;
    for (const LoggedConflict& conflict : story.conflicts) {
      const double away = std::abs(conflict.time - loss.at);
      if (away >= least || (is_part && !RankOf(task, conflict.ranks))) continue;
      nearest = &conflict;
      least = away;
    }
    if (nearest != nullptr) return nearest;
  }
  return nullptr;
}

}  // namespace

std::string UnitOfLoss(const std::string& name) {
  const std::string task = name.substr(0, name.find('.'));
  const std::string row = name.substr(name.rfind('.') + 1);
  if (task == "torque_minimization") return "N m";
  if (task == "posture" || task == "light_joints" || task == "mimic") {
    return "rad/s2";
  }
  switch (row.empty() ? '\0' : row[0]) {
    case 'k':
    case 'm':
      return "N m";
    case 'l':
    case 'f':
      return "N";
    case 'w':
      return "rad/s2";
    default:
      return "m/s2";
  }
}

LossCause FindCause(const Span& loss, const RunStory& story) {
  const LoggedConflict* nearest = FindNearest(loss, story);
  if (nearest == nullptr) return {false, false, HardestFirst(loss.with)};
  LossCause cause{true, false, Constraints(nearest->ranks, loss.with)};
  if (!cause.rows.empty()) return cause;
  cause.has_ranks = true;
  const std::string task = TaskOf(loss.name);
  const double own_rank =
      RankOf(task, nearest->ranks)
          .value_or(std::numeric_limits<double>::infinity());
  for (const auto& [name, rank] : nearest->ranks) {
    if (TaskOf(name) != task && rank <= own_rank) {
      cause.rows.emplace_back(name, rank);
    }
  }
  cause.rows = HardestFirst(cause.rows);  // The lowest rank, the nearest.
  return cause;
}

}  // namespace poise
