// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "poise/sim/log/log_reader.h"
#include "poise/tools/commands/explain/foot_story.h"
#include "poise/tools/commands/explain/momentum_cost.h"
#include "poise/tools/commands/explain/row_phrases.h"

namespace poise {

/// Names of rows, each with a number.
using Values = std::vector<std::pair<std::string, double>>;

/// A tick of a log: when it began, and how long it took, s.
struct LogTick {
  double time, period;
};

/// While something was so, and the worst of it.
struct Span {
  std::string name;
  double from, to, at,
      peak;     ///< `from`, `to`: where its first and last tick begin.
  double end;   ///< Of its last tick.
  Values with;  ///< What else was so at the worst of it.

  double lasted() const { return end - from; }
};

/// Spans by name, as rows of a log are added in the order of time; short pauses
/// join two, one of a tick always.
class Spans {
 public:
  /// Pauses of up to this, s, are short.
  explicit Spans(double pause = 0.020) : pause_(pause) {}

  void Add(const std::string& name, const LogTick& tick, double value,
           const Values& with);
  const std::vector<Span>& spans() const { return spans_; }

 private:
  double pause_;
  std::vector<Span> spans_;
  std::map<std::string, size_t> open_;
};

/// Rows that contradict each other, with their levels.
struct LoggedConflict {
  double time;  ///< s.
  Values levels;
};

/// What a log tells of a run.
struct RunStory {
  Spans rows;  ///< That acted, with their multipliers.
  Spans said;  ///< By what they mean: a friction pyramid has four.
  std::set<std::string> constraints;  ///< Rows that were active, by name.
  Spans losses;     ///< Of rows of tasks, each with the rows that acted then.
  Spans states;     ///< Where the status was not ok: that, and the reason.
  Spans pushes{0};  ///< Their force, N, with its parts.
  Spans touches;    ///< Of two links: "a|b".
  std::vector<FootStory> feet;
  std::vector<LoggedConflict> conflicts;
  MomentumCost momentum;  ///< Up to the fall.
  bool has_rows = false;
};

/// Reads all rows of a log; fell_at is when the robot fell, s, or infinite. Throws std::invalid_argument, naming the file, if it
/// does not hold what the controller said; and the row, if that is no UTF-8.
RunStory ReadRunStory(const std::filesystem::path& log,
                      const RowPhrases& phrases, double fell_at,
                      LogReader* reader);

}  // namespace poise
