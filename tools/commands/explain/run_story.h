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

/// Start and period of a tick of a log, s.
struct LogTick {
  double time, period;
};

/// An interval in which a named state lasted, and its largest value.
struct Span {
  std::string name;
  /// `from` and `to`: times at which the first and the last tick begin, s.
  /// `peak`: the value with the largest magnitude, with its sign. `at`: its
  /// time, s.
  double from, to, at, peak;
  double end;         ///< End of the last tick, s.
  Values with;        ///< Other values at the time `at`.
  int num_ticks = 0;  ///< Ticks in the state, without those of pauses.

  double lasted() const { return end - from; }
};

/// Collects spans by name, from rows of a log in order of time. A short pause
/// does not end a span.
class Spans {
 public:
  /// @param pause  longest short pause, s.
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
  double time;  ///< Time of the tick, s.
  Values levels;
};

/// The contents of a log as spans.
struct RunStory {
  Spans rows;  ///< Active rows by name, with their multipliers.
  Spans said;  ///< Active rows by phrase. Several rows may share a phrase, as
               ///< the four rows of a friction pyramid.
  std::set<std::string> constraints;  ///< Rows that were active, by name.
  Spans losses;     ///< Residuals of task rows, with the active rows.
  Spans states;     ///< Status other than ok; the name is "STATUS REASON".
  Spans pushes{0};  ///< Norm of the push force, N, with its components.
  Spans touches;    ///< Two links that touch: "a|b".
  std::vector<FootStory> feet;
  std::vector<LoggedConflict> conflicts;
  MomentumCost momentum;  ///< Up to the fall.
  bool has_rows = false;
};

/// Reads all rows of a log. Throws std::invalid_argument with the name of the
/// file if the log does not have the columns of the controller. Also throws,
/// with the row, if a text is not UTF-8.
///
/// @param fell_at  time at which the robot fell, s; infinite if it did not
///                 fall.
RunStory ReadRunStory(const std::filesystem::path& log,
                      const RowPhrases& phrases, double fell_at,
                      LogReader* reader);

}  // namespace poise
