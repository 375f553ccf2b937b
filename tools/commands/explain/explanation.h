// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace poise {

/// Says of a recorded run when, what and why: which rows of the hierarchy came
/// to act, what each task lost to them, how the ticks ended, and how the run
/// did.
///
///     rows       [{name, from, to, at, multiplier}]: while a row acted (gaps
///                below 20 ms, or of a tick, are none), and when its multiplier
///                was largest. Here and below, from and to are the times at
///                which the first and the last of its ticks begin.
///     losses     [{name, from, to, at, amount, unit, because, while}]: while a
///                row of a task was not met, and the worst of it; of the nearest
///                conflict within 60 ms, the constraints or, where there are
///                none, the rows of tasks that come before; where there is no
///                conflict, the constraints that acted. Hardest first; sentences name five.
///     conflicts  [{at, rows: [{name, level}]}]: rows that contradict each other,
///                none of which can be spared, where the log has them. `rank`
///                is an alias of `level`.
///     status     [{name, from, to, reason}]: where it was not "ok"; reason as
///                in docs/log.md, null where there is none.
///     pushes     [{from, to, at, force}]: while something pushed, N, at its most.
///     touches    [{links, from, to}]: while two links pressed on each other.
///     stance     [{foot, phase, from, to}]: the phases of each foot, in the
///                order of time; see docs/log.md.
///     recovered, fell_at   from summary.json; null where there is none of this
///                log, and recovered where the run was interrupted.
///     notes      [sentence, ...]: that the log was cut, or is not the summary's.
///     sentences  the same for a person, in the order of time.
///     causes     [{task, kind, from, cost_Ns, rows: [{phrase, cost_Ns}]}]: what
///                kept the momentum from its target, see MomentumCost.
///     story      [sentence, ...]: the run in at most six sentences, in order of
///                cause.
///
/// Throws std::invalid_argument, naming the file, if there is no log, or it
/// does not hold what the controller said.
nlohmann::json Explain(const std::filesystem::path& run);

}  // namespace poise
