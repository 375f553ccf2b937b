// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/explanation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "tools/describe_row.h"
#include "tools/foot_story.h"
#include "tools/open_log.h"
#include "tools/run_summary.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr double kGap = 0.020;     // s: shorter pauses join two spans.
constexpr size_t kMostCauses = 5;  // Named in a sentence about a loss.
constexpr size_t kMostRows = 10;   // In one about a conflict.
// What contradicts itself is logged once in a while.
constexpr double kConflictLasts = 0.06;  // s.
constexpr double kShort = 0.005;         // s: not worth a sentence.
constexpr double kSmallLoss = 0.5;       // N, N m, m/s2: not worth a sentence.

// While something was so, and the worst of it.
struct Span {
  std::string name;
  double from, to, at, peak;
  std::vector<std::pair<std::string, double>> causes;
};

using Values = std::vector<std::pair<std::string, double>>;

// "a=1;b=-2", as the recorder writes it.
Values Parse(std::string_view cell) {
  Values values;
  while (!cell.empty()) {
    const size_t end = std::min(cell.find(';'), cell.size());
    const std::string_view item = cell.substr(0, end);
    const size_t equals = item.rfind('=');
    if (equals != std::string_view::npos) {
      values.emplace_back(
          item.substr(0, equals),
          std::strtod(std::string(item.substr(equals + 1)).c_str(), nullptr));
    }
    cell.remove_prefix(std::min(end + 1, cell.size()));
  }
  return values;
}

class Spans {
 public:
  void Add(const std::string& name, double time, double value,
           const Values& causes) {
    const auto [it, is_new] = open_.try_emplace(name, spans_.size());
    if (!is_new && time - spans_[it->second].to > kGap) {
      it->second = spans_.size();
    }
    if (it->second == spans_.size()) {
      spans_.push_back({name, time, time, time, 0, {}});
    }
    Span& span = spans_[it->second];
    span.to = time;
    if (std::abs(value) < std::abs(span.peak)) return;
    span.peak = value;
    span.at = time;
    span.causes = causes;
  }
  const std::vector<Span>& spans() const { return spans_; }

 private:
  std::vector<Span> spans_;
  std::map<std::string, size_t> open_;
};

Values HardestFirst(Values rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) > std::abs(b.second);
  });
  return rows;
}

// Of rows that contradict each other, those that bound, each as it acts: a
// conflict does not say how hard, nor, in older logs, on which side.
Values Constraints(const Values& rows, const Values& acting) {
  Values bounds;
  for (const auto& [name, rank] : rows) {
    if (DescribeRow(name) == name) continue;
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

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string UnitOfLoss(const std::string& name) {
  const std::string row = name.substr(name.rfind('.') + 1);
  if (name.rfind("momentum.", 0) == 0) return row[0] == 'k' ? "N m" : "N";
  return row[0] == 'w' ? "rad/s2" : "m/s2";
}

std::string Sentence(const Span& span) {
  return Format("%.3f s: ", span.from) + span.name +
         Format(" for %.0f ms", 1e3 * (span.to - span.from)) +
         Format(" (multiplier %.3g", std::abs(span.peak)) +
         Format(" at %.3f s).", span.at);
}

// What a list that ends early leaves unsaid.
std::string AndMore(size_t count, size_t said) {
  return count <= said ? "" : " and " + std::to_string(count - said) + " more";
}

std::string LossSentence(const Span& span) {
  std::string text = Format("%.3f s: ", span.from) + span.name + " gave up " +
                     Format("%.3g ", std::abs(span.peak)) +
                     UnitOfLoss(span.name) + Format(" (at %.3f s)", span.at);
  std::vector<std::string> said;
  for (const auto& [name, value] : span.causes) {
    const std::string cause = DescribeRow(name);
    if (std::find(said.begin(), said.end(), cause) != said.end()) continue;
    said.push_back(cause);
    if (said.size() > kMostCauses) continue;
    text += (said.size() == 1 ? ", because of " : ", ") + cause;
  }
  return text + AndMore(said.size(), kMostCauses) + ".";
}

// What to call a row among others of its task: constraints one by one, tasks by
// their name.
std::string Group(const std::string& name) {
  const std::string said = DescribeRow(name);
  return said != name ? said : Spaced(name.substr(0, name.rfind('.')));
}

// In the order of their ranks, the lowest first: it gave way.
std::string ConflictSentence(double time, Values rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.second > b.second;
  });
  std::string text;
  std::vector<std::string> said;
  for (const auto& [name, rank] : rows) {
    const std::string group = Group(name);
    if (std::find(said.begin(), said.end(), group) != said.end()) continue;
    said.push_back(group);
    if (said.size() > kMostRows) continue;
    text += (said.size() == 1 ? "" : "; ") + group;
    text += Format(" (rank %.0f)", rank);
  }
  return Format("%.3f s: cannot all be met: ", time) + text +
         AndMore(said.size(), kMostRows) + ".";
}

