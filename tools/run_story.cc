// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/run_story.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "tools/describe_row.h"

namespace poise {
namespace {

constexpr double kGap = 0.020;  // s: shorter pauses join two spans.
// What contradicts itself is logged once in a while.
constexpr double kConflictLasts = 0.06;  // s.

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

}  // namespace

void Spans::Add(const std::string& name, double time, double value,
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

RunStory ReadRunStory(const std::filesystem::path& log, LogReader* opened) {
  LogReader& reader = *opened;
  const auto time = reader.Find("time"), status = reader.Find("status"),
             active = reader.Find("active"), lost = reader.Find("lost"),
             conflict = reader.Find("conflict"), reason = reader.Find("reason");
  if (!time || !status || !active) {
    throw std::invalid_argument(log.string() +
                                ": has no columns time, status and active");
  }
  RunStory story;
  for (const std::string name : {"left_foot", "right_foot"}) {
    story.feet.emplace_back(name, reader);
  }
  while (reader.Next()) {
    story.has_rows = true;
    const double t = reader.Number(*time);
    for (FootStory& foot : story.feet) foot.Look(t, reader);
    const Values acting = Parse(reader.cell(*active));
    for (const auto& [name, value] : acting) {
      story.rows.Add(name, t, value, {});
      story.said.Add(DescribeRow(name), t, value, {});
    }
    if (reader.cell(*status) != "ok") {
      std::string state(reader.cell(*status));
      if (reason) state.append(" ").append(reader.cell(*reason));
      story.states.Add(state, t, 1, {});
    }
    if (conflict && !reader.cell(*conflict).empty()) {
      story.conflicts.emplace_back(t, Parse(reader.cell(*conflict)));
    }
    if (!lost) continue;
    for (const auto& [name, value] : Parse(reader.cell(*lost))) {
      const bool is_known = !story.conflicts.empty() &&
                            t - story.conflicts.back().first < kConflictLasts;
      story.losses.Add(name, t, value,
                       is_known
                           ? Constraints(story.conflicts.back().second, acting)
                           : HardestFirst(acting));
    }
  }
  return story;
}

}  // namespace poise
