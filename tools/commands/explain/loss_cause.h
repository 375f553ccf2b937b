// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <set>
#include <string>

#include "poise/tools/commands/explain/row_phrases.h"
#include "poise/tools/commands/explain/run_story.h"

namespace poise {

/// Why a row of a task was not met.
struct LossCause {
  bool is_known = false;    ///< Or the rows are what else was so, no more.
  bool has_levels = false;  ///< The rows are of tasks, with their levels.
  Values rows;              ///< Hardest first; of levels, the last.
};

/// Whether a row is a constraint, and no target of a task: by its description or,
/// without one, because the log lists the row as active at some time.
bool IsConstraint(const std::string& name, const std::set<std::string>& active,
                  const RowPhrases& phrases);

/// What the nearest conflict says: the constraints in it or, where there are none,
/// the tasks that come before. Where no conflict is known, the constraints that
/// acted, of which none need press on the task.
LossCause FindCause(const Span& loss, const RunStory& story,
                    const RowPhrases& phrases);

}  // namespace poise