// Why a tick failed safe, after what happened.
std::string SayWhy(const std::string& reason) {
  if (reason == "state") return ": what it is told of the robot cannot be";
  if (reason == "clock") return ": the time of the robot's state stands still";
  if (reason == "no_answer") return ": no answer that meets the dynamics";
  return "";
}

// Whether a run was stopped while the robot was up: nobody saw the end.
bool WasInterrupted(const json& summary) {
  return summary.value("interrupted", json()) == true &&
         !summary.value("fell_at", json()).is_number();
}

std::string Ending(const json& summary) {
  if (!summary.contains("recovered")) return "How it ended is not recorded.";
  if (WasInterrupted(summary)) {
    const json at = summary.value("duration", json());
    return "The run was interrupted" +
           (at.is_number() ? Format(" at %.3f s", at.get<double>()) : "") +
           ", the robot still up: how it would have ended is not known.";
  }
  if (summary["recovered"] == true) return "The robot recovered.";
  const json fell_at = summary.value("fell_at", json());
  if (!fell_at.is_number()) {
    return "The robot stayed up, but did not come back to its place.";
  }
  const json by = summary.value("fell_by", json());
  return "The robot fell at " + Format("%.3f s", fell_at.get<double>()) +
         (by.is_string() && by != "" ? ": " + by.get<std::string>() : "") + ".";
}

}  // namespace

