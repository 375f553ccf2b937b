// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/truncated_ticks.h"

#include <algorithm>
#include <map>
#include <vector>

#include "poise/tools/commands/format.h"

namespace poise {
namespace {

using nlohmann::json;

// The state of a truncated tick, before the number of the level.
std::string State() { return "truncated " + std::string(kLevelReason); }

// Returns the ticks by the first level that was not solved.
std::map<std::string, int> CountByLevel(const RunStory& story) {
  std::map<std::string, int> ticks;
  for (const Span& span : story.states.spans()) {
    if (span.name.rfind(State(), 0) != 0) continue;
    ticks[span.name.substr(State().size())] += span.num_ticks;
  }
  return ticks;
}

bool IsTruncatedBefore(double time, const RunStory& story) {
  const std::vector<Span>& spans = story.states.spans();
  return std::any_of(spans.begin(), spans.end(), [&](const Span& span) {
    return span.from < time && span.name.rfind(State(), 0) == 0;
  });
}

// Returns the budget, us, or 0 if no solve took so long: a limit of iterations
// may end solves, too.
double FindBudget(const json& summary) {
  const json hqp = summary.value("hqp", json::object());
  if (!hqp.is_object()) return 0;
  const auto number = [](const json& object, const char* key, double absent) {
    const json value = object.is_object() ? object.value(key, json()) : json();
    return value.is_number() ? value.get<double>() : absent;
  };
  const double budget = number(hqp, "budget_us", 0);
  if (hqp.value("budget_clock", json()) == json(true)) return budget;
  return number(hqp.value("modelled_us", json()), "max", budget) >= budget
             ? budget
             : 0;
}

}  // namespace

std::string SayTruncated(const RunStory& story, const json& summary) {
  int sum = 0;
  std::string levels;
  for (const auto& [level, ticks] : CountByLevel(story)) {
    levels += (sum == 0 ? ": level " : ", level ") + level + " in " +
              std::to_string(ticks);
    sum += ticks;
  }
  if (sum == 0) return "";
  std::string text = std::to_string(sum);
  const json all = summary.value("ticks", json());
  if (all.is_number_integer()) text += " of " + all.dump();
  text += sum == 1 && !all.is_number_integer() ? " tick" : " ticks";
  text += sum == 1 ? " was" : " were";
  text += " not solved to the last level";
  const double budget = FindBudget(summary);
  if (budget > 0) {
    text += Format(" with a budget of %g us", budget);
  }
  text += levels + ".";
  const json fell_at = summary.value("fell_at", json());
  const bool may_have_helped = budget > 0 && fell_at.is_number() &&
                               IsTruncatedBefore(fell_at.get<double>(), story);
  return may_have_helped ? text + " A larger budget may have helped." : text;
}

}  // namespace poise
