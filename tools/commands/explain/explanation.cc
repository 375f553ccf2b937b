// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/explanation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string_view>

#include "poise/sim/log/open_log.h"
#include "poise/sim/log/run_summary.h"
#include "poise/tools/commands/explain/ending.h"
#include "poise/tools/commands/explain/foot_story.h"
#include "poise/tools/commands/explain/loss_cause.h"
#include "poise/tools/commands/explain/momentum_cost.h"
#include "poise/tools/commands/explain/row_phrases.h"
#include "poise/tools/commands/explain/run_story.h"
#include "poise/tools/commands/explain/short_story.h"
#include "poise/tools/commands/explain/truncated_ticks.h"
#include "poise/tools/commands/format.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr size_t kMostCauses = 5;   // Maximum in a sentence about a loss.
constexpr size_t kMostRows = 10;    // Maximum in a sentence about a conflict.
constexpr double kShort = 0.005;    // s. Shorter events get no sentence.
constexpr double kRounding = 1e-6;  // s, rounding of a sum of ticks.
constexpr double kSmallLoss = 0.5;  // N, N m, m/s2. Less gets no sentence.

std::string Milliseconds(double seconds) {
  return Format(" for %.0f ms", 1e3 * seconds);
}

std::string Sentence(const Span& span) {
  return Format("%.3f s: active constraint: ", span.from) + span.name +
         Milliseconds(span.lasted()) +
         Format(" (largest multiplier %.3g", std::abs(span.peak)) +
         Format(" at %.3f s).", span.at);
}

// Returns how many entries a shortened list omits, as text.
std::string AndMore(size_t count, size_t said) {
  return count <= said ? "" : " and " + std::to_string(count - said) + " more";
}

// Names a row in a list. A constraint has its own name; rows of a task share
// the name of the task.
std::string Group(const std::string& name, const RunStory& story,
                  const RowPhrases& phrases) {
  return IsConstraint(name, story.constraints, phrases)
             ? phrases.phrase(name)
             : Spaced(phrases.task(name));
}

std::string LossSentence(const Span& span, const LossCause& cause,
                         const RunStory& story, const RowPhrases& phrases) {
  const std::string unit = phrases.unit(span.name);
  std::string text =
      Format("%.3f s: ", span.from) + phrases.phrase(span.name) +
      " missed its target by up to " + Format("%.3g", std::abs(span.peak)) +
      (unit.empty() ? "" : " " + unit) + Format(" (at %.3f s)", span.at);
  const char* begin =
      cause.is_known ? ", because of " : ", with active constraints ";
  std::vector<std::string> said;
  for (const auto& [name, value] : cause.rows) {
    const std::string row = Group(name, story, phrases);
    if (std::find(said.begin(), said.end(), row) != said.end()) continue;
    said.push_back(row);
    if (said.size() > kMostCauses) continue;
    text += (said.size() == 1 ? begin : ", ") + row;
    if (cause.has_levels) text += Format(" (level %.0f)", value);
  }
  text += AndMore(said.size(), kMostCauses);
  if (!cause.is_known && !said.empty()) text += " (perhaps not the cause)";
  return text + ".";
}

// Sorts the rows by level, the lowest priority first, because the other rows
// violate the rows of that level.
std::string ConflictSentence(double time, Values rows, const RunStory& story,
                             const RowPhrases& phrases) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.second > b.second;
  });
  std::string text;
  std::vector<std::string> said;
  for (const auto& [name, level] : rows) {
    const std::string group = Group(name, story, phrases);
    if (std::find(said.begin(), said.end(), group) != said.end()) continue;
    said.push_back(group);
    if (said.size() > kMostRows) continue;
    text += (said.size() == 1 ? "" : "; ") + group;
    text += Format(" (level %.0f)", level);
  }
  return Format("%.3f s: these requirements contradict each other: ", time) +
         text + AndMore(said.size(), kMostRows) + ".";
}

// Returns the reason of a status other than ok, as the end of a sentence.
std::string SayWhy(const std::string& reason, const RowPhrases& phrases) {
  if (reason.rfind(kLevelReason, 0) == 0) {
    return ": level " + reason.substr(kLevelReason.size()) +
           " and the levels below it are not solved";
  }
  if (reason == "state")
    return ": the robot's state is invalid (not finite, too large, or the "
           "quaternion is not normalized)";
  if (reason == "clock") return ": the time of the robot's state stands still";
  if (reason == "no_answer") {
    return ": the solver has no solution that satisfies the dynamics, or a row "
           "is not finite";
  }
  if (!reason.empty())
    return ": the most violated limit is " + phrases.phrase(reason);
  return "";
}

// Returns " in 5 of 12 ticks" if a state has pauses.
std::string SayShare(const Span& span) {
  const double period = span.end - span.to;
  if (period <= 0) return "";
  const long all = std::lround(span.lasted() / period);
  if (span.num_ticks >= all) return "";
  return " in " + std::to_string(span.num_ticks) + " of " +
         std::to_string(all) + " ticks";
}

