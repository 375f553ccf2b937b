// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/run_story.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "poise/robot/finding.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/log/open_log.h"

namespace poise {
namespace {

// Maximum time between two successive ticks, in tick periods.
constexpr double kNextTick = 1.5;

// Parses a cell such as "a=1;b=-2".
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

// Returns a text cell of the current row, valid until the next row is read.
// Throws std::invalid_argument if the cell is not UTF-8.
std::string_view Text(const LogReader& reader, int column) {
  const std::string_view cell = reader.cell(column);
  if (IsUtf8(cell)) return cell;
  throw std::invalid_argument(reader.place() + ": " + reader.columns()[column] +
                              " is " + Quoted(cell) + ", is not UTF-8");
}

// Returns the columns of a vector, or nothing if one of them is missing.
std::vector<int> FindAll(const LogReader& reader,
                         std::initializer_list<std::string> names) {
  std::vector<int> columns;
  for (const std::string& name : names) {
    const auto column = reader.Find(name);
    if (!column) return {};
    columns.push_back(*column);
  }
  return columns;
}

void AddPush(const LogReader& reader, const std::vector<int>& columns,
             const LogTick& tick, Spans* pushes) {
  Values parts;
  double square = 0;
  for (const int column : columns) {
    const double part = reader.Number(column);
    parts.emplace_back(reader.columns()[column], part);
    square += part * part;
  }
  // Rounding may leave a force at the end of a push.
  constexpr double kLeast = 1e-6;  // N.
  if (square > kLeast * kLeast)
    pushes->Add("push", tick, std::sqrt(square), parts);
}

// Parses a cell such as "a|b;c|d" and adds each pair of links.
void AddTouches(std::string_view cell, const LogTick& tick, Spans* touches) {
  while (!cell.empty()) {
    const size_t end = std::min(cell.find(';'), cell.size());
    touches->Add(std::string(cell.substr(0, end)), tick, 1, {});
    cell.remove_prefix(std::min(end + 1, cell.size()));
  }
}

// Returns the sum of some columns, or NaN if there are no columns.
double Sum(const LogReader& reader, const std::vector<int>& columns) {
  if (columns.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const int column : columns) sum += reader.Number(column);
  return sum;
}

// Returns the time from the first row to the second, s, or 0 if there are fewer
// than two rows.
double FindPeriod(const std::filesystem::path& log, int time) {
  const std::unique_ptr<LogReader> reader = OpenLog(log);
  if (!reader->Next()) return 0;
  const double first = reader->Number(time);
  return reader->Next() ? std::max(0.0, reader->Number(time) - first) : 0;
}

}  // namespace

void Spans::Add(const std::string& name, const LogTick& tick, double value,
                const Values& with) {
  const double gap = std::max(pause_, kNextTick * tick.period);
  const auto [it, is_new] = open_.try_emplace(name, spans_.size());
  if (!is_new && tick.time - spans_[it->second].to > gap) {
    it->second = spans_.size();
  }
  if (it->second == spans_.size()) {
    spans_.push_back({name, tick.time, tick.time, tick.time, 0, 0, {}});
  }
  Span& span = spans_[it->second];
  if (span.num_ticks == 0 || tick.time > span.to) ++span.num_ticks;
  span.to = tick.time;
  span.end = tick.time + tick.period;
  if (std::abs(value) < std::abs(span.peak)) return;
  span.peak = value;
  span.at = tick.time;
  span.with = with;
}

RunStory ReadRunStory(const std::filesystem::path& log,
                      const RowPhrases& phrases, double fell_at,
                      LogReader* opened) {
  LogReader& reader = *opened;
  const auto time = reader.Find(kTimeColumn),
             status = reader.Find(kStatusColumn),
             active = reader.Find(kActiveColumn),
             lost = reader.Find(kLostColumn),
             conflict = reader.Find(kConflictColumn),
             reason = reader.Find(kReasonColumn),
             touching = reader.Find(kTouchingColumn);
  if (!time || !status || !active) {
    throw std::invalid_argument(
        log.string() + ": must have the columns time, status and active");
  }
  const std::vector<int> push =
      FindAll(reader, {PushColumn('x'), PushColumn('y'), PushColumn('z')});
  const std::vector<int> loads = FindAll(
      reader, {ForceColumn("left_foot", 'z'), ForceColumn("right_foot", 'z')});
  RunStory story;
  for (const std::string name : {"left_foot", "right_foot"}) {
    story.feet.emplace_back(name, reader);
  }
  const double period = FindPeriod(log, *time);
  while (reader.Next()) {
    story.has_rows = true;
    const LogTick tick{reader.Number(*time), period};
    for (FootStory& foot : story.feet) foot.Look(tick.time, reader);
    AddPush(reader, push, tick, &story.pushes);
    if (touching) AddTouches(Text(reader, *touching), tick, &story.touches);
    const Values acting = Parse(Text(reader, *active));
    for (const auto& [name, value] : acting) {
      story.rows.Add(name, tick, value, {});
      story.said.Add(phrases.phrase(name), tick, value, {});
      story.constraints.insert(name);
    }
    if (Text(reader, *status) != "ok") {
      std::string state(reader.cell(*status));
      if (reason) state.append(" ").append(Text(reader, *reason));
      story.states.Add(state, tick, 1, {});
    }
    const Values conflicting =
        conflict ? Parse(Text(reader, *conflict)) : Values();
    if (!conflicting.empty()) {
      story.conflicts.push_back({tick.time, conflicting});
    }
    const Values missed = lost ? Parse(Text(reader, *lost)) : Values();
    for (const auto& [name, value] : missed) {
      story.losses.Add(name, tick, value, acting);
    }
    if (tick.time > fell_at) continue;
    story.momentum.Look(tick.time, period, phrases, acting, missed, conflicting,
                        Sum(reader, loads));
  }
  return story;
}

}  // namespace poise
