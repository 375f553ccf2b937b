// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "tools/commands/explain/run_story.h"

namespace poise {

/// Why a row of a task was not met.
struct LossCause {
  bool is_known = false;   ///< Or the rows are what else was so, no more.
  bool has_ranks = false;  ///< The rows are of tasks, with their ranks.
  Values rows;             ///< Hardest first; of ranks, the lowest.
};

/// The unit of what a row of a task lost, by what the row is called; of a joint, as
/// of one that turns.
std::string UnitOfLoss(const std::string& name);

/// What the nearest conflict says: the constraints in it or, where there are none,
/// the tasks that come before. Where no conflict is known, the constraints that
/// acted, of which none need press on the task.
LossCause FindCause(const Span& loss, const RunStory& story);

}  // namespace poise
