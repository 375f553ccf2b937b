// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/foot_story.h"
#include "tools/log_reader.h"

namespace poise {

/// Names of rows, each with a number.
using Values = std::vector<std::pair<std::string, double>>;

/// While something was so, and the worst of it.
struct Span {
  std::string name;
  double from, to, at, peak;
  Values causes;
};

/// Spans by name, as rows of a log are added in the order of time; short pauses
/// join two.
class Spans {
 public:
  void Add(const std::string& name, double time, double value,
           const Values& causes);
  const std::vector<Span>& spans() const { return spans_; }

 private:
  std::vector<Span> spans_;
  std::map<std::string, size_t> open_;
};

/// What a log tells of a run.
struct RunStory {
  Spans rows;    ///< That acted, with their multipliers.
  Spans said;    ///< By what they mean: a friction pyramid has four.
  Spans losses;  ///< Of rows of tasks, each with what pressed then.
  Spans states;  ///< Where the status was not ok: that, and the reason.
  std::vector<FootStory> feet;
  std::vector<std::pair<double, Values>> conflicts;  ///< At a time, s: ranks.
  bool has_rows = false;
};

/// Reads all rows of a log. Throws std::invalid_argument, naming the file, if it
/// does not hold what the controller said.
RunStory ReadRunStory(const std::filesystem::path& log, LogReader* reader);

}  // namespace poise