json Explain(const std::filesystem::path& run) {
  const std::filesystem::path log = FindLog(run);
  const std::unique_ptr<LogReader> opened = OpenLog(log);
  LogReader& reader = *opened;
  const auto time = reader.Find("time"), status = reader.Find("status"),
             active = reader.Find("active"), lost = reader.Find("lost"),
             conflict = reader.Find("conflict"), reason = reader.Find("reason");
  if (!time || !status || !active) {
    throw std::invalid_argument(log.string() +
                                ": has no columns time, status and active");
  }
  // Rows by name and, for the sentences, by what they mean: a friction pyramid
  // has four.
  Spans rows, said, losses, states;
  std::vector<FootStory> feet;
  for (const std::string name : {"left_foot", "right_foot"}) {
    feet.emplace_back(name, reader);
  }
  std::vector<std::pair<double, Values>> conflicts;
  bool has_rows = false;
  while (reader.Next()) {
    has_rows = true;
    const double t = reader.Number(*time);
    for (FootStory& foot : feet) foot.Look(t, reader);
    const Values acting = Parse(reader.cell(*active));
    for (const auto& [name, value] : acting) {
      rows.Add(name, t, value, {});
      said.Add(DescribeRow(name), t, value, {});
    }
    if (reader.cell(*status) != "ok") {
      std::string state(reader.cell(*status));
      if (reason) state.append(" ").append(reader.cell(*reason));
      states.Add(state, t, 1, {});
    }
    if (conflict && !reader.cell(*conflict).empty()) {
      conflicts.emplace_back(t, Parse(reader.cell(*conflict)));
    }
    if (!lost) continue;
    for (const auto& [name, value] : Parse(reader.cell(*lost))) {
      const bool is_known =
          !conflicts.empty() && t - conflicts.back().first < kConflictLasts;
      losses.Add(name, t, value,
                 is_known ? Constraints(conflicts.back().second, acting)
                          : HardestFirst(acting));
    }
  }

  json notes = json::array();
  if (reader.cut_short()) {
    notes.push_back(log.filename().string() +
                    " was cut short: its last row is not whole.");
  }
  const RunSummary read = ReadRunSummary(run);
  if (read.is_of_other_log) notes.push_back(read.note);
  const json summary = read.values.is_null() ? json::object() : read.values;
  json out = {
      {"recovered",
       WasInterrupted(summary) ? json() : summary.value("recovered", json())},
      {"fell_at", summary.value("fell_at", json())},
      {"notes", notes},
      {"rows", json::array()},
      {"losses", json::array()},
      {"conflicts", json::array()},
      {"status", json::array()},
      {"stance", json::array()},
      {"sentences", json::array()}};
  std::vector<std::pair<double, std::string>> sentences;
  for (const Span& span : rows.spans()) {
    out["rows"].push_back({{"name", span.name},
                           {"from", span.from},
                           {"to", span.to},
                           {"at", span.at},
                           {"multiplier", std::abs(span.peak)}});
  }
  for (const Span& span : said.spans()) {
    if (span.to - span.from < kShort) continue;
    sentences.emplace_back(span.from, Sentence(span));
  }
  for (const FootStory& foot : feet) {
    for (const FootStory::Phase& phase : foot.phases()) {
      out["stance"].push_back({{"foot", foot.foot()},
                               {"phase", phase.name},
                               {"from", phase.from},
                               {"to", phase.to}});
    }
    for (const auto& sentence : foot.Sentences()) sentences.push_back(sentence);
  }
  for (const Span& span : losses.spans()) {
    json because = json::array();
    for (const auto& [name, value] : span.causes) because.push_back(name);
    out["losses"].push_back({{"name", span.name},
                             {"from", span.from},
                             {"to", span.to},
                             {"at", span.at},
                             {"amount", span.peak},
                             {"unit", UnitOfLoss(span.name)},
                             {"because", because}});
    if (std::abs(span.peak) < kSmallLoss) continue;
    sentences.emplace_back(span.from, LossSentence(span));
  }
  std::string last;
  for (const auto& [at, found] : conflicts) {
    json names = json::array();
    for (const auto& [name, rank] : found) {
      names.push_back({{"name", name}, {"rank", rank}});
    }
    out["conflicts"].push_back({{"at", at}, {"rows", names}});
    // The same again is not said again.
    const std::string sentence = ConflictSentence(at, found);
    const std::string what = sentence.substr(sentence.find(':'));
    if (what != last) sentences.emplace_back(at, sentence);
    last = what;
  }
  for (const Span& span : states.spans()) {
    const std::string name = span.name.substr(0, span.name.find(' '));
    const std::string why =
        span.name.substr(std::min(name.size() + 1, span.name.size()));
    out["status"].push_back({{"name", name},
                             {"from", span.from},
                             {"to", span.to},
                             {"reason", why.empty() ? json() : json(why)}});
    sentences.emplace_back(
        span.from, Format("%.3f s: ", span.from) + "the controller says " +
                       Spaced(name) + Format(", until %.3f s", span.to) +
                       SayWhy(why) + ".");
  }
  std::stable_sort(
      sentences.begin(), sentences.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
  // What falling limbs press against explains nothing.
  const json fell_at = summary.value("fell_at", json());
  const double end = fell_at.is_number()
                         ? fell_at.get<double>()
                         : std::numeric_limits<double>::infinity();
  size_t left_out = 0;
  for (const auto& [when, text] : sentences) {
    if (when <= end) {
      out["sentences"].push_back(text);
    } else {
      ++left_out;
    }
  }
  if (sentences.empty()) {
    out["sentences"].push_back(
        has_rows ? "No row acted: every task got what it asked."
                 : log.filename().string() + " has a header and no rows.");
  }
  for (const json& note : notes) out["sentences"].push_back(note);
  out["sentences"].push_back(Ending(summary));
  if (left_out > 0) {
    out["sentences"].push_back(
        Format("After that, %.0f more; --json has its rows.",
               static_cast<double>(left_out)));
  }
  return out;
}

}  // namespace poise