using Sentences = std::vector<std::pair<double, std::string>>;  // By time, s.

// Each of the next seven functions returns one list of Explain() and appends
// the sentences about the list.
json ExplainRows(const RunStory& story, Sentences* sentences) {
  json out = json::array();
  for (const Span& span : story.rows.spans()) {
    out.push_back({{"name", span.name},
                   {"from", span.from},
                   {"to", span.to},
                   {"at", span.at},
                   {"multiplier", std::abs(span.peak)}});
  }
  for (const Span& span : story.said.spans()) {
    if (span.lasted() < kShort - kRounding) continue;
    sentences->emplace_back(span.from, Sentence(span));
  }
  return out;
}

json ExplainStance(const RunStory& story, Sentences* sentences) {
  json out = json::array();
  for (const FootStory& foot : story.feet) {
    for (const FootStory::Phase& phase : foot.phases()) {
      out.push_back({{"foot", foot.foot()},
                     {"phase", phase.name},
                     {"from", phase.from},
                     {"to", phase.to}});
    }
    for (const auto& sentence : foot.Sentences()) {
      sentences->push_back(sentence);
    }
    for (const FootStory::Step& step : foot.steps()) {
      sentences->emplace_back(step.at, SayStep(foot.foot(), step));
    }
  }
  return out;
}

json ExplainLosses(const RunStory& story, const RowPhrases& phrases,
                   Sentences* sentences) {
  json out = json::array();
  for (const Span& span : story.losses.spans()) {
    const LossCause cause = FindCause(span, story, phrases);
    json names = json::array();
    for (const auto& [name, value] : cause.rows) names.push_back(name);
    out.push_back({{"name", span.name},
                   {"from", span.from},
                   {"to", span.to},
                   {"at", span.at},
                   {"amount", span.peak},
                   {"unit", phrases.unit(span.name)},
                   {"because", cause.is_known ? names : json::array()},
                   {"while", cause.is_known ? json::array() : names}});
    if (std::abs(span.peak) < kSmallLoss) continue;
    sentences->emplace_back(span.from,
                            LossSentence(span, cause, story, phrases));
  }
  return out;
}

json ExplainConflicts(const RunStory& story, const RowPhrases& phrases,
                      Sentences* sentences) {
  json out = json::array();
  std::string last;
  for (const auto& [at, found] : story.conflicts) {
    json names = json::array();
    for (const auto& [name, level] : found) {
      names.push_back({{"name", name}, {"level", level}, {"rank", level}});
    }
    out.push_back({{"at", at}, {"rows", names}});
    // A repeated conflict gets one sentence only.
    const std::string sentence = ConflictSentence(at, found, story, phrases);
    const std::string what = sentence.substr(sentence.find(':'));
    if (what != last) sentences->emplace_back(at, sentence);
    last = what;
  }
  return out;
}

json ExplainStatus(const RunStory& story, const RowPhrases& phrases,
                   Sentences* sentences) {
  json out = json::array();
  for (const Span& span : story.states.spans()) {
    const std::string name = span.name.substr(0, span.name.find(' '));
    const std::string why =
        span.name.substr(std::min(name.size() + 1, span.name.size()));
    out.push_back({{"name", name},
                   {"from", span.from},
                   {"to", span.to},
                   {"ticks", span.num_ticks},
                   {"reason", why.empty() ? json() : json(why)}});
    sentences->emplace_back(span.from, Format("%.3f s: ", span.from) +
                                           "the controller reports " +
                                           Spaced(name) + SayShare(span) +
                                           Format(" until %.3f s", span.to) +
                                           SayWhy(why, phrases) + ".");
  }
  return out;
}

json ExplainPushes(const RunStory& story, Sentences* sentences) {
  json out = json::array();
  for (const Span& span : story.pushes.spans()) {
    json force = json::array();
    for (const auto& [name, part] : span.with) force.push_back(part);
    out.push_back({{"from", span.from},
                   {"to", span.to},
                   {"at", span.at},
                   {"force", force}});
    sentences->emplace_back(
        span.from,
        Format("%.3f s: the robot is pushed with ", span.from) +
            Format(span.peak < 100 ? "%.3g N," : "%.0f N,", span.peak) +
            Milliseconds(span.lasted()) + ".");
  }
  return out;
}

json ExplainTouches(const RunStory& story, Sentences* sentences) {
  json out = json::array();
  for (const Span& span : story.touches.spans()) {
    const size_t bar = std::min(span.name.find('|'), span.name.size());
    const std::string a = span.name.substr(0, bar);
    const std::string b = span.name.substr(std::min(bar + 1, span.name.size()));
    out.push_back({{"links", {a, b}}, {"from", span.from}, {"to", span.to}});
    sentences->emplace_back(
        span.from, Format("%.3f s: ", span.from) + Spaced(a) + " touches " +
                       Spaced(b) + "," + Milliseconds(span.lasted()) + ".");
  }
  return out;
}

