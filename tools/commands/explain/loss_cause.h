// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <set>
#include <string>

#include "poise/tools/commands/explain/row_phrases.h"
#include "poise/tools/commands/explain/run_story.h"

namespace poise {

/// The cause of the residual of a task row.
struct LossCause {
  bool is_known = false;    ///< False: `rows` only lists active constraints.
  bool has_levels = false;  ///< Each number in `rows` is a level.
  Values rows;              ///< Largest multiplier or level first.
};

/// Returns true if a row is a constraint and false if it is a target of a task.
/// The description of the row decides. A row without a description is a
/// constraint if the log lists it as active at some time.
bool IsConstraint(const std::string& name, const std::set<std::string>& active,
                  const RowPhrases& phrases);

/// Finds the cause of a loss in the nearest conflict. The cause is the
/// constraints of the conflict. If it has none, the cause is its tasks of the
/// same or a higher level. Without a conflict, the rows are the active
/// constraints, which need not be related to the task.
LossCause FindCause(const Span& loss, const RunStory& story,
                    const RowPhrases& phrases);

}  // namespace poise
