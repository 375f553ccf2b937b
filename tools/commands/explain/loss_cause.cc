// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/loss_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace poise {
namespace {

// Longest time between a loss and the conflict that explains it. The log has a
// conflict every 50 ms.
constexpr double kConflictLasts = 0.06;  // s.

Values HardestFirst(Values rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) > std::abs(b.second);
  });
  return rows;
}

// Returns the constraints of a conflict, with their names and multipliers as in
// `acting`. A conflict has no multipliers. In older logs it also does not say
// which side of a constraint is meant.
Values Constraints(const Values& rows, const Values& acting,
                   const RunStory& story, const RowPhrases& phrases) {
  Values bounds;
  for (const auto& [name, level] : rows) {
    if (!IsConstraint(name, story.constraints, phrases)) continue;
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

// Returns the level of a task in a conflict, if the conflict has its rows.
std::optional<double> LevelOf(const std::string& task, const Values& rows,
                              const RowPhrases& phrases) {
  for (const auto& [name, level] : rows) {
    if (phrases.task(name) == task) return level;
  }
  return std::nullopt;
}

// Returns the conflict nearest in time that contains the task of a loss. If
// there is none, returns the nearest of all conflicts. That conflict is about
// the highest level with a residual, and such a conflict also restricts all
// levels below.
const LoggedConflict* FindNearest(const Span& loss, const RunStory& story,
                                  const RowPhrases& phrases) {
  const std::string task = phrases.task(loss.name);
  for (const bool is_part : {true, false}) {
    const LoggedConflict* nearest = nullptr;
    double least = kConflictLasts;
    for (const LoggedConflict& conflict : story.conflicts) {
      const double away = std::abs(conflict.time - loss.at);
      if (away >= least ||
          (is_part && !LevelOf(task, conflict.levels, phrases)))
        continue;
      nearest = &conflict;
      least = away;
    }
    if (nearest != nullptr) return nearest;
  }
  return nullptr;
}

}  // namespace

bool IsConstraint(const std::string& name, const std::set<std::string>& active,
                  const RowPhrases& phrases) {
  if (phrases.is_described(name)) return phrases.is_limit(name);
  // Only constraints are ever active. In older logs a conflict has no suffix
  // ".min" or ".max".
  return active.count(name) > 0 || active.count(name + ".min") > 0 ||
         active.count(name + ".max") > 0;
}

LossCause FindCause(const Span& loss, const RunStory& story,
                    const RowPhrases& phrases) {
  const LoggedConflict* nearest = FindNearest(loss, story, phrases);
  if (nearest == nullptr) return {false, false, HardestFirst(loss.with)};
  LossCause cause{true, false,
                  Constraints(nearest->levels, loss.with, story, phrases)};
  if (!cause.rows.empty()) return cause;
  cause.has_levels = true;
  const std::string task = phrases.task(loss.name);
  const double own_level =
      LevelOf(task, nearest->levels, phrases)
          .value_or(std::numeric_limits<double>::infinity());
  for (const auto& [name, level] : nearest->levels) {
    if (phrases.task(name) != task && level <= own_level) {
      cause.rows.emplace_back(name, level);
    }
  }
  // The lowest level is the nearest one, so its rows come first.
  cause.rows = HardestFirst(cause.rows);
  return cause;
}

}  // namespace poise
