// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace poise {

/// Explains a recorded run: what happened, when and why. Times are in seconds.
/// `from` and `to` are the times at which the first and the last tick of an
/// interval begin. `at` is the time of the largest value.
///
///     rows       [{name, from, to, at, multiplier}]: intervals in which a row
///                was active, and its largest multiplier. Gaps below 20 ms do
///                not end an interval.
///     losses     [{name, from, to, at, amount, unit, because, while}]:
///                intervals in which a row of a task had a residual, and the
///                largest residual. `because` lists the constraints in the
///                nearest conflict within 60 ms. If the conflict has no
///                constraints, `because` lists its task rows of the same or a
///                higher level. If there is no conflict, `while` lists the
///                active constraints. The largest multiplier is first;
///                sentences name five rows.
///     conflicts  [{at, rows: [{name, level}]}]: minimal sets of rows that
///                contradict each other, if the log has them. `rank` is an
///                alias of `level`.
///     status     [{name, from, to, ticks, reason}]: intervals in which the
///                status was not "ok", apart from short pauses, and the number
///                of such ticks. See docs/log.md for reason; null if there is
///                none.
///     pushes     [{from, to, at, force}]: pushes, with the largest force, N.
///     touches    [{links, from, to}]: intervals in which two links touched.
///     stance     [{foot, phase, from, to}]: the phases of each foot in order
///                of time; see docs/log.md.
///     recovered, fell_at   from summary.json; null if summary.json is missing
///                or belongs to another log. recovered is also null if the run
///                was interrupted.
///     notes      [sentence, ...]: faults of the files: the log is cut short,
///                or the summary belongs to another log.
///     sentences  [sentence, ...]: the same for people, in order of time.
///     causes     [{task, kind, from, cost_Ns, rows: [{phrase, cost_Ns}]}]: the
///                limits that kept the momentum from its target, see
///                MomentumCost.
///     story      [sentence, ...]: a summary of at most six sentences, in order
///                of time.
///
/// Throws std::invalid_argument with the name of the file if there is no log,
/// or if the log does not have the columns of the controller.
nlohmann::json Explain(const std::filesystem::path& run);

}  // namespace poise