json ExplainCauses(const RunStory& story) {
  json out = json::array();
  for (const MomentumCause& cause : story.momentum.Causes()) {
    json rows = json::array();
    for (const auto& [phrase, cost] : cause.rows) {
      rows.push_back({{"phrase", phrase}, {"cost_Ns", cost}});
    }
    out.push_back({{"task", cause.task},
                   {"kind", cause.kind},
                   {"from", cause.from},
                   {"cost_Ns", cause.cost},
                   {"rows", rows}});
  }
  return out;
}

// Returns a sentence for a run without a sentence about constraints or tasks.
std::string SayNothing(const RunStory& story) {
  std::set<std::string> rows, losses;
  for (const Span& span : story.rows.spans()) rows.insert(span.name);
  for (const Span& span : story.losses.spans()) losses.insert(span.name);
  if (rows.empty() && losses.empty()) {
    return "No constraint was active, and every task reached its target.";
  }
  const auto count = [](const std::set<std::string>& names, const char* did) {
    const char* noun = names.size() == 1 ? " row that " : " rows that ";
    return std::to_string(names.size()) + noun + did;
  };
  std::string text = "No event lasted for 5 ms; --json lists ";
  if (!rows.empty()) text += count(rows, "became active");
  if (!rows.empty() && !losses.empty()) text += " and ";
  if (!losses.empty())
    text += count(losses, "missed a target by less than 0.5");
  return text + ".";
}

// Appends the sentences to `out` in order of time, up to the fall. Contacts of
// a falling robot explain nothing. Returns the number of sentences after the
// fall.
size_t SayInOrder(const json& summary, Sentences sentences, json* out) {
  std::stable_sort(
      sentences.begin(), sentences.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
  const json fell_at = summary.value("fell_at", json());
  const double end = fell_at.is_number()
                         ? fell_at.get<double>()
                         : std::numeric_limits<double>::infinity();
  size_t left_out = 0;
  for (const auto& [when, text] : sentences) {
    if (when <= end) {
      out->push_back(text);
    } else {
      ++left_out;
    }
  }
  return left_out;
}

}  // namespace

json Explain(const std::filesystem::path& run) {
  const std::filesystem::path log = FindLog(run);
  const std::unique_ptr<LogReader> reader = OpenLog(log);
  const RunSummary read = ReadRunSummary(run);
  const json summary = read.values.is_null() ? json::object() : read.values;
  const RowPhrases phrases(summary);
  const json fell_at = summary.value("fell_at", json());
  const RunStory story = ReadRunStory(
      log, phrases,
      fell_at.is_number() ? fell_at.get<double>()
                          : std::numeric_limits<double>::infinity(),
      reader.get());

  json notes = json::array();
  if (reader->cut_short()) {
    notes.push_back(log.filename().string() +
                    " was cut short: its last row is incomplete.");
  }
  const std::string unknown =
      read.note.empty() ? ""
                        : read.note +
                              " So the outcome of the run is not known, and "
                              "rows have their names in the log.";

  json out = {
      {"recovered",
       WasInterrupted(summary) ? json() : summary.value("recovered", json())},
      {"fell_at", fell_at},
      {"notes", notes}};
  // Sentences with the same time keep this order.
  Sentences sentences;
  out["rows"] = ExplainRows(story, &sentences);
  out["stance"] = ExplainStance(story, &sentences);
  out["losses"] = ExplainLosses(story, phrases, &sentences);
  out["conflicts"] = ExplainConflicts(story, phrases, &sentences);
  out["status"] = ExplainStatus(story, phrases, &sentences);

  const bool is_quiet = sentences.empty();
  out["pushes"] = ExplainPushes(story, &sentences);
  out["touches"] = ExplainTouches(story, &sentences);

  json said = json::array();
  if (!unknown.empty()) said.push_back(unknown);
  const size_t left_out = SayInOrder(summary, sentences, &said);
  const std::string said_of_quiet =
      story.has_rows ? SayNothing(story)
                     : log.filename().string() + " has a header and no rows.";
  if (is_quiet) said.push_back(said_of_quiet);
  const std::string truncated = SayTruncated(story, summary);
  if (!truncated.empty()) said.push_back(truncated);
  for (const json& note : notes) said.push_back(note);
  said.push_back(Ending(summary));
  if (left_out > 0) {
    said.push_back(Format("Events after the fall: %.0f. --json lists them.",
                          static_cast<double>(left_out)));
  }
  out["sentences"] = said;
  out["causes"] = ExplainCauses(story);
  std::vector<std::string> must_be_said;
  if (is_quiet) must_be_said.push_back(said_of_quiet);
  if (!truncated.empty()) must_be_said.push_back(truncated);
  for (const json& note : notes) must_be_said.push_back(note);
  std::vector<std::string> story_told =
      TellShortStory(story, summary, must_be_said, Ending(summary));
  if (!unknown.empty()) {
    story_told.insert(story_told.begin(), unknown);
    out["notes"].push_back(unknown);
  }
  out["story"] = story_told;
  return out;
}

}  // namespace poise
